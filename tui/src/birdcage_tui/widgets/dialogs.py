"""Dialogs lie over a page and leave row 1 alive: a question in words."""

from __future__ import annotations

from typing import TypeVar, cast

from rich.text import Text
from textual import on
from textual.app import ComposeResult
from textual.await_complete import AwaitComplete
from textual.containers import Vertical, VerticalScroll
from textual.message import Message
from textual.screen import ModalScreen, Screen
from textual.widgets import Static

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.stop_words import esc_text, stop_keys
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.status import TopRow

Found = TypeVar("Found")
EDGE = 2
"""Columns of the lower edge of a frame's inside that its words leave free."""


class Layer(Screen[Found]):
    """What lies over a page and is closed once, by an answer: dialogs, help, the palette, the letters of a jump.

    The base after one of Textual's own.
    """

    def dismiss(self, result: Found | None = None) -> AwaitComplete:
        """Close with a result; do nothing where it is closed already, or where another layer lies over it.

        Textual would close whatever lies on top then: a dialog that is not answered, or the last screen, which
        ends the app. A second click, or a message that was under way, is enough for that.
        """
        stack = self.app.screen_stack
        on_top = bool(stack) and stack[-1] is self
        return super().dismiss(result) if on_top else AwaitComplete()


class Dialog(ModalScreen[Found], Layer[Found]):
    """Lies over a page, and leaves row 1 alive."""

    KEYS = ""
    """What its keys do, for the lower edge of its frame; `show` adds what closes it and what stops the dish."""
    OTHER = ""
    """What closes it while anything moves or may move: Esc stops the dish then, and the dialog stays."""

    _edge = ""

    def on_mount(self) -> None:
        """Fill row 1."""
        cast(AppHost, self.app).paint()

    def show(self, view: View) -> None:
        """Name in the frame the key that closes it now, which is a target for the mouse, and what stops the dish."""
        frame = self.query_one_optional(Vertical)
        closes = esc_text(view, closes="closes", other=self.OTHER)
        target = f"[bold @click=screen.leave]{closes}[/]"
        shapes = ((f"{self.KEYS}, ", f", {stop_keys(view)}"), (f"{self.KEYS}, ", ""), ("", ""))
        if view.may_move:  # where Esc does not close it, that comes before what Enter does
            shapes = (shapes[0], ("", f", {stop_keys(view)}"), ("", ", Esc stops"))
        room = self.size.width if frame is None else frame.size.width - EDGE
        before, after = next(
            (shape for shape in shapes if len(shape[0]) + len(closes) + len(shape[1]) <= room), shapes[-1]
        )
        words = f"{before}{target}{after}"
        if self.KEYS and words != self._edge and frame is not None:
            self._edge = frame.border_subtitle = words

    def action_leave(self) -> None:
        """Close without a result."""
        self.dismiss(None)


DECLINE = "do nothing"
TAKEN_IN_S = 1.0
"""So long after a question came by itself `y` is a key for what was there before, and no answer."""


class AnswerRow(Static):
    """One answer on a row of its own: its key, its words, and a target for the mouse."""

    class Given(Message):
        """A person pressed it."""

        def __init__(self, yes: bool) -> None:
            super().__init__()
            self.yes = yes

    def __init__(self, key: str, words: str, *, yes: bool) -> None:
        super().__init__()
        self.means_yes, self._told = yes, ("", "")
        self.tell(key, words)

    def tell(self, key: str, words: str) -> None:
        """Show this key and these words."""
        if self._told != (key, words):
            self._told = (key, words)
            self.update(Text.assemble((f" {key} ", "bold reverse"), f" {words}"))

    def on_click(self) -> None:
        """Tell the dialog."""
        self.post_message(self.Given(self.means_yes))


class QuestionScreen(Dialog[bool]):
    """Asks once, in words that name the consequence. `y` does it; Esc, n or Enter do not.

    `by_itself`: it may come up while a person presses keys, and no key has asked for it just before.
    """

    BINDINGS = [("y", "answer(True)", "yes"), ("escape,n,enter", "answer(False)", "no")]  # noqa: RUF012

    def __init__(self, title: str, words: str, yes: str, *, by_itself: bool = False) -> None:
        super().__init__()
        self._title, self._words, self._yes = title, words, yes
        self._by_itself, self._came_at = by_itself, 0.0

    def compose(self) -> ComposeResult:
        """The words, and both answers."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = self._title
            with VerticalScroll():
                yield Static(self._words, markup=False)
            with Vertical(id="answers"):
                yield AnswerRow(" y ", self._yes, yes=True)
                yield AnswerRow("Esc", DECLINE, yes=False)

    def on_mount(self) -> None:
        """Let the arrows scroll words that are longer than the screen."""
        super().on_mount()
        self.query_one(VerticalScroll).focus()
        self._came_at = cast(AppHost, self.app).view().now

    def show(self, view: View) -> None:
        """Name the key that declines: Esc stops the dish while it moves or may move."""
        esc = ("n", f"{DECLINE}. Esc stops the dish") if view.may_move else ("Esc", DECLINE)
        for answer in self.query(AnswerRow):
            if not answer.means_yes:
                answer.tell(*esc)

    @on(AnswerRow.Given)
    def _given(self, answer: AnswerRow.Given) -> None:
        self.dismiss(answer.yes)

    def action_answer(self, yes: bool) -> None:
        """Close with the answer, unless it came too early to be one."""
        early = cast(AppHost, self.app).view().now - self._came_at < TAKEN_IN_S
        if not (yes and self._by_itself and early):
            self.dismiss(yes)
