"""The same on the sky: where the peaks and the objects stand, and which way each was off, much enlarged."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.calibrate.scatter import NICE_DEG
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.polar import Polar
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.calibration.guide import GuideView

ARROW_DEG = 20.0
"""How long the scale's residual is drawn, in degrees of this map's elevation."""


class OverSkyPane(Pane):
    """A map of the sky, N up and E right: peaks by number, each with what is left of it as a line."""

    HELP = (
        "A map of the sky, N up and E right. Numbers are peaks. The line at each shows its residual, enlarged as the "
        "frame says. Dots are objects that you can peak on, the triangle marks the one under the cursor. Peaks all "
        "over the sky tell more than many in one place."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "On the sky"
        self.chosen = ""
        """The name of the object under the cursor."""

    def draw(self, cells: Cells, view: View) -> None:
        """Draw it."""
        polar = Polar(cells.width, cells.height, view.settings.cell_aspect)
        canvas = Braille(cells.width, cells.height)
        low, high = view.state.el_min_deg, view.state.el_max_deg
        if low is not None and low > 0:
            polar.hatch(canvas, "faint", 0, low)
        if high is not None and high < 90:
            polar.hatch(canvas, "faint", high, 90)
        polar.ring(canvas, 0, "line")
        for el_deg in (30, 60):
            polar.ring(canvas, el_deg, "line", 4.0)
        now = view.calibrate
        guide = None if now is None else now.guide
        if guide is not None:
            self._arrows(canvas, polar, guide)
        canvas.onto(cells, 0, 0)
        for az_deg, word in ((0, "N"), (90, "E"), (180, "S"), (270, "W")):
            x, y = polar.cell(az_deg, 0)
            cells.put(min(max(x, 0), cells.width - 1), min(max(y, 0), cells.height - 1), word, "dim")
        if guide is not None:
            self._signs(cells, polar, guide)
        position = view.state.position
        if position is not None:
            cells.put(*polar.cell(position.az_deg, position.el_deg), view.pointer, "accent-strong")

    def _arrows(self, canvas: Braille, polar: Polar, guide: GuideView) -> None:
        fit = guide.fit
        words = ""
        if fit is not None:
            most = max(each.off_deg for each in fit.residuals)
            top = next((nice for nice in NICE_DEG if nice >= most), NICE_DEG[-1])
            words = f"scale: 20° = {top:g}° of error"
            for each in fit.residuals:
                az, el = each.peak.true_az_deg, each.peak.true_el_deg
                x0, y0 = polar.dot(az, el)
                # Up on the sky is towards the middle of the map, right is clockwise about it.
                middle_x, middle_y = polar.middle
                reach = polar.radius / 90.0
                tall = polar.dot_aspect
                away = max(((x0 - middle_x) ** 2 + ((y0 - middle_y) * tall) ** 2) ** 0.5, 1e-6)
                out_x, out_y = (x0 - middle_x) / away, (y0 - middle_y) * tall / away
                scale = ARROW_DEG / top * reach
                x1 = x0 - out_x * each.up_deg * scale - out_y * each.right_deg * scale
                y1 = y0 + (out_x * each.right_deg - out_y * each.up_deg) * scale / tall
                canvas.line(x0, y0, x1, y1, "accent")
        if words != (self.border_subtitle or ""):  # setting it repaints the pane, equal or not
            self.border_subtitle = words

    def _signs(self, cells: Cells, polar: Polar, guide: GuideView) -> None:
        for each in guide.proposals:
            cells.put(*polar.cell(each.candidate.az_deg, each.candidate.el_deg), "·", "text")
        for each in guide.proposals:
            if each.candidate.name == self.chosen:
                x, y = polar.cell(each.candidate.az_deg, each.candidate.el_deg)
                cells.put(x, y, "▶", "target-strong")
        if guide.expected is not None:
            cells.put(*polar.cell(*guide.expected), "✕", "target-strong")
        for peak in guide.peaks:
            x, y = polar.cell(peak.true_az_deg, peak.true_el_deg)
            cells.put(x, y, str(peak.number), "accent-strong")
