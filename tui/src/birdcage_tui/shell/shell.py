"""The shell: one screen, pages behind keys, and the way from the station's events to what is drawn."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.station.events import Event, MoveEnded
from birdcage.station.requests import Unwatch, Watch
from textual import events, on
from textual.app import ComposeResult
from textual.binding import Binding
from textual.containers import Container
from textual.driver import Driver
from textual.timer import Timer
from textual.widgets import ContentSwitcher, Input

from birdcage_tui import commands
from birdcage_tui.console.tap import WireTap
from birdcage_tui.drawing.screen_size import size_classes
from birdcage_tui.feeds.calibrate_feed import CalibrateFeed
from birdcage_tui.feeds.clock_watch import ClockWatch
from birdcage_tui.feeds.horizon_book import HorizonBook
from birdcage_tui.feeds.preset_book import PresetBook
from birdcage_tui.feeds.ready_watch import ReadyWatch
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.feeds.signal_feed import SignalFeed
from birdcage_tui.feeds.sky_feed import SkyFeed
from birdcage_tui.feeds.track_feed import TrackFeed
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.pages.dashboard import DashboardPage
from birdcage_tui.shell.key_queue import KeyQueue
from birdcage_tui.shell.paging import Paging
from birdcage_tui.shell.start_objects import StartObjects
from birdcage_tui.shell.stopping import focused_widget, is_stop_key, stop_first
from birdcage_tui.shell.surface import Surface
from birdcage_tui.shell.tour import Tour
from birdcage_tui.shown.clock_told import ClockTold
from birdcage_tui.shown.link_book import LinkBook
from birdcage_tui.shown.notes import Notes
from birdcage_tui.shown.pursuit import says_nothing_new
from birdcage_tui.shown.state_words import ended_text
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.esc_field import EscField
from birdcage_tui.widgets.footer import KeyBar, PageBar
from birdcage_tui.widgets.messages import SkyChanged, StationEvent
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.palette import CommandProvider
from birdcage_tui.widgets.scope import Scope, scopes_of
from birdcage_tui.widgets.status import BadDayRow, TopRow

if TYPE_CHECKING:
    from birdcage.station.session import Session

    from birdcage_tui.console.overlay import ConsoleOverlay

FRESH_S = 0.6
"""A frame younger than this has the time and the ages on it: no other is drawn for them alone."""
LISTEN_S = 0.4
"""Between two looks at how long the dish has been silent."""


class Shell(Surface):
    """What is seen, and when; what commands do is in `app`."""

    TITLE = "birdcage"
    CSS_PATH = Path(__file__).with_name("app.tcss")
    AUTO_FOCUS = None
    ENABLE_COMMAND_PALETTE = False  # Textual's own, over row 1; ours is a command
    COMMANDS = {CommandProvider}  # noqa: RUF012
    BINDINGS = [  # noqa: RUF012
        Binding(key, f"key({key!r})", show=False, priority=priority) for key, priority in commands.KEYS.items()
    ]
    """One for each key of the table: what it does depends on what has the focus."""

    def __init__(self, session: Session, settings: AppOptions | None = None) -> None:
        super().__init__(settings or AppOptions())
        self.session = session
        self.station = session.station
        self.under_way: set[Future[object]] = set()
        """Motions that you asked for and that are not at their end."""
        self.step_deg = 1.0
        """What one press of a jog key is."""
        self.tap = WireTap(self.station.is_steering)
        """What passes on the wire, from the first byte on; the console takes it out."""
        self.tap_problem = ""
        """Why nothing of the wire is heard, as a sentence."""
        self.sheet: ConsoleOverlay | None = None
        """The console, once it was opened."""
        self.presets = PresetBook(self.settings.presets_file)
        """Directions with names; read after the first frame."""
        self.horizon = HorizonBook(self.settings.horizon)
        """The line of trees and roofs."""
        self.sky = SkyFeed(self.settings.sky, lambda sky: self.post_message(SkyChanged(sky)), self.say_soon)
        self.track = TrackFeed(self.settings.track, self.soon, self._news, self.bell)
        self.calibrate = CalibrateFeed(self.settings.calibrate, self.soon, self._changed)
        self.clock_watch = ClockWatch(
            self.settings.clock_check, lambda told: self.soon(partial(self._hear_clock, told))
        )
        self.ready = ReadyWatch(self.settings.ready, self.soon, self._changed)
        self.aim: tuple[float, float] | None = None
        """Where the go-to line would lead, while one types into it."""
        self.signals = SignalFeed(self.settings.signal, self.station, self.soon, self._changed)
        self.link_book = LinkBook()
        self.notes = Notes()
        self._tour = Tour(self.track.set_autotrack)
        if not self.settings.tour:
            self._tour.end()
        self._unsubscribe: Callable[[], None] | None = None
        self._watching: str | None = None
        self._features: frozenset[str] = frozenset()
        self._pocket: Page | None = None
        self.folded = False
        """Whether the pocket view stands in for every page."""
        self._paging = Paging(self)
        self.keys = KeyQueue(self, super().on_event, self.stop_key, self._stopped)
        self._frames: Timer | None = None
        self._late = False
        self._start_objects = StartObjects()

    def get_driver_class(self) -> type[Driver]:
        """Return the platform's driver, with STOP in front."""
        return stop_first(super().get_driver_class())

    def compose(self) -> ComposeResult:
        """Rows 1 and 2, the pages, the footer."""
        yield TopRow()
        yield BadDayRow()
        with Container(id="stage"), ContentSwitcher(initial="page-dashboard", id="pages"):
            yield DashboardPage(id="page-dashboard")
        yield GotoLine()
        yield from (PageBar(), KeyBar())

    def on_mount(self) -> None:
        """Show a first frame; the session begins only after it has been painted."""
        self.theme_changed_signal.subscribe(self, self._recolour)
        self._frames = self.set_interval(self._frame_s, self._tick, pause=True)
        self.set_interval(1.0, self._second)
        self.set_interval(LISTEN_S, self._listen)
        self.call_after_refresh(self._begin)

    def _begin(self) -> None:
        self._start_objects.freeze()
        self.presets.load()
        self.signals.begin()
        self._unsubscribe = self.station.subscribe(self._tell)
        try:
            self.session.on_wire(self.tap.take_in)
        except BirdcageError as problem:
            self.tap_problem = str(problem)
        self.session.start()
        self.sky.begin(self.station.state, self.settings.place, self.horizon.known)
        self.track.begin(self.settings.place, self.horizon.known)
        self.clock_watch.begin()
        self.ready.begin()
        self.watch_page()
        if self.settings.first_page != "dashboard":
            self.show_page(self.settings.first_page)
        self.paint()

    def _tell(self, event: Event) -> None:
        """Pass an event on. Runs on the station's thread, and does nothing else there."""
        self.post_message(StationEvent(event))

    def on_unmount(self) -> None:
        """Hear no more events, and let go of what was made."""
        for each in (self.signals, self.sky, self.track, self.calibrate, self.clock_watch, self.ready):
            each.close()
        if self._unsubscribe is not None:
            self._unsubscribe()
        self._start_objects.thaw()

    def note(self, words: str) -> None:
        """Show what a command did, and keep it with the time; nothing shows nothing."""
        self.notes.tell(words, self.session.clock.utc())

    def view(self) -> View:
        """Return what one frame shows, now."""
        clock, crash = self.session.clock, self.session.crash
        return View(
            self.station.state,
            clock.monotonic(),
            clock.utc(),
            self.settings,
            self.signals.book.samples,
            self._tour.says,
            "" if crash is None else f"{type(crash).__name__}: {crash}",
            self.notes.last,
            self._watching is not None,
            tuple(scope.scope for scope in self.scopes()),
            self.step_deg,
            asked=bool(self.under_way),
            typing=isinstance(focused_widget(lambda: self.focused), Input),
            presets=self.presets.entries,
            aim=self.aim,
            told=self.notes.told,
            sky=self.sky.now,
            horizon=self.horizon.state,
            clock=self.clock_watch.now,
            track=self.track.now,
            followed=tuple(self.track.looks),
            heard=self.signals.book.heard,
            signal_trouble=self.signals.trouble,
            trips=self.link_book.trips,
            calibrate=self.calibrate.now,
            ready=self.ready.now,
        )

    def paint(self) -> None:
        """Draw a frame; only rows that changed are sent."""
        if not self.is_running or not self.screen_stack:
            return
        self._painted = self._loop_time()
        view, base = self.view(), self.screen_stack[0]
        with self.batch_update():
            for part in (
                *(screen.query_one_optional(TopRow) for screen in self.screen_stack),
                *(base.query_one_optional(kind) for kind in (BadDayRow, PageBar, KeyBar, GotoLine)),
                self.sheet if self.sheet is not None and self.sheet.is_open else None,
                self._seen(),
                *(screen for screen in self.screen_stack if isinstance(screen, Dialog)),
                base.focused if isinstance(base.focused, EscField) else None,
            ):
                if part is not None:  # none is left when the app ends
                    part.show(view)
        if self._frames is not None:
            if view.animated:
                self._frames.resume()
            else:
                self._frames.pause()

    def _listen(self) -> None:
        """Draw at once when the dish begins to owe an answer, or has given it."""
        late = View(self.station.state, self.session.clock.monotonic(), self.session.clock.utc(), self.settings,
                    watched=self._watching is not None).late  # fmt: skip
        if late != self._late:
            self._late = late
            self.paint()

    def _second(self) -> None:
        """Tick, unless the dish's answers make for frames often enough: at rest each costs unseen work."""
        if self._tour.running or self._loop_time() - self._painted >= FRESH_S:
            self._tick()
        else:
            self._keep_sky()

    def _keep_sky(self) -> None:
        self.sky.keep(self.station.state, self.settings.place, self.horizon.known)
        self.track.keep(self.settings.place, self.horizon.known, self.station.state.feed_name)

    def _tick(self) -> None:
        """Move the tour on and draw: ages and the time have changed."""
        self._tour.step(self.view())
        self._keep_sky()
        self._changed()

    def _news(self) -> None:
        """Draw what was told; a tour that is still to begin waits for no frame."""
        self.link_book.hear(self.station.state.link)
        if self._tour.running:
            self._tour.step(self.view())
        self._changed()

    @on(StationEvent)
    def _hear(self, message: StationEvent) -> None:
        event = message.event
        if isinstance(event, MoveEnded) and not says_nothing_new(event, self.station.state):
            self.note(ended_text(event))
        self.track.hear(event)
        self._news()

    @on(SkyChanged)
    def _see(self, message: SkyChanged) -> None:
        first, self.sky.now = self.sky.now is None, message.sky
        if first or message.sky.searched != 1.0:
            self._changed()  # else the next frame is soon enough: one comes every second

    def _hear_clock(self, told: ClockTold) -> None:
        self.clock_watch.now = told
        self._changed()

    @on(events.Resize)
    async def _lay_out(self, event: events.Resize) -> None:
        """Choose the layout."""
        width, height = event.size  # `self.size` may still be the old one
        screen = self.screen_stack[0]
        classes = size_classes(width, height)
        for name, holds in classes.items():
            screen.set_class(holds, name)
        self.set_class(classes["-tiny"], "-tiny")
        await self._fold(classes["-tiny"])
        self.call_after_refresh(self.paint)

    async def _fold(self, tiny: bool) -> None:
        """Below 80x24 the pocket view stands in for every page; once all of it is mounted, at its first use."""
        if tiny and self._pocket is None:
            from birdcage_tui.pages.pocket import PocketPage

            self._pocket = PocketPage()
            await self.screen_stack[0].mount(self._pocket, before="#stage")
        if tiny != self.folded:
            self.folded = tiny
            self.screen_stack[0].set_focus(None)
            if self._unsubscribe is not None:
                self.watch_page()

    def _seen(self) -> Page | None:
        """Return the page that is seen; None before one is there, and when the app ends."""
        if self.folded:
            return self._pocket
        pages = self.screen_stack[0].query_one_optional("#pages")
        found = () if pages is None else pages.children
        return next((page for page in found if isinstance(page, Page) and page.display), None)

    def show_page(self, name: str, then: str | None = None) -> None:
        """Show a page, or slide the console over it; `then` is one of its commands, to be done there."""
        self.run_worker(self._paging.show(name, then), group="page", exclusive=False)

    def say_soon(self, words: str) -> None:
        """Tell something soon. Any thread; nothing is told once the app has ended."""
        self.call_later(self.say, words)

    def say(self, words: str) -> None:
        """Tell what was done, or why not, in one sentence."""
        self.note(words)
        self.paint()

    @property
    def page(self) -> Page:
        """The page that is seen."""
        page = self._seen()
        assert page is not None, "the first page is composed with the app"
        return page

    def scopes(self) -> tuple[Scope, ...]:
        """Return whose commands hold now, innermost first."""
        page = self._seen() if self.screen_stack else None
        if page is None:
            return ()
        focused = self.screen_stack[0].focused
        if self.folded or self.sheet is None or not self.sheet.is_open:
            return scopes_of(focused, [page])
        # The console lies over the page, whose keys hold only while something of it has the focus.
        in_page = focused is not None and page in focused.ancestors_with_self
        return scopes_of(focused, [page, self.sheet] if in_page else [self.sheet])

    def watch_page(self) -> None:
        """Ask the station to read what the visible page shows, and nothing else."""
        page = self._seen()
        typing = self.sheet is not None and self.sheet.typing
        features = self.signals.watch(page.WATCHES if page is not None else frozenset(), typing=typing)
        features = features & {"position"} if typing else features  # the rest would change the menu meanwhile
        wanted = page.id if page is not None and features else None
        if (wanted, features) == (self._watching, self._features):
            return
        if self._watching not in (None, wanted):
            self.station.submit(Unwatch(self._watching))
        if wanted is not None and page is not None:
            self.station.submit(Watch(wanted, features, page.RATE_HZ))
        self._watching, self._features = wanted, features

    def typing_changed(self) -> None:
        """The console's line has the focus, or no longer (also because the app ends, page by page)."""
        if self.screen_stack and self.screen_stack[0].query("#pages") and self._seen() is not None:
            self.watch_page()
            self.paint()

    def stop_key(self, event: events.Key) -> bool:
        """Stop the dish if this key means STOP now. Any thread; nothing is painted before it."""
        if not is_stop_key(event.key, focused_widget(lambda: self.focused), self.view_may_move):
            return False
        self.station.stop(YOU)
        return True

    def view_may_move(self) -> bool:
        """Return whether anything moves or may move by itself. Any thread."""
        if self._tour.running or self.under_way:
            return True
        return View(self.station.state, 0.0, self.session.clock.utc(), self.settings, track=self.track.now).may_move

    async def on_event(self, event: events.Event) -> None:
        """STOP comes before bindings, widgets and frames."""
        if not await self.keys.take(event):
            await super().on_event(event)

    def _stopped(self) -> None:
        self.end_tour()
        self.note("STOP.")
        self._changed()

    def end_tour(self) -> None:
        """Let the demo do nothing by itself any more."""
        if self._tour.running:
            self._changed()
        self._tour.end()
