"""What every controller is: what makes a generator that keeps the dish on a course while a leg lasts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import Facts
from birdcage.tracking.curve import Curve
from birdcage.tracking.steps import Steps

LEAD_S = 1.0
"""How long before the target comes into reach a controller takes over."""


@dataclass(slots=True)
class ControllerInput:
    """What a controller steers by. The course may be replaced while it steers: it is read anew for each command."""

    course: Callable[[], Curve]
    model: Facts
    """With the speeds in force."""
    start_az_deg: float
    """Where the dish stands, or was sent last, as the course counts it."""
    start_el_deg: float
    now_s: float
    """When steering begins, or goes on in another way."""
    until_s: float
    """When the leg ends."""
    latency_s: float = 0.06
    """From the first byte of a command until it acts: at first a guess, then what the controller has measured."""
    dead_band_steps: float = 0.5
    dead_band_deg: float = 0.0
    """An axis that would move by less than this, or by less than `dead_band_steps` of its steps, is left alone."""
    look_every_s: float = 1.0
    """How often the position is read."""
    from_s: float = 0.0
    """When the target comes into reach: the dish waits for it until then."""
    answered: int = 0
    """How many lines in a row the dish has answered in time before."""
    delay_s: float = 2.0
    """The longest that a byte may be on its way: after a lost answer the line is silent for up to twice that."""

    def least_way_deg(self, axis: Axis) -> float:
        """Return how far an axis must be off to be moved: by the dead band in steps or in degrees, whichever is more.

        Never less than half a step, as no command moves it by less.
        """
        return max(self.dead_band_deg, max(self.dead_band_steps, 0.5) * axis.step_deg)

    def next_look_s(self, due_s: float, now_s: float) -> float:
        """Return when to look next, where that is due at a time and a look is over now; POSIX seconds.

        Never before the machine may be asked again: such a look waits, and no command goes out meanwhile.
        """
        return max(due_s, now_s + (self.model.least_look_interval_s or 0.0))


Controller: TypeAlias = Callable[[ControllerInput], Steps]
"""Keeps the dish on its course until the leg ends, or it is closed."""
