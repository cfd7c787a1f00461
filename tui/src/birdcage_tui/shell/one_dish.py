"""One dish of the app: its session, its feeds, and all else that is this dish's and no other's."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from birdcage.station.access import FaceSession
from birdcage.station.events import Event
from birdcage.station.requests import Unwatch, Watch

from birdcage_tui.console.tap import WireTap
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.frame_feeds import FrameFeeds
from birdcage_tui.shell.frame_pacer import FramePacer
from birdcage_tui.shell.key_queue import KeyQueue
from birdcage_tui.shell.motions import Motions
from birdcage_tui.shell.tour import Tour
from birdcage_tui.shown.view import View, may_move

if TYPE_CHECKING:
    from birdcage_tui.shown.sky_picture import SkyPicture

ROW = "status row"
"""The subject under which the station reads where a dish points while another one's pages are seen."""


class DishHost(Protocol):
    """The app, seen from one of its dishes."""

    keys: KeyQueue
    frames: FramePacer

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread."""

    def paint(self) -> None:
        """Draw a frame."""

    def bell(self) -> None:
        """Ring."""

    def shows(self, dish: OneDish) -> bool:
        """Return whether pages, keys and questions are about this dish. Any thread."""

    def tell_event(self, dish: OneDish, event: Event) -> None:
        """Pass an event of this dish on. Runs on the station's thread."""

    def tell_sky(self, dish: OneDish, sky: SkyPicture) -> None:
        """Pass on what this dish's watch of the sky has seen. Any thread."""

    def news(self, dish: OneDish) -> None:
        """Draw what this dish was told."""


class OneDish:
    """What becomes of it goes on while the pages show another dish. `tag` tells it from that; empty: it is the only."""

    def __init__(self, host: DishHost, session: FaceSession, settings: AppOptions, tag: str) -> None:
        self._host, self.tag = host, tag
        self.session, self.station = session, session.station
        self.settings, self.network = settings, settings.network
        self.keys = host.keys
        self.motions = Motions(self)
        self.tap = WireTap(self.station.is_steering, session.on_wire)
        """What passes on the wire, from the first byte on; the console takes it out."""
        self.feeds = feeds = FrameFeeds(
            session, settings, host.soon, host.frames.changed, news=lambda: host.news(self),
            show_sky=lambda sky: host.tell_sky(self, sky), say=self.say, bell=host.bell,
        )  # fmt: skip
        self.horizon, self.track = feeds.horizon, feeds.track
        self.tour = Tour(feeds.track.set_autotrack)
        if not settings.tour:
            self.tour.end()
        self._unsubscribe: Callable[[], None] | None = None

    @property
    def is_shown(self) -> bool:
        """Whether pages, keys and questions are about this one now. Any thread."""
        return self._host.shows(self)

    @property
    def has_begun(self) -> bool:
        """Whether its session has."""
        return self._unsubscribe is not None

    def begin(self) -> None:
        """Begin its session and its feeds; after the first frame."""
        self.feeds.presets.load()
        self.feeds.signals.begin()
        self._unsubscribe = self.station.subscribe(lambda event: self._host.tell_event(self, event))
        if not self.session.via:  # else another program would have to pass all of it on
            self.tap.begin()
        self.session.start()
        self.feeds.begin(self.settings.place)

    def close(self) -> None:
        """Hear no more, and let go of what was made for it. Its session is closed apart."""
        self.feeds.close()
        if self._unsubscribe is not None:
            self._unsubscribe()

    def hide(self) -> None:
        """Have the station read no more than a row shows, and a recording needs."""
        self.feeds.signals.watch(frozenset(), typing=False)
        self.station.submit(Watch(ROW, frozenset({"position"}), 1.0))

    def show(self) -> None:
        """Leave to the pages what the station reads."""
        self.station.submit(Unwatch(ROW))

    def say(self, words: str) -> None:
        """Tell what was done, or why not, in one sentence."""
        self.note(words)
        self._host.paint()

    def note(self, words: str) -> None:
        """Keep what a command did, with the time; nothing shows nothing."""
        self.feeds.notes.tell(words, self.session.clock.utc())

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread."""
        self._host.soon(work)

    def end_tour(self) -> None:
        """Let the demo do nothing by itself any more."""
        if self.tour.running:
            self._host.frames.changed()
        self.tour.end()

    @property
    def may_move(self) -> bool:
        """Whether it moves or may move by itself. Any thread."""
        if self.tour.running or self.motions.under_way:
            return True
        return may_move(self.station.state, self.track.now)

    def glance(self) -> View:
        """Return what a row shows of it."""
        return self.feeds.glance(self.settings, self.motions, tour=self.tour.says, tag=self.tag)
