"""What the station tells. Frozen; every event has its monotonic and UTC time; angles are true degrees."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import Enum

from birdcage.rotator.feature import Value
from birdcage.station.pursuit_state import PointingSample, Pursuit
from birdcage.station.state import Activity, Fault, HeldState, LinkState, Motion, Pointing, StopReport
from birdcage.station.task_state import TaskState


class End(Enum):
    """How a motion ended."""

    ARRIVED = "arrived"
    SUPERSEDED = "superseded"
    STOPPED = "stopped"
    REFUSED = "refused"
    NOT_TAKEN = "not taken"
    """What the dish answered is not known, and it stands still: no fault."""
    FAULT = "fault"


@dataclass(frozen=True, slots=True)
class Event:
    """Base of all."""

    at: float
    utc: datetime


@dataclass(frozen=True, slots=True)
class LinkChanged(Event):
    """The link came up, fell silent, or was lost."""

    link: LinkState


@dataclass(frozen=True, slots=True)
class PositionRead(Event):
    """The dish said where it is."""

    position: Pointing


@dataclass(frozen=True, slots=True)
class MoveStarted(Event):
    """A motion was sent to the dish."""

    motion: Motion
    holder: str


@dataclass(frozen=True, slots=True)
class MoveProgress(Event):
    """The dish is under way."""

    position: Pointing
    to_go_deg: float
    left_s: float


@dataclass(frozen=True, slots=True)
class MoveEnded(Event):
    """A motion is over; `reason` is a sentence."""

    end: End
    reason: str
    position: Pointing | None
    miss_deg: float = 0.0
    """How far it arrived from the direction that was asked for: of a machine that goes to the nearest that it reaches.
    """


@dataclass(frozen=True, slots=True)
class StopSent(Event):
    """STOP's bytes went out, or there was nothing to send."""

    report: StopReport


@dataclass(frozen=True, slots=True)
class StopConfirmed(Event):
    """The dish answered and stands still, or it did not (`report.confirmed` is False)."""

    report: StopReport


@dataclass(frozen=True, slots=True)
class HeldChanged(Event):
    """STOP latched, or was released (None)."""

    held: HeldState | None


@dataclass(frozen=True, slots=True)
class LeaseChanged(Event):
    """Control went to `holder`, from `previous`."""

    holder: str | None
    previous: str | None


@dataclass(frozen=True, slots=True)
class FaultRaised(Event):
    """Something is wrong."""

    fault: Fault


@dataclass(frozen=True, slots=True)
class FaultAcknowledged(Event):
    """A person has read it."""

    fault: Fault
    by: str


@dataclass(frozen=True, slots=True)
class DishRestarted(Event):
    """The dish was heard to start: its boot text came."""

    said: str
    """The line of it that told so."""
    was_met: bool
    """Whether it had answered this program before: else it may have been switched on just now."""


@dataclass(frozen=True, slots=True)
class SettingsSaved(Event):
    """The dish has saved settings of its own: they count from its next power cycle on."""

    names: tuple[str, ...]
    """As the dish calls them."""


@dataclass(frozen=True, slots=True)
class ReadingRead(Event):
    """A value was read from the dish."""

    feature: str
    value: Value
    unit: str


@dataclass(frozen=True, slots=True)
class TranscriptLine(Event):
    """A line that passed on the wire; `direction` is `>` to the dish, `<` from it, `#` a remark."""

    direction: str
    text: str
    is_prompt: bool = False
    """Whether it is a prompt that came unasked, and nothing else."""


@dataclass(frozen=True, slots=True)
class NotNowChanged(Event):
    """The owner's command says that the dish may not move unattended now, or that it may again (an empty sentence)."""

    sentence: str


@dataclass(frozen=True, slots=True)
class ClientIgnored(Event):
    """The wishes of a network client are not carried out; told at most once a minute for each."""

    client: str
    why: str


@dataclass(frozen=True, slots=True)
class Recovered(Event):
    """A dish that had restarted was homed again with no person near."""

    sentence: str


@dataclass(frozen=True, slots=True)
class PursuitChanged(Event):
    """A pursuit began, is in another phase, or has another plan."""

    pursuit: Pursuit


@dataclass(frozen=True, slots=True)
class TaskChanged(Event):
    """A task began, is in another phase, is further on, or is over."""

    task: TaskState


@dataclass(frozen=True, slots=True)
class Followed(Event):
    """How well the dish points, about once a second while it follows."""

    number: int
    """Of the pursuit."""
    sample: PointingSample


@dataclass(frozen=True, slots=True)
class ActivityChanged(Event):
    """The dish does something else now."""

    activity: Activity
    text: str
    raw: bool = False
    """Whether a raw line may have set the dish in motion."""
