"""What the setup page needs of the app."""

from __future__ import annotations

from typing import Protocol

from birdcage.station.access import FaceStation

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.feeds.settings import AppOptions


class SetupHost(AppHost, Protocol):
    """The app, seen from the page."""

    settings: AppOptions
    station: FaceStation

    def begin_anew(self) -> None:
        """End, and begin again with the settings as they are then."""
