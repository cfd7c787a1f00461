"""Draws the horizon: with the mouse along the tree line, or with the arrows."""

from __future__ import annotations

from typing import cast

from birdcage.sky.horizon import HorizonMask
from textual import events
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.widgets import Static

from birdcage_tui.control.sketch import TOP_DEG, Sketch
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.status import TopRow

SCALE = 4
"""Columns at the left for the degrees."""
STEP_DEG = 1.0
PARTS = " ▁▂▃▄▅▆▇█"
WORDS = (
    "Draw the tree line with the mouse. Or ← → select an azimuth, ↑ ↓ raise and lower the line, Home sets it to 0°. "
    "Drawing moves nothing."
)


class SketchPane(Pane, can_focus=True):
    """Azimuth across, elevation up, from north round to north."""

    HELP = "Drag to draw. ← → select an azimuth, ↑ ↓ change its height by a degree. Enter saves."

    def __init__(self, mask: HorizonMask) -> None:
        super().__init__(id="sketch")
        self._mask = mask
        self.sketch = Sketch(mask, 72)
        self.cursor = 0
        self._pen: tuple[int, float] | None = None

    def on_resize(self) -> None:
        """Take as many columns as there is room for, while nothing is drawn yet."""
        if not self.sketch.drawn:
            self.sketch = Sketch(self._mask, self.size.width - SCALE)
            self.cursor = min(self.cursor, self.sketch.columns - 1)
        super().on_resize()

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the line as a filled ground, the scale, and the cursor with its figures."""
        rows = cells.height - 2
        sketch = self.sketch
        for el_deg in range(0, int(TOP_DEG), 15):
            y = rows - 1 - round(el_deg / TOP_DEG * rows)
            cells.right(SCALE - 1, max(y, 0), f"{el_deg}°", "dim")
            cells.put(SCALE, y, "·" * sketch.columns, "line")
        for column, height in enumerate(sketch.heights):
            ink = "target" if column in sketch.drawn else "dim"
            filled = min(height / TOP_DEG, 1.0) * rows
            for row in range(rows):
                part = min(max(filled - row, 0.0), 1.0)
                if part > 1 / 16:
                    cells.put(SCALE + column, rows - 1 - row, PARTS[round(part * 8)], ink)
        names = {sketch.columns * quarter // 4: name for quarter, name in enumerate("NESW")}
        names[sketch.columns - 1] = "N"
        for column, name in names.items():
            cells.put(SCALE + column, rows, name, "strong")
        position = view.state.position
        if position is not None:
            cells.put(SCALE + int(position.az_deg / 360.0 * sketch.columns), rows, view.pointer, "accent-strong")
        # On a name the cursor is its ground: the axis keeps its letters.
        here = names.get(self.cursor, "▲")
        cells.put(SCALE + self.cursor, rows, here, "text" if here == "▲" else "accent-row")
        words = f"{sketch.azimuth(self.cursor):.0f}°  {sketch.heights[self.cursor]:.1f}° high"
        cells.put(SCALE, rows + 1, words, "text")
        cells.right(cells.width, rows + 1, f"{len(sketch.mask().points)} points", "dim")

    def _point(self, event: events.MouseEvent) -> tuple[int, float]:
        """Return the column and height under the mouse; beyond an edge what stands at that edge."""
        offset = event.get_content_offset_capture(self)
        rows = self.size.height - 2
        column = min(max(offset.x - SCALE, 0), self.sketch.columns - 1)
        return column, (rows - offset.y - 0.5) / rows * TOP_DEG

    def on_mouse_down(self, event: events.MouseDown) -> None:
        """Set the pen down."""
        event.stop()
        self.capture_mouse()
        self._pen = self._point(event)
        self._draw_to(self._pen)

    def on_mouse_move(self, event: events.MouseMove) -> None:
        """Draw on, while the button is held."""
        if self._pen is not None:
            event.stop()
            self._draw_to(self._point(event))

    def on_mouse_up(self, event: events.MouseUp) -> None:
        """Lift the pen."""
        if self._pen is not None:
            event.stop()
            self._pen = None
            self.release_mouse()

    def _draw_to(self, point: tuple[int, float]) -> None:
        self.sketch.line(self._pen or point, point)
        self._pen, self.cursor = point, point[0]
        self.redraw()

    def on_key(self, event: events.Key) -> None:
        """Draw by hand."""
        here = self.sketch.heights[self.cursor]
        match event.key:
            case "left" | "right":
                self.cursor = (self.cursor + (1 if event.key == "right" else -1)) % self.sketch.columns
            case "up" | "down":
                self.sketch.put(self.cursor, round(here + (STEP_DEG if event.key == "up" else -STEP_DEG)))
            case "home":
                self.sketch.put(self.cursor, 0.0)
            case _:
                return
        event.stop()
        self.redraw()


class SketchScreen(Dialog[HorizonMask | None]):
    """Enter keeps what was drawn; q, and at rest Esc, does not."""

    DEFAULT_CSS = """
    SketchScreen > Vertical { width: 96%; max-width: 200; height: 1fr; margin: 0 0 1 0; }
    SketchScreen SketchPane { height: 1fr; }
    SketchScreen Static { height: auto; color: $dim; }
    """
    KEYS, OTHER = "Enter saves", "q closes"
    BINDINGS = [("enter", "keep", "keep"), ("escape,q", "leave", "close")]  # noqa: RUF012

    def __init__(self, mask: HorizonMask) -> None:
        super().__init__()
        self._mask = mask

    def compose(self) -> ComposeResult:
        """The words and the picture."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = "Draw the horizon"
            yield Static(WORDS, markup=False)
            yield SketchPane(self._mask)

    def on_mount(self) -> None:
        """Draw, and let the arrows go to the picture."""
        pane = self.query_one(SketchPane)
        self.set_focus(pane)
        super().on_mount()
        self.call_after_refresh(lambda: pane.show(cast(AppHost, self.app).view()))

    def action_keep(self) -> None:
        """Close with what was drawn."""
        self.dismiss(self.query_one(SketchPane).sketch.mask())
