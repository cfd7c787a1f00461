"""What the app knows of the sky: owns what watches it on a thread of its own, and hears from it by messages.

Nothing here imports numpy or sgp4, and no call waits: what is asked for is done on the watch's own thread.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol

from birdcage.station.state import StationState

from birdcage_tui.shown.options import SitePlace

if TYPE_CHECKING:
    from birdcage.base.clock import Clock
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.sky.horizon import HorizonMask
    from birdcage.sky.world import WorldView

    from birdcage_tui.feeds.sky_add import AddOutcome
    from birdcage_tui.feeds.world_ask import Ask
    from birdcage_tui.shown.sky_picture import ShownPass, SkyPicture

Show = Callable[["SkyPicture"], object]
"""Takes a picture of the sky, on whichever thread made it."""
Say = Callable[[str], object]
"""Takes a sentence to be told, on any thread."""
ShowWorld = Callable[["WorldView"], object]
"""Takes the world at one moment, on whichever thread made it."""

TellAdded = Callable[["AddOutcome"], object]
"""Takes what came of elements that were added, on whichever thread did it."""


class SkySource(Protocol):
    """What watches the sky. No call waits."""

    def start(self) -> None:
        """Begin, on a thread of its own."""

    def keep(self, state: StationState, place: SitePlace | None, horizon: HorizonMask | None = None) -> None:
        """Take what is known of the dish, whose limits reach follows from, and where it stands.

        `horizon`: what hides the sky there now; None: what the settings said.
        """

    def set_favourite(self, satellite: int | str, favourite: bool) -> None:
        """Mark or unmark a satellite, by number or name."""

    def export(self, rows: Sequence[ShownPass]) -> None:
        """Write passes to files, and tell where."""

    def look_down(self, ask: Ask, show: ShowWorld) -> None:
        """Work out what a map of the world shows, and show it."""

    def add_elements(self, typed: str, tell: TellAdded) -> None:
        """Take elements into the catalogue, by a path or as text, and tell what came of it."""

    def close(self) -> None:
        """End soon; nothing is told any more."""


MakeSky = Callable[[Show, Say], SkySource]


def make_sky(settings: Settings, paths: Paths, clock: Clock, *, demo: bool, threads: bool = True) -> MakeSky:
    """Return what makes the sky by the settings, once the app wants it: nothing of it is loaded before.

    `threads=False`: a test calls its `step`.
    """

    def make(show: Show, say: Say) -> SkySource:
        from birdcage_tui.feeds.sky_source import open_sky

        return open_sky(settings, paths, clock, show, say, demo=demo, threads=threads)

    return make


class SkyFeed:
    """The app's end. `now` is what was heard last."""

    def __init__(self, make: MakeSky | None, show: Show, say: Say) -> None:
        self._make, self._show, self._say = make, show, say
        self.source: SkySource | None = None
        self._closed = False
        self.now: SkyPicture | None = None

    def begin(self, state: StationState, place: SitePlace | None, horizon: HorizonMask | None = None) -> None:
        """Begin to watch; after the first frame."""
        if self._make is None or self._closed:
            return
        self.source = self._make(self._show, self._say)
        self.source.keep(state, place, horizon)
        self.source.start()

    def keep(self, state: StationState, place: SitePlace | None, horizon: HorizonMask | None = None) -> None:
        """Take what has become of the dish, its place and the horizon there."""
        if self.source is not None:
            self.source.keep(state, place, horizon)

    def set_favourite(self, satellite: int | str, favourite: bool) -> None:
        """Mark or unmark a satellite."""
        if self.source is not None:
            self.source.set_favourite(satellite, favourite)

    def export(self, rows: Sequence[ShownPass]) -> None:
        """Write passes to files; where is told later."""
        if self.source is not None:
            self.source.export(rows)

    def look_down(self, ask: Ask, show: ShowWorld) -> bool:
        """Work out what a map of the world shows; return whether that will be done."""
        if self.source is None or self._closed:
            return False
        self.source.look_down(ask, show)
        return True

    def add_elements(self, typed: str, tell: TellAdded) -> bool:
        """Take elements into the catalogue; return whether that will be done."""
        if self.source is None or self._closed:
            return False
        self.source.add_elements(typed, tell)
        return True

    def close(self) -> None:
        """End."""
        self._closed = True
        if self.source is not None:
            self.source.close()
