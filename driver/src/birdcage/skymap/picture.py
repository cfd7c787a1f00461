"""A map as a picture: axes in degrees, scale with unit, what and when, names of satellites. Needs Pillow."""

from __future__ import annotations

import io
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.base.version import version
from birdcage.signal.recordings import DEMO
from birdcage.skymap.colour_maps import COLOUR_MAPS, STEPS, USUAL
from birdcage.skymap.fits_head import number_of
from birdcage.skymap.picture_words import (
    GAP,
    axis_names,
    axis_ticks,
    drawn,
    level_ticks,
    satellites_on,
    tick_words,
    title_of,
    told_of,
)
from birdcage.skymap.plan import MapFrame
from birdcage.skymap.sky_map import SkyMap

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw
    from PIL.ImageFont import FreeTypeFont, ImageFont

MAP_PX = (2200, 1300)
"""The map has about so many pixels at most, each way; a cell always has whole ones."""
LEFT, TOP, RIGHT, BOTTOM = 190, 60, 290, 250
BAR_PX, BAR_GAP, TICK = 40, 50, 14
PAPER, INK, QUIET, RULE = (255, 255, 255), (24, 28, 38), (96, 102, 116), (24, 28, 38)
UNHEARD, STRIPE, STRIPES_PX = (236, 236, 232), (196, 197, 194), 18
"""Directions that were not measured: grey with slanted lines, which no scale has."""
TITLE_PT, TEXT_PT, SMALL_PT = 46, 32, 28


@dataclass(frozen=True)
class _Sheet:
    """What is drawn on, and where the map lies on it."""

    sky_map: SkyMap
    image: Image
    pen: ImageDraw
    left: int
    top: int
    width: int
    height: int
    cell: tuple[int, int]

    def at(self, x_deg: float, y_deg: float) -> tuple[float, float]:
        """Return the pixel of an angle along both axes: a cell's middle is its angle."""
        plan = self.sky_map.plan
        right = (x_deg - plan.x_low_deg) / plan.step_deg + 0.5
        up = (y_deg - plan.y_low_deg) / plan.row_step_deg + 0.5
        return self.left + right * self.cell[0], self.top + self.height - up * self.cell[1]


def as_png(sky_map: SkyMap, colours: str = USUAL) -> bytes:
    """Return the picture, in one of the colours of `COLOUR_MAPS`. The place itself is nowhere in it."""
    from PIL.PngImagePlugin import PngInfo

    grid = sky_map.grid()
    sheet = _laid_out(sky_map)
    low, high = _ends(grid)
    sheet.image.paste(_cells(grid, low, high, colours, sheet), (sheet.left, sheet.top))
    _satellites(sheet)
    _beam(sheet)
    _axes(sheet)
    _scale(sheet, low, high, colours)
    _legend(sheet)
    about = PngInfo()
    about.add_text("Title", title_of(sky_map))
    about.add_text("Software", f"birdcage {version()}")
    if sky_map.demo:
        about.add_text("Comment", DEMO)
    written = io.BytesIO()
    sheet.image.save(written, "PNG", pnginfo=about)
    return written.getvalue()


def _font(size: int) -> FreeTypeFont | ImageFont:
    from PIL import ImageFont as Fonts

    return Fonts.load_default(size)


def _laid_out(sky_map: SkyMap) -> _Sheet:
    """Return an empty sheet with its title, as large as the map and the title need."""
    from PIL import Image, ImageDraw

    plan = sky_map.plan
    a_degree = min(MAP_PX[0] / (plan.columns * plan.step_deg), MAP_PX[1] / (plan.rows * plan.row_step_deg))
    cell = (max(round(a_degree * plan.step_deg), 1), max(round(a_degree * plan.row_step_deg), 1))
    width, height = cell[0] * plan.columns, cell[1] * plan.rows
    title, badge = title_of(sky_map), "DEMO: simulated sky" if sky_map.demo else ""
    measure = ImageDraw.Draw(Image.new("RGB", (1, 1)))
    wide = measure.textlength(title, _font(TITLE_PT))
    beside = measure.textlength(badge, _font(TEXT_PT)) + 90 if badge else 0.0
    full = max(LEFT + width + RIGHT, LEFT + round(wide + beside) + 60)
    lines = _wrapped(told_of(sky_map), full - LEFT - 60, measure)
    top = TOP + 70 + 44 * len(lines) + 30
    image = Image.new("RGB", (full, top + height + BOTTOM), PAPER)
    pen = ImageDraw.Draw(image)
    pen.text((LEFT, TOP), title, INK, _font(TITLE_PT))
    if badge:
        _badge(pen, LEFT + wide + 40, TOP, badge)
    for number, line in enumerate(lines):
        pen.text((LEFT, TOP + 70 + 44 * number), line, QUIET, _font(TEXT_PT))
    return _Sheet(sky_map, image, pen, LEFT, top, width, height, cell)


def _badge(pen: ImageDraw, left: float, top: float, words: str) -> None:
    wide = pen.textlength(words, _font(TEXT_PT))
    pen.rounded_rectangle((left, top - 2, left + wide + 40, top + 52), 10, INK)
    pen.text((left + 20, top + 25), words, PAPER, _font(TEXT_PT), anchor="lm")


def _wrapped(parts: list[str], room: float, pen: ImageDraw) -> list[str]:
    lines: list[str] = []
    for part in parts:
        joined = f"{lines[-1]}{GAP}{part}" if lines else part
        if lines and pen.textlength(joined, _font(TEXT_PT)) <= room:
            lines[-1] = joined
        else:
            lines.append(part)
    return lines


def _ends(grid: NDArray[np.float64]) -> tuple[float, float]:
    """Return the lowest and highest level; 0 and 1 where nothing was heard."""
    import numpy as np

    if np.isnan(grid).all():
        return 0.0, 1.0
    return float(np.nanmin(grid)), float(np.nanmax(grid))


def _cells(grid: NDArray[np.float64], low: float, high: float, colours: str, sheet: _Sheet) -> Image:
    """Return the map itself: each cell one block of its colour, hatched where nothing was heard."""
    import numpy as np
    from PIL import Image

    table = np.array([COLOUR_MAPS[colours](step / STEPS) for step in range(STEPS + 1)], dtype=np.uint8)
    levels = (grid[::-1] - low) / (high - low if high > low else 1.0)
    heard = ~np.isnan(levels)
    steps = np.rint(np.where(heard, levels, 0.0) * STEPS).astype(np.intp)
    blocks = [np.repeat(np.repeat(each, sheet.cell[1], 0), sheet.cell[0], 1) for each in (table[steps], heard)]
    return Image.composite(
        Image.fromarray(blocks[0]), _hatched(*blocks[1].shape), Image.fromarray(blocks[1].astype(np.uint8) * 255)
    )


def _hatched(height: int, width: int) -> Image:
    """Return grey with slanted lines."""
    import numpy as np
    from PIL import Image

    rows, columns = np.indices((STRIPES_PX, STRIPES_PX))
    stripe = np.clip(2.0 - np.abs((rows + columns) % STRIPES_PX - STRIPES_PX / 2), 0.0, 1.0)[..., None]
    tile = (np.array(UNHEARD) * (1.0 - stripe) + np.array(STRIPE) * stripe).astype(np.uint8)
    down, across = -(-height // STRIPES_PX), -(-width // STRIPES_PX)
    return Image.fromarray(np.ascontiguousarray(np.tile(tile, (down, across, 1))[:height, :width]))


def _axes(sheet: _Sheet) -> None:
    sky_map, pen = sheet.sky_map, sheet.pen
    plan, small = sky_map.plan, _font(SMALL_PT)
    right, bottom = sheet.left + sheet.width, sheet.top + sheet.height
    a_degree_px = sheet.cell[0] / plan.step_deg
    for x_deg in axis_ticks(plan.x_low_deg, plan.x_high_deg, plan.step_deg, a_degree_px, 150):
        x, _ = sheet.at(x_deg, plan.y_low_deg)
        pen.line((x, bottom, x, bottom + TICK), RULE, 3)
        pen.text((x, bottom + TICK + 8), tick_words(sky_map, x_deg, azimuth=True), INK, small, anchor="ma")
    a_degree_px = sheet.cell[1] / plan.row_step_deg
    for y_deg in axis_ticks(plan.y_low_deg, plan.y_high_deg, plan.row_step_deg, a_degree_px, 80):
        _, y = sheet.at(plan.x_low_deg, y_deg)
        pen.line((sheet.left - TICK, y, sheet.left, y), RULE, 3)
        words = tick_words(sky_map, y_deg, azimuth=False)
        pen.text((sheet.left - TICK - 10, y), words, INK, small, anchor="rm")
    pen.rectangle((sheet.left - 2, sheet.top - 2, right + 1, bottom + 1), outline=RULE, width=2)
    along, upward = axis_names(sky_map)
    pen.text((sheet.left + sheet.width / 2, bottom + 72), along, INK, _font(TEXT_PT), anchor="ma")
    _upright(sheet, upward, 34, sheet.top + sheet.height // 2)


def _upright(sheet: _Sheet, words: str, left: int, middle: int) -> None:
    """Write words from bottom to top."""
    from PIL import Image, ImageDraw

    wide = round(sheet.pen.textlength(words, _font(TEXT_PT))) + 8
    strip = Image.new("RGB", (wide, 44), PAPER)
    ImageDraw.Draw(strip).text((4, 2), words, INK, _font(TEXT_PT))
    sheet.image.paste(strip.rotate(90, expand=True), (left, max(middle - wide // 2, 0)))


def _scale(sheet: _Sheet, low: float, high: float, colours: str) -> None:
    """Draw the colour bar, with its unit above."""
    pen, small = sheet.pen, _font(SMALL_PT)
    left, top, height = sheet.left + sheet.width + BAR_GAP, sheet.top, sheet.height
    for row in range(height):
        pen.line((left, top + row, left + BAR_PX, top + row), COLOUR_MAPS[colours](1.0 - row / max(height - 1, 1)))
    pen.rectangle((left - 2, top - 2, left + BAR_PX + 1, top + height + 1), outline=RULE, width=2)
    for level in level_ticks(low, high, max(height // 90, 2)):
        y = top + (height - 1) * (1.0 - ((level - low) / (high - low) if high > low else 0.5))
        pen.line((left + BAR_PX, y, left + BAR_PX + TICK, y), RULE, 3)
        pen.text((left + BAR_PX + TICK + 10, y), f"{level:.6g}", INK, small, anchor="lm")
    pen.text((left, top - 18), drawn(sheet.sky_map.unit), INK, small, anchor="ls")


def _legend(sheet: _Sheet) -> None:
    """Say below how much was heard, and what is hatched."""
    sky_map, pen = sheet.sky_map, sheet.pen
    plan, small = sky_map.plan, _font(SMALL_PT)
    y, x = sheet.top + sheet.height + 178, float(sheet.left)
    step = f"{plan.step_deg:g}°" if plan.y_step_deg is None else f"{plan.step_deg:g}° x {plan.y_step_deg:.3g}°"
    words = f"{len(sky_map.samples)} of {plan.cells} directions{GAP}step {step}"
    az, el = number_of(sky_map.about, "beam_az_deg"), number_of(sky_map.about, "beam_el_deg")
    if az is not None and el is not None:
        words += f"{GAP}beam {az:.3g}°" if az == el else f"{GAP}beam {az:.3g}° x {el:.3g}°"
    pen.text((x, y), words, QUIET, small, anchor="lm")
    if not sky_map.is_complete:
        x += pen.textlength(words, small) + 50
        sheet.image.paste(_hatched(34, 60), (round(x), y - 17))
        pen.rectangle((round(x), y - 17, round(x) + 60, y + 17), outline=STRIPE, width=2)
        pen.text((x + 76, y), "not measured", QUIET, small, anchor="lm")


def _satellites(sheet: _Sheet) -> None:
    """Ring each satellite and name it beside, where its name covers no other one."""
    if sheet.sky_map.plan.frame is MapFrame.TARGET:
        x, y = sheet.at(0.0, 0.0)
        for width, ink in ((7, PAPER), (3, INK)):
            sheet.pen.line((x - 18, y, x + 18, y), ink, width)
            sheet.pen.line((x, y - 18, x, y + 18), ink, width)
        return
    found = [(*sheet.at(az, el), label, name) for az, el, label, name in satellites_on(sheet.sky_map)]
    taken = [(x - 13, y - 13, x + 13, y + 13) for x, y, _label, _name in found]
    for left, top, right, bottom in taken:
        sheet.pen.ellipse((left, top, right, bottom), outline=PAPER, width=7)
        sheet.pen.ellipse((left + 2, top + 2, right - 2, bottom - 2), outline=INK, width=3)
    for x, y, label, name in found:
        _name_beside(sheet, x, y, (f"{label}  {name}", label), taken)


def _name_beside(
    sheet: _Sheet, x: float, y: float, names: tuple[str, ...], taken: list[tuple[float, float, float, float]]
) -> None:
    """Write the first of the names that has room above, below, right or left of a ring."""
    small = _font(SMALL_PT)
    for name in names:
        for dx, dy, anchor in ((0, -18, "ms"), (0, 18, "ma"), (22, 0, "lm"), (-22, 0, "rm")):
            box = sheet.pen.textbbox((x + dx, y + dy), name, small, anchor=anchor, stroke_width=3)
            if _inside(box, sheet) and not any(_overlap(box, other) for other in taken):
                sheet.pen.text((x + dx, y + dy), name, INK, small, anchor=anchor, stroke_width=3, stroke_fill=PAPER)
                taken.append(box)
                return


def _inside(box: tuple[float, float, float, float], sheet: _Sheet) -> bool:
    return (
        box[0] >= sheet.left and box[1] >= sheet.top and box[2] <= sheet.left + sheet.width
        and box[3] <= sheet.top + sheet.height
    )  # fmt: skip


def _overlap(one: tuple[float, float, float, float], other: tuple[float, float, float, float]) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def _beam(sheet: _Sheet) -> None:
    """Draw the beam to scale into the lower left corner, where it covers little of the map."""
    sky_map = sheet.sky_map
    az, el = number_of(sky_map.about, "beam_az_deg"), number_of(sky_map.about, "beam_el_deg")
    if az is None or el is None:
        return
    plan = sky_map.plan
    high = el / plan.row_step_deg * sheet.cell[1]
    middle_deg = plan.y_low_deg + el if plan.frame is MapFrame.AZEL else 0.0
    wide = az / max(math.cos(math.radians(middle_deg)), 0.1) / plan.step_deg * sheet.cell[0]
    if wide > sheet.width / 6 or high > sheet.height / 4:
        return
    left, bottom = sheet.left + 20, sheet.top + sheet.height - 20
    for grow, width, ink in ((2, 7, PAPER), (0, 3, INK)):
        ends = (left - grow, bottom - high - grow, left + wide + grow, bottom + grow)
        sheet.pen.ellipse(ends, outline=ink, width=width)
    sheet.pen.text(
        (left + wide + 16, bottom - high / 2), "beam", INK, _font(SMALL_PT), anchor="lm", stroke_width=4,
        stroke_fill=PAPER,
    )  # fmt: skip
