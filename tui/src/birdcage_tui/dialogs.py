"""Dialogs lie over a page and leave row 1 alive: a question in words."""

from __future__ import annotations

from typing import TypeVar, cast

from rich.text import Text
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.screen import ModalScreen
from textual.widgets import Static

from birdcage_tui.host import Host
from birdcage_tui.status import TopRow

Answer = TypeVar("Answer")


class Dialog(ModalScreen[Answer]):
    """Lies over a page, and leaves row 1 alive."""

    def on_mount(self) -> None:
        """Fill row 1."""
        cast(Host, self.app).paint()


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
            yield Static(self._words, markup=False)
            yield Static(
                Text.assemble(
                    "\n", (" y ", "bold reverse"), f" {self._yes}      ", (" Esc ", "bold reverse"), " do nothing"
                )
            )

    def action_answer(self, yes: bool) -> None:
        """Close with the answer."""
        self.dismiss(yes)
