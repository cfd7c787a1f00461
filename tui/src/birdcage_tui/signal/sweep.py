"""A sweep on true axes: every direction with its error, the beam that fits, and the sweeps before it beneath."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import shorten, wrap
from birdcage_tui.drawing.strip_scale import strip_scale
from birdcage_tui.shown.sweep_book import SweepFit, SweepShown
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

Scale = Callable[[float], float]
AXES = {"az": "azimuth", "el": "elevation", "path": "along the path"}
AXIS_COLUMNS = 7
EMPTY = "No sweep yet. w sweeps an axis through where the dish points."


class SweepPane(Pane):
    """Level over azimuth or elevation."""

    HELP = (
        "Each cross is one direction, its height the error of the mean. The line is the beam that fits. Earlier sweeps "
        "along the same axis lie beneath, dim."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Sweep"

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the newest one over those before it."""
        if not view.sweeps:
            for row, line in enumerate(wrap(EMPTY, max(cells.width - 2, 10))):
                cells.put(1, row, line, "dim")
            return
        newest = view.sweeps[-1]
        cells.put(1, 0, shorten(_words(newest, view.heard.unit), cells.width - 2), "text")
        shown = _beside(newest, view.sweeps)
        before = len(shown) - 1
        beneath = f"{before} before it" if before > 1 else "the one before"
        title = f"Sweep, dim: {beneath}" if before > 0 else "Sweep"
        if self.border_title != title:  # setting it repaints the pane, equal or not
            self.border_title = title
        if shown and cells.height >= 4:
            self._plot(cells, shown, view.heard.span, view.heard.least)

    @staticmethod
    def _plot(cells: Cells, sweeps: Sequence[SweepShown], span: float, least: float | None) -> None:
        newest, width, height = sweeps[-1], cells.width - AXIS_COLUMNS - 2, cells.height - 2
        points = [point for sweep in sweeps for point in sweep.points]
        left, right = _ends(newest)
        levels = [each.level for each in points]
        scale, dots = strip_scale(min(levels), max(levels), span, least, height), height * 4 - 1
        canvas = Braille(width, height)

        def x_of(deg: float) -> float:
            return (deg - left) / (right - left) * (width * 2 - 1)

        def y_of(level: float) -> float:
            return scale.dot(level, dots)

        for tick in scale.ticks:
            canvas.line(0, y_of(tick), width * 2 - 1, y_of(tick), "faint", every=8)
            cells.put(1, 1 + int(y_of(tick)) // 4, f"{tick:6.{scale.decimals}f}", "dim")
        for sweep in sweeps[:-1]:
            for one, other in itertools.pairwise(sweep.points):
                canvas.line(x_of(one.deg), y_of(one.level), x_of(other.deg), y_of(other.level), "dim", every=2)
        if newest.fit is not None:
            canvas.line(x_of(newest.fit.deg), 0, x_of(newest.fit.deg), dots, "line", every=4)
            _curve(canvas, newest.fit, (left, right), x_of, y_of)
        for point in newest.points:
            x, y = x_of(point.deg), y_of(point.level)
            reach = max(abs(y_of(point.level + point.sigma) - y), 1.0)
            canvas.line(x, y - reach, x, y + reach, "strong")
            canvas.line(x - 1, y, x + 1, y, "strong")
        canvas.onto(cells, AXIS_COLUMNS + 1, 1)
        _write_axis(cells, newest, left, right, width)


def _beside(newest: SweepShown, sweeps: Sequence[SweepShown]) -> list[SweepShown]:
    """Return those of which something is on the axis of the newest one, and this as the last."""
    if not newest.points:
        return []
    left, right = _ends(newest)
    same = (each for each in sweeps if each.axis == newest.axis)
    return [each for each in same if any(left <= point.deg <= right for point in each.points)]


def _ends(sweep: SweepShown) -> tuple[float, float]:
    """Return both ends of the axis: those that it is to have, while it goes on in equal steps."""
    degs = [each.deg for each in sweep.points]
    if not sweep.is_over and 2 <= len(degs) < sweep.of:
        degs.append(degs[0] + (degs[-1] - degs[0]) / (len(degs) - 1) * (sweep.of - 1))
    left, right = min(degs), max(degs)
    return (left - 0.5, right + 0.5) if right - left < 0.1 else (left, right)


def _curve(canvas: Braille, fit: SweepFit, ends: tuple[float, float], x_of: Scale, y_of: Scale) -> None:
    left, right = ends
    steps = 160
    degs = [left + (right - left) * index / steps for index in range(steps + 1)]
    for one, other in itertools.pairwise(degs):
        canvas.line(x_of(one), y_of(fit.level(one)), x_of(other), y_of(fit.level(other)), "accent")


def _write_axis(cells: Cells, newest: SweepShown, left: float, right: float, width: int) -> None:
    y, x = cells.height - 1, AXIS_COLUMNS + 1
    cells.put(x, y, _deg_text(left, newest.axis), "dim")
    cells.right(x + width, y, _deg_text(right, newest.axis), "dim")
    if newest.fit is not None:
        at = _deg_text(newest.fit.deg, newest.axis)
        middle = x + round((newest.fit.deg - left) / (right - left) * (width - 1)) - len(at) // 2
        if x + 9 < middle < x + width - 9 - len(at):
            cells.put(middle, y, at, "accent-strong")
    else:
        name = AXES[newest.axis]
        cells.put(x + (width - len(name)) // 2, y, name, "dim")


def _deg_text(deg: float, axis: str, digits: int = 1) -> str:
    if axis == "path":
        return f"{deg:+.{digits}f}°"
    return f"{deg % 360.0 if axis == 'az' else deg:.{digits}f}°"


def _words(sweep: SweepShown, unit: str) -> str:
    if sweep.fit is not None:
        fit, unit = sweep.fit, "dB" if sweep.fit.decibels else unit
        digits = 1 if fit.decibels else 0
        return (
            f"{AXES[sweep.axis]} {_deg_text(fit.deg, sweep.axis, 2)} ±{fit.sigma_deg:.2f}°  "
            f"width {fit.width_deg:.1f}°  rise {fit.rise:.{digits}f}  floor {fit.floor:.{digits}f} {unit}"
        )
    if sweep.is_over:
        return sweep.why
    last = sweep.points[-1] if sweep.points else None
    told = "" if last is None else f", {last.level:.0f} {unit} at {_deg_text(last.deg, sweep.axis)}"
    what = "Drift scan" if sweep.axis == "path" else f"Sweep in {AXES[sweep.axis]}"
    return f"{what}: {sweep.done} of {sweep.of} directions{told}"
