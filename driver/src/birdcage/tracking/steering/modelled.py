"""Steers a dish that does not tell its position.

Where it stands is what it was sent to: nothing is read, and nothing shows a move that was lost.
"""

from __future__ import annotations

from birdcage.tracking.controller import Helm
from birdcage.tracking.steering import fast, queued, whole
from birdcage.tracking.steps import Activity


def modelled(helm: Helm) -> Activity:
    """Follow by the model of both axes alone."""
    if not helm.model.moves_one_axis:
        yield from whole.steer(helm)
        return
    yield from (queued.steer if helm.model.moves_in_turn else fast.steer)(helm, looks=False)
