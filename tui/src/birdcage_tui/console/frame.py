"""The console's own rows: the upper edge with what is going on, the hint, the prompt, the lower edge with the keys."""

from __future__ import annotations

from rich.style import Style

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import pad, wrap
from birdcage_tui.drawing.themes import DEFAULT, LOOKS
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

LONGEST_HINT = 5
Keys = tuple[tuple[str, str], ...]
"""Names of commands, each with its word."""


class Edge(Pane):
    """A row of the frame; its line has the colour of the focus while something in the console has it."""

    INK = "edge"
    lit = False

    @property
    def inks(self) -> dict[str, Style]:
        """The styles of the theme, and the line's."""
        look = LOOKS.get(self.app.theme, LOOKS[DEFAULT])
        return {**look.inks, "edge": Style(color=look.focus if self.lit else look.line, bgcolor=look.ground)}


class HeadLine(Edge):
    """The upper edge: the name, WATCH or TALK with what that means; at the right, matches, new lines or figures."""

    mode = ("", "", "key")
    right: tuple[str, str] = ("", "dim")
    right_command = ""

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - what it says is set by the console
        """Write into the line."""
        cells.put(0, 0, f"╭{'─' * (cells.width - 2)}╮", "edge")
        word, sentence, ink = self.mode
        x = cells.put(2, 0, " Console ", "text")
        x = cells.put(x, 0, f" {word} ", ink)
        x = cells.put(x, 0, f" {sentence} ", "text" if word == "TALK" else "dim")
        words, ink = self.right
        if words and x + len(words) + 4 <= cells.width:
            start = cells.width - len(words) - 4
            cells.put(start, 0, f" {words} ", ink)
            if self.right_command:
                self.heat(start, 0, len(words) + 2, self.right_command)


class HintLine(Pane):
    """What the line would do, what completes it, or how to begin. Grows when words need room."""

    INK = "dim"
    says: tuple[tuple[str, str], ...] = ()
    """Sentences, each with its ink; each begins a row."""

    def lines(self, width: int) -> list[tuple[str, str]]:
        """Return the wrapped rows and their inks, one at least."""
        rows = [(row, ink) for words, ink in self.says for row in wrap(words, max(width - 2, 10), most=LONGEST_HINT)]
        return rows or [("", self.INK)]

    def show(self, view: View) -> None:
        """Take as many rows as the words need."""
        rows = len(self.lines(self.size.width or 78))
        if self.styles.height is None or self.styles.height.value != rows:
            self.styles.height = rows
        super().show(view)

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - what it says is set by the console
        """Write the words, in colour over the whole width when they warn."""
        rows = self.lines(cells.width)
        for y, (row, ink) in enumerate(rows):
            cells.put(0, y, pad(f" {row}", cells.width), ink)
            self.heat(0, y, cells.width, "console-type")


class PromptCell(Pane):
    """What stands before the line: the dish's prompt as it wrote it."""

    INK = "bar"
    NARROWEST = 6
    words = "?"
    ink = "bar"

    def show(self, view: View) -> None:
        """Take the width of the prompt, so that the line begins beside it."""
        width = max(len(self.words), self.NARROWEST) + 2
        if self.styles.width is None or self.styles.width.value != width:
            self.styles.width = width
        super().show(view)

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - what it says is set by the console
        """Write it, right-aligned, against what is typed."""
        cells.right(cells.width - 1, 0, self.words, self.ink)
        self.heat(0, 0, cells.width, "console-type")


class KeysLine(Edge):
    """The lower edge: keys as mouse targets, those of the line or the search while one types, else those of the log."""

    LOG: Keys = (
        ("console-type", "type"), ("console-find", "find"), ("console-stamps", "times"), ("console-hex", "hex"),
        ("console-polling", "polling"), ("console-save", "save"), ("page-console", "close"), ("console-clear", "clear"),
        ("console-end", "follow"),
    )  # fmt: skip
    LINE: Keys = (
        ("console-complete", "complete"), ("console-older", "older"), ("console-recall", "recall"),
        ("console-page-up", "log"), ("console-end-line", "end it"), ("page-console", "close"),
    )  # fmt: skip
    FIND: Keys = (("console-recall", "older line"), ("console-page-up", "log"), ("page-console", "close"))
    shown = LOG
    SHOWN = {"page-console": "F5"}  # noqa: RUF012

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - the keys hold always
        """Write the keys into the line."""
        cells.put(0, 0, f"╰{'─' * (cells.width - 2)}╯", "edge")
        x = 2
        for name, word in self.shown:
            shown = self.SHOWN.get(name, BY_NAME[name].shown)
            width = len(shown) + len(word) + 3
            if x + width > cells.width - 2:
                continue
            end = cells.put(cells.put(x, 0, f" {shown} ", "key"), 0, f"{word} ", "dim")
            self.heat(x, 0, end - x, name)
            x = end + 1
