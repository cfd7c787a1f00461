"""The palette, made from the table of commands: one line an entry, what cannot be done now last, with its reason."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import cast

from textual import events
from textual.app import ComposeResult
from textual.command import CommandList, CommandPalette, DiscoveryHit, Hit, Hits, Provider
from textual.containers import Vertical
from textual.content import Content
from textual.widgets import Input

from birdcage_tui.commands import COMMANDS, PAGES, Command, in_force
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.status import TopRow

KEY_WIDTH = 8
"""Columns of a key, right-aligned."""
CURSOR = 1e-1
"""Factor on the score of a key that only moves a cursor."""
CURSOR_KEYS = frozenset({"up", "down", "left", "right", "pageup", "pagedown", "home", "end"})
MOVING = ("Jog", "Nudge")
"""Groups whose arrows move the dish."""
REFUSED = 1e-3
"""Factor on the score of what cannot be done now: it comes after all that can."""


class Palette(CommandPalette, Dialog[None]):
    """Textual's palette in the frame of our dialogs, under row 1: status and the mouse's STOP are never covered."""

    ID = "--command-palette"
    """Textual looks for it, to open no second one."""
    KEYS = "Enter runs it"

    def __init__(self) -> None:
        super().__init__(placeholder="Type part of a command", id=self.ID)

    def compose(self) -> ComposeResult:
        """Row 1, then what Textual has."""
        yield TopRow()
        yield from super().compose()

    def on_mount(self) -> None:
        """Name the frame; fill row 1, and let the footer know that one types, once the field has the focus."""
        self.query_one(Vertical).border_title = "All commands"
        self.call_after_refresh(cast(AppHost, self.app).paint)

    def show(self, view: View) -> None:
        """Say what Backspace does with what is typed, while Esc stops the dish."""
        self.OTHER = "Backspace closes if empty" if self._typed else "Backspace closes"
        super().show(view)

    def on_key(self, event: events.Key) -> None:
        """Close by Backspace where nothing is typed: Esc stops the dish while it moves."""
        if event.key == "backspace" and not self._typed:
            event.stop()
            self.action_leave()

    @property
    def _typed(self) -> bool:
        """Whether anything is typed; a frame may be painted while the palette is still being made, or taken apart."""
        field = self.query_one_optional(Input)
        return field is not None and bool(field.value)

    def action_leave(self) -> None:
        """Close, and look for nothing more."""
        self._action_escape()

    def _action_command_list(self, action: str) -> None:
        """Move in the list. Pages of one that is not drawn yet, or has no row here, cannot be turned."""
        if "page" not in action or self.query_one(CommandList).scrollable_content_region:
            super()._action_command_list(action)


def page_of(command: Command) -> str:
    """Return the title of the page on which the command holds; empty for one that holds everywhere."""
    where = command.page or (command.where[0] if command.where else "")
    return next((title for name, title, _ in PAGES if name == where), "")


def nearness(query: str, command: Command, *, here: bool) -> float:
    """Return how well a command's title answers: 0 where a word of the query is no part of it.

    A whole word, or the beginning of a page's name, counts most, then the beginning of a word; keys that only move a
    cursor come last, and where they do nothing they are left out.
    """
    title = command.title.casefold()
    words = title.split()
    asked = query.casefold().split()
    cursor = bool(CURSOR_KEYS.intersection(command.keys)) and command.group not in MOVING
    if not asked or not all(part in title for part in asked) or (cursor and not here):
        return 0.0
    is_page = command.name.startswith("page-")
    ranks = [4 if part in words else 3 if is_page else 2 if title.startswith(part) else 1 for part in asked]
    score = sum(ranks) + (0.5 if here else 0.0) + (2.0 if is_page else 0.0)
    return score * (CURSOR if cursor else 1.0)


class CommandProvider(Provider):
    """Every command by its title, the nearest first."""

    _chosen = False

    def _do(self, command: Command) -> None:
        """Do it, once for each palette: Textual would do it for a second Enter or click as well."""
        if not self._chosen:
            self._chosen = True
            cast(AppHost, self.app).action_command(command.name)

    def _commands(self) -> Iterator[tuple[Command, bool, str | None]]:
        """Yield each command, whether it holds here, and why it cannot be done now: first what can, and holds here."""
        view = cast(AppHost, self.app).view()
        here = in_force(view.scopes)
        found = [(command, command in here, command.refused(view)) for command in (*here, *COMMANDS)]
        known = {entry[0].name: entry for entry in reversed(found)}
        yield from sorted((known[name] for name in dict.fromkeys(entry[0].name for entry in found)),
                          key=lambda entry: (entry[2] is not None, not entry[1]))  # fmt: skip

    def _line(self, title: Content, command: Command, *, here: bool, reason: str | None) -> Content:
        """Return key, title and help, or the reason, in one line; only what can be done now is bold."""
        page = "" if here else page_of(command)
        bold = "bold" if reason is None else ""
        head = Content.assemble((f"{command.shown:>{KEY_WIDTH}}  ", bold), title.stylize_before(bold))
        if self.app.has_class("-tiny"):  # a phone has room for the title alone
            return head
        words = f"Not now: {reason}" if reason is not None else command.help
        return Content.assemble(head, f" ({page})" if page else "", f"  {words}")

    async def discover(self) -> Hits:
        """Yield all, before anything is typed."""
        for command, here, reason in self._commands():
            line = self._line(Content(command.title), command, here=here, reason=reason)
            yield DiscoveryHit(line, partial(self._do, command), text=command.title)

    async def search(self, query: str) -> Hits:
        """Yield what matches."""
        matcher, commands = self.matcher(query), tuple(self._commands())
        scores = [nearness(query, command, here=here) for command, here, _ in commands]
        if not any(scores):  # an abbreviation: letters in this order
            scores = [matcher.match(f"{command.title} {command.name}") for command, _, _ in commands]
        for (command, here, reason), score in zip(commands, scores, strict=True):
            if score > 0:
                line = self._line(matcher.highlight(command.title), command, here=here, reason=reason)
                can = 1.0 if reason is None else REFUSED
                yield Hit(score * can, line, partial(self._do, command), text=command.title)
