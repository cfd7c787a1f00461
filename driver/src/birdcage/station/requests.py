"""What a face may ask of the station. Frozen; angles are true degrees unless a name says otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from birdcage.base.config import Settings
from birdcage.rotator.feature import Value
from birdcage.rotator.verdict import Grade
from birdcage.station.pursuit_state import PursuitOptions
from birdcage.station.run_request import Run as Run  # noqa: PLC0414 - faces ask for it by this module
from birdcage.station.setting_requests import ReadSettings as ReadSettings  # noqa: PLC0414
from birdcage.station.setting_requests import SaveSettings as SaveSettings  # noqa: PLC0414
from birdcage.station.setting_requests import WriteSettings as WriteSettings  # noqa: PLC0414
from birdcage.station.sync_request import Sync as Sync  # noqa: PLC0414
from birdcage.station.task_state import TaskValue

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan


@dataclass(frozen=True, slots=True)
class Goto:
    """Point there, exactly, once. Its future resolves at arrival with a `Pointing`."""

    az_deg: float
    el_deg: float
    holder: str
    clamp: bool = False
    """Move to the nearest allowed elevation instead of refusing one outside the limits."""
    take_over: bool = False
    """Take control from whoever has it, visibly; what is refused takes nothing, and ends no pursuit."""
    asked: bool = True
    """Whether a person asks for it; if not, MotionRefused (`not_now`) while the owner's command says so."""
    resume_within_s: float = 0.0
    """Whether it also lets go of HELD: where only a lost link has taken control from this holder, for so long at most,
    and the dish is at rest where it was left. 0: a person has to release it."""


@dataclass(frozen=True, slots=True)
class Follow:
    """One target of a stream (less than 3 s apart, one holder); the only motion that may be leap-frogged."""

    az_deg: float
    el_deg: float
    holder: str
    leapfrog: bool = False
    clamp: bool = False
    """As in `Goto`."""
    asked: bool = True
    """As in `Goto`."""
    resume_within_s: float = 0.0
    """As in `Goto`."""


@dataclass(frozen=True, slots=True)
class Pursue:
    """Carry out a plan: pre-position, wait, follow, and what `options.at_end` says.

    Its future resolves when the pursuit is taken on, with its number; `StationState.pursuit` tells the rest. A plan for
    the same target and pass as the pursuit under way replaces its plan, and nothing begins anew: so a refined share or
    another time offset comes in. Any other ends the one under way.
    """

    plan: Plan
    holder: str
    options: PursuitOptions = field(default_factory=PursuitOptions)
    asked: bool = True
    """Whether a person has asked for it just now; if not, even its first motion counts down."""
    renews: int | None = None
    """The number of the pursuit for which this is only a better plan: where that one is over, nothing begins anew."""


@dataclass(frozen=True, slots=True)
class EndPursuit:
    """End the pursuit; the dish stays where it is, and comes to rest. Nothing happens when there is none."""

    by: str


@dataclass(frozen=True, slots=True)
class Drive:
    """Keep the dish going in a direction: while this is asked for again within 0.6 s, and no longer.

    The dish gets targets a little ahead of it, so it comes to rest by itself whatever becomes of whoever asks.
    """

    az: int
    """-1, 0 or 1: clockwise positive."""
    el: int
    """-1, 0 or 1: up positive."""
    holder: str


@dataclass(frozen=True, slots=True)
class EndMotion:
    """Stop what `holder` set in motion, end its tasks and give its control back. Other holders keep theirs."""

    holder: str


@dataclass(frozen=True, slots=True)
class BeginTask:
    """Begin a task of a kind that this station was given (`StationSettings.tasks`); resolves with its number.

    CommandRefused (`unknown`, `bad_parameter`): there is no such kind, or it does not take these values.
    """

    kind: str
    values: Mapping[str, TaskValue]
    """By the names of its fields."""
    holder: str
    asked: bool = True
    """Whether a person has asked for it just now; if not, its first motion counts down."""


@dataclass(frozen=True, slots=True)
class ResumeTask:
    """Take up what the program before this one did not finish (`StationState.kept_task`); resolves with its number.

    CommandRefused (`absent`) if there is nothing.
    """

    by: str


@dataclass(frozen=True, slots=True)
class DropTask:
    """What the program before this one did not finish is not taken up any more."""

    by: str


@dataclass(frozen=True, slots=True)
class Jog:
    """Step from the last *commanded* target: ten presses are ten steps."""

    d_az_deg: float
    d_el_deg: float
    holder: str
    take_over: bool = False
    """As in `Goto`."""


@dataclass(frozen=True, slots=True)
class TurnSkew:
    """Turn the feed about the beam to this angle of the dish's skew axis. Its future resolves at arrival.

    MotionRefused (`unsupported`) on a dish without that axis (`StationState.dish.skew` is None).
    """

    deg: float
    holder: str
    take_over: bool = False
    """As in `Goto`."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Stop everything and hold. `Station.stop` sends its first bytes from the caller's own thread."""

    by: str


@dataclass(frozen=True, slots=True)
class Release:
    """Let go of HELD."""

    by: str


@dataclass(frozen=True, slots=True)
class Home:
    """Find the references by running into the stops. `axes` are motor numbers; both when empty."""

    holder: str
    axes: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class ReleaseMotors:
    """Take the current off the motors: the dish may fall under its own weight, and its position is then unknown."""

    holder: str


@dataclass(frozen=True, slots=True)
class Engage:
    """Put the current back on the motors. Where the dish is stays unknown until it is homed."""

    holder: str


@dataclass(frozen=True, slots=True)
class Stow:
    """Fold the dish flat with the firmware's own command. MotionRefused unless the active feed allows it."""

    holder: str


@dataclass(frozen=True, slots=True)
class Park:
    """Go to a park position, on the turn of the cable nearest its middle. Its future resolves once the dish is there.

    Never stows. Control is given back at the end.
    """

    az_deg: float
    el_deg: float
    holder: str
    asked: bool = True
    """Whether somebody has asked for it just now; if not, it counts down."""


@dataclass(frozen=True, slots=True)
class SetSpeed:
    """Set the greatest speed of an axis (a motor number), in deg/s, until the dish restarts."""

    axis: int
    speed_deg_s: float
    holder: str


@dataclass(frozen=True, slots=True)
class Read:
    """Ask the dish for some of its features (`StationState.dish.features`) now; no control is needed.

    Its future resolves with a mapping of id to `Reading`: what the dish did not tell is left out.
    """

    features: tuple[str, ...]
    agreed: bool = False
    """Whether a person was told what reading them does (`read_hazard`), and agreed. Else ConfirmationNeeded."""


@dataclass(frozen=True, slots=True)
class Set:
    """Write a feature of the dish; its future resolves with the `Reading` that was read back."""

    feature: str
    value: Value
    """True for one that is momentary."""
    holder: str
    agreed: bool = False
    """Whether a person was told the feature's `hazard`, and agreed. ConfirmationNeeded if it has one and none did."""


@dataclass(frozen=True, slots=True)
class Raw:
    """One line for the dish's own console, exempt from the limits. Its future resolves with a `RawReply`.

    It takes the lease (`console`). Held for a line that moves the dish while STOP is latched. A line sent while another
    one still prints ends that one with a bare Enter.
    """

    line: str
    holder: str = "console"
    confirmed: Grade = Grade.HARMLESS
    """How bad a person was told that it is. ConfirmationNeeded when it is worse in the menu that the dish is in now."""


@dataclass(frozen=True, slots=True)
class ListCommands:
    """Ask the dish for the commands of its present menu (`?`); resolves with a tuple of `MenuCommand`."""

    holder: str = "console"


@dataclass(frozen=True, slots=True)
class ProbePort:
    """Listen at several baud rates, the present one first; resolves with a tuple of `BaudFinding`. Moves nothing."""

    bauds: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Connect:
    """Use another port or baud rate from now on. Not while the dish moves."""

    port: str
    baud: int | None = None


@dataclass(frozen=True, slots=True)
class ApplySettings:
    """Take limits, alignment and feed from these settings from now on. Not while the dish moves."""

    settings: Settings
    by: str


@dataclass(frozen=True, slots=True)
class ReloadSettings:
    """Read birdcage.toml again, and take limits, alignment and feed from it as `ApplySettings` does.

    For programs that are attached, which have written there. CommandRefused where the station's program reads another
    file, or none.
    """

    file: str
    """The file that was written, as an absolute path."""


@dataclass(frozen=True, slots=True)
class SetSearch:
    """Switch the firmware's own TV search off, or walk that back (see `Facts.search_switch`).

    By a setting: for good, after a backup of the dish's settings, with effect from the next power cycle on; its future
    resolves with the path of the backup. Where it can only be ended while it runs, that is done at once, and the future
    resolves with None; giving it back is then CommandRefused (`unsupported`): it begins by itself at power-up.
    """

    holder: str
    disabled: bool


@dataclass(frozen=True, slots=True)
class AcquireLease:
    """Take control as `holder`; `take_over` takes it from another holder, visibly."""

    holder: str
    take_over: bool = False
    for_s: float | None = None
    """It ends by itself after so long; None: not before it is given back. Asking again begins anew."""


@dataclass(frozen=True, slots=True)
class ReleaseLease:
    """Give control back."""

    holder: str


@dataclass(frozen=True, slots=True)
class Watch:
    """Somebody looks at these, `rate_hz` times a second at most, and within the budget of the wire.

    Features of the dish by id (`StationState.dish.features`), `position`, and `health`: all features that a machine
    marks as telling how well it is, each at its own interval. What the machine lacks is not read. `ReadingRead` and
    `StationState.readings` tell; a signal (`rssi`) comes in short bursts, whatever the rate, unless the watch is
    steady.
    """

    watcher: str
    features: frozenset[str]
    rate_hz: float = 1.0
    steady: bool = False
    """Whether the console stays in the signal's menu while the dish rests, and leaves it for a position a second."""
    agreed: bool = False
    """Whether a person has agreed to what reading does (`read_hazard`): else a feature that has such is not read."""


@dataclass(frozen=True, slots=True)
class Unwatch:
    """End a watch."""

    watcher: str


@dataclass(frozen=True, slots=True)
class ReportIgnored:
    """Tell everybody that the wishes of a network client are not carried out (`ClientIgnored`). Moves nothing."""

    client: str
    why: str
    """As a sentence."""


@dataclass(frozen=True, slots=True)
class AcknowledgeFault:
    """A person has read the fault."""

    by: str


@dataclass(frozen=True, slots=True)
class AcceptLimits:
    """A person accepts the dish's own limits by name, after the settings that limit motion could not be read."""

    by: str


Request = (
    Goto | Follow | Pursue | EndPursuit | Drive | Run | EndMotion | BeginTask | ResumeTask | DropTask | Jog | TurnSkew
    | Stop | Release | Home | Sync | ReleaseMotors | Engage | Stow | Park | SetSpeed | Read | Set | Raw | ListCommands
    | ProbePort | Connect | ApplySettings | ReloadSettings | SetSearch | ReadSettings
    | WriteSettings | SaveSettings | AcquireLease | ReleaseLease | Watch | Unwatch
    | ReportIgnored | AcknowledgeFault | AcceptLimits
)  # fmt: skip
