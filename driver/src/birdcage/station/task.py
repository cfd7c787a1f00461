"""A task: something that takes more than one exchange, as a generator of steps (`docs/decisions/0052-tasks.md`)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from datetime import datetime
from typing import ClassVar, Generic, TypeVar

from birdcage.station.task_state import TaskPhase, TaskValue
from birdcage.tracking.steps import StepResult, Steps

Item = TypeVar("Item")
Report = Callable[[TaskPhase, str, str, "datetime | None"], None]
"""Takes the phase of a task, why, what comes next and when."""


class Task(ABC):
    """What the host drives between the station's exchanges.

    The host takes the lease before anything moves, counts down before motion that no person has just asked for, gives
    way to whoever takes control, ends it on STOP, holds still while the link is lost or the clock steps, lets it go on
    afterwards, and keeps it in the journal. A task says what its steps are, and little else.
    """

    kind: ClassVar[str]
    """What it is called in events, in the journal and on disk: `pursuit`, `homing`."""
    counts_down: ClassVar[bool] = True
    """Whether the host counts down for it; else its own steps do."""
    goes_on: ClassVar[bool] = True
    """Whether it may go on after somebody else had control, or the link was lost; else it is over then."""
    done_words: ClassVar[str] = "Done."
    is_unattended: ClassVar[bool] = True
    """Whether it may go on with no person near: then the owner's command is asked whether the dish may move."""
    gives_back: ClassVar[bool] = True
    """Whether it gives control back at its end; else whoever asked for it keeps control."""
    cut_words: str = ""
    """What STOP has cut short, in a sentence."""
    resume_words: ClassVar[str] = "Release it to resume."
    """What makes it go on, once it was interrupted."""
    homed_words: str = ""
    """The same where the dish no longer knows where it points; empty for the same words."""
    holder: str
    resumes: bool = False
    """Whether it may go on by itself after a short loss of the link with nothing changed."""
    resume_within_s: float = 10.0

    @abstractmethod
    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Begin, or go on from where it stands; `now_s` in POSIX seconds. `asked`: a person has just asked for it."""

    @property
    def streams(self) -> bool:
        """Whether what it sends now keeps the dish in motion: it has to come to rest when this ends."""
        return False

    @property
    def keeps_speeds(self) -> bool:
        """Whether speeds that it has changed stay so now; else they are put back before anything else moves."""
        return self.streams

    @property
    def ends_at_s(self) -> float:
        """When it is too late to go on; POSIX seconds."""
        return float("inf")

    @property
    def progress(self) -> tuple[int, int] | None:
        """How many of its pieces are done, and of how many; None if it has none."""
        return None

    @property
    def end_words(self) -> str:
        """How it ended, once all is done."""
        return self.done_words

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """What it has found so far, by name, for faces."""
        return {}

    def goes_to(self, now_s: float) -> tuple[float, float] | None:  # noqa: ARG002 - most cannot tell
        """Return the true direction to which it would move first now; None if that is not known."""
        return None

    def bind(self, report: Report) -> None:  # noqa: B027 - only for those with stages of their own
        """Take what tells the host of its own stages."""

    def heard(self, answer: StepResult, now_s: float) -> None:  # noqa: B027 - the steps hear it first
        """Take in what came of a step that was carried out."""

    def entered(self, phase: TaskPhase, why: str, *, is_done: bool) -> None:  # noqa: B027 - the host shows it
        """Take in that the host has put it into another phase; `is_done`: it is over because all is done."""

    def result(self) -> object:
        """Return what whoever asked for it gets at its end."""
        return None


class ItemTask(Task, Generic[Item]):
    """A task of pieces, done one after the other: the points of a scan, the axes to home.

    As a dataclass of plain values it outlives the program: `is_kept` keeps those values and how far it is. A piece that
    was cut short is done anew.
    """

    is_kept: ClassVar[bool] = False
    """Whether it can be taken up again by the program that comes after."""
    done: int = 0
    """How many pieces are done."""

    @abstractmethod
    def items(self) -> Sequence[Item]:
        """Return the pieces, the same ones each time."""

    @abstractmethod
    def do(self, item: Item) -> Steps:
        """Do one of them."""

    def finish(self) -> Steps:
        """Do what is left to do once all are done."""
        yield from ()

    def steps(self, now_s: float, *, asked: bool) -> Steps:  # noqa: ARG002 - it begins with the piece that is next
        """Do what is not done yet."""
        for item in self.items()[self.done :]:
            yield from self.do(item)
            self.done += 1
        yield from self.finish()

    @property
    def progress(self) -> tuple[int, int]:
        """How many pieces are done, and of how many."""
        return self.done, len(self.items())
