"""What the app looks like on this terminal: theme, glyph set, attributes in place of colours."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import cast

from textual.app import App
from textual.filter import LineFilter, Monochrome
from textual.reactive import Reactive
from textual.screen import Screen
from textual.widget import Widget

from birdcage_tui.drawing import attributes
from birdcage_tui.drawing.glyphs import GlyphFilter
from birdcage_tui.drawing.themes import DEFAULT, LOOKS, ThemeColours
from birdcage_tui.feeds.app_host import AppHost


class Ground(Screen[None]):
    """The one screen. A change of focus repaints the two widgets that it concerns, not everything."""

    focused: Reactive[Widget | None] = Reactive(None, repaint=False)

    def on_screen_resume(self) -> None:
        """Draw a frame when a dialog has gone: while one types there, Space is no STOP, and the footer said so."""
        cast(AppHost, self.app).paint()


class Appearance:
    """What finished rows go through, by the settings and what the terminal can show."""

    def __init__(self, app: App[None], theme: str, glyphs: str) -> None:
        self._app = app
        for look in LOOKS.values():
            app.register_theme(look.theme())
        app.theme = theme if theme in LOOKS else DEFAULT
        self._glyph_filter = GlyphFilter(glyphs)
        self._attribute_filter = attributes.AttributeFilter(self._look)
        self._colourless = attributes.wanted(os.environ)
        # The ground of a text field cannot be told from that of the page there.
        app.set_class(self._colourless or app.console.color_system in (None, "standard"), "-few-colours")

    def _look(self) -> ThemeColours:
        return LOOKS.get(self._app.theme, LOOKS[DEFAULT])

    def filters(self, usual: Sequence[LineFilter]) -> list[LineFilter]:
        """Return Textual's own filters with ours: another glyph set, and attributes in place of colours."""
        filters = [one for one in usual if not (self._colourless and isinstance(one, Monochrome))]
        if self._colourless:
            filters.append(self._attribute_filter)
        if self._glyph_filter.enabled:
            filters.append(self._glyph_filter)
        return filters


def next_theme(present: str) -> str:
    """Return the name of the theme that comes after one."""
    names = list(LOOKS)
    return names[(names.index(present) + 1) % len(names)] if present in names else names[0]
