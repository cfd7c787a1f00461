"""What the setup page needs of the app."""

from __future__ import annotations

from typing import Protocol

from birdcage.station.station import Station

from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shown.view import View


class SetupHost(Protocol):
    """The app, seen from the page."""

    settings: AppOptions
    station: Station

    def view(self) -> View:
        """Return what one frame shows, now."""

    def paint(self) -> None:
        """Draw a frame."""

    def say(self, words: str) -> None:
        """Put a sentence into row 2."""

    def show_page(self, name: str) -> None:
        """Show another page."""

    def begin_anew(self) -> None:
        """End, and begin again with the settings as they are then."""

    def action_command(self, name: str) -> None:
        """Do a command of the table, or say why not."""
