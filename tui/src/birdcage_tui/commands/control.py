"""Commands of the control page alone."""

from __future__ import annotations

from birdcage_tui.commands.table import Command

CONTROL: tuple[Command, ...] = ()
