"""What of the app knows its dishes: which of them pages, keys and questions are about, and where news go."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from birdcage.station.access import FaceSession
from birdcage.station.events import Event
from textual import on
from textual.app import App

from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.dishes import Dishes
from birdcage_tui.shell.frame_pacer import FramePacer
from birdcage_tui.shell.key_queue import KeyQueue
from birdcage_tui.shell.one_dish import OneDish
from birdcage_tui.shown.event_words import event_words
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.messages import SkyChanged, StationEvent

if TYPE_CHECKING:
    from birdcage_tui.shown.sky_picture import SkyPicture


class DishApp(App[None]):
    """Its attributes, `station` and `track` among them, are those of the dish that is shown."""

    keys: KeyQueue
    frames: FramePacer

    @abstractmethod
    def view(self) -> View:
        """Return what one frame shows, now."""

    @abstractmethod
    def paint(self) -> None:
        """Draw a frame; only rows that changed are sent."""

    @abstractmethod
    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread; nothing happens once the app has ended."""

    def take_dishes(self, given: Sequence[tuple[FaceSession, AppOptions]]) -> None:
        """Take the dishes of this app; the first is shown. Once."""
        self.dishes = Dishes(self, given)
        self._take_up()

    def begin_with(self, number: int) -> None:
        """Have everything be about this dish, from 1, with the first frame; before the app runs."""
        self.dishes.begin_with(number)
        self._take_up()

    def take_next(self) -> None:
        """Have everything be about the next dish, and draw that."""
        self.dishes.take_next()
        self._take_up()
        self.paint()

    def _take_up(self) -> None:
        self.dish = dish = self.dishes.shown
        self.session, self.station, self.network = dish.session, dish.station, dish.network
        self.tap, self.motions, self.feeds = dish.tap, dish.motions, dish.feeds
        feeds = dish.feeds
        self.presets, self.horizon, self.maps, self.system = feeds.presets, feeds.horizon, feeds.maps, feeds.system
        self.sky, self.track, self.signals, self.calibrate = feeds.sky, feeds.track, feeds.signals, feeds.calibrate

    def shows(self, dish: OneDish) -> bool:
        """Return whether pages, keys and questions are about this dish. Any thread."""
        return self.dishes.shown is dish

    @property
    def settings(self) -> AppOptions:
        """What the app was told of the dish that is shown."""
        return self.dishes.shown.settings

    @settings.setter
    def settings(self, settings: AppOptions) -> None:
        self.dishes.shown.settings = settings

    def tell_event(self, dish: OneDish, event: Event) -> None:
        """Pass an event on. Runs on the station's thread, and does nothing else there."""
        self.post_message(StationEvent(event, dish))

    def tell_sky(self, dish: OneDish, sky: SkyPicture) -> None:
        """Pass on what a dish's watch of the sky has seen. Any thread."""
        self.post_message(SkyChanged(sky, dish))

    def note(self, words: str) -> None:
        """Show what a command did, and keep it with the time; nothing shows nothing."""
        self.dishes.shown.note(words)

    def say(self, words: str) -> None:
        """Tell what was done, or why not, in one sentence."""
        self.note(words)
        self.paint()

    def say_once(self, words: str) -> None:
        """Say it, unless that was done in this run."""
        self.feeds.notes.tell_once(words, self.session.clock.utc())

    def _rest(self) -> None:
        """Do what a second asks for where no frame is due; a tour that is still to begin waits for no frame."""
        if any(dish.tour.running for dish in self.dishes.all):
            self._tick()
        else:
            self.dishes.keep()

    def _tick(self) -> None:
        """Move the tour on and draw: ages and the time have changed."""
        self.dishes.step_tours(self.view())
        self.dishes.keep()
        self.frames.changed()

    def news(self, dish: OneDish) -> None:
        """Draw what a dish was told; a tour that is still to begin waits for no frame."""
        dish.feeds.link_book.hear(dish.station.state.link)
        if dish.tour.running:
            self.dishes.step_tours(self.view())
        self.frames.changed()

    @on(StationEvent)
    def _hear(self, message: StationEvent) -> None:
        event, dish = message.event, message.of
        assert isinstance(dish, OneDish), "`tell_event` is the only one who tells"
        if words := event_words(event, dish.station.state):
            dish.note(words)
        dish.track.hear(event)
        self.news(dish)

    @on(SkyChanged)
    def _see(self, message: SkyChanged) -> None:
        assert isinstance(message.of, OneDish), "`tell_sky` is the only one who tells"
        sky = message.of.feeds.sky
        first, sky.now = sky.now is None, message.sky
        if first or message.sky.searched != 1.0:
            self.frames.changed()  # else the next frame is soon enough: one comes every second
