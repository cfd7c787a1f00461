"""What of a polar sky stays between frames: grid, limits, horizon, what cannot be reached, the geostationary arc."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

from birdcage.sky.geostationary import arc

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cell_len, fit
from birdcage_tui.drawing.polar import Polar
from birdcage_tui.shown.view import View

if TYPE_CHECKING:
    from birdcage.sky.horizon import HorizonMask

QUIET = ("faint", "line", "dim")
"""Dots that a name may cover."""
LINES = (*QUIET, "text", "target", "accent")
"""All that is drawn in dots, what matters included."""
LABELS_DEG = (0.0, 20.0, -20.0, 270.0, 290.0, 250.0)
"""Where along a circle its elevation is written, off the usual place: the first that lies on nothing."""
MASK_STEP_DEG = 2
ARC_STEPS = 60
LONGEST_TARGET = 18
"""Columns of the target's name on a map."""
STOP_SIGN = "║"
"""Where the cable ends: no hatching, which says what cannot be reached."""
UNKNOWN_SIGN = "░"
"""Fills a scale on which it is not known where the dish stands."""


def sky_titles(name: str) -> tuple[str, ...]:
    """Return the titles of a map with its legend, from all of it to the least."""
    return (
        f"{name}  N up, E right  ▨ cannot reach  {STOP_SIGN} cable stop",
        f"{name}  ▨ cannot reach  {STOP_SIGN} cable stop",
        f"{name}  N up, E right  ▨ cannot reach",
        f"{name}  ▨ cannot reach  {STOP_SIGN} stop",
        f"{name}  ▨ cannot reach",
    )


def title_for(titles: tuple[str, ...], width: int, *, stops: bool) -> str:
    """Return the longest title that a pane of so many cells inside has room for; stops only where there are some."""
    fits = [words for words in titles if len(words) <= width - 2 and (stops or STOP_SIGN not in words)]
    return fits[0] if fits else titles[-1]


def has_stops(view: View) -> bool:
    """Return whether the marks of the cable's ends stand on the map."""
    dish, position = view.state.dish, view.state.position
    return dish is not None and dish.cable is not None and position is not None and position.cable_deg is not None


ARC_INK = "dim"
"""Of the geostationary arc: quiet, for the target alone is in its colour."""


class SkyBackdrop:
    """Draws the layer, and keeps it until size, limits, horizon or place are others."""

    def __init__(self, *, with_arc: bool = True) -> None:
        self._with_arc = with_arc
        self._kept: tuple[object, Braille] | None = None

    def draw(self, polar: Polar, view: View) -> Braille:
        """Return a copy of the layer, to draw on."""
        state = view.state
        mask = None if view.sky is None else view.sky.mask
        mapping = None if state.dish is None else state.dish.mapping
        key = (
            polar, state.el_min_deg, state.el_max_deg, sector(view), state.no_go_sectors, mask, view.settings.place,
            id(mapping), state.alignment,
        )  # fmt: skip
        if self._kept is None or self._kept[0] != key:
            self._kept = (key, self._layer(polar, view, mask))
        return self._kept[1].copy()

    def _layer(self, polar: Polar, view: View, mask: HorizonMask | None) -> Braille:
        state = view.state
        canvas = Braille(polar.width, polar.height)
        low, high = state.el_min_deg, state.el_max_deg
        if low is not None:
            polar.hatch(canvas, "faint", 0.0, low)
        if high is not None:
            polar.hatch(canvas, "faint", high, 90.0)
        closed = sector(view)
        if closed is not None:
            polar.hatch(canvas, "faint", low or 0.0, high or 90.0, *closed)
        own_arc = _own_arc(view)
        if own_arc:
            polar.hatch(canvas, "faint", low or 0.0, high or 90.0)
        for az_from, az_to, below, _ in state.no_go_sectors:
            if below > (low or 0.0):
                polar.hatch(canvas, "faint", low or 0.0, min(below, 90.0), az_from, (az_to - az_from) % 360.0)
        for az_deg in (0.0, 90.0, 180.0, 270.0):
            canvas.line(*polar.dot(az_deg, high or 88.0), *polar.dot(az_deg, low or 0.0), "line", every=4)
        for el_deg in (30.0, 60.0):
            if low is None or high is None or low + 8 < el_deg < high - 8:
                polar.ring(canvas, el_deg, "line", 4.0)
        for edge in (low, high):
            if edge is not None:
                polar.ring(canvas, edge, "line")
        polar.ring(canvas, 0.0, "dim")
        for here, there in itertools.pairwise(own_arc):
            canvas.line(*polar.dot(*here), *polar.dot(*there), "text")
        if mask:
            self._mask(canvas, polar, mask)
        place = view.settings.place
        if place is not None and self._with_arc:
            points = arc(place.latitude_deg, place.longitude_deg, 1.5)
            canvas.dotted([polar.dot(az_deg, el_deg) for _, az_deg, el_deg in points], ARC_INK, 2.6)
        return canvas

    @staticmethod
    def _mask(canvas: Braille, polar: Polar, mask: HorizonMask) -> None:
        """Draw the line of trees and roofs, and hatch what it hides."""
        before = None
        for az_deg in range(0, 361, MASK_STEP_DEG):
            el_deg = mask.at(float(az_deg))
            here = polar.dot(az_deg, el_deg)
            if before is not None and (el_deg > 0 or before[2] > 0):
                canvas.line(*before[:2], *here, "dim")
            if el_deg > 1:
                canvas.line(*polar.dot(az_deg, 0.0), *here, "faint", every=3)
            before = (*here, el_deg)


def _own_arc(view: View) -> list[tuple[float, float]]:
    """Return the true directions of a machine that turns a single axis: all that it reaches. Empty for any other."""
    dish = view.state.dish
    if dish is None or dish.mapping is None or len(dish.axes) > 1:
        return []
    (axis,) = dish.axes
    span_deg = axis.max_deg - axis.min_deg
    angles = (axis.min_deg + span_deg * k / ARC_STEPS for k in range(ARC_STEPS + 1))
    return [view.state.alignment.to_true(*dish.mapping.to_sky({axis.name: deg})) for deg in angles]


def sector(view: View) -> tuple[float, float] | None:
    """Return azimuth and width of what the cable keeps out of reach on any turn; None when it is nothing."""
    state = view.state
    if state.dish is None or state.dish.cable is None or state.turn.value == "unknown":
        return None
    span = state.dish.cable.max_deg - state.dish.cable.min_deg
    if span >= 360:
        return None
    return round((state.dish.cable.max_deg + state.az_offset_deg) % 360, 1), round(360 - span, 1)


def rim(cells: Cells, polar: Polar, view: View) -> None:
    """Write the winds, the limits of elevation, and where the cable ends."""
    state = view.state
    for az_deg, name in ((0.0, "N"), (90.0, "E"), (180.0, "S"), (270.0, "W")):
        cells.put(*polar.cell(az_deg, 0.0), name, "strong")
    place = view.settings.place
    away_deg = 45.0 if place is None or place.latitude_deg >= 0 else 135.0  # where the arc is not
    for limit in (state.el_min_deg, state.el_max_deg):
        if limit is not None:
            words = f"{limit:.0f}°"
            places = [polar.cell(away_deg + aside, limit) for aside in LABELS_DEG]
            free = (place for place in places if cells.free(*place, len(words), *QUIET))
            cells.put(*next(free, places[0]), words, "dim")
    position, dish = state.position, state.dish
    if position is not None and position.cable_deg is not None and dish is not None and dish.cable is not None:
        for end in (dish.cable.min_deg, dish.cable.max_deg):
            cells.put(*polar.cell(position.az_deg + end - position.cable_deg, 0.0), STOP_SIGN, "warn")


def name_target(cells: Cells, polar: Polar, name: str, x: int, y: int) -> None:
    """Write the target's name beside its mark, inside the map: where it lies on nothing, else on the fewest signs."""
    name = fit(name, LONGEST_TARGET)
    if label(cells, (name,), x, y, x - polar.width // 2, "target-strong", polar):
        return
    length = cell_len(name)
    last = max(polar.width - length, 0)
    sides = (x + 2, x - 1 - length) if x < polar.width // 2 else (x - 1 - length, x + 2)
    below = min(max(x - length // 2, 0), last)
    spots = [(start, y) for start in sides if 0 <= start <= last]
    spots += [(start, row) for row in (y + 1, y - 1) for start in (*sides, below)
              if 0 <= start <= last and 0 <= row < polar.height]  # fmt: skip

    def cost(spot: tuple[int, int]) -> int:
        """Return what a name there would hide or touch: a letter is worse than a piece of a line."""
        near = range(max(spot[0] - 1, 0), min(spot[0] + length + 1, cells.width))
        letters = sum(not cells.free(column, spot[1], 1, *LINES) for column in near)
        return 8 * letters + sum(not cells.free(column, spot[1], 1, *QUIET) for column in near)

    spot = min(spots, key=cost, default=(below, y))
    cells.put(*spot, name, "target-strong")
    cells.shut(*spot, length)


def label(
    cells: Cells, names: tuple[str, ...], x: int, y: int, off: int, ink: str, within: Polar | None = None
) -> bool:
    """Write the first name that lies on nothing beside a mark: in its row if possible, else in the next, else not.

    `off`: how many columns right of the middle the mark stands; `within`: the map, when something else stands right of
    it or below. Return whether one was written.
    """
    end, bottom = (cells.width, cells.height) if within is None else (within.width, within.height)
    for name in names:
        length = cell_len(name)
        outward, inward = (x + 2, x - 1 - length) if off >= 0 else (x - 1 - length, x + 2)
        below = x - length // 2
        places = [(outward, y), (inward, y), (below, y + 1), (below, y - 1), (outward, y + 1)]
        for start, row in places:
            # Two free cells keep it apart from other words; in the mark's row one does, on the mark's side.
            left, right = start - 2, start + length + 2
            if row == y:
                left, right = (start - 1, right) if start > x else (left, start + length + 1)
            if (
                start >= 0
                and start + length <= end
                and 0 <= row < bottom
                and cells.free(left, row, right - left, *QUIET)
            ):
                cells.put(start, row, name, ink)
                cells.shut(start, row, length)
                return True
    return False
