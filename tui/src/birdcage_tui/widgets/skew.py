"""The third axis of a dish that has one: the angle of the feed about the beam, as text, as a gauge, as an arc."""

from __future__ import annotations

import math

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.digits import angle_text, put_big, width_of
from birdcage_tui.drawing.needle import draw_needle
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.sky_ground import UNKNOWN_SIGN

LEAST_GAUGE = 8
"""Columns below which a gauge tells nothing."""
ARC_ROWS, ARC_WIDTH = 5, 46
"""Rows and columns from which the arc is drawn instead of the gauge."""
THERE_DEG = 0.05


def has_skew(view: View) -> bool:
    """Return whether the dish has that axis."""
    return view.state.dish is not None and view.state.dish.skew is not None


def skew_limits(view: View) -> tuple[float, float]:
    """Return its range, in degrees; only for a dish that has it."""
    skew = view.state.dish.skew if view.state.dish is not None else None
    assert skew is not None, "asked only where there is one"
    return skew.min_deg, skew.max_deg


def skew_deg(view: View) -> float | None:
    """Return where it stands; None while that is not known."""
    position = view.state.position
    return None if position is None else position.skew_deg


def skew_text(view: View) -> str:
    """Return its angle in eight columns: `~` before one that is modelled, dashes while it is not known."""
    angle_deg, position = skew_deg(view), view.state.position
    mark = "~" if position is not None and position.modelled and angle_deg is not None else " "
    return f"{mark}{angle_text(angle_deg, 3)}°"


def skew_target(view: View) -> float | None:
    """Return where it was sent, while that differs from where it stands."""
    target, here = view.state.target_skew_deg, skew_deg(view)
    return target if target is not None and (here is None or abs(target - here) > THERE_DEG) else None


def skew_gauge(cells: Cells, x: int, y: int, width: int, view: View) -> None:
    """Draw a line from one end of the range to the other, the feed on it, and the target."""
    if width < LEAST_GAUGE:
        return
    low, high = skew_limits(view)
    here, target = skew_deg(view), skew_target(view)
    track = width - 2

    def column(angle_deg: float) -> int:
        return x + 1 + min(track - 1, max(0, round((angle_deg - low) / (high - low) * (track - 1))))

    cells.put(x, y, "▕" + ("─" if here is not None else UNKNOWN_SIGN) * track + "▏", "line" if here is None else "dim")
    if target is not None:
        if here is not None:
            left, right = sorted((column(here), column(target)))
            cells.put(left, y, "━" * (right - left + 1), "accent")
        cells.put(column(target), y, "✕", "target-strong")
    if here is not None:
        modelled = view.state.position is not None and view.state.position.modelled
        cells.put(column(here), y, "◎" if modelled else "◉", "dim" if view.stale else "accent-strong")


def skew_row(cells: Cells, x: int, y: int, view: View) -> None:
    """Write name, angle and gauge in one row, from column `x` to the margin at the right."""
    x = cells.put(x, y, "skew", "dim")
    x = cells.put(x, y, skew_text(view), "dim" if view.stale else "strong") + 1
    target = skew_target(view)
    low, high = skew_limits(view)
    words = f" to {target:.2f}°" if target is not None else f" {low:.0f} to {high:.0f}°"
    room = cells.width - 1 - x - len(words)
    if room >= LEAST_GAUGE:
        skew_gauge(cells, x, y, room, view)
        cells.right(cells.width - 1, y, words, "target" if target is not None else "dim")
    else:
        cells.put(x, y, words.strip()[: max(cells.width - x, 0)], "target" if target is not None else "dim")


class SkewPane(Pane):
    """Angle, target and keys; an arc where there is room, else a gauge."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Skew"

    def draw(self, cells: Cells, view: View) -> None:
        """Draw what there is room for; nothing for a dish without that axis."""
        if not has_skew(view):
            return
        if cells.height >= ARC_ROWS and cells.width >= ARC_WIDTH:
            self._with_arc(cells, view)
            return
        if cells.height == 1 and cells.width < 36:
            self._narrow(cells, view)
            return
        skew_row(cells, 1, 0, view)
        if cells.height > 1:
            self._keys(cells, 1, view)
        if cells.height > 2:
            cells.put(1, 2, _word(view)[: cells.width - 2], "dim")

    def _narrow(self, cells: Cells, view: View) -> None:
        """Write angle, target and two keys in one short row."""
        x = cells.put(0, 0, "skew", "dim")
        x = cells.put(x, 0, skew_text(view), "dim" if view.stale else "strong")
        target = skew_target(view)
        if target is not None:
            cells.put(x, 0, f"✕{target:.1f}", "target")
        for x, name in ((cells.width - 7, "skew-down"), (cells.width - 3, "skew-up")):
            known = BY_NAME[name]
            cells.put(x, 0, f" {known.shown} ", "key" if known.refused(view) is None else "bar-dim")
            self.heat(x, 0, 3, name)

    def _with_arc(self, cells: Cells, view: View) -> None:
        """Write digits and keys at the left, the arc at the right."""
        left = max(width_of("000.00°") + 4, 25)
        here, position = skew_deg(view), view.state.position
        text = " --.-- " if here is None else angle_text(here, 3) + "°"
        put_big(cells, 1, 0, text.rstrip(), "dim" if view.stale else "big")
        if position is not None and position.modelled and here is not None:
            cells.put(0, 1, "~", "strong")
        target = skew_target(view)
        y = 3
        words = _word(view) if target is None else f"sent to {target:.2f}°"
        cells.put(1, y, words[: left - 2], "dim" if target is None else "target")
        self._keys(cells, cells.height - 1 if cells.height > y + 2 else y + 1, view)
        draw_arc(cells, left, 0, cells.width - left - 1, cells.height, view)

    def _keys(self, cells: Cells, y: int, view: View) -> None:
        x = self.button(cells, 1, y, "skew-down", view, f"-{view.step_deg:g}°")
        x = self.button(cells, x, y, "skew-up", view, f"+{view.step_deg:g}°")
        if x + 8 < cells.width:
            self.button(cells, x, y, "skew", view, "to …")


def _word(view: View) -> str:
    position = view.state.position
    if position is None or position.skew_deg is None:
        return "unknown"
    return "modelled, not read" if position.modelled else "around the beam"


def draw_arc(cells: Cells, x: int, y: int, width: int, height: int, view: View) -> None:
    """Draw the range as an arc, its low end at the left. From which side the dish is seen is not told by any source."""
    low, high = skew_limits(view)
    canvas = Braille(width, height)
    tall = view.settings.cell_aspect / 2.0
    radius = max(4.0, min(width - 12.0, (height * 4 - 6.0) * tall))
    hub_x, hub_y = float(width), height * 4 - 3.0

    def dot(angle_deg: float, part: float = 1.0) -> tuple[float, float]:
        turn = math.radians(180.0 * (high - angle_deg) / (high - low))
        return hub_x + radius * part * math.cos(turn), hub_y - radius * part * math.sin(turn) / tall

    def cell(angle_deg: float, part: float = 1.0) -> tuple[int, int]:
        at_x, at_y = dot(angle_deg, part)
        return x + math.floor(at_x / 2), y + math.floor(at_y / 4)

    count = round(radius * 3.2)
    canvas.dotted([dot(low + (high - low) * step / count) for step in range(count + 1)], "dim", 1.0)
    for tick in range(13):
        angle_deg = low + (high - low) * tick / 12
        canvas.line(*dot(angle_deg, 0.86 if tick % 3 == 0 else 0.93), *dot(angle_deg), "dim")
    here, target = skew_deg(view), skew_target(view)
    if target is not None:
        canvas.line(*dot(target, 0.25), *dot(target, 0.9), "target", 3)
    if here is not None:
        modelled = view.state.position is not None and view.state.position.modelled
        share = (here - low) / (high - low)
        draw_needle(canvas, hub_x, hub_y, 180.0 * share - 90.0, radius * 0.8, 0.0,
                    "dim" if view.stale else "accent", hollow=modelled, dot_aspect=tall)  # fmt: skip
    canvas.onto(cells, x, y)
    for angle_deg in (low, high):
        at_x, at_y = cell(angle_deg)
        text = f"{angle_deg:.0f}°"
        at_x = at_x - len(text) if angle_deg == low else at_x + 1
        if x <= at_x and at_x + len(text) <= cells.width:
            cells.put(at_x, at_y, text, "dim")
    if target is not None:
        cells.put(*cell(target), "✕", "target-strong")
