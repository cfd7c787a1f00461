"""Dialogs lie over a page and leave row 1 alive: a question in words."""

from __future__ import annotations

from typing import TypeVar, cast

from rich.text import Text
from textual import on
from textual.app import ComposeResult
from textual.containers import Vertical, VerticalScroll
from textual.message import Message
from textual.screen import ModalScreen
from textual.widgets import Static

from birdcage_tui.host import Host
from birdcage_tui.status import TopRow

Found = TypeVar("Found")


class Dialog(ModalScreen[Found]):
    """Lies over a page, and leaves row 1 alive."""

    def on_mount(self) -> None:
        """Fill row 1."""
        cast(Host, self.app).paint()


class Answer(Static):
    """One answer on a row of its own: its key, its words, and a target for the mouse."""

    class Given(Message):
        """A person pressed it."""

        def __init__(self, yes: bool) -> None:
            super().__init__()
            self.yes = yes

    def __init__(self, key: str, words: str, *, yes: bool) -> None:
        super().__init__(Text.assemble((f" {key} ", "bold reverse"), f" {words}"))
        self._means_yes = yes

    def on_click(self) -> None:
        """Tell the dialog."""
        self.post_message(self.Given(self._means_yes))


class QuestionScreen(Dialog[bool]):
    """Asks once, in words that name the consequence. `y` does it; Esc, n or Enter do not."""

    BINDINGS = [("y", "answer(True)", "yes"), ("escape,n,enter", "answer(False)", "no")]  # noqa: RUF012

    def __init__(self, title: str, words: str, yes: str) -> None:
        super().__init__()
        self._title, self._words, self._yes = title, words, yes

    def compose(self) -> ComposeResult:
        """The words, and both answers."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = self._title
            with VerticalScroll():
                yield Static(self._words, markup=False)
            with Vertical(id="answers"):
                yield Answer(" y ", self._yes, yes=True)
                yield Answer("Esc", "do nothing", yes=False)

    def on_mount(self) -> None:
        """Let the arrows scroll words that are longer than the screen."""
        super().on_mount()
        self.query_one(VerticalScroll).focus()

    @on(Answer.Given)
    def _given(self, answer: Answer.Given) -> None:
        self.dismiss(answer.yes)

    def action_answer(self, yes: bool) -> None:
        """Close with the answer."""
        self.dismiss(yes)
