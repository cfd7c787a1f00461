"""The Winegard Pathway X2, of the Dish Playmaker family (`docs/reference/g2-kin.md`)."""

from __future__ import annotations

from birdcage.protocol.pathway_x2.protocol import PathwayX2Protocol

__all__ = ["PathwayX2Protocol"]
