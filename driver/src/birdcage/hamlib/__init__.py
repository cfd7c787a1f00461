"""Any rotator behind a server that speaks Hamlib's rotctld protocol, over TCP (`docs/reference/rotctl.md`)."""

from __future__ import annotations

from birdcage.hamlib.rotator import HamlibRotator

__all__ = ["HamlibRotator"]
