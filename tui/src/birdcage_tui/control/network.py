"""The Network tab: who has control of the dish now, who may take it, and how it is stopped from elsewhere."""

from __future__ import annotations

from collections.abc import Sequence

from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical

from birdcage_tui.control.last import LogPane
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.shown.held_words import after_release
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.track_words import live_words, next_words, plain_name
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.pane import Pane

Row = tuple[str, str, str]
"""A name, the ink of the words after it, and the words."""

HELP = "Who controls the dish, and what else can stop or move it."
NAMES = 18
"""Columns of the names."""
BESIDE = 100
"""Columns from which what the last commands did stands beside it."""
LOG, FAR = 46, 200
"""Columns of that, and from which it has half of the width."""
OVER, LEAST_SKY = 24, 16
"""Rows of the words where the sky stands under them, and what that has then at least."""
MOVERS: tuple[Row, ...] = (
    ("You", "text", "arrows, g, presets, when control is free or the tracker's."),
    ("Tracker", "text", "f, autotrack on Track, while control is free or its own."),
    ("Console", "text", "raw lines (page 5), without limits. It asks first."),
    ("Other programs", "text", "kept out of the port, but for root and who had it before."),
)
SHELL: tuple[Row, ...] = (
    ("birdcage stop", "text", "stops it, whatever program drives it. It is HELD then."),
    ("birdcage hold", "text", "the same, before you work on the dish."),
    ("birdcage release", "text", "releases it, and names who waits to move it."),
)
NOT_DEMO = "They do not reach a demo."
LATER = "The server for Gpredict and others is not in this version."


def now_rows(view: View) -> list[Row]:
    """Return who has control, what for, and what holds the dish."""
    state, pursuit = view.state, pursuit_of(view.state)
    holder = state.holder
    control = "free" if holder is None else f"{holder}, at this terminal" if holder == YOU else holder
    found = [("Control", "strong" if holder else "dim", f"{control[:1].upper()}{control[1:]}.")]
    held = state.held
    if held is not None:
        since = "" if held.utc is None else f" since {held.utc:%H:%M:%S}Z"
        ignored = f" Refused {held.next_holder} {held.ignored} times." if held.next_holder and held.ignored else ""
        by = held.by or "unknown"
        found.append(("Held", "warn", f"by {by}{since}.{ignored} Enter releases it: {after_release(view)}."))
    if pursuit is not None:
        told = "  ".join(filter(None, (plain_name(pursuit.plan.aim.name), live_words(view))))
        found.append(("Following", "text", f"{told}, for {pursuit.holder}."))
        if coming := next_words(view):
            found.append(("", "dim", f"{coming[:1].upper()}{coming[1:]}."))
    found.append(("Port", "text", f"{state.port.split('?')[0] or '--'}"))
    return found


class ControlPane(Pane):
    """Words in two columns: what is now, who may move it, and what a shell can do."""

    HELP = HELP

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Who may move the dish"

    def draw(self, cells: Cells, view: View) -> None:
        """Write group after group; where they do not all fit without, there is no air between them."""
        shell = (*SHELL, ("", "dim", NOT_DEMO)) if view.state.demo else SHELL
        groups = (
            _lines("", now_rows(view), cells.width),
            _lines("Who may move it", MOVERS, cells.width),
            _lines("In a shell", shell, cells.width),
            _lines("", (("rotctld", "dim", LATER),), cells.width),
        )
        air = sum(map(len, groups)) + len(groups) - 1 <= cells.height
        y = 0
        for lines in groups:
            for name, ink, words in lines:
                cells.put(1, y, name, "dim")
                cells.put(1 + NAMES, y, words, ink)
                y += 1
            y += air


def _lines(heading: str, rows: Sequence[Row], width: int) -> list[Row]:
    """Return a group with its heading, wrapped beside the names."""
    found: list[Row] = [(heading, "text", "")] if heading else []
    for name, ink, words in rows:
        lines = wrap(words, max(width - NAMES - 2, 10))
        found += [(name if not index else "", ink, line) for index, line in enumerate(lines)]
    return found


class NetworkPane(Horizontal):
    """Who may move the dish; where there is room, what the commands did, what comes next, and where the dish points."""

    HELP = HELP
    DEFAULT_CSS = f"""
    NetworkPane ControlPane, NetworkPane LogPane, NetworkPane SkyPane {{ border: round $line;
        border-title-color: $dim; border-title-style: none; border-subtitle-color: $dim; height: 1fr; }}
    NetworkPane Vertical {{ width: 1fr; }}
    NetworkPane ControlPane {{ padding: 1 0 0 0; }}
    NetworkPane LogPane {{ width: 1fr; display: none; }}
    NetworkPane SkyPane {{ display: none; }}
    NetworkPane.-beside LogPane {{ display: block; width: {LOG}; }}
    NetworkPane.-far LogPane {{ width: 1fr; }}
    NetworkPane.-over ControlPane {{ height: {OVER}; }}
    NetworkPane.-over SkyPane {{ display: block; }}
    """

    def compose(self) -> ComposeResult:
        """All three."""
        with Vertical():
            yield ControlPane()
            yield SkyPane()
        yield LogPane()

    def on_resize(self) -> None:
        """Show what has room."""
        self.set_class(self.size.width >= BESIDE, "-beside")
        self.set_class(self.size.width >= FAR, "-far")
        self.set_class(self.size.height >= OVER + LEAST_SKY, "-over")

    def show(self, view: View) -> None:
        """Draw what is seen."""
        for pane in self.query(Pane):
            if pane.display:
                pane.show(view)
