"""What the setup page needs of the app."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from birdcage.station.access import FaceStation

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.feeds.settings import AppOptions


class ReleaseKeys(Protocol):
    """What is typed, in its order."""

    def let_go(self, release: Callable[[], object]) -> None:
        """Let go of HELD by what is dealt with now, unless STOP was typed after it."""


class SetupHost(AppHost, Protocol):
    """The app, seen from the page."""

    settings: AppOptions
    station: FaceStation

    @property
    def keys(self) -> ReleaseKeys:
        """What is typed, in its order."""

    def begin_anew(self) -> None:
        """End, and begin again with the settings as they are then."""
