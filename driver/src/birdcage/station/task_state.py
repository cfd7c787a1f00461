"""What the station tells of a task."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from enum import StrEnum

from birdcage.rotator.feature import Value

TaskValue = Value | tuple[tuple[float, ...], ...]
"""What a task is told, and finds: a value, or rows of numbers."""


class TaskPhase(StrEnum):
    """What becomes of a task."""

    WAITING = "waiting"
    """For its time to begin."""
    COUNTDOWN = "countdown"
    """It is about to move without a fresh request: `next_at` says when. STOP cancels it."""
    RUNNING = "running"
    YIELDED = "yielded"
    """Somebody else has control; it goes on, after a countdown, when they give it back."""
    INTERRUPTED = "interrupted"
    """The link was lost, or the clock stepped: the dish stays still. `why` says what would make it go on."""
    OVER = "over"
    """`why` says how it ended."""


@dataclass(frozen=True, slots=True)
class TaskState:
    """A task at one moment. Part of `StationState` while it lives."""

    number: int
    """Counts the tasks of this station, from 1."""
    kind: str
    holder: str
    phase: TaskPhase
    since: float
    """Monotonic seconds at which the phase began."""
    why: str
    """A sentence for a person."""
    next_what: str = ""
    """What happens next, as a word or two."""
    next_at: datetime | None = None
    done: int | None = None
    """How many of its pieces are done; None if it has none."""
    of: int | None = None
    is_done: bool = False
    """Whether it is over because all is done."""
    found: Mapping[str, TaskValue] = field(default_factory=dict)
    """What it has found so far, by name: of a peak its direction, and how sure that is."""


@dataclass(frozen=True, slots=True)
class KeptTask:
    """A task that the program before this one did not finish: `ResumeTask` takes it up again."""

    kind: str
    holder: str
    done: int
    of: int
    utc: datetime
    """When it was last known to go on."""
