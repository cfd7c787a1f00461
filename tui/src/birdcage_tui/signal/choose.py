"""Which source is heard: a list of them, each with its unit, its rate, how long it measures, and who has it."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.signal.source import MONITOR
from rich.text import Text
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.widgets import OptionList
from textual.widgets.option_list import Option

from birdcage_tui.drawing.cell_text import cut
from birdcage_tui.shown.source_choice import SourceChoice
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.status import TopRow

WIDTH = 66


class SourceScreen(Dialog[str | None]):
    """Enter or a click takes the one that is selected."""

    KEYS, OTHER = "↑ ↓, Enter hears it", "s closes"
    BINDINGS = [("escape,s,q", "leave", "close")]  # noqa: RUF012

    def __init__(self, choices: Sequence[SourceChoice]) -> None:
        super().__init__()
        self._choices = choices

    def compose(self) -> ComposeResult:
        """The list."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = "Source of the signal"
            width = min(WIDTH, self.app.size.width - 8)
            yield OptionList(*(Option(_rows(each, width), id=each.facts.id) for each in self._choices))

    def on_mount(self) -> None:
        """Select the one that is heard."""
        super().on_mount()
        rows = self.query_one(OptionList)
        rows.highlighted = next((index for index, each in enumerate(self._choices) if each.chosen), 0)
        rows.focus()

    def on_option_list_option_selected(self, event: OptionList.OptionSelected) -> None:
        """Close, and take it."""
        event.stop()
        self.dismiss(event.option.id)


def _rows(choice: SourceChoice, width: int) -> Text:
    """Return two rows: what it tells and how often; where it is, or what is wrong with it."""
    facts = choice.facts
    rate = f"{facts.rate_hz:.1f}/s" if facts.rate_hz >= 0.95 else f"every {1.0 / facts.rate_hz:.0f} s"
    if facts.of_dish:
        rate = "as often as the wire allows"
    dwell = "" if facts.dwell_s is None else f", each {facts.dwell_s:g} s long"
    owner = {"": "", MONITOR: ", in use"}.get(choice.owner, f", in use for {choice.owner}")
    mark = "●" if choice.chosen else " "
    first = cut(f"{mark} {facts.label:<10} {facts.unit}, {rate}{dwell}{owner}", width)
    second = cut(f"  {choice.trouble or facts.where}", width)
    return Text.assemble((first, "bold" if choice.chosen else ""), ("\n" + second, "dim" if not choice.trouble else ""))
