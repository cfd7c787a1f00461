"""What the calibration tab shows: pure data, told by the guide."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.base.alignments import AlignmentSet
    from birdcage.calibration.guide import GuideView


@dataclass(frozen=True, slots=True)
class KeptSet:
    """A set of the alignment with a name, and whether the dish is pointed by it."""

    entry: AlignmentSet
    in_force: bool


@dataclass(frozen=True, slots=True)
class CalibrateNow:
    """What the tab shows. Pure data."""

    guide: GuideView | None = None
    """None before it was opened, and where that failed."""
    sets: tuple[KeptSet, ...] = ()
    told: str = ""
    """What the last deed did, in a sentence."""
    wrong: str = ""
    """Why the last deed was not done, or nothing can be proposed."""
    removed: int = 0
    """How many peaks can be brought back."""
    searching: bool = False
    """Whether it is being found out what is best to peak on."""
    enough: bool = False
    """Whether nothing that is up would tell much more."""
