"""What dialogs and palette need of the app, so that they need not know it."""

from __future__ import annotations

from typing import Protocol

from birdcage_tui.view import View


class Host(Protocol):
    """The app, seen from inside."""

    def view(self) -> View:
        """Return what one frame shows, now."""

    def paint(self) -> None:
        """Draw a frame."""

    def action_command(self, name: str) -> None:
        """Do a command of the table, or say why not."""
