"""The Winegard Pathway X1, of the Dish Playmaker family (`docs/reference/g2-kin.md`)."""

from __future__ import annotations

from birdcage.protocol.pathway_x1.protocol import PathwayX1Protocol

__all__ = ["PathwayX1Protocol"]
