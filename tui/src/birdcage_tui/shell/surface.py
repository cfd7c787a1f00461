"""What the app looks like on this terminal, and how often it is drawn: theme, glyph set, attributes, frames."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import cast

from textual import events
from textual.app import App
from textual.driver import Driver
from textual.filter import LineFilter, Monochrome
from textual.reactive import Reactive
from textual.screen import Screen
from textual.timer import Timer
from textual.widget import Widget

from birdcage_tui.drawing import attributes
from birdcage_tui.drawing.glyphs import GlyphFilter
from birdcage_tui.drawing.terminal_cells import aspect_of
from birdcage_tui.drawing.themes import DEFAULT, LOOKS, ThemeColours
from birdcage_tui.feeds.host import AppHost
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.widgets.pane import Pane


class Ground(Screen[None]):
    """The one screen. A change of focus repaints the two widgets that it concerns, not everything."""

    focused: Reactive[Widget | None] = Reactive(None, repaint=False)

    def on_screen_resume(self) -> None:
        """Draw a frame when a dialog has gone: while one types there, Space is no STOP, and the footer said so."""
        cast(AppHost, self.app).paint()


class Surface(App[None]):
    """The base of the shell: what is drawn is the shell's, when and in which signs and colours is settled here."""

    def __init__(self, settings: AppOptions) -> None:
        super().__init__()
        self.settings = settings
        self._frame_s = 1.0 / settings.update_hz
        """Between two frames while something moves, and between two repaints on change, at least."""
        self._soon: Timer | None = None
        self._painted = 0.0
        for look in LOOKS.values():
            self.register_theme(look.theme())
        self.theme = settings.theme if settings.theme in LOOKS else DEFAULT
        self._glyph_filter = GlyphFilter(settings.glyphs)
        self._attribute_filter = attributes.AttributeFilter(self._look)
        self._colourless = attributes.wanted(os.environ)
        # The ground of a text field cannot be told from that of the page there.
        self.set_class(self._colourless or self.console.color_system in (None, "standard"), "-few-colours")

    def _look(self) -> ThemeColours:
        return LOOKS.get(self.theme, LOOKS[DEFAULT])

    def get_driver_class(self) -> type[Driver]:
        """Return the platform's driver; ours, which bears bad terminals, where that is Textual's for Linux."""
        driver = super().get_driver_class()
        if driver.__name__ != "LinuxDriver":
            return driver
        from birdcage_tui.drawing.terminal import TerminalDriver

        return TerminalDriver

    def get_default_screen(self) -> Screen[None]:
        """Return the screen under everything."""
        return Ground(id="_default")

    def get_line_filters(self) -> Sequence[LineFilter]:
        """Return what finished rows go through: another glyph set, and attributes in place of colours."""
        filters = [one for one in super().get_line_filters() if not (self._colourless and isinstance(one, Monochrome))]
        if self._colourless:
            filters.append(self._attribute_filter)
        if self._glyph_filter.enabled:
            filters.append(self._glyph_filter)
        return filters

    def on_resize(self, event: events.Resize) -> None:
        """Find out the shape of a character: another font has another."""
        told = event.pixel_size
        if told is not None and event.size:
            aspect = aspect_of(told.width / event.size.width, told.height / event.size.height)
            if aspect is not None:
                self.cell_aspect_told(aspect)
        elif (ask := getattr(self._driver, "ask_cell_size", None)) is not None:
            ask()

    def cell_aspect_told(self, aspect: float) -> None:
        """Take what the terminal says of its characters, where no setting says it. Any thread."""
        self.soon(lambda: self._take_aspect(aspect))

    def _take_aspect(self, aspect: float) -> None:
        if not self.settings.cell_aspect_set and aspect != self.settings.cell_aspect:
            self.settings = replace(self.settings, cell_aspect=aspect)
            self.paint()

    def _recolour(self, _: object) -> None:
        for pane in self.screen_stack[0].query(Pane):
            pane.redraw()

    def paint(self) -> None:
        """Draw a frame."""
        raise NotImplementedError

    def _loop_time(self) -> float:
        return self._loop.time() if self._loop is not None else 0.0

    def _changed(self) -> None:
        """Draw: at once when the last frame is a while ago, else as soon as the next may be drawn."""
        wait_s = self._painted + self._frame_s - self._loop_time()
        if self._terminal_lags():
            wait_s = max(wait_s, self._frame_s / 2)
        if wait_s <= 0:
            self.paint()
        elif self._soon is None:
            self._soon = self.set_timer(wait_s, self._paint_soon)

    def _paint_soon(self) -> None:
        self._soon = None
        if self._terminal_lags():
            self._changed()
        else:
            self.paint()

    def _terminal_lags(self) -> bool:
        """Return whether a frame still waits to be written: another one would only stand behind it."""
        return getattr(self._driver, "unwritten", 0) > 0

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread; nothing happens once the app has ended."""
        self.call_later(work)
