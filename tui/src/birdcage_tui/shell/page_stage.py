"""The stage: which page is seen, one after another in the order of the keys, and what the station reads for it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from birdcage.station.requests import Unwatch, Watch
from textual.app import App
from textual.widget import Widget
from textual.widgets import ContentSwitcher

from birdcage_tui.console.console_host import ConsoleHost
from birdcage_tui.feeds.signal_feed import SignalFeed
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.pages.register import make_page
from birdcage_tui.shell.key_queue import idle
from birdcage_tui.widgets.other_dish import OtherDishRow
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.scope import Scope

if TYPE_CHECKING:
    from birdcage_tui.console.overlay import ConsoleOverlay, DishLog
    from birdcage_tui.console.tap import WireTap


class StageHost(ConsoleHost, Protocol):
    """The app, seen from its stage."""

    signals: SignalFeed

    def note(self, words: str) -> None:
        """Show what a command did, and keep it."""

    def paint(self) -> None:
        """Draw a frame."""


class PageStage:
    """Shows pages, and slides the console over them; each is loaded and mounted on its first visit."""

    def __init__(self, app: App[None], host: StageHost) -> None:
        self._app, self._host = app, host
        self._turn = asyncio.Lock()
        """A first visit takes a while: the next key waits for it, and so the last one pressed is what is seen."""
        self.sheet: ConsoleOverlay | None = None
        """The console, once it was opened."""
        self._logs: dict[WireTap, DishLog] = {}
        """What it has seen of each dish."""
        self._pocket: Page | None = None
        self.folded = False
        """Whether the pocket view stands in for every page."""
        self._watching: str | None = None
        self._features: frozenset[str] = frozenset()

    @property
    def watched(self) -> bool:
        """Whether the visible page has the station ask the dish all the time."""
        return self._watching is not None

    @property
    def open_sheet(self) -> ConsoleOverlay | None:
        """The console while it lies over the page; else None."""
        return self.sheet if self.sheet is not None and self.sheet.is_open else None

    def seen(self) -> Page | None:
        """Return the page that is seen; None before one is there, and when the app ends."""
        if self.folded:
            return self._pocket
        pages = self._app.screen_stack[0].query_one_optional("#pages")
        found = () if pages is None else pages.children
        return next((page for page in found if isinstance(page, Page) and page.display), None)

    def scopes(self) -> tuple[Scope, ...]:
        """Return whose commands hold now, innermost first."""
        page = self.seen() if self._app.screen_stack else None
        if page is None:
            return ()
        focused, sheet = self._app.screen_stack[0].focused, self.open_sheet
        chain = [] if focused is None else focused.ancestors_with_self
        outermost: list[Widget] = [page]
        if sheet is not None and not self.folded:
            # The console lies over the page, whose keys hold only while something of it has the focus.
            outermost = [page, sheet] if page in chain else [sheet]
        outermost.extend(self._app.screen_stack[0].query(OtherDishRow))
        return tuple(node for node in dict.fromkeys((*chain, *outermost)) if isinstance(node, Scope))

    def watch(self) -> None:
        """Ask the station to read what the visible page shows, and nothing else."""
        page, station = self.seen(), self._host.station
        typing = self.sheet is not None and self.sheet.typing
        features = self._host.signals.watch(page.watches if page is not None else frozenset(), typing=typing)
        features = features & {"position"} if typing else features  # the rest would change the menu meanwhile
        wanted = page.id if page is not None and features else None
        if (wanted, features) == (self._watching, self._features):
            return
        if self._watching not in (None, wanted):
            station.submit(Unwatch(self._watching))
        if wanted is not None and page is not None:
            station.submit(Watch(wanted, features, page.RATE_HZ, agreed=page.agreed))
        self._watching, self._features = wanted, features

    async def change_dish(self, take_next: Callable[[], None]) -> None:
        """Show the next dish on the same page, which is made anew: no widget of one dish ever acts on another.

        `take_next` has the app be about that dish. It is called when what the widgets had still to say has been heard.
        """
        async with self._turn:
            screen, pages = self._app.screen_stack[0], self._pages
            name = (pages.current or "page-dashboard").removeprefix("page-")
            if self._is_asked:
                return  # a question about this dish came up meanwhile
            under_way = next(
                (page.under_way for page in pages.children if isinstance(page, Page) and page.under_way), ""
            )
            if under_way:
                self._host.note(f"Setup is at work. Wait: {under_way}. Then O shows the other dish.")
                self._host.paint()
                return
            pages.current = None  # from here on no page opens a dialog late
            screen.query_one(GotoLine).close()
            screen.set_focus(None)
            if self.sheet is not None:
                self.sheet.close()
                await self.sheet.remove()
                self.sheet = None
            if self._watching is not None:
                self._host.station.submit(Unwatch(self._watching))
            self._watching, self._features = None, frozenset()
            await pages.remove_children()
            if self._pocket is not None:
                await self._pocket.remove()
                self._pocket = None
            for pump in (*screen.query(GotoLine), screen, self._app):
                await idle(pump)
            if not self._is_asked:  # by what was heard last: it is answered for the dish that it was asked about
                take_next()
            if self.folded:
                await self._mount_pocket()
            await self._page(name, None)
            self._host.paint()

    @property
    def _is_asked(self) -> bool:
        return len(self._app.screen_stack) > 1

    def typing_changed(self) -> None:
        """The console's line has the focus, or no longer (also because the app ends, page by page)."""
        stack = self._app.screen_stack
        if stack and stack[0].query("#pages") and self.seen() is not None:
            self.watch()
            self._host.paint()

    async def fold(self, tiny: bool, *, watches: bool) -> None:
        """Below 80x24 the pocket view stands in for every page; once all of it is mounted, at its first use."""
        screen = self._app.screen_stack[0]
        if tiny and self._pocket is None:
            await self._mount_pocket()
        if tiny != self.folded:
            self.folded = tiny
            screen.set_focus(None)
            if watches:
                self.watch()

    async def _mount_pocket(self) -> None:
        from birdcage_tui.pages.pocket import PocketPage

        self._pocket = PocketPage()
        await self._app.screen_stack[0].mount(self._pocket, before="#stage")

    async def show(self, name: str, then: str | None) -> None:
        """Show a page; `then` is one of its commands, to be done there."""
        async with self._turn:
            await (self._console(then) if name == "console" else self._page(name, then))

    @property
    def _pages(self) -> ContentSwitcher:
        return self._app.screen_stack[0].query_one("#pages", ContentSwitcher)

    async def _console(self, then: str | None) -> None:
        """Slide the console over the page, or away again; with `then`, one of its commands, it stays."""
        app, host = self._app, self._host
        if self.folded:
            host.note("The console needs 80x24 or more.")
            host.paint()
            return
        if self.sheet is None:
            from birdcage_tui.console.overlay import ConsoleOverlay

            self.sheet = ConsoleOverlay(host, self._logs.get(host.tap))
            self._logs[host.tap] = self.sheet.dish_log
            await app.screen_stack[0].query_one("#stage").mount(self.sheet)
            self.sheet.open()
        elif not self.sheet.is_open:
            self.sheet.open()
        elif then is None:
            self.sheet.close()
            self._arrive()
        if then is not None:
            self.sheet.do(then)
        app.call_after_refresh(host.paint)

    async def _page(self, name: str, then: str | None) -> None:
        app, pages, page_id = self._app, self._pages, f"page-{name}"
        page = next((page for page in pages.children if page.id == page_id), None)
        if page is None:
            page = make_page(name)
            page.display = False
            await pages.mount(page)
        if pages.current != page_id:
            with app.batch_update():  # one repaint, not one of the old layout and another of the new
                if isinstance(page, Page):
                    page.show(self._host.view())  # as it will be seen: else what it showed last would be painted first
                pages.current = page_id
                if not self.folded:
                    self._arrive()
        if self.folded:
            self._host.note("Pages need 80x24 or more.")
            then = None
        self.watch()
        app.call_after_refresh(self._host.paint)
        if then is not None and (seen := self.seen()) is not None:
            seen.do(then)

    def _arrive(self) -> None:
        """Give the focus to what the page wants it on; never to a text field. An open console keeps it."""
        page = self._pages.visible_content
        if self.open_sheet is not None:
            return
        first = page.FIRST_FOCUS if isinstance(page, Page) else None
        self._app.screen_stack[0].set_focus(page.query_one(first) if page is not None and first is not None else None)
