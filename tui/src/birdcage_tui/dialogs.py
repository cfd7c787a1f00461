"""The few things that lie over a page: help, a question in words, and the one-line go-to."""

from __future__ import annotations

import math
import textwrap
from typing import TypeVar, cast

from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical, VerticalScroll
from textual.message import Message
from textual.screen import ModalScreen
from textual.widgets import Input, Label, Static

from birdcage_tui.commands import COMMANDS
from birdcage_tui.host import Host
from birdcage_tui.status import TopRow
from birdcage_tui.view import View

HELP_WIDTH = 70
Answer = TypeVar("Answer")


def help_text(view: View) -> Text:
    """Return all commands with their keys, from the table; what cannot be done now says why."""
    text, group = Text(), ""
    for command in COMMANDS:
        if command.group != group:
            group = command.group
            text.append(f"{group}\n", "bold")
        title = command.title if command.title.endswith("…") else f"{command.title}."
        reason = command.refused(view)
        why = "" if reason is None else f" Not now: {reason}"
        lines = textwrap.wrap(f"{title} {command.help}{why}", HELP_WIDTH - 11)
        text.append(f"  {command.shown:>7}  ", "bold")
        text.append(f"\n{'':11}".join(lines) + "\n")
    text.append("Always\n", "bold")
    text.append("   Ctrl+C  STOP, in text fields and dialogs too.\n")
    text.append("      Esc  STOP while anything moves or may move by itself;\n")
    text.append("           at rest it closes what lies on top.\n")
    return text


class Dialog(ModalScreen[Answer]):
    """Lies over a page, and leaves row 1 alive."""

    def on_mount(self) -> None:
        """Fill row 1."""
        cast(Host, self.app).paint()


class HelpScreen(Dialog[None]):
    """All keys. Any of Esc, ? or Enter closes it."""

    BINDINGS = [("escape,question_mark,enter", "dismiss", "close")]  # noqa: RUF012

    def __init__(self, view: View) -> None:
        super().__init__()
        self._view = view

    def compose(self) -> ComposeResult:
        """The table, scrolled with the arrow keys."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = "Keys"
            frame.border_subtitle = "Esc closes"
            with VerticalScroll():
                yield Static(help_text(self._view))


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


def parse_direction(text: str) -> tuple[float, float]:
    """Return azimuth and elevation from `231.4 44`, space, comma or slash between.

    ValueError says what is wrong.
    """
    words = text.replace(",", " ").replace("/", " ").replace("°", " ").split()
    try:
        az_deg, el_deg = map(float, words)
    except ValueError:
        raise ValueError("Type two numbers, azimuth and elevation: 231.4 44") from None
    if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
        raise ValueError("Both must be finite numbers.")
    return az_deg, el_deg


class GotoLine(Horizontal):
    """One line above the footer: azimuth and elevation; Enter sends it and gives the focus back."""

    class Sent(Message):
        """A direction to go to."""

        def __init__(self, az_deg: float, el_deg: float) -> None:
            super().__init__()
            self.az_deg, self.el_deg = az_deg, el_deg

    def compose(self) -> ComposeResult:
        """A label and a field, which has no focus before `open`."""
        yield Label("go to  az el:")
        yield Input(placeholder="231.4 44      Enter goes there, Esc closes, Ctrl+C stops", disabled=True)

    def open(self) -> None:
        """Show the line and take the focus."""
        self.add_class("-open")
        field = self.query_one(Input)
        field.disabled = False
        field.value = ""
        field.focus()

    def close(self) -> None:
        """Hide the line and give the focus back."""
        self.remove_class("-open")
        self.query_one(Input).disabled = True
        self.screen.set_focus(None)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Send what was typed, or say what is wrong with it."""
        event.stop()
        try:
            az_deg, el_deg = parse_direction(event.value)
        except ValueError as wrong:
            self.query_one(Input).value = ""
            self.query_one(Input).placeholder = str(wrong)
            return
        self.close()
        self.post_message(self.Sent(az_deg, el_deg))

    def on_key(self, event: events.Key) -> None:
        """Esc closes the line (the app has stopped the dish first, if it could move)."""
        if event.key == "escape":
            event.stop()
            self.close()
