"""Homing as a task: one axis after the other, then where the dish is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from birdcage.station.task import ItemTask
from birdcage.tracking.steps import HomeAxis, Steps, TakeReferences


@dataclass
class HomingTask(ItemTask[int]):
    """Finds the references of axes, by running each into its end stop. Where that is cut short it is over."""

    kind = "homing"
    goes_on = False
    is_unattended = False
    gives_back = False
    cut_words = "No other axis is homed."
    holder: str
    axes: tuple[int, ...]
    """Motor numbers."""
    whole: bool
    """Whether these are all: the turn of the cable is counted from there then."""

    def items(self) -> Sequence[int]:
        """Return the axes."""
        return self.axes

    def do(self, item: int) -> Steps:
        """Home one of them."""
        yield HomeAxis(item)

    def finish(self) -> Steps:
        """Read where the dish is."""
        yield TakeReferences(self.whole)
