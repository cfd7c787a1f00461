"""What a frame knows of the horizon and of recording it."""

from __future__ import annotations

from dataclasses import dataclass, field

from birdcage.sky.horizon import HorizonMask


@dataclass(frozen=True, slots=True)
class HorizonState:
    """The line of trees and roofs as it counts now. It refuses no motion."""

    mask: HorizonMask = field(default_factory=HorizonMask)
    recording: bool = False
    """Whether each rest after a jog becomes a point."""
    undo: bool = False
    """Whether there is a change to take back."""
    problem: str = ""
    """Why nothing can be kept, as a sentence; empty when it can."""


def count_text(mask: HorizonMask) -> str:
    """Return how many points there are: `8 points`, `1 point`, `flat`."""
    count = len(mask.points)
    return "flat" if not count else "1 point" if count == 1 else f"{count} points"
