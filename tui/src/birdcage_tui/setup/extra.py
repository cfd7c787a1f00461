"""What stands under the words and answers of a step: causes, wiring, or a small compass."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from birdcage.setup.case import Cause
from birdcage.setup.wiring import connectors_of

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.setup import causes as walk
from birdcage_tui.setup import wiring
from birdcage_tui.setup.compass import draw_compass
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

COMPASS_STEPS = ("direction", "place", "north", "first")
WIRED_STEPS = ("link",)


class ExtraKind(Enum):
    """What it shows."""

    NOTHING = ""
    CAUSES = "What may be wrong"
    WIRING = "Wiring"
    COMPASS = "Where it looks"
    POINTING = "The dish now"
    """The heading alone: the instrument under it is a pane of its own."""


class ExtraPane(Pane):
    """A heading in a line, and one of the kinds under it."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.kind = ExtraKind.NOTHING
        self.causes: Sequence[Cause] = ()
        self.chosen = 0
        self.seen = ""
        self.firmware: str | None = None
        self.place: SitePlace | None = None
        self.alone = False
        """Whether nothing stands above it, because a person asked for the wiring."""

    def wiring_rows(self, width: int) -> int:
        """Return how many rows all of the wiring takes, with its heading."""
        return 1 + len(wiring.lines(connectors_of(self.firmware), width - 2))

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the heading and what belongs under it."""
        if self.kind is ExtraKind.NOTHING:
            return
        width = cells.width - 2
        heading = self.kind.value
        hint = "← → another cause" if self.kind is ExtraKind.CAUSES and len(self.causes) > 1 else ""
        cells.put(1, 0, "─" * width, "line")
        x = cells.put(3, 0, f" {heading} ", "dim")
        if self.alone:
            self.heat(x + 1, 0, 16, "setup-wiring")
            cells.put(x, 0, " ↑ ↓ more   w back ", "text")
        if hint:
            x += 1
            cells.put(x, 0, f" {hint} ", "text")
            middle = x + len(hint) // 2
            self.heat(x, 0, middle - x, "setup-previous-cause")
            self.heat(middle, 0, len(hint) - (middle - x), "setup-next-cause")
        if self.kind is ExtraKind.COMPASS:
            draw_compass(cells, 2, view, self.place)
            return
        if self.kind is ExtraKind.POINTING:
            return
        lines = self._lines(width, cells.height - 1)
        if len(lines) >= cells.height and not self.alone:
            lines = lines[: wiring.whole_items(lines, cells.height - 1)]
            self.heat(x + 1, 0, 8, "setup-wiring")
            cells.put(x + 1, 0, " w: all ", "text")
        for y, line in enumerate(lines, 1):
            x = 1
            for ink, text in line:
                x = cells.put(x, y, text, ink)

    def _lines(self, width: int, room: int) -> list[wiring.Line]:
        if self.kind is ExtraKind.WIRING:
            return wiring.lines(connectors_of(self.firmware), width)
        seen = walk.seen_lines(self.seen, width)
        told = [*seen, *walk.cause_lines(self.causes, self.chosen, width, max(room - len(seen), 1))]
        plugs = connectors_of(self.firmware)
        plug = wiring.contacts(plugs[0]) if len(plugs) == 1 and plugs[0].pins else []
        if plug and len(told) + len(plug) + 2 <= room:
            heading = f" {plugs[0].plug}, {plugs[0].drawing.value.partition(',')[0]} "
            told += [(), (("line", "──"), ("dim", heading), ("line", "─" * (width - 2 - len(heading)))), *plug]
        return told


def kind_for(step: str, *, mute: bool, wiring_asked: bool, wide: bool, wired: bool) -> ExtraKind:
    """Return what stands under a step; a simulated dish has no wires, nor has one that is on no serial line."""
    if wiring_asked:
        return ExtraKind.WIRING
    if mute and step == "link":
        return ExtraKind.CAUSES
    if not wide:
        return ExtraKind.NOTHING
    if step in WIRED_STEPS and wired:
        return ExtraKind.WIRING
    return ExtraKind.COMPASS if step in COMPASS_STEPS else ExtraKind.POINTING
