"""How well the dish has pointed in the last seconds of a pursuit, beside the digits where there is room."""

from __future__ import annotations

from itertools import pairwise

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.shown.error_scale import legible_deg
from birdcage_tui.shown.pursuit import sample_of
from birdcage_tui.shown.view import View

LEAST_WIDTH, MOST_WIDTH = 24, 60
LEAST_TOP_DEG = 0.1
"""What the top of the strip stands for at least: a good pursuit must look like one."""
GAP_S = 5.0


def draw_error_strip(cells: Cells, x: int, height: int, view: View) -> None:
    """Draw a heading and the pointing error, a second a column of dots, in the rows 0 to `height`.

    Nothing unless the dish follows now.
    """
    width = min(cells.width - 1 - x, MOST_WIDTH)
    if width < LEAST_WIDTH or height < 4 or not view.link_up or sample_of(view) is None:
        return
    shown = [look for look in view.followed if view.now - look.at < width * 2]
    if len(shown) < 2:
        return
    x = cells.width - 1 - width
    worst = max(look.error_deg for look in shown)
    top_deg = max(LEAST_TOP_DEG, legible_deg([look.error_deg for look in shown]) * 1.1)
    canvas, dots = Braille(width, height - 1), (height - 1) * 4 - 1

    def at(at_s: float, error_deg: float) -> tuple[float, float]:
        return width * 2 - 1 - (view.now - at_s), dots * (1 - min(error_deg / top_deg, 1.0))

    canvas.line(0, dots, width * 2 - 1, dots, "line", every=4)
    for one, other in pairwise(shown):
        if other.at - one.at <= GAP_S:
            canvas.line(*at(one.at, one.error_deg), *at(other.at, other.error_deg), "accent")
    cells.put(x, 0, f"error  max {worst:.2f}° in {view.now - shown[0].at:.0f} s"[:width], "dim")
    canvas.onto(cells, x, 1)
