"""Steers a dish that does not tell its position.

Where it stands is what it was sent to: nothing is read, and nothing shows a move that was lost.
"""

from __future__ import annotations

from birdcage.tracking.controller_input import ControllerInput
from birdcage.tracking.steering import fast, queued, whole
from birdcage.tracking.steps import Steps


def modelled(guide: ControllerInput) -> Steps:
    """Follow by the model of both axes alone."""
    if not guide.model.moves_one_axis:
        yield from whole.steer(guide)
        return
    yield from (queued.steer if guide.model.moves_in_turn else fast.steer)(guide, looks=False)
