"""What was seen on a port at one baud rate, for the walk through the causes of silence."""

from __future__ import annotations

from birdcage.console.probe import USUAL_BAUDS, BaudFinding, Saw

__all__ = ["USUAL_BAUDS", "BaudFinding", "Saw"]
