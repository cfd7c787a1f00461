"""Without colours: what colours say is said by bold, dim and reverse, and the terminal keeps its own two colours."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache

from rich.color import Color as RichColor
from rich.segment import Segment
from rich.style import Style
from textual.color import Color
from textual.filter import LineFilter

from birdcage_tui.drawing.themes import ThemeColours, contrast

REVERSED_FROM = 1.8
"""A ground that differs this much from the look's own is a bar, a cursor or a label: reverse."""
COLOURLESS = ("vt", "dumb")
"""Beginnings of `TERM` that know no colours."""


def wanted(environ: Mapping[str, str]) -> bool:
    """Return whether there are to be no colours: `NO_COLOR` is set, or the terminal has none."""
    return bool(environ.get("NO_COLOR")) or environ.get("TERM", "").startswith(COLOURLESS)


def hex_of(colour: RichColor | None, otherwise: str) -> str:
    """Return `#rrggbb`; `otherwise` for none, and for the terminal's own."""
    return otherwise if colour is None or colour.is_default else colour.get_truecolor().hex


@lru_cache(2048)
def without_colour(style: Style, look: ThemeColours) -> Style:
    """Return `style` in attributes alone."""
    ink, ground = hex_of(style.color, look.text), hex_of(style.bgcolor, look.ground)
    if style.reverse:
        ink, ground = ground, ink
    reverse = ground == look.row or contrast(ground, look.ground) >= REVERSED_FROM
    # Nothing is dim on a reversed row: it is there because it matters.
    quiet = not reverse and contrast(ink, ground) <= contrast(look.dim, look.ground) + 0.2 and ink != look.focus
    bold = bool(style.bold) or ink == look.focus
    plain = style.without_color + Style(reverse=reverse, dim=quiet and not bold, bold=bold)
    return plain + Style(meta=style.meta) if style.meta else plain  # what a click finds stays


class AttributeFilter(LineFilter):
    """Takes the colours out of finished rows, and puts attributes in."""

    def __init__(self, look: Callable[[], ThemeColours]) -> None:
        super().__init__()
        self._look = look

    def apply(self, segments: list[Segment], _background: Color) -> list[Segment]:
        """Return the same row without colours."""
        look = self._look()
        return [
            Segment(text, None if style is None else without_colour(style, look), control)
            for text, style, control in segments
        ]
