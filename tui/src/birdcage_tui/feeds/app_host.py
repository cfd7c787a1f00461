"""What dialogs and palette need of the app, so that they need not know it."""

from __future__ import annotations

from concurrent.futures import Future
from typing import Protocol

from birdcage.station.access import FaceStation
from birdcage.station.requests import Request

from birdcage_tui.feeds.calibrate_feed import CalibrateFeed
from birdcage_tui.feeds.horizon_book import HorizonBook
from birdcage_tui.feeds.map_feed import MapFeed
from birdcage_tui.feeds.network_source import NetworkSource
from birdcage_tui.feeds.preset_book import PresetBook
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.feeds.signal_feed import SignalFeed
from birdcage_tui.feeds.sky_feed import SkyFeed
from birdcage_tui.feeds.system_feeds import SystemFeeds
from birdcage_tui.feeds.track_feed import TrackFeed
from birdcage_tui.shown.view import View


class ShownDish(Protocol):
    """A dish of the app, as it was shown: what is told and asked of it stays its own once another one is shown."""

    @property
    def station(self) -> FaceStation:
        """Where requests go."""

    @property
    def is_shown(self) -> bool:
        """Whether pages, keys and questions are about this one now."""

    def say(self, words: str) -> None:
        """Tell a sentence of it: in row 2 while it is shown, and among its notes."""


class AppHost(Protocol):
    """The app, seen from inside."""

    presets: PresetBook
    """Directions with names."""
    horizon: HorizonBook
    """The line of trees and roofs."""
    sky: SkyFeed
    """What is known of the sky, and how to ask for more."""
    track: TrackFeed
    """The pursuit desk, and what it has told."""
    signals: SignalFeed
    """What sources of a signal have told."""
    maps: MapFeed
    """The maps of the sky: the one under way, and those that are kept."""
    system: SystemFeeds
    """What the System page reads and does."""
    calibrate: CalibrateFeed
    """The guide of the calibration, and what it has told."""
    network: NetworkSource | None
    """Runs the server for other programs; None: it can't be run here."""
    settings: AppOptions
    """What the app was told before it began."""
    aim: tuple[float, float] | None
    """Where the go-to line would lead, while one types into it."""

    @property
    def dish(self) -> ShownDish:
        """The dish that is shown now; whatever answers late keeps the one that it was asked for."""

    def view(self) -> View:
        """Return what one frame shows, now."""

    def paint(self) -> None:
        """Draw a frame."""

    def watch_page(self) -> None:
        """Have the station read what the page shows now."""

    def action_command(self, name: str) -> None:
        """Do a command of the table, or say why not."""

    def show_page(self, name: str, then: str | None = None) -> None:
        """Show a page; `then` is one of its commands, to be done there."""

    def say(self, words: str) -> None:
        """Put a sentence into row 2, where the calm line is."""

    def say_once(self, words: str) -> None:
        """Say it, unless that was done in this run."""

    def ask(self, request: Request) -> None:
        """Submit a request; if it fails, the sentence of its error is shown."""

    def begin_way(self) -> Future[object]:
        """Count a motion of yours that somebody else will submit as under way, until what is returned is done."""

    def open_goto(self, text: str = "") -> None:
        """Open the go-to line with `text` in it."""
