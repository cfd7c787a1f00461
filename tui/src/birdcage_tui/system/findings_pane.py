"""The Health tab: what needs attention, the most urgent first, and what to do about it."""

from __future__ import annotations

from birdcage.diagnostics.finding import Finding, Weight
from textual.geometry import Region

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.shown.view import View
from birdcage_tui.system.cursor_pane import CursorPane, Detail, Line

MARKS = {Weight.FAULT: ("▲", "fault"), Weight.WARN: ("▲", "warn"), Weight.NOTE: ("·", "dim")}
TEXT = 9
"""Column of the text, after sign and word."""
WORDS = {Weight.FAULT: "now", Weight.WARN: "soon", Weight.NOTE: "note"}
"""How urgent it is, beside the colour."""


class FindingsPane(CursorPane):
    """Findings to choose from."""

    HELP = (
        "What needs attention, the most urgent first: from what every birdcage program has kept of this dish, and its "
        "present state. Enter explains, and says what to do. a: you have seen it; it comes back when it happens again. "
        "What goes by itself stays until its cause is gone."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__("system-health", id=id)
        self._chosen = ""
        """The id of the finding under the cursor: a new one may come before it."""

    def move(self, by: int) -> None:
        """Move the cursor by rows."""
        self._chosen = ""
        super().move(by)

    def choose(self, row: int, value: int) -> None:
        """Put the cursor on a row."""
        self._chosen = ""
        super().choose(row, value)

    def findings(self, view: View) -> tuple[Finding, ...]:
        """Return what was found."""
        health = view.health.health
        return () if health is None else health.findings

    def count(self, view: View) -> int:
        """Return how many there are."""
        return len(self.findings(view))

    def chosen(self, view: View) -> Finding | None:
        """Return the finding under the cursor; None where there is none."""
        found = self.findings(view)
        if not found:
            return None
        ids = [each.id for each in found]
        self.at = ids.index(self._chosen) if self._chosen in ids else min(self.at, len(found) - 1)
        self._chosen = ids[self.at]
        return found[self.at]

    def draw(self, cells: Cells, view: View) -> None:
        """Write each in two lines at most."""
        found, now = self.findings(view), view.health
        self.hits = []
        if now.health is None or not found:
            self._none(cells, view)
            return
        self.chosen(view)
        most = max(1, min(3, cells.height // 3))
        problem = wrap(f"▲ {now.problem}", max(cells.width - 2, 10), most=most) if now.problem else []
        for y, line in enumerate(problem, cells.height - len(problem)):
            cells.put(1, y, line, "warn")
        room = max(cells.height - len(problem), 1)
        width = max(cells.width - TEXT - 1, 10)
        texts = [wrap(each.text, width, most=2) for each in found]
        lines = [(number, index) for number, text in enumerate(texts) for index in range(len(text))]
        here = next(at for at, (number, _) in enumerate(lines) if number == self.at)
        top = self.scroll(here, len(lines), room)
        for y, (number, index) in enumerate(lines[top : top + room]):
            mark, ink = MARKS[found[number].weight]
            lit = number == self.at and self.has_focus
            if lit:
                cells.put(0, y, " " * cells.width, "accent-row")
            if not index:
                cells.put(0, y, "▶" if number == self.at else " ", "accent-row" if lit else "accent-strong")
                cells.put(2, y, f"{mark} {WORDS[found[number].weight]:<5}", "accent-row" if lit else ink)
            text = "accent-row" if lit else "text"
            cells.put(TEXT, y, texts[number][index], text if number or lit else "strong")
            self.hits.append((Region(0, y, cells.width, 1), number, 0))

    @staticmethod
    def _none(cells: Cells, view: View) -> None:
        now = view.health
        if now.problem:
            lines: list[Line] = [("warn", line) for line in wrap(f"▲ {now.problem}", max(cells.width - 2, 10))]
        elif now.health is None:
            known = view.state.dish is not None
            lines = [("dim", "Reading the journal …" if known else "The dish is not known yet.")]
        else:
            lines = [("good", "● Nothing needs attention.")]
        for y, (ink, words) in enumerate(lines):
            cells.put(1, y, words, ink)

    def detail(self, view: View, width: int) -> Detail | None:
        """Return what the finding means, and what to do."""
        finding = self.chosen(view)
        if finding is None:
            health = view.health.health
            return None if health is None else Detail("Looked at", _wrapped("dim", health.looked_at, width))
        lines = _wrapped("strong", finding.text, width) + _wrapped("text", finding.why, width)
        if finding.todo:
            lines.append(("", ""))
        for number, step in enumerate(finding.todo, 1):
            indent = " " * (len(str(number)) + 2)
            lines += [("text", line) for line in wrap(f"{number}. {step}", max(width, 10), indent=indent)]
        lines.append(("", ""))
        if finding.since is not None:
            times = "once" if finding.count == 1 else f"{finding.count} times"
            lines += _wrapped("dim", f"{times}, first {finding.since:%d %b %H:%M}Z", width)
        goes = "It clears when its cause is gone." if finding.lasts else "a: you have seen it."
        lines += _wrapped("dim", goes, width)
        return Detail("What to do", lines)


def _wrapped(ink: str, words: str, width: int) -> list[Line]:
    return [(ink, line) for line in wrap(words, max(width, 10))] if words else []
