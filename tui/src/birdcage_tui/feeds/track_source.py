"""The app's pursuit desk: opened on a thread of its own, since what it needs takes a while to load."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage_tui.feeds.demo_sky import lay_demo_sky
from birdcage_tui.feeds.track_feed import TrackSource
from birdcage_tui.shown.options import SitePlace

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.pursuit.attached_desk import AttachedDesk
    from birdcage.pursuit.desk import PursuitDesk
    from birdcage.pursuit.orders import Order
    from birdcage.signal.source_set import SourceSet
    from birdcage.sky.horizon import HorizonMask
    from birdcage.sky.observer import Observer
    from birdcage.station.attached import AttachedStation
    from birdcage.station.services import Services
    from birdcage.station.session import Session

    from birdcage_tui.feeds.track_feed import MakeTrack, ShowTrack


def make_track(session: Session, settings: Settings, load: Callable[[], Settings], paths: Paths, *, demo: bool,
               signals: SourceSet | None = None, services: Services | None = None, threads: bool = True
               ) -> MakeTrack:  # fmt: skip
    """Return what opens the desk of a session, once the app wants it.

    `load` reads the settings again when the place has changed. `signals` has the receiver that the desk tunes; without
    it the desk has one of its own. Programs that are attached reach it by `services`. `threads=False`: a test calls
    its `step`.
    """

    def make(show: ShowTrack) -> DeskSource:
        def open_desk() -> PursuitDesk:
            from birdcage.pursuit.desk import PursuitDesk
            from birdcage.pursuit.desk_setup import DeskSetup

            observer = observer_of(settings)
            if demo:
                # Else it might read the catalogue before that is filled, and look at it again seconds later only.
                lay_demo_sky(paths.catalogue, session.clock.utc(), observer)
            receiver = None if signals is None else signals.receiver
            setup = DeskSetup(
                paths.catalogue, lambda: settings, paths, observer, demo, receiver=receiver,
                source_of=None if signals is None else signals.get, load=load,
            )  # fmt: skip
            desk = PursuitDesk(session.station, session.clock, setup, show, threads=threads)
            if services is not None:
                from birdcage.pursuit.desk_service import PURSUIT, DeskService

                services.offer(PURSUIT, DeskService(desk))
            return desk

        return DeskSource(open_desk, load, threads=threads)

    return make


def follow_there(station: AttachedStation) -> MakeTrack:
    """Return what has the desk of the program that a station is attached to."""
    return lambda show: AttachedTrack(station, show)


def observer_of(settings: Settings, place: SitePlace | None = None) -> Observer | None:
    """Return where the dish stands; `place` counts over the settings, whose height it takes over."""
    from birdcage.sky.observer import Observer

    own = settings.place
    if place is not None:
        return Observer(place.latitude_deg, place.longitude_deg, own.height_m, name=place.name)
    if own.latitude_deg is None or own.longitude_deg is None:
        return None
    return Observer(own.latitude_deg, own.longitude_deg, own.height_m, name=own.name or "")


class _Surroundings:
    """Where the dish stands, the horizon there, and its feed: as they were taken last."""

    def __init__(self) -> None:
        self._place: SitePlace | None = None
        self._horizon: HorizonMask | None = None
        self._feed = ""

    def differ(self, place: SitePlace | None, horizon: HorizonMask | None, feed: str) -> bool:
        """Take them, and return whether one differs from what was known of it."""
        before, self._place = self._place, place
        mask, self._horizon = self._horizon, horizon
        fed, self._feed = self._feed, feed
        elsewhere = before is not None and place is not None and place != before
        masked = mask is not None and horizon is not None and horizon != mask
        return elsewhere or masked or bool(fed and feed != fed)


class AttachedTrack(TrackSource):
    """Hands every order to the desk of another program. Orders that come before it is heard wait for it."""

    def __init__(self, station: AttachedStation, show: ShowTrack) -> None:
        self._station, self._show = station, show
        self._lock = threading.Lock()
        self._waiting: list[Order] = []
        self._closed = False
        self._surroundings = _Surroundings()
        self._desk: AttachedDesk | None = None

    def start(self) -> None:
        """Hear the desk."""
        threading.Thread(target=self._begin, name="pursuit-opens", daemon=True).start()

    def _begin(self) -> None:
        from birdcage.pursuit.attached_desk import AttachedDesk

        desk = AttachedDesk(self._station, self._show)
        desk.start()
        with self._lock:
            self._desk = desk
            if self._closed:
                desk.close()
            for order in self._waiting:
                desk.ask(order)
            self._waiting.clear()

    def ask(self, order: Order) -> None:
        """Hand an order on, or keep it until the desk is heard."""
        with self._lock:
            if self._desk is None:
                self._waiting.append(order)
            else:
                self._desk.ask(order)

    def keep(self, place: SitePlace | None, horizon: HorizonMask | None = None, feed: str = "") -> None:
        """Have the settings read again over there where this app has changed them."""
        if self._surroundings.differ(place, horizon, feed):
            self.read_settings()

    def close(self) -> None:
        """Hear no more. What was ordered goes on."""
        with self._lock:
            self._closed = True
            if self._desk is not None:
                self._desk.close()

    def wait(self, timeout_s: float) -> None:
        """Wait for nothing: the other program remembers."""


class DeskSource(TrackSource):
    """Hands every order to the desk; those that come before it is open wait for it, in their order."""

    def __init__(self, open_desk: Callable[[], PursuitDesk], load: Callable[[], Settings], *, threads: bool) -> None:
        self._open, self._load, self._threads = open_desk, load, threads
        self._lock = threading.Lock()
        self._waiting: list[Order] = []
        self._closed = False
        self._surroundings = _Surroundings()
        self.desk: PursuitDesk | None = None

    def start(self) -> None:
        """Open the desk."""
        if self._threads:
            threading.Thread(target=self._begin, name="pursuit-opens", daemon=True).start()
        else:
            self._begin()

    def _begin(self) -> None:
        desk = self._open()
        with self._lock:
            if self._closed:
                desk.close(0.0)
                return
            self.desk = desk
            for order in self._waiting:
                desk.ask(order)
            self._waiting.clear()
        desk.start()

    def ask(self, order: Order) -> None:
        """Hand an order on, or keep it until the desk is open."""
        with self._lock:
            if self.desk is None:
                self._waiting.append(order)
            else:
                self.desk.ask(order)

    def step(self) -> None:
        """Do what there is to do, on the calling thread."""
        if self.desk is not None:
            for _ in range(50):
                if self.desk.step() > 0:
                    break

    def keep(self, place: SitePlace | None, horizon: HorizonMask | None = None, feed: str = "") -> None:
        """Take where the dish stands, the horizon there (None: the settings'), and the name of its feed."""
        if self._surroundings.differ(place, horizon, feed):
            settings = self._load()
            observer = observer_of(settings, place)
            self.apply(settings, observer)

    def close(self) -> None:
        """End soon; an opening that is under way ends by itself."""
        with self._lock:
            self._closed = True
            desk = self.desk
        if desk is not None:
            desk.close(0.0)

    def wait(self, timeout_s: float) -> None:
        """Wait until it has left on disk what is to be remembered, where there is such a thing."""
        if self.desk is not None and self.desk.owes:
            self.desk.wait(timeout_s)
