"""A tapered needle in dots: broad at the hub, one dot at its tip, which is where it points."""

from __future__ import annotations

import math

from birdcage_tui.drawing.canvas import Braille


def draw_needle(canvas: Braille, x: float, y: float, angle_deg: float, length: float, tail: float, ink: str,
                *, hollow: bool = False, dot_aspect: float = 1.0) -> None:  # fmt: skip
    """Draw one from (x, y) in dots; `angle_deg` is clockwise from straight up; `hollow` is its outline, dotted.

    Lengths are in widths of a dot; `dot_aspect` is how much taller one is.
    """
    angle = math.radians(angle_deg)
    along_x, along_y = math.sin(angle), -math.cos(angle)
    tip_x, tip_y = x + along_x * length, y + along_y * length / dot_aspect
    half = max(1.0, min(2.5, length * 0.045))
    steps = max(1, round(half * 2))
    if hollow:
        for off in (-half, half):
            canvas.line(x - along_y * off, y + along_x * off / dot_aspect, tip_x, tip_y, ink, 2)
        return
    for step in range(-steps, steps + 1):
        off = half * step / steps
        base_x, base_y = x - along_y * off, y + along_x * off / dot_aspect
        canvas.line(base_x, base_y, tip_x, tip_y, ink)
        if tail:
            canvas.line(base_x, base_y, x - along_x * tail, y - along_y * tail / dot_aspect, ink)
