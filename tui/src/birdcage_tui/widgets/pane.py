"""The base of everything that is drawn: a widget that repaints only the rows that changed."""

from __future__ import annotations

from rich.style import Style
from textual import events
from textual.geometry import Region
from textual.screen import Screen
from textual.strip import Strip
from textual.widget import Widget

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.themes import DEFAULT, LOOKS
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.messages import CommandChosen


class Pane(Widget):
    """Draws a `View` into cells. Textual sends identical cells again, so rows are compared first."""

    INK = "text"
    """The ink of cells that nothing is written in."""

    def __init__(self, *, id: str | None = None, classes: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id, classes=classes)
        self._cells: Cells | None = None
        self._strips: list[Strip] = []
        self.view: View | None = None
        self.hot: list[tuple[Region, str]] = []
        """Where a click gives which command; filled by `draw`."""
        self._screen: Screen[object] | None = None

    @property
    def screen(self) -> Screen[object]:
        """The screen that it is on: it stays there. Textual climbs up to it several times a frame."""
        if self._screen is None:
            self._screen = super().screen
        return self._screen

    @property
    def inks(self) -> dict[str, Style]:
        """The styles of the theme in force."""
        return LOOKS.get(self.app.theme, LOOKS[DEFAULT]).inks

    def draw(self, cells: Cells, view: View) -> None:
        """Draw into `cells`, which are as large as the widget's content."""
        raise NotImplementedError

    def button(self, cells: Cells, x: int, y: int, command: str, view: View, text: str = "") -> int:
        """Write a command as its key and a word on one ground, clickable; dim while it is refused.

        Return the column in which the next one may begin.
        """
        known = BY_NAME[command]
        dim = known.refused(view) is not None
        start = x
        x = cells.put(x, y, f" {known.shown} ", "bar-dim" if dim else "key")
        x = cells.put(x, y, f"{text or known.title} ", "bar-dim" if dim else "bar")
        self.heat(start, y, x - start, command)
        return x + 1

    def run_of(self, ink: str, x: int, y: int) -> int:
        """Return how many cells from this one on are drawn in that ink."""
        return 0 if self._cells is None else self._cells.run_of(ink, x, y)

    def heat(self, x: int, y: int, width: int, command: str) -> None:
        """Let a click on these cells give a command."""
        self.hot.append((Region(x, y, width, 1), command))

    def on_click(self, event: events.Click) -> None:
        """Do what stands under the mouse."""
        offset = event.get_content_offset(self)
        if offset is None:
            return
        for region, command in self.hot:
            if region.contains_point(offset):
                event.stop()
                self.post_message(CommandChosen(command))
                return

    def show(self, view: View) -> None:
        """Draw `view`, and repaint the rows in which it differs from what stands there."""
        self.view, size = view, self.size  # which Textual works out anew each time
        if not size or not self.is_attached:
            return
        cells = Cells(size.width, size.height, self.INK, view.settings.glyphs)
        self.hot = []
        self.draw(cells, view)
        before, self._cells = self._cells, cells
        if before is None or before.width != cells.width or before.height != cells.height:
            changed = list(range(cells.height))
            self._strips = [Strip([])] * cells.height
        else:
            changed = cells.rows_unlike(before)
        inks = self.inks
        for y in changed:
            self._strips[y] = cells.strip(y, inks)
        if changed:
            self.refresh(*(Region(0, y, cells.width, 1) for y in changed))

    def redraw(self) -> None:
        """Draw the last view again: the size or the theme is another."""
        self._cells = None
        if self.view is not None:
            self.show(self.view)
        self.refresh()

    def on_resize(self) -> None:
        """Draw at the new size; a pane that is only shown again has been drawn already."""
        if self._cells is None or (self._cells.width, self._cells.height) != (self.size.width, self.size.height):
            self.redraw()

    def render_line(self, y: int) -> Strip:
        """Return row `y` as drawn."""
        if y < len(self._strips):
            return self._strips[y]
        return Strip.blank(self.size.width, self.inks[self.INK])
