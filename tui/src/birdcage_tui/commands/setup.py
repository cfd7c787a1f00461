"""Commands of the setup page alone."""

from __future__ import annotations

from birdcage_tui.commands.table import Command

SETUP: tuple[Command, ...] = ()
