"""The inks of a map's picture: two levels in one cell, and words and lines on top of a level."""

from __future__ import annotations

from functools import cache, lru_cache

from birdcage.skymap.colour_maps import COLOUR_MAPS, USUAL
from rich.color import Color
from rich.style import Style

from birdcage_tui.drawing.themes import DEFAULT, LOOKS, ThemeColours, contrast
from birdcage_tui.signal.map_raster import LEVELS, UNKNOWN

STATES = 2 * LEVELS + 1
"""Levels that were heard, those that are a neighbour's, and nothing."""
NIGHT = "red"
"""What the night theme shows whatever was chosen: other colours would take the dark from the eyes."""
NEIGHBOUR, NEIGHBOUR_BY_DAY = 0.6, 0.8
"""How much of its colour a direction keeps that was not heard itself, on a dark ground and on a light one."""
LEGIBLE = 2.6
"""Contrast below which a line or a word takes the theme's text or ground instead of its own colour."""
ASCII, SHADES = ".:-=+*#%@", "·░▒▓█"
"""A glyph a level where colours can't tell them."""


def colours_for(chosen: str, theme: str) -> str:
    """Return the name of the colours that are shown."""
    return NIGHT if theme == "night" else chosen if chosen in COLOUR_MAPS else USUAL


def next_colours(present: str) -> str:
    """Return the name of those that come after."""
    names = list(COLOUR_MAPS)
    return names[(names.index(present) + 1) % len(names)] if present in names else USUAL


@cache
def pair(upper: int, lower: int) -> str:
    """Return the ink of a cell whose halves have these levels."""
    return f"map {upper} {lower}"


def over(ink: str, level: int) -> str:
    """Return an ink of the theme on the ground of a level."""
    return f"over {ink} {level}"


def glyph(level: int, *, ascii_only: bool) -> str:
    """Return the glyph of a level; a space for nothing."""
    ramp = ASCII if ascii_only else SHADES
    return " " if level == UNKNOWN else ramp[level % LEVELS * len(ramp) // LEVELS]


class MapInks(dict[str, Style]):
    """Those of the theme, and what `pair` and `over` name."""

    def __init__(self, look: ThemeColours, colours: str) -> None:
        super().__init__(look.inks)
        self._look, self._hex = look, _levels(look.name, colours)

    def __missing__(self, name: str) -> Style:
        kind, *words = name.split()
        if kind == "map":
            upper, lower = (self._hex[int(word)] for word in words)
            style = Style.from_color(Color.parse(upper), Color.parse(lower))
        else:
            ink, level = words
            style = self._over(ink, self._hex[int(level)])
        self[name] = style
        return style

    def _over(self, ink: str, ground: str) -> Style:
        """Return an ink on the ground of a level: its own colour, else that of the dark theme, else light or dark."""
        for look in (self._look, LOOKS[DEFAULT]) if self._look.name != "night" else (self._look,):
            style = look.inks[ink]
            colour = look.text if style.color is None else style.color.get_truecolor().hex
            if contrast(colour, ground) >= LEGIBLE:
                return Style(color=colour, bgcolor=ground, bold=bool(style.bold))
        plain = max((self._look.text, self._look.ground), key=lambda each: contrast(each, ground))
        return Style(color=plain, bgcolor=ground, bold=bool(self._look.inks[ink].bold))

    def colour(self, level: int) -> str:
        """Return the colour of a level as `#rrggbb`."""
        return self._hex[level]


@lru_cache(maxsize=8)
def inks_of(theme: str, colours: str) -> MapInks:
    """Return the inks of a theme with these colours, which are made once."""
    return MapInks(LOOKS[theme], colours)


def _levels(theme: str, colours: str) -> tuple[str, ...]:
    """Return the colour of every level; the last one, which is `UNKNOWN` as an index, is the theme's ground."""
    ground, keeps = LOOKS[theme].ground, NEIGHBOUR if LOOKS[theme].dark else NEIGHBOUR_BY_DAY
    heard = [COLOUR_MAPS[colours](index / (LEVELS - 1)) for index in range(LEVELS)]
    back = tuple(int(ground[at : at + 2], 16) for at in (1, 3, 5))
    dim = [
        tuple(round(there + (here - there) * keeps) for here, there in zip(each, back, strict=True)) for each in heard
    ]
    return (*(f"#{red:02x}{green:02x}{blue:02x}" for red, green, blue in (*heard, *dim)), ground)
