"""Help for what has the focus, from the table of commands: each line a key, and a target for mouse and Enter."""

from __future__ import annotations

from rich.text import Text
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.widget import Widget
from textual.widgets import OptionList
from textual.widgets.option_list import Option

from birdcage_tui.commands import Command, in_force
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.status import TopRow

WIDTH = 70
ALWAYS = (
    "Ctrl+C also stops in text fields and dialogs. Esc stops while the dish moves or may move by itself. "
    "At rest Esc closes a layer. ? or q closes this help at any time."
)


def help_words(focused: Widget | None, page: Widget) -> str:
    """Return what the nearest widget says of itself in `HELP`, from the focus outward, and last the page."""
    for widget in (*(() if focused is None else (focused, *focused.ancestors)), page):
        words = getattr(widget, "HELP", None)
        if isinstance(widget, Widget) and words:
            return str(words)
    return ""


def line_of(command: Command, view: View, width: int) -> Text:
    """Return a command's key and words; what cannot be done now says why, and its key is not bold."""
    title = command.title if command.title.endswith("…") else f"{command.title}."
    reason = command.refused(view)
    why = "" if reason is None else f" Not now: {reason}"
    rows = wrap(f"{title} {command.help}{why}", max(width - 11, 12))
    return Text.assemble((f"{command.shown:>8}  ", "bold" if reason is None else ""), f"\n{'':10}".join(rows))


class HelpScreen(Dialog[str | None]):
    """What can be done here. Enter or a click does what is selected; ? or q closes, and at rest Esc."""

    KEYS, OTHER = "↑ ↓, Enter does it", "? closes"
    BINDINGS = [("escape,question_mark,q", "leave", "close")]  # noqa: RUF012

    def __init__(self, view: View, words: str) -> None:
        super().__init__()
        self._view, self._words = view, words

    def compose(self) -> ComposeResult:
        """The widget's own words, the commands in force from the nearest outward, and what always holds."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = "Help"
            yield OptionList(*self._options())

    def on_mount(self) -> None:
        """Give the keys to the list. Nothing is selected before an arrow selects it: Enter does nothing unasked."""
        super().on_mount()
        rows = self.query_one(OptionList)
        rows.highlighted = None
        rows.focus()

    def _options(self) -> list[Option]:
        options: list[Option] = []
        width = min(WIDTH, self.app.size.width - 10)
        gap = "\n" if self.app.size.height >= 24 else ""
        if self._words:
            options.append(Option(Text(self._words), disabled=True))
        group = ""
        for command in in_force(self._view.scopes):
            if command.group != group:
                group = command.group
                options.append(Option(Text(f"{gap if options else ''}{group}", "bold"), disabled=True))
            options.append(Option(line_of(command, self._view, width), id=command.name))
        options.append(Option(Text(f"{gap}Always", "bold"), disabled=True))
        options.append(Option(Text(ALWAYS), disabled=True))
        return options

    def on_option_list_option_selected(self, event: OptionList.OptionSelected) -> None:
        """Close, and have it done."""
        event.stop()
        self.dismiss(event.option.id)
