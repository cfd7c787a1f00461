"""The target's digits, each of which steps up and down: with the cursor, or with the mouse above and below it."""

from __future__ import annotations

from typing import cast

from birdcage.station.requests import Jog
from textual import events

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.digits import angle_text
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.pursuit import aimed_at
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.pane import Pane

STEPS = ((10.0, 0.0), (1.0, 0.0), (0.1, 0.0), (0.01, 0.0), (0.0, 10.0), (0.0, 1.0), (0.0, 0.1), (0.0, 0.01))
"""What one step of each digit is, from the left: azimuth, then elevation. Hundreds follow by carrying: no single key
moves the dish further than the largest jog step."""
AT = (1, 2, 4, 5, 0, 1, 3, 4)
"""Where each digit stands in its own number."""
FIRST = 1
"""The cursor begins on whole degrees of azimuth."""


class DigitsPane(Pane, can_focus=True):
    """Three rows: up, the digits, down."""

    HELP = (
        "Left and right select a digit of the target, up and down step it. "
        "Each step is a jog of that size. All limits apply. "
        "At rest, Esc goes back to the rose."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.cursor = FIRST
        self._columns: tuple[int, ...] = ()

    @property
    def scope(self) -> str:
        """What its commands have in `where`."""
        return "digits"

    def draw(self, cells: Cells, view: View) -> None:
        """Write the target, or while there is none the position; the cursor's digit is reversed while it has focus."""
        aimed, position = aimed_at(view), view.state.position
        here = None if position is None else (position.az_deg, position.el_deg)
        az, el = aimed or here or (None, None)
        wide = cells.width >= 36
        left, x_az, x_el = (1, 12, 25) if wide else (0, 7, 17)
        cells.put(left, 1, "target" if aimed else "now", "target" if aimed else "dim")
        numbers = (("---.--" if az is None else angle_text(az, 3)), ("--.--" if el is None else angle_text(el, 2)))
        for x, name, number in zip((x_az, x_el), ("az", "el"), numbers, strict=True):
            if wide:
                cells.put(x - 3, 1, name, "dim")
            cells.put(cells.put(x, 1, number, "strong"), 1, "°", "dim")
        self._columns = tuple((x_az if index < 4 else x_el) + at for index, at in enumerate(AT))
        for index, x in enumerate(self._columns):
            marked = index == self.cursor and self.has_focus
            cells.put(x, 0, "▲", "accent-strong" if marked else "dim")
            cells.put(x, 2, "▼", "accent-strong" if marked else "dim")
            if marked:
                cells.put(x, 1, numbers[index // 4][AT[index]], "accent-row")

    def do(self, command: str) -> bool:
        """Move the cursor, or step its digit."""
        match command:
            case "digit-left" | "digit-right":
                by = 1 if command == "digit-right" else -1
                self.cursor = min(max(self.cursor + by, 0), len(STEPS) - 1)
                self._again()
            case "digit-up":
                self.nudge(self.cursor, 1.0)
            case "digit-down":
                self.nudge(self.cursor, -1.0)
            case _:
                return False
        return True

    def nudge(self, digit: int, by: float) -> None:
        """Step a digit: a jog of its size, which carries."""
        d_az, d_el = STEPS[digit]
        cast(AppHost, self.app).ask(Jog(by * d_az, by * d_el, YOU))

    def _again(self) -> None:
        if self.view is not None:
            self.show(self.view)

    def on_focus(self) -> None:
        """Show the cursor, once Textual has taken the focus in."""
        self.call_later(self._again)

    def on_blur(self) -> None:
        """Hide the cursor."""
        self.call_later(self._again)

    def on_key(self, event: events.Key) -> None:
        """Esc goes back to the rose (the app has stopped the dish first, if it could move)."""
        if event.key == "escape":
            event.stop()
            self.screen.set_focus(self.screen.query_one("#rose"))

    def on_click(self, event: events.Click) -> None:
        """Choose the digit in that column; above or below it, step it too."""
        offset = event.get_content_offset(self)
        if offset is None or offset.x not in self._columns:
            return
        event.stop()
        self.cursor = self._columns.index(offset.x)
        self._again()
        if offset.y in (0, 2):
            cast(AppHost, self.app).action_command("digit-up" if offset.y == 0 else "digit-down")
