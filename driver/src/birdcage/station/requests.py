"""What a face may ask of the station. Frozen; angles are true degrees unless a name says otherwise."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Goto:
    """Point there, exactly, once. Its future resolves at arrival with a `PositionRead`."""

    az_deg: float
    el_deg: float
    holder: str
    clamp: bool = False
    """Move to the nearest allowed elevation instead of refusing one outside the limits."""


@dataclass(frozen=True, slots=True)
class Follow:
    """One target of a stream (less than 3 s apart, one holder); the only motion that may be leap-frogged."""

    az_deg: float
    el_deg: float
    holder: str
    leapfrog: bool = False


@dataclass(frozen=True, slots=True)
class Jog:
    """Step from the last *commanded* target: ten presses are ten steps."""

    d_az_deg: float
    d_el_deg: float
    holder: str


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
class SetSearch:
    """Switch the firmware's own TV search off for good, or walk that back, after a backup of the dish's settings.

    Takes effect after a power cycle. Its future resolves with the path of the backup.
    """

    holder: str
    disabled: bool


@dataclass(frozen=True, slots=True)
class AcquireLease:
    """Take control as `holder`; `take_over` takes it from another holder, visibly."""

    holder: str
    take_over: bool = False


@dataclass(frozen=True, slots=True)
class ReleaseLease:
    """Give control back."""

    holder: str


@dataclass(frozen=True, slots=True)
class Watch:
    """Somebody looks at these features (`position`, `rssi`, `health`), `rate_hz` times a second at most."""

    watcher: str
    features: frozenset[str]
    rate_hz: float = 1.0


@dataclass(frozen=True, slots=True)
class Unwatch:
    """Nobody looks there any more."""

    watcher: str


@dataclass(frozen=True, slots=True)
class AcknowledgeFault:
    """A person has read the fault."""

    by: str


@dataclass(frozen=True, slots=True)
class AcceptLimits:
    """A person accepts the dish's own limits by name, after the settings that limit motion could not be read."""

    by: str


Request = (
    Goto
    | Follow
    | Jog
    | Stop
    | Release
    | Home
    | ReleaseMotors
    | SetSearch
    | AcquireLease
    | ReleaseLease
    | Watch
    | Unwatch
    | AcknowledgeFault
    | AcceptLimits
)
