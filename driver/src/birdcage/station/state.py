"""What the station knows at one moment: one immutable value, replaced as a whole, read by any thread."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from enum import Enum, StrEnum
from types import MappingProxyType

from birdcage.antenna.alignment import Alignment
from birdcage.antenna.gate import UNTOLD
from birdcage.base.beam import Beam
from birdcage.base.held import HeldNote, HeldReason
from birdcage.base.no_go import NoGoSector
from birdcage.base.reason import Reason
from birdcage.rotator.facts import CableTurn, Facts
from birdcage.rotator.feature import Reading
from birdcage.rotator.ladder import StopMeans
from birdcage.rotator.own import OwnFacts
from birdcage.rotator.values import Position
from birdcage.station.converter import FeedConverter
from birdcage.station.network_state import NetworkState
from birdcage.station.pursuit_state import Pursuit
from birdcage.station.task_state import KeptTask, TaskState


class LinkPhase(Enum):
    """The state of the link."""

    CLOSED = "closed"
    OPENING = "opening"
    UP = "up"
    SILENT = "silent"
    """The port is there; the dish does not answer, or not in its language."""
    LOST = "lost"
    """The port is gone; the station looks for it again."""


class Activity(Enum):
    """What the dish is known to be doing."""

    UNKNOWN = "unknown"
    IDLE = "idle"
    SLEWING = "slewing"
    STOPPING = "stopping"
    HOMING = "homing"
    STOWING = "stowing"
    SWEEPING = "sweeping"
    """Along an axis, by itself (`Facts.sweep`)."""
    INITIALIZING = "initializing"
    FOLLOWING = "following"
    """Kept on a target by a pursuit."""
    MOVING_UNASKED = "moving unasked"
    MOTOR_RUN = "motor run"
    """One motor runs without a target, while somebody holds a key (`Run`)."""


MOVING = frozenset(
    {
        Activity.SLEWING,
        Activity.FOLLOWING,
        Activity.STOPPING,
        Activity.HOMING,
        Activity.STOWING,
        Activity.SWEEPING,
        Activity.MOVING_UNASKED,
        Activity.MOTOR_RUN,
    }
)
"""What a dish does that is not at rest."""


class LimitSource(Enum):
    """Who set a limit of motion."""

    DISH = "dish"
    """Read from the dish's own settings."""
    MODEL = "model"
    """What this kind of dish has; this one was not asked, or did not tell."""
    USER = "user"
    """`birdcage.toml` narrows it."""


class FaultReason(StrEnum):
    """What is wrong with the dish."""

    STALL = "stall"
    """An axis does not turn, or did not find its reference."""
    SPEED = "speed"
    """It did not take its own speed back."""
    UNHOMED = "unhomed"
    """It no longer knows where it points, and no boot text was heard."""
    MOVED = "moved"
    """It moves though nothing was sent."""
    REBOOT = "reboot"
    """It has restarted."""


class TvSearch(Enum):
    """The firmware's TV search."""

    RUNNING = "running"
    OFF = "off"
    OFF_UNTIL_POWER_UP = "off until power-up"
    NONE = "none"
    """The machine has none."""
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class LinkState:
    """The link, and why it is as it is."""

    state: LinkPhase = LinkPhase.CLOSED
    since: float = 0.0
    """Monotonic seconds."""
    last_reply: float | None = None
    """When the dish last answered, in monotonic seconds."""
    round_trip_s: float | None = None
    detail: str = ""
    """A sentence for a person; while lost, what is being tried."""
    reason: Reason | None = None
    """Why it is silent or lost; None while it is neither."""
    stray_bytes: int = 0
    """Bytes of line noise since the link came up."""
    asked: int = 0
    """Lines that were sent since the link came up, and wait for their answer or have had it."""
    unanswered: int = 0
    """How many of them got no answer, or none that could be read."""
    late: int = 0
    """How many got theirs later than the stream of targets could wait for it, or not at all."""


@dataclass(frozen=True, slots=True)
class Pointing:
    """A direction that was read (or modelled, and then says so)."""

    az_deg: float
    """True azimuth, 0 to 360."""
    el_deg: float
    dish_az_deg: float
    """As the dish counts it, before the offset; it may count on beyond the circle."""
    dish_el_deg: float
    at: float
    """Monotonic seconds of the reading."""
    utc: datetime
    cable_deg: float | None = None
    """Turn of the cable, when it is known."""
    skew_deg: float | None = None
    """The dish's skew; None on a dish without that axis."""
    modelled: bool = False
    """Computed and not read: nothing can be asked while a silent slew lasts. `at` is then when it was computed."""
    read_at: float | None = None
    """Monotonic seconds of the last reading, where `modelled`; None if `at` is that."""
    uncertainty_deg: float | None = None
    """Within how many degrees of it the dish should be, where `modelled`; None where it was read."""

    @property
    def dish(self) -> Position:
        """Return the dish's own angles."""
        return Position(self.dish_az_deg, self.dish_el_deg)

    @property
    def told_at(self) -> float:
        """Monotonic seconds of when the dish last said where it was: what an age is counted from."""
        return self.at if self.read_at is None else self.read_at

    @property
    def az_text(self) -> str:
        """The azimuth as people read it: two decimals, never 360.00."""
        return f"{round(self.az_deg, 2) % 360.0:.2f}°"


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion under way: where from, where to, when it will be there, and what stops it."""

    from_az_deg: float
    from_el_deg: float
    to_az_deg: float
    to_el_deg: float
    started: float
    """Monotonic seconds."""
    eta: float
    """Monotonic seconds at which it should have arrived; at the latest, and not to be shown, unless `eta_known`."""
    stop_power_s: float | None
    """How long a stop takes from top speed; None when nothing stops this motion.

    With `end of move`, how long the move of the axis under way takes as a whole; `rests_at` tells when it ends.
    """
    stop_means: StopMeans
    to_skew_deg: float | None = None
    """Where the skew is sent; None in a motion of azimuth and elevation, whose own angles then do not change."""
    rests_at: float | None = None
    """Monotonic seconds at which the move of one axis that is under way should end; None if STOP need not wait."""
    az_way_deg: float | None = None
    """How far the azimuth turns from `from_az_deg`, clockwise positive; None while which way round is not known."""
    eta_known: bool = True
    """Whether the speeds of what moves are known."""
    stop_proven: bool = False
    """Whether a source, or a STOP of this dish in motion, has shown that `stop_means` works."""


@dataclass(frozen=True, slots=True)
class HeldState:
    """STOP is latched."""

    by: str
    """Empty if that is not known."""
    since: float
    """Monotonic seconds since when this program knows."""
    utc: datetime | None
    """When it was latched; None if that is not known."""
    reason: HeldReason
    next_holder: str | None = None
    """Who would move first after release, and where to."""
    next_az_deg: float | None = None
    next_el_deg: float | None = None
    ignored: int = 0
    """How many motions were asked for and ignored since."""
    earlier: bool = False
    """Whether an earlier program latched it, which has ended since."""
    damage: str = ""
    """Why who and when are not known, as a sentence; empty normally."""
    detail: str = ""
    """More about the reason, in words; empty for nothing."""

    @property
    def sentence(self) -> str:
        """Who holds it, since when and why."""
        return self._note.sentence

    @property
    def why(self) -> str:
        """The reason in words."""
        return self._note.why

    @property
    def _note(self) -> HeldNote:
        return HeldNote(self.by, self.utc, self.reason, damage=self.damage, detail=self.detail)


@dataclass(frozen=True, slots=True)
class Fault:
    """Shown until acknowledged."""

    reason: FaultReason
    what: str
    meaning: str
    remedy: str
    utc: datetime
    axis: str = ""
    """The name of the axis that it is of; empty where it is of none, or of an unknown one."""
    homing: bool = False
    """Whether that axis failed to find its reference: its angles mean nothing then."""
    az_deg: float | None = None
    """True direction where the dish stood; None where that was not known."""
    el_deg: float | None = None

    @property
    def is_of_power(self) -> bool:
        """Whether its power has failed, or may have: the dish has restarted, or no longer knows where it points."""
        return self.reason in (FaultReason.REBOOT, FaultReason.UNHOMED)


@dataclass(frozen=True, slots=True)
class BootLog:
    """What the dish printed when it last started, from its first boot mark to its prompt."""

    utc: datetime
    """When that mark came."""
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class StopReport:
    """What the last STOP really did."""

    by: str
    at: float
    means: StopMeans
    confirmed: bool | None
    """None while it is not known yet."""
    sentence: str


@dataclass(frozen=True, slots=True)
class StationState:
    """All of it. A field that is None is not known, and shows as a dash."""

    link: LinkState = field(default_factory=LinkState)
    port: str = ""
    demo: bool = False
    dish: Facts | None = None
    firmware_version: str | None = None
    position: Pointing | None = None
    position_lost: Reason | None = None
    """Why the last position no longer holds; None while it does."""
    position_text: str = ""
    """What the dish said instead of where it is, in a sentence; empty if that was not asked or needs no words."""
    target_az_deg: float | None = None
    target_el_deg: float | None = None
    target_miss_deg: float = 0.0
    """How far the target lies from the direction that was asked for: a machine with a mapping goes to the nearest."""
    target_skew_deg: float | None = None
    motion: Motion | None = None
    activity: Activity = Activity.UNKNOWN
    activity_since: float = 0.0
    activity_text: str = ""
    """More about it: a boot line, the axis being homed."""
    raw_activity: bool = False
    """Whether that activity, if it is unknown, is due to a raw line."""
    holder: str | None = None
    holder_until: datetime | None = None
    """When its control ends by itself; None if it lasts until it is given back."""
    held: HeldState | None = None
    held_trouble: str = ""
    """Why HELD, or its release, is not kept for the programs that come after; empty if it is."""
    fault: Fault | None = None
    boot_log: BootLog | None = None
    """Of its last start that this program heard; None if it heard none."""
    last_stop: StopReport | None = None
    unplanned_stop: StopMeans = StopMeans.NONE
    """By what STOP ends a motion that goes on without a plan of this program."""
    homed: bool | None = None
    search: TvSearch = TvSearch.UNKNOWN
    turn: CableTurn = CableTurn.UNKNOWN
    menu: str | None = None
    az_offset_deg: float = 0.0
    el_offset_deg: float = 0.0
    alignment: Alignment = field(default_factory=Alignment)
    """The whole of what is in force: the offsets above, tilt and collimation. Shown whenever it is not zero."""
    feed_name: str = ""
    converter: FeedConverter | None = None
    """Of that feed: from what the dish's own tuner is set to, to the sky. None where its LO is not set."""
    own: OwnFacts = field(default_factory=OwnFacts)
    """What was learnt of this dish itself, which `dish` has too, with where it comes from."""
    beam: Beam | None = None
    """Of this dish with that feed; None if it is not known."""
    stow_allowed: bool = False
    el_min_deg: float | None = None
    """The lowest and highest true elevation that a motion may go to: the dish's own limits and the user's."""
    el_max_deg: float | None = None
    cable_min_deg: float | None = None
    """How far the cable may turn, counted by the dish; None if there is no such limit."""
    cable_max_deg: float | None = None
    no_go_sectors: tuple[NoGoSector, ...] = ()
    """True degrees, from `birdcage.toml`."""
    limit_sources: Mapping[str, LimitSource] = field(default_factory=lambda: MappingProxyType({}))
    """Where `el_min`, `el_max`, `cable_min` and `cable_max` come from."""
    motion_refused_because: str | None = None
    """Why no motion is taken at all (unreadable settings), else None."""
    not_now: str = ""
    """Why the dish is not moved unattended, as a sentence of the owner's command; empty while it may be."""
    surveyed: bool = False
    """Whether the dish was asked for its identity, limits and settings since the link came up."""
    tasks: tuple[TaskState, ...] = ()
    """Those that are not over, in the order in which they began."""
    kept_task: KeptTask | None = None
    """What the program before this one did not finish; None if there is nothing to resume."""
    pursuit: Pursuit | None = None
    """The present one, or the last one until another begins."""
    speeds_lent: Mapping[int, float] = field(default_factory=lambda: MappingProxyType({}))
    """The speeds (deg/s, by motor) that are put back once a pursuit no longer changes them; empty while none does."""
    signal_owners: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    """Who owns a signal source now, by its id (`tuner`, `rigctl`): the target that it is read for, or `monitor`."""
    warnings: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    """What a person should know of this program itself, by subject: `birdcage stop` can't reach it, …; sentences."""
    readings: Mapping[str, Reading] = field(default_factory=lambda: MappingProxyType({}))
    """By feature (`StationState.dish.features`), and what else a survey told, by its own names."""
    network: NetworkState | None = None
    """The server for Hamlib's clients; None if none runs."""

    @property
    def awaits_first_move(self) -> bool:
        """Whether this dish does not tell where it points, and was not sent anywhere yet: a full direction may be."""
        return self.position_lost is UNTOLD

    @property
    def awaits_sync(self) -> bool:
        """Whether a person has to sync it (`Sync`) before it is sent anywhere."""
        return self.homed is False and self.dish is not None and bool(self.dish.must_be_synced)

    @property
    def raw_motion(self) -> bool:
        """Whether a raw line may have set the dish in motion, and it was not seen at rest since."""
        return self.raw_activity and self.activity is Activity.UNKNOWN
