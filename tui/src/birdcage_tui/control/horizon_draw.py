"""The line of trees and roofs on the dials: all around on the rose, and at this azimuth on the elevation arc."""

from __future__ import annotations

from birdcage.sky.horizon import HorizonMask

from birdcage_tui.control.compass import Compass
from birdcage_tui.drawing.canvas import Braille

STEP_DEG = 2
LEAST_DEG = 0.5
"""Less than this lies on the rim."""
CLEAR = 40.0
"""Dots of radius from which the line stands apart from the rim by itself, and its points can be told apart."""


def part_of(el_deg: float) -> float:
    """Return how far from the hub of the rose an elevation stands: as on the sky map, the rim is 0, the hub 90."""
    return 1.0 - min(max(el_deg, 0.0), 90.0) / 90.0


def draw_skyline(canvas: Braille, compass: Compass, mask: HorizonMask) -> None:
    """Draw the line, and hatch between it and the rim what it hides."""
    if not mask:
        return
    ink = "dim" if compass.radius >= CLEAR else "text"
    before: tuple[float, float] | None = None
    was_deg = 0.0
    for az_deg in range(0, 361, STEP_DEG):
        el_deg = mask.at(float(az_deg))
        here = compass.dot(az_deg, part_of(el_deg))
        if before is not None and max(el_deg, was_deg) > LEAST_DEG:
            canvas.line(*before, *here, ink)
        if el_deg > LEAST_DEG and az_deg % (2 * STEP_DEG) == 0:
            canvas.line(*compass.dot(az_deg, 1.0), *here, "faint", every=3)
        before, was_deg = here, el_deg
    if compass.radius >= CLEAR:
        for point in mask.points:
            x, y = compass.dot(point[0], part_of(point[1]))
            for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1)):
                canvas.dot(x + dx - 0.5, y + dy - 0.5, "text")
