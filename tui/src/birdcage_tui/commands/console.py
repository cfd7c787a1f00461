"""Commands of the console page alone."""

from __future__ import annotations

from birdcage_tui.commands.table import Command

CONSOLE: tuple[Command, ...] = ()
