"""How far the dish pointed beside the target in the last seconds, as one would see it through the beam."""

from __future__ import annotations

import math

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.shown.error_scale import STEPS_DEG
from birdcage_tui.shown.pursuit import beam_of, sample_of, shown_is_followed
from birdcage_tui.shown.track_words import degrees, half_beam
from birdcage_tui.shown.view import View

LOOKS = 30
LEAST = 16
"""Columns from which it tells something."""


def offset_deg(target_az: float, target_el: float, az_deg: float, el_deg: float) -> tuple[float, float]:
    """Return how far a direction is right of and above the target, in degrees on the sky."""
    turn = (az_deg - target_az + 180.0) % 360.0 - 180.0
    return turn * math.cos(math.radians(target_el)), el_deg - target_el


def draw_bullseye(cells: Cells, x: int, width: int, view: View) -> bool:
    """Draw it over the whole height; return whether there was something to draw, and room for it."""
    if sample_of(view) is None or not shown_is_followed(view) or x < 44 or width < LEAST:
        return False
    last = list(view.followed)[-LOOKS:]
    spots = [offset_deg(one.target_az_deg, one.target_el_deg, one.reported_az_deg, one.reported_el_deg) for one in last]
    if not spots:
        return False
    top = next((step for step in STEPS_DEG if step >= max(math.hypot(*spot) for spot in spots)), STEPS_DEG[-1])
    canvas = Braille(width, cells.height)
    middle_x, middle_y = float(width // 2 * 2), float(cells.height * 2)
    dot_aspect = view.settings.cell_aspect / 2.0
    radius = min(middle_x, middle_y * dot_aspect) - 1.0
    canvas.circle(middle_x, middle_y, radius, "line", dot_aspect=dot_aspect)
    canvas.circle(middle_x, middle_y, radius / 2, "line", 3.0, dot_aspect)
    beam = beam_of(view)
    if beam is not None and beam.narrow_deg / 2 < top:
        across, up = (radius * width / 2 / top for width in (beam.az_deg, beam.el_deg))
        canvas.ellipse(middle_x, middle_y, across, up / dot_aspect, "dim")
    dots = [(middle_x + across / top * radius, middle_y - up / top * radius / dot_aspect) for across, up in spots]
    for dot in dots:
        canvas.dot(*dot, "accent")
    canvas.onto(cells, x, 0)
    cells.put(x + width // 2, cells.height // 2, "✕", "target-strong")
    here = int(dots[-1][0]) // 2, int(dots[-1][1]) // 4
    cells.put(x + here[0], here[1], view.pointer, "accent-strong")
    cells.right(x, 0, f"last {LOOKS} s", "dim")
    cells.right(x, 1, f"ring {degrees(top)}", "dim")
    if beam is not None:
        cells.right(x, 2, f"half beam {half_beam(beam)}", "dim")
    return True
