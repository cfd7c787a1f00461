"""Everything above the horizon now: a dot each, Sun and Moon, and names where they fit."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import fit
from birdcage_tui.drawing.polar import Polar
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.sky_ground import QUIET, label

OVER = (*QUIET, "target", "accent", "text")
"""Dots that a satellite's own may stand on."""
CELLS_A_NAME = 45
"""A name for so many cells of the picture, at most."""
CROWD = 60
"""With more satellites than this only favourites are named: the others would hide each other."""
LONGEST = 16
OLD_SIGN = "?"
"""Marks what is drawn by elements that are too old: it is not to be believed that it stands there."""


def draw_trails(canvas: Braille, polar: Polar, view: View) -> None:
    """Dot where the satellites have been; nothing in a crowd."""
    moving = [] if view.sky is None else [one for one in view.sky.up if not one.fixed]
    if len(moving) <= CROWD:
        for one in moving:
            for az_deg, el_deg in one.trail:
                canvas.dot(*polar.dot(az_deg, el_deg), "text" if one.favourite and not one.old else "dim")


def draw_up(cells: Cells, polar: Polar, view: View, target: str = "") -> dict[tuple[int, int], str]:
    """Draw what is up, and return what stands in which cell. The target has its name already.

    In a crowd only favourites stand out.
    """
    sky = view.sky
    named: dict[tuple[int, int], str] = {}
    if sky is None:
        return named
    for glyph, name, place in (("☼", "Sun", sky.sun), ("☾", "Moon", sky.moon)):
        if place is not None and place[1] > 0:
            cell = polar.cell(*place)
            if cells.free(*cell, 1, *OVER):
                cells.put(*cell, glyph, "strong")
            named[cell] = name
    marks, quiet = [], "dim" if len([one for one in sky.up if not one.fixed]) > CROWD else "text"
    for one in sky.up:
        cell = polar.cell(one.az_deg, one.el_deg)
        named[cell] = f"{one.name}, {named[cell]}" if cell in named else one.name
        if cells.free(*cell, 1, *OVER):
            sign, ink = (OLD_SIGN, "dim") if one.old else ("•", "strong" if one.favourite else quiet)
            cells.put(*cell, sign, ink)
        if not one.fixed and one.name != target:
            marks.append((one, cell))
    wanted = [pair for pair in marks if pair[0].favourite or len(marks) <= CROWD]
    # Tens of degrees, then the name: a satellite that creeps past another does not take its name away.
    wanted.sort(key=lambda pair: (not pair[0].favourite, -(pair[0].el_deg // 10), pair[0].name))
    middle, left = polar.width // 2, cells.width * cells.height // CELLS_A_NAME
    for one, (x, y) in wanted:
        if left <= 0:
            break
        name = fit(one.name, LONGEST)
        # The elevation of your own: it is seen to move, where a cell of the map is degrees wide.
        sure = one.favourite and not one.old
        names = (f"{name} {one.el_deg:.1f}°", name) if sure else (name,)
        left -= label(cells, names, x, y, x - middle, "text" if sure else "dim")
    return named
