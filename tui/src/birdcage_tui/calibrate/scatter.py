"""What is left: how far each object lay from where the fitted model has the beam, as one would see it in the sky."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from birdcage_tui.calibrate.calibrate_words import BEGIN, put_wrapped
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.calibration.fit import Fit

NICE_DEG = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 90.0, 180.0)
"""Half widths of the picture."""
LONGEST = 4.0
"""By how much the peaks left out may stretch the scale before they stand at its edge instead."""


def reach_of(fit: Fit) -> float:
    """Return the half width in degrees: all that is left fits, and what was left out where that is not far more."""
    most = max(max(abs(each.right_deg), abs(each.up_deg)) for each in fit.residuals)
    alone = [
        max(abs(each.alone_right_deg), abs(each.alone_up_deg))
        for each in fit.residuals
        if each.alone_right_deg is not None and each.alone_up_deg is not None
    ]
    wanted = max(most * 1.1, min(max(alone, default=0.0) * 1.1, most * LONGEST))
    return next((nice for nice in NICE_DEG if nice >= wanted), NICE_DEG[-1])


LEGEND = "numbers: peaks  ○ left out"
BESIDE = ((0, 0), (2, 0), (-2, 0), (0, -1), (0, 1), (2, -1), (-2, -1), (2, 1), (-2, 1))
"""Where the number of a peak stands whose cell holds another number: as near as there is room.

Two in adjacent cells would read as one number.
"""


class ScatterPane(Pane):
    """Right of and above the middle, each peak by its number; a ring where it lies by the others alone."""

    HELP = (
        "Each number is the residual of a peak, right and up from the fitted model. A ring is its residual with a fit "
        "to the other peaks: the error to expect where you did not measure. A ring far from its number means that only "
        "this peak supports that part of the fit."
    )

    def draw(self, cells: Cells, view: View) -> None:
        """Draw it; without a peak, say what to do and why."""
        now = view.calibrate
        guide = None if now is None else now.guide
        fit = None if guide is None else guide.fit
        self._told(*(("Calibrate", "") if fit is None else ("Residuals", LEGEND)))
        if fit is None:
            y = 0
            for ink, words in BEGIN:
                y = put_wrapped(cells, y, words, ink) + (1 if cells.height >= 15 else 0)
            return
        self._plot(cells, fit, view.state.beam, view.settings.cell_aspect / 2.0)

    def _told(self, title: str, words: str) -> None:
        if (title, words) != (self.border_title, self.border_subtitle or ""):  # setting it repaints, equal or not
            self.border_title, self.border_subtitle = title, words

    @staticmethod
    def _plot(cells: Cells, fit: Fit, beam: Beam | None, dot_aspect: float) -> None:
        reach = reach_of(fit)
        width, height = cells.width, cells.height
        canvas = Braille(width, height)
        half_x, half_y = width - 1.0, (height * 2.0 - 2.0) * dot_aspect
        radius = min(half_x, half_y)
        middle_x, middle_y = float(width // 2 * 2), float(height // 2 * 4 + 1)

        def dot(right: float, up: float) -> tuple[float, float]:
            # What lies beyond the picture stands at its edge.
            x = min(max(right / reach * radius, -half_x), half_x)
            y = min(max(up / reach * radius, -half_y), half_y)
            return middle_x + x, middle_y - y / dot_aspect

        canvas.line(middle_x - radius, middle_y, middle_x + radius, middle_y, "line")
        canvas.line(middle_x, middle_y - radius / dot_aspect, middle_x, middle_y + radius / dot_aspect, "line")
        canvas.circle(middle_x, middle_y, radius, "line", dot_aspect=dot_aspect)
        canvas.circle(middle_x, middle_y, radius / 2, "line", 4.0, dot_aspect)
        if beam is not None and reach / 4 < beam.narrow_deg / 2 < reach:
            across, up = (radius * width / 2 / reach for width in (beam.az_deg, beam.el_deg))
            canvas.ellipse(middle_x, middle_y, across, up / dot_aspect, "dim", 2.0)
        for each in fit.residuals:
            if each.alone_right_deg is not None and each.alone_up_deg is not None:
                canvas.line(*dot(each.right_deg, each.up_deg), *dot(each.alone_right_deg, each.alone_up_deg), "dim", 3)
        canvas.onto(cells, 0, 0)
        for word, right, up in ((f"{reach:g}° up", 0.0, reach), (f"{reach:g}° right", reach, 0.0)):
            x, y = dot(right, up)
            cells.put(min(int(x / 2) + 2, width - len(word)), max(int(y / 4) - (0 if up else 1), 0), word, "dim")
        for each in fit.residuals:
            if each.alone_right_deg is not None and each.alone_up_deg is not None:
                x, y = dot(each.alone_right_deg, each.alone_up_deg)
                cells.put(int(x / 2), int(y / 4), "○", "dim")
        taken: set[tuple[int, int]] = set()
        for each in sorted(fit.residuals, key=lambda one: -math.hypot(one.right_deg, one.up_deg)):
            at_x, at_y = dot(each.right_deg, each.up_deg)
            number = str(each.peak.number)
            for right, down in BESIDE:
                x, y = min(max(int(at_x / 2) + right, 0), width - len(number)), int(at_y / 4) + down
                if 0 <= y < height and taken.isdisjoint((x + index, y) for index in range(-1, len(number) + 1)):
                    taken |= {(x + index, y) for index in range(len(number))}
                    cells.put(x, y, number, "accent-strong")
                    break
