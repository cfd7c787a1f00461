"""A small compass: where the dish looks, where its own zero lies, where the Sun stands. North is up, east right."""

from __future__ import annotations

import math

from birdcage.sky.sun import sun

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.view import View

LEAST_HEIGHT, MOST_HEIGHT = 9, 37
WORDS = 24


def draw_compass(cells: Cells, top: int, view: View, place: SitePlace | None) -> None:
    """Draw it from row `top` to the bottom of `cells`, with its readings at the right."""
    height = cells.height - top
    width = min(height * 2, cells.width - WORDS - 2)
    if height < LEAST_HEIGHT or width < 2 * LEAST_HEIGHT:
        _readings(cells, 1, top, view, place)
        return
    height = min(height, width // 2 + 1, MOST_HEIGHT)
    width = min(width, height * 2)
    dots = Braille(width, height)
    x0, y0 = float(width - 1), float(height * 2)
    tall = view.settings.cell_aspect / 2.0
    radius = min(x0 - 6, (y0 - 5) * tall)
    dots.circle(x0, y0, radius, "line", dot_aspect=tall)
    for tick_deg in range(0, 360, 30):
        inner = radius - (4 if tick_deg % 90 == 0 else 2)
        dots.line(*_at(x0, y0, tall, inner, tick_deg), *_at(x0, y0, tall, radius, tick_deg), "dim")
    position = view.state.position
    if position is not None:
        dots.line(x0, y0, *_at(x0, y0, tall, radius - 4, position.az_deg), "accent")
        if view.state.az_offset_deg:
            dots.line(*_at(x0, y0, tall, radius * 0.55, view.state.az_offset_deg),
                      *_at(x0, y0, tall, radius, view.state.az_offset_deg), "dim", every=2)  # fmt: skip
    left = 1
    dots.onto(cells, left, top)
    for letter, at_deg in (("N", 0), ("E", 90), ("S", 180), ("W", 270)):
        _mark(cells, left, top, _at(x0, y0, tall, radius + 3, at_deg), letter, "dim")
    if place is not None:
        az_deg, el_deg = sun(view.utc, place.latitude_deg, place.longitude_deg)
        _mark(cells, left, top, _at(x0, y0, tall, radius, az_deg), "☼", "target-strong" if el_deg > 0 else "dim")
    if position is not None:
        _mark(cells, left, top, _at(x0, y0, tall, radius - 4, position.az_deg), "◉", "accent-strong")
    _readings(cells, left + width + 2, top + 1, view, place)


def _at(x0: float, y0: float, tall: float, reach: float, az_deg: float) -> tuple[float, float]:
    angle = math.radians(az_deg)
    return x0 + reach * math.sin(angle), y0 - reach * math.cos(angle) / tall


def _mark(cells: Cells, left: int, top: int, dot: tuple[float, float], glyph: str, ink: str) -> None:
    cells.put(left + math.floor(dot[0] / 2), top + math.floor(dot[1] / 4), glyph, ink)


def _readings(cells: Cells, x: int, y: int, view: View, place: SitePlace | None) -> None:
    """Write what the compass shows as numbers; unknown is a dash."""
    position, state = view.state.position, view.state
    own, true, el = ("---.--°", "---.--°", "--.--°")
    if position is not None:
        own, true, el = f"{position.dish_az_deg:6.2f}°", f"{position.az_deg:6.2f}°", f"{position.el_deg:5.2f}°"
    rows = [
        ("◉", "accent-strong", "dish, true", true),
        (" ", "dim", "dish frame", own),
        (" ", "dim", "elevation", f" {el}"),
        (" ", "dim", "offset", f"{state.az_offset_deg:+6.2f}°"),
    ]
    if place is None:
        rows.append(("☼", "dim", "Sun", "unknown"))
    else:
        az_deg, el_deg = sun(view.utc, place.latitude_deg, place.longitude_deg)
        rows += [
            ("☼", "target-strong" if el_deg > 0 else "dim", "Sun, true", f"{az_deg:6.2f}°"),
            (" ", "dim", "elevation", f"{el_deg:6.2f}°"),
        ]
    for index, (glyph, ink, name, value) in enumerate(rows):
        cells.put(x, y + index, glyph, ink)
        cells.put(x + 2, y + index, f"{name:11}", "dim")
        cells.put(x + 13, y + index, value, "dim" if view.stale and "Sun" not in name else "text")
