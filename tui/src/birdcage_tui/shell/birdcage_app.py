"""The app: one screen, and the way from the station's events to a frame.

Its parts know one thing each:

- `dish_app`: which dish all is about; `dishes`: those of the app; `one_dish`: what is each one's own.
- `frame_feeds`: where a frame's data come from; `frame_pacer`: when one is drawn; `appearance`: how it looks.
- `page_stage`: which page is seen, and what the station reads for it.
- `key_queue`: what was typed; `deeds`: what a command does; `questions`: what is asked before that.
- `motions`: what you asked the dish to do; `ending`: how the app ends.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.station.requests import Goto, Request
from textual import events, on
from textual.app import ComposeResult
from textual.binding import Binding
from textual.containers import Container
from textual.driver import Driver
from textual.filter import LineFilter
from textual.screen import Screen
from textual.widgets import ContentSwitcher, Input, TextArea

from birdcage_tui import commands
from birdcage_tui.drawing.screen_size import size_classes
from birdcage_tui.drawing.terminal_cells import aspect_of
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.pages.dashboard import DashboardPage
from birdcage_tui.shell.appearance import Appearance, Ground
from birdcage_tui.shell.deeds import Deeds
from birdcage_tui.shell.dish_app import DishApp
from birdcage_tui.shell.ending import Ending
from birdcage_tui.shell.frame_pacer import FramePacer
from birdcage_tui.shell.key_queue import KeyQueue
from birdcage_tui.shell.page_stage import PageStage
from birdcage_tui.shell.questions import Questions
from birdcage_tui.shell.start_objects import StartObjects
from birdcage_tui.shell.stopping import driver_for
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.esc_field import EscField
from birdcage_tui.widgets.footer import KeyBar, PageBar
from birdcage_tui.widgets.messages import CommandChosen
from birdcage_tui.widgets.other_dish import OtherDishRow
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.palette import CommandProvider
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.status import BadDayRow, TopRow

if TYPE_CHECKING:
    from birdcage.station.access import FaceSession


class BirdcageApp(DishApp):
    """A ground station in a terminal."""

    TITLE = "birdcage"
    CSS_PATH = Path(__file__).with_name("app.tcss")
    AUTO_FOCUS = None
    ENABLE_COMMAND_PALETTE = False  # Textual's own, over row 1; ours is a command
    COMMANDS = {CommandProvider}  # noqa: RUF012
    BINDINGS = [  # noqa: RUF012
        Binding(key, f"key({key!r})", show=False, priority=priority) for key, priority in commands.KEYS.items()
    ]
    """One for each key of the table: what it does depends on what has the focus."""

    def __init__(
        self, session: FaceSession, settings: AppOptions | None = None, *also: tuple[FaceSession, AppOptions]
    ) -> None:
        """Show the dish of `session`; `also` are those that are driven beside it."""
        super().__init__()
        first = settings or AppOptions()
        self._appearance = Appearance(self, first.theme, first.glyphs)
        self.frames = FramePacer(self, self.paint, 1.0 / first.update_hz)
        self.keys = KeyQueue(self, super().on_event, self.means_stop, self._stop, self._stopped)
        self.take_dishes(((session, first), *also))
        self.stage = PageStage(self, self)
        self.questions = Questions(self, self)
        self.deeds = Deeds(self, self)
        self.ending = Ending(self, self)
        self.aim: tuple[float, float] | None = None
        """Where the go-to line would lead, while one types into it."""
        self._start_objects = StartObjects()

    def get_driver_class(self) -> type[Driver]:
        """Return the driver of this terminal, with STOP in front."""
        return driver_for(super().get_driver_class())

    def get_default_screen(self) -> Screen[None]:
        """Return the screen under everything."""
        return Ground(id="_default")

    def get_line_filters(self) -> Sequence[LineFilter]:
        """Return what finished rows go through."""
        return self._appearance.filters(super().get_line_filters())

    def compose(self) -> ComposeResult:
        """Rows 1 and 2, the pages, the footer."""
        yield TopRow()
        if self.dishes.several:
            yield OtherDishRow()
        yield BadDayRow()
        with Container(id="stage"), ContentSwitcher(initial="page-dashboard", id="pages"):
            yield DashboardPage(id="page-dashboard")
        yield GotoLine()
        yield from (PageBar(), KeyBar())

    def on_mount(self) -> None:
        """Show a first frame; the session begins only after it has been painted. A signal may have come before."""
        self.theme_changed_signal.subscribe(self, self._recolour)
        self.frames.begin(self._tick, self._rest, lambda: self.feeds.is_late(watched=self.stage.watched))
        self.call_after_refresh(self._begin)
        self.ending.leave_by_signal()

    def _begin(self) -> None:
        self._start_objects.freeze()
        self.dishes.begin()
        self.stage.watch()
        if self.settings.first_page != "dashboard":
            self.show_page(self.settings.first_page)
        self.paint()

    def on_unmount(self) -> None:
        """Hear no more events, and let go of what was made."""
        self.dishes.close()
        self._start_objects.thaw()

    def view(self) -> View:
        """Return what one frame shows, now."""
        return self.feeds.frame(
            self.settings, self.stage, self.motions,
            tour=self.dishes.shown.tour.says, aim=self.aim,
            typing=bool(self.screen_stack) and isinstance(self.focused, Input),
            tag=self.dishes.shown.tag, others=self.dishes.glances(),
        )  # fmt: skip

    def paint(self) -> None:
        """Draw a frame; only rows that changed are sent."""
        if not self.is_running or not self.screen_stack:
            return
        self.frames.painted()
        view, base = self.view(), self.screen_stack[0]
        with self.batch_update():
            for part in (
                *(screen.query_one_optional(TopRow) for screen in self.screen_stack),
                *(base.query_one_optional(kind) for kind in (OtherDishRow, BadDayRow, PageBar, KeyBar, GotoLine)),
                self.stage.open_sheet,
                self.stage.seen(),
                *(screen for screen in self.screen_stack if isinstance(screen, Dialog)),
                base.focused if isinstance(base.focused, EscField) else None,
            ):
                if part is not None:  # none is left when the app ends
                    part.show(view)
        self.frames.run(animated=view.animated)

    @on(events.Resize)
    def _find_aspect(self, event: events.Resize) -> None:
        """Find out the shape of a character: another font has another."""
        told = event.pixel_size
        if told is not None and event.size:
            aspect = aspect_of(told.width / event.size.width, told.height / event.size.height)
            if aspect is not None:
                self.cell_aspect_told(aspect)
        elif (ask := getattr(self._driver, "ask_cell_size", None)) is not None:
            ask()

    def cell_aspect_told(self, aspect: float) -> None:
        """Take what the terminal says of its characters, where no setting says it. Any thread."""
        self.soon(lambda: self._take_aspect(aspect))

    def _take_aspect(self, aspect: float) -> None:
        if not self.settings.cell_aspect_set and aspect != self.settings.cell_aspect:
            self.settings = replace(self.settings, cell_aspect=aspect)
            self.paint()

    def _recolour(self, _: object) -> None:
        for pane in self.screen_stack[0].query(Pane):
            pane.redraw()

    @on(events.Resize)
    async def _lay_out(self, event: events.Resize) -> None:
        """Choose the layout."""
        width, height = event.size  # `self.size` may still be the old one
        screen = self.screen_stack[0]
        classes = size_classes(width, height)
        for name, holds in classes.items():
            screen.set_class(holds, name)
        self.set_class(classes["-tiny"], "-tiny")
        await self.stage.fold(classes["-tiny"], watches=self.dishes.shown.has_begun)
        self.call_after_refresh(self.paint)

    def show_page(self, name: str, then: str | None = None) -> None:
        """Show a page, or slide the console over it; `then` is one of its commands, to be done there."""
        self.run_worker(self.stage.show(name, then), group="page", exclusive=False)

    def show_other_dish(self) -> None:
        """Show the next dish on the page that is seen now."""
        self.run_worker(self.stage.change_dish(self.take_next), group="page", exclusive=False)

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread; nothing happens once the app has ended."""
        self.call_later(work)

    @property
    def page(self) -> Page:
        """The page that is seen."""
        page = self.stage.seen()
        assert page is not None, "the first page is composed with the app"
        return page

    def watch_page(self) -> None:
        """Have the station read what the page that is seen shows now."""
        self.stage.watch()

    def typing_changed(self) -> None:
        """The console's line has the focus, or no longer (also because the app ends, page by page)."""
        self.stage.typing_changed()

    def means_stop(self, event: events.Key) -> bool:
        """Return whether a key is STOP now: Ctrl+C, Space outside text, Esc while anything may move. Any thread.

        A text field counts from when it has its place on the screen: before, a person can't mean it.
        """
        if event.key == "space":
            screens = self.screen_stack  # none when the app ends
            focused = screens[-1].focused if screens else None
            return not (isinstance(focused, Input | TextArea) and focused.region.area)
        return event.key == "ctrl+c" or (event.key == "escape" and self.view_may_move())

    def _stop(self) -> None:
        self.dishes.stop(YOU)

    def view_may_move(self) -> bool:
        """Return whether any dish moves or may move by itself. Any thread."""
        return self.dishes.may_move

    async def on_event(self, event: events.Event) -> None:
        """STOP comes before bindings, widgets and frames."""
        if not await self.keys.take(event):
            await super().on_event(event)

    def _stopped(self) -> None:
        self.end_tour()
        self.note("STOP.")
        self.frames.changed()

    def end_tour(self) -> None:
        """Let the demo do nothing by itself any more."""
        self.dishes.end_tours()

    def action_key(self, key: str) -> None:
        """Do what the key means to what has the focus."""
        command = commands.for_key(key, [scope.scope for scope in self.stage.scopes()])
        if command is not None:
            self.deeds.do(command.name)

    def action_command(self, name: str) -> None:
        """Do the command, or say why not."""
        self.deeds.do(name)

    def open_goto(self, text: str = "") -> None:
        """Open the go-to line, over whatever page is seen."""
        self.deeds.open_goto(text)

    def ask(self, request: Request) -> None:
        """Submit a request; if it fails, the sentence of its error is shown."""
        self.motions.ask(request)

    def begin_way(self) -> Future[object]:
        """Count a motion of yours that somebody else will submit as under way, until what is returned is done."""
        return self.motions.begin_way()

    def move_to(self, place: SitePlace) -> None:
        """Let every page and the search for passes count from another place."""
        self.settings = replace(self.settings, place=place)
        for page in self.screen_stack[0].query(Page):
            page.place_changed()
        self.horizon.place_changed()
        self.dishes.keep()

    def begin_anew(self) -> None:
        """End, and begin again with the settings as they are then."""
        self.ending.begin_anew()

    def leave(self) -> None:
        """STOP first if anything moves, and end."""
        self.ending.leave()

    def _handle_exception(self, error: Exception) -> None:
        """End the app by an error. A layer or a page that was still being made when a person left is none."""
        if self.keys.closed:
            self._close_messages_no_wait()
        else:
            super()._handle_exception(error)

    def terminal_gone(self) -> None:
        """End as by SIGHUP: the driver has found the terminal closed. Any thread."""
        self.ending.terminal_gone()

    @property
    def fault(self) -> Exception | None:
        """What ended the app, if a fault of birdcage did."""
        return self._exception

    def restore_terminal(self) -> bool:
        """Give the terminal back where the app's own thread no longer can; return whether it takes any words."""
        restore: Callable[[], bool] | None = getattr(self._driver, "restore", None)
        return restore is not None and restore()

    def on_stop_button_pressed(self) -> None:
        """The mouse stops."""
        self.deeds.stop()

    def on_bad_day_row_pressed(self, event: BadDayRow.Pressed) -> None:
        """The mouse releases or acknowledges; the dish that the row told of, and no other."""
        if event.tag == self.dishes.shown.tag:
            self.deeds.release()

    def on_command_chosen(self, event: CommandChosen) -> None:
        """The mouse does what a key does."""
        self.action_command(event.name)

    def on_goto_line_sent(self, event: GotoLine.Sent) -> None:
        """Go where the person typed."""
        self.ask(Goto(event.az_deg, event.el_deg, YOU))

    def on_goto_line_skew_sent(self, event: GotoLine.SkewSent) -> None:
        """Turn the skew to what the person typed."""
        self.motions.turn_skew(event.deg)
