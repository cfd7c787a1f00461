"""What the console needs of the app."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from birdcage.station.access import FaceSession, FaceStation

from birdcage_tui.console.tap import WireTap
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shown.view import View


class ConsoleHost(Protocol):
    """The app, seen from the console."""

    session: FaceSession
    station: FaceStation
    settings: AppOptions
    tap: WireTap

    def view(self) -> View:
        """Return what one frame shows, now."""

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread."""

    def typing_changed(self) -> None:
        """The line has the focus, or no longer."""

    def show_page(self, name: str) -> None:
        """Show or hide the console, or show a page."""
