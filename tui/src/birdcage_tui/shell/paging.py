"""Going from page to page: one after another, in the order of the keys, however fast they are pressed."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from textual.widgets import ContentSwitcher

from birdcage_tui.pages.register import make_page
from birdcage_tui.widgets.page import Page

if TYPE_CHECKING:
    from birdcage_tui.shell.shell import Shell


class Paging:
    """Shows pages, and slides the console over them; each is loaded and mounted on its first visit."""

    def __init__(self, shell: Shell) -> None:
        self._shell = shell
        self._turn = asyncio.Lock()
        """A first visit takes a while: the next key waits for it, and so the last one pressed is what is seen."""

    async def show(self, name: str, then: str | None) -> None:
        """Show a page; `then` is one of its commands, to be done there."""
        async with self._turn:
            await (self._console(then) if name == "console" else self._page(name, then))

    @property
    def _pages(self) -> ContentSwitcher:
        return self._shell.screen_stack[0].query_one("#pages", ContentSwitcher)

    async def _console(self, then: str | None) -> None:
        """Slide the console over the page, or away again; with `then`, one of its commands, it stays."""
        shell = self._shell
        if shell.folded:
            shell.note("The console needs 80x24 or more.")
            shell.paint()
            return
        if shell.sheet is None:
            from birdcage_tui.console.overlay import ConsoleOverlay

            shell.sheet = ConsoleOverlay(shell)
            await shell.screen_stack[0].query_one("#stage").mount(shell.sheet)
            shell.sheet.open()
        elif not shell.sheet.is_open:
            shell.sheet.open()
        elif then is None:
            shell.sheet.close()
            self._arrive()
        if then is not None:
            shell.sheet.do(then)
        shell.call_after_refresh(shell.paint)

    async def _page(self, name: str, then: str | None) -> None:
        shell, pages, page_id = self._shell, self._pages, f"page-{name}"
        page = next((page for page in pages.children if page.id == page_id), None)
        if page is None:
            page = make_page(name)
            page.display = False
            await pages.mount(page)
        if pages.current != page_id:
            with shell.batch_update():  # one repaint, not one of the old layout and another of the new
                if isinstance(page, Page):
                    page.show(shell.view())  # as it will be seen: else what it showed last would be painted first
                pages.current = page_id
                if not shell.folded:
                    self._arrive()
        if shell.folded:
            shell.note("Pages need 80x24 or more.")
            then = None
        shell.watch_page()
        shell.call_after_refresh(shell.paint)
        if then is not None:
            shell.page.do(then)

    def _arrive(self) -> None:
        """Give the focus to what the page wants it on; never to a text field. An open console keeps it."""
        shell, page = self._shell, self._pages.visible_content
        if shell.sheet is not None and shell.sheet.is_open:
            return
        first = page.FIRST_FOCUS if isinstance(page, Page) else None
        shell.screen_stack[0].set_focus(page.query_one(first) if page is not None and first is not None else None)
