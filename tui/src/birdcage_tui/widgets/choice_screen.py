"""A dialog that asks for one of several things, each in two rows: what it is, and what it means."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rich.text import Text
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.widgets import OptionList, Static
from textual.widgets.option_list import Option

from birdcage_tui.drawing.cell_text import shorten
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.status import TopRow

WIDTH = 66


@dataclass(frozen=True, slots=True)
class ChoiceRow:
    """One of them."""

    id: str
    first: str
    second: str
    is_present: bool = False
    """Whether it is in force now: it is marked, and selected at first."""
    warns: bool = False
    """Whether the second row tells of something wrong."""


class ChoiceScreen(Dialog[str | None]):
    """Enter or a click takes the one that is selected."""

    DEFAULT_CSS = """
    ChoiceScreen #words { margin-bottom: 1; color: $dim; }
    """
    KEYS, OTHER = "↑ ↓, Enter takes it", "q closes"
    BINDINGS = [("escape,q", "leave", "close")]  # noqa: RUF012

    def __init__(self, title: str, rows: Sequence[ChoiceRow], words: str = "") -> None:
        """`words` stand above the list."""
        super().__init__()
        self._title, self._rows, self._words = title, rows, words

    def compose(self) -> ComposeResult:
        """The list."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = self._title
            if self._words:
                yield Static(self._words, id="words", markup=False)
            yield OptionList(*(Option(self._text(each), id=each.id) for each in self._rows))

    def on_mount(self) -> None:
        """Select the one that is in force, or the first."""
        super().on_mount()
        rows = self.query_one(OptionList)
        rows.highlighted = next((index for index, each in enumerate(self._rows) if each.is_present), 0)
        rows.focus()

    def on_option_list_option_selected(self, event: OptionList.OptionSelected) -> None:
        """Close, and take it."""
        event.stop()
        self.dismiss(event.option.id)

    def on_option_list_option_highlighted(self, event: OptionList.OptionHighlighted) -> None:
        """Write both rows of the one that is selected alike: dim is hard to read on its ground."""
        for index, row in enumerate(self._rows):
            event.option_list.replace_option_prompt_at_index(index, self._text(row, plain=index == event.option_index))

    def _text(self, row: ChoiceRow, *, plain: bool = False) -> Text:
        mark, width = "●" if row.is_present else " ", min(WIDTH, self.app.size.width - 8)
        first, second = shorten(f"{mark} {row.first}", width), shorten(f"  {row.second}", width)
        bold = "bold" if row.is_present or plain else ""
        return Text.assemble((first, bold), ("\n" + second, "" if row.warns or plain else "dim"))
