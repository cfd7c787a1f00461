"""What is not worth a command."""

from __future__ import annotations

from birdcage.rotator.axis import Axis
from birdcage.tracking.controller_input import ControllerInput


def dead_band_deg(guide: ControllerInput, axis: Axis) -> float:
    """Return how far an axis must be off to be moved: what the helm says in steps or in degrees, whichever is more.

    Never less than half a step, as no command moves it by less.
    """
    return max(guide.dead_band_deg, max(guide.dead_band_steps, 0.5) * axis.step_deg)
