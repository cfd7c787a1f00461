"""Curves of a target that is always up: how strong and how far off it was lately, and where it drifts within a day."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from statistics import fmean
from typing import TYPE_CHECKING

from birdcage.base.geometry import separation

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.shown.error_scale import STEPS_DEG, shown_deg
from birdcage_tui.shown.track_words import degrees, drifts
from birdcage_tui.shown.view import STALE_S, View

if TYPE_CHECKING:
    from birdcage.tracking.day import Day
    from birdcage.tracking.plan import Plan

LEFT, RIGHT = 6, 8
"""Columns of the scales."""
BACK_S = 1200.0
"""How far back signal and error are shown."""
SILENT_S = 15.0
"""A longer silence is a gap: the tuner is read every 9 s, in bursts."""
NEAR_DEG = 1.0
"""So near counts as on the target while the beam is not known."""
DAY_ROWS = 4
"""Rows of a day's drift: two curves, and their times."""
DRIFT = "drift over 24 h"
"""What the curves of a day and the figures beside them are."""
LEAST_DRIFT_DEG = 0.05
"""The least that a scale of drift spans: what is less must look like it."""

Series = list[tuple[float, float]]
"""Seconds before now, and values."""


def draw_still(cells: Cells, view: View, plan: Plan, day: Day, *, followed: bool) -> None:
    """Draw signal and error of the last 20 minutes, and below them the drift of the next 24 hours, if there is any."""
    width = cells.width - LEFT - RIGHT
    drifting = drifts(day) and cells.height >= DAY_ROWS + 5
    rows = cells.height - 1 - (DAY_ROWS if drifting else 0)  # a row for the times
    if width < 12 or rows < 2:
        return
    if plan.legs:
        errors_height = max(rows // 3, 1)
        signal_height = rows - errors_height
        _signal(cells, view, day, (0, signal_height, width), followed=followed)
        _errors(cells, view, plan, (signal_height, errors_height, width), followed=followed)
        _past(cells, rows, width)
    else:
        for row, line in enumerate(wrap("Out of reach: no signal and no error to show.", cells.width - 2)[:rows]):
            cells.put(1, row, line, "dim")
    if drifting:
        _drift(cells, day, view.utc.timestamp(), (rows + 1, width))


def _on_target(view: View, day: Day) -> Series:
    """Return what was heard while the dish pointed at the target, to half of its beam."""
    beam, found = view.state.beam, []
    near_deg = NEAR_DEG if beam is None else max(beam.az_deg, beam.el_deg) / 2.0
    for each in view.signal:
        past_s = view.now - each.at
        if past_s > BACK_S or each.az_deg is None or each.el_deg is None:
            continue
        az_deg, el_deg = day.sky.at(view.utc.timestamp() - past_s)
        if separation(az_deg, el_deg, each.az_deg, each.el_deg) <= near_deg:
            found.append((past_s, each.value))
    return found


def _signal(cells: Cells, view: View, day: Day, box: tuple[int, int, int], *, followed: bool) -> None:
    y, height, width = box
    unit, series = view.heard.unit, _on_target(view, day)
    cells.put(0, y + (height - 1) // 2, "sig", "strong")
    if not series:
        first = y + (height - 1) // 2  # beside the name
        for row, line in enumerate(wrap(_nothing(view, followed=followed), width + RIGHT - 1)):
            if first + row < y + height:
                cells.put(LEFT, first + row, line, "dim")
        return
    low, high = min(value for _, value in series), max(value for _, value in series)
    spare = max(view.heard.span - (high - low), (high - low) * 0.1) / 2.0
    low, high = low - spare, high + spare
    _curve(cells, series, (low, high), box, "accent")
    _scale(cells, box, f"{high:.0f}", f"{low:.0f}")
    last_s, last = series[-1]
    ink = "dim" if last_s > SILENT_S else "strong"
    cells.right(cells.width, y + (height - 1) // 2, f"{last:.0f} {'cts' if unit == 'counts' else unit}", ink)


def _nothing(view: View, *, followed: bool) -> str:
    if view.signal_trouble:
        return view.signal_trouble
    if not view.link_up:
        return "No signal: the dish does not answer."
    return "The tuner is read while the dish stands still." if followed else "f and Enter follow it and read the tuner."


def _errors(cells: Cells, view: View, plan: Plan, box: tuple[int, int, int], *, followed: bool) -> None:
    """Draw how far off the dish was since it follows; what the plan expects stands in words, where there is room."""
    y, height, _ = box
    looks = [each for each in view.followed if view.now - each.at <= BACK_S] if followed else []
    series = [(view.now - each.at, shown_deg(each)) for each in looks]
    expected = None if plan.pointing is None or plan.pointing.median is None else plan.pointing.median.rms_deg
    worst = max([0.0 if expected is None else expected, *(value for _, value in series)])
    top = next((step for step in STEPS_DEG if step >= worst * 1.05), STEPS_DEG[-1])
    cells.put(0, y + (height - 1) // 2, "err", "strong")
    _curve(cells, series, (0.0, top), box, "accent", of=max)
    _scale(cells, box, degrees(top), "0")
    if series:
        stale = series[-1][0] > 2 * STALE_S
        cells.right(cells.width, y + (height - 1) // 2, degrees(series[-1][1]), "dim" if stale else "strong")
    words = "" if expected is None else f"expected ±{degrees(expected)}"
    if words and cells.free(LEFT, y + (height - 1) // 2, len(words) + 2):
        cells.put(LEFT, y + (height - 1) // 2, words, "dim")


def _scale(cells: Cells, box: tuple[int, int, int], high: str, low: str) -> None:
    """Write the ends of a scale, where its name leaves them room."""
    y, height, _ = box
    if height > 2:
        cells.right(LEFT - 1, y, high, "dim")
    if height > 1:
        cells.right(LEFT - 1, y + height - 1, low, "dim")


def _by_column(series: Series, width: int, of: Callable[[list[float]], float]) -> Series:
    """Return one value for each column of dots that has any: more is not to be seen."""
    found: dict[int, Series] = {}
    for each in series:
        found.setdefault(int(each[0] / BACK_S * width * 2), []).append(each)
    return [(fmean(past_s for past_s, _ in some), of([value for _, value in some])) for some in found.values()]


def _curve(
    cells: Cells, series: Series, span: tuple[float, float], box: tuple[int, int, int], ink: str,
    of: Callable[[list[float]], float] = fmean,
) -> None:  # fmt: skip
    """Draw values over the past, now at the right edge."""
    y, height, width = box
    canvas, dots = Braille(width, height), height * 4 - 1
    low, high = span

    def at(past_s: float, value: float) -> tuple[float, float]:
        share = (min(max(value, low), high) - low) / max(high - low, 1e-9)
        return (width * 2 - 1) * (1.0 - past_s / BACK_S), dots * (1.0 - share)

    series = _by_column(series, width, of)
    for one, other in itertools.pairwise(series):
        if one[0] - other[0] <= SILENT_S + BACK_S / width:
            canvas.line(*at(*one), *at(*other), ink)
    if series:
        canvas.dot(*at(*series[-1]), ink)
    canvas.onto(cells, LEFT, y)


def _past(cells: Cells, y: int, width: int) -> None:
    """Write how long ago, up to now."""
    for past_min in (20, 15, 10, 5, 0):
        words = f"-{past_min} min" if past_min == 20 else f"-{past_min}" if past_min else "now"
        x = LEFT + int((width - 1) * (1.0 - past_min * 60.0 / BACK_S)) - (0 if past_min == 20 else len(words) // 2)
        if cells.free(x - 1, y, len(words) + 2):
            cells.put(x, y, words, "dim")


def _drift(cells: Cells, day: Day, now_s: float, box: tuple[int, int]) -> None:
    """Draw azimuth and elevation of the day from now on, each on a scale of its own."""
    top, width = box
    heights = ((DAY_ROWS - 1) // 2, (DAY_ROWS - 1) - (DAY_ROWS - 1) // 2)
    start_s, y = day.sky.start_s, top
    times = [start_s + (day.sky.end_s - start_s) * step / (width * 2 - 1) for step in range(width * 2)]
    az, el = day.sky.sample(times)
    for name, values, height in (("AZ", az.tolist(), heights[0]), ("EL", el.tolist(), heights[1])):
        low, high = min(values), max(values)
        spare = max(LEAST_DRIFT_DEG - (high - low), 0.0) / 2.0
        canvas, dots = Braille(width, height), height * 4 - 1
        for column, value in enumerate(values):
            share = (value - low + spare) / (high - low + 2.0 * spare)
            canvas.dot(column, dots * (1.0 - share), "target" if times[column] >= now_s else "dim")
        canvas.onto(cells, LEFT, y)
        cells.put(0, y, name, "strong")
        cells.right(cells.width, y, f"{high - low:.2f}°", "target")
        y += height
    for hours in (0, 24, 12, 6, 18):
        words = DRIFT if hours == 12 and width >= 2 * len(DRIFT) else f"+{hours} h" if hours else "now"
        x = LEFT + int((width - 1) * hours / 24.0) - (0 if not hours else len(words) // 2)
        if cells.free(x - 1, y, len(words) + 2):
            cells.put(x, y, words, "dim")
