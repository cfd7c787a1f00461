"""The last row: the keys of this page, each of them clickable."""

from __future__ import annotations

from textual import events
from textual.message import Message

from birdcage_tui.canvas import Cells
from birdcage_tui.commands import COMMANDS
from birdcage_tui.pane import Pane
from birdcage_tui.view import View


class KeyBar(Pane):
    """Keys and words from the table of commands. What cannot be done now is dim, and says why when pressed."""

    INK = "bar-dim"

    class Chosen(Message):
        """A person pressed a key's name."""

        def __init__(self, name: str) -> None:
            super().__init__()
            self.name = name

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.spans: list[tuple[range, str]] = []
        """Which columns belong to which command."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write the keys from left to right; at the right, how to get to the pages."""
        self.spans = []
        pages = " 1-0 pages "
        x = 1
        for command in COMMANDS:
            if not command.footer or x + len(command.shown) + len(command.footer) + 3 > cells.width - len(pages):
                continue
            start = x
            dim = command.refused(view) is not None
            x = cells.put(x, 0, f" {command.shown} ", "bar-dim" if dim else "key")
            x = cells.put(x, 0, command.footer, "bar-dim" if dim else "bar")
            self.spans.append((range(start, x), command.name))
            x += 2
        start = cells.width - len(pages)
        cells.put(start, 0, pages, "bar")
        self.spans.append((range(start, cells.width), "help"))

    def on_click(self, event: events.Click) -> None:
        """Do what the word under the mouse says."""
        for columns, name in self.spans:
            if event.x in columns:
                event.stop()
                self.post_message(self.Chosen(name))
