"""A page that is not built yet says so, and what will be there."""

from __future__ import annotations

from textual.app import ComposeResult

from birdcage_tui.commands import PAGES
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.pane import Pane

WILL = {
    "camera": ("Files named by time, target and direction, never overwritten.",),
    "motor": ("Stored positions, limits, and the arc in reach.",),
    "survey": (
        "Frequency, width and level of each carrier.",
        "A report of the satellites that the carriers belong to.",
    ),
}
MEANWHILE = {
    "camera": "Until then: `birdcage log` keeps what was followed when, and how well.",
    "motor": "Until then: the control page (2) moves the dish, and keeps directions as presets.",
    "survey": "Until then: `birdcage if --if 1180` lists what a received frequency may be, `birdcage downlinks` what "
    "satellites send.",
}


class PlainWords(Pane):
    """The words of a page that is to come."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self._name_of_page = name

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - these words hold always
        """A title, a few sentences, and where to go meanwhile."""
        number, (_, title, text) = next(
            (number, page) for number, page in enumerate(PAGES, 1) if page[0] == self._name_of_page
        )
        width = min(cells.width - 4, 72)
        x = max((cells.width - width) // 2, 1)
        y = max((cells.height - 14) // 2, 1)
        cells.put(x, y, title, "strong")
        cells.right(x + width, y, str(number % 10), "dim")
        cells.put(x, y + 1, "─" * width, "line")
        cells.put(x, y + 3, text, "text")
        y += 5
        cells.put(x, y, "This page is not built yet. It will have:", "text")
        for sentence in WILL[self._name_of_page]:
            for index, line in enumerate(wrap(sentence, width - 4)):
                y += 1
                cells.put(x + 2, y, f"{'·' if not index else ' '} {line}", "text")
        y += 2
        for index, line in enumerate(wrap(MEANWHILE.get(self._name_of_page, ""), width)):
            cells.put(x, y + index, line, "dim")


class PlainPage(Page):
    """An honest page: words, and nothing that only looks like a control."""

    def __init__(self, name: str) -> None:
        super().__init__(id=f"page-{name}")
        self._page_name = name

    def compose(self) -> ComposeResult:
        """The words alone."""
        yield PlainWords(self._page_name)
