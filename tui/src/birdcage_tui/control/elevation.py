"""The elevation seen from the side: a quarter circle with floor and ceiling, the needle, and a scale with tenths."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import cast

from textual import events

from birdcage_tui.control.tape import ROWS, draw_tape
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.needle import draw_needle
from birdcage_tui.drawing.terminal_cells import ASPECT
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.pursuit import aimed_at
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

UNDER_DEG = 3.0
"""A target nearer than this lies under the needle: its ray would only break it."""
WORDS, ROOM = 2, 12
"""Rows that the limits in words take over the quarter; from how many rows on they are written."""
WITH_HORIZON = 3
"""The same rows with the horizon among them."""
QUIET = ("faint", "line", "dim")


@dataclass(frozen=True, slots=True)
class Quarter:
    """A quarter circle with its hub at the lower left, in dots on `width` by `height` cells."""

    width: int
    height: int
    words: int = WORDS
    aspect: float = ASPECT
    """Height over width of a cell."""

    @property
    def dot_aspect(self) -> float:
        """Height over width of a dot: a cell is 2 dots wide and 4 tall."""
        return self.aspect / 2.0

    @property
    def radius(self) -> float:
        """Widths of a dot from the hub to the arc."""
        over = self.words * 4 if self.height >= ROOM else 0
        return max(4.0, min(self.width * 2 - 10, (self.height * 4 - 8 - over) * self.dot_aspect))

    @property
    def hub(self) -> tuple[float, float]:
        """The hub: the arc stands in the middle of what the words over it leave."""
        left = max(2.0, (self.width * 2 - 8 - self.radius) / 2)
        row = min(self.height - 1, math.floor((self.height * 4 + self.radius / self.dot_aspect) / 8 + self.words / 2))
        return left, row * 4 + 1.5  # the middle of a row, where its sign stands

    def dot(self, el_deg: float, part: float = 1.0) -> tuple[float, float]:
        """Return the dot at an elevation, at a part of the radius."""
        x, y = self.hub
        el = math.radians(el_deg)
        return x + self.radius * part * math.cos(el), y - self.radius * part * math.sin(el) / self.dot_aspect

    def cell(self, el_deg: float, part: float = 1.0) -> tuple[int, int]:
        """Return the cell of that dot."""
        x, y = self.dot(el_deg, part)
        return math.floor(x / 2), math.floor(y / 4)

    def direction(self, column: int, row: int) -> float | None:
        """Return the elevation of a cell; None outside the quarter."""
        x0, y0 = self.hub
        dx, dy = column * 2 + 1 - x0, (y0 - row * 4 - 2) * self.dot_aspect
        el_deg = math.degrees(math.atan2(dy, dx))
        reach = math.hypot(dx, dy)
        return el_deg if 3 <= reach <= self.radius + 8 and -2.0 <= el_deg <= 92.0 else None

    def hatch(self, canvas: Braille, low_deg: float, high_deg: float) -> None:
        """Fill the part between two elevations with thin diagonals."""
        x0, y0 = self.hub
        for row in range(math.ceil(self.radius / self.dot_aspect) + 1):
            up = row * self.dot_aspect
            for across in range(math.ceil(self.radius) + 1):
                if (across - row) % 5 or not 0.25 <= math.hypot(across, up) / self.radius <= 0.98:
                    continue
                if low_deg <= math.degrees(math.atan2(up, across)) <= high_deg:
                    canvas.dot(x0 + across, y0 - row, "line")


def horizon_deg(view: View) -> float | None:
    """Return how high trees and roofs stand where the dish looks; None if that is not known."""
    position = view.state.position
    return None if position is None or not view.horizon.mask.is_line else view.horizon.mask.at(position.az_deg)


class ElevationPane(Pane):
    """The quarter circle over its scale."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Elevation"
        self._static: tuple[object, Braille] | None = None

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the quarter, what limits it, the needle and the target."""
        quarter, state = self._quarter(cells.width, cells.height, view), view.state
        aimed = aimed_at(view)
        position, target = state.position, None if aimed is None else aimed[1]
        canvas = self._ground(quarter, view).copy()
        self._horizon(canvas, quarter, view)
        if view.aim is not None:
            canvas.line(*quarter.dot(view.aim[1], 0.3), *quarter.dot(view.aim[1], 0.93), "text", 5)
        if target is not None and (position is None or abs(target - position.el_deg) > UNDER_DEG):
            canvas.line(*quarter.dot(target, 0.3), *quarter.dot(target, 0.93), "target", 3)
        if position is not None:
            ink = "dim" if view.stale else "accent"
            if state.el_offset_deg:
                canvas.line(*quarter.dot(position.dish_el_deg, 0.1), *quarter.dot(position.dish_el_deg, 0.7), "dim", 2)
            draw_needle(canvas, *quarter.hub, 90.0 - position.el_deg, quarter.radius * 0.88, 0.0, ink,
                        hollow=position.modelled, dot_aspect=quarter.dot_aspect)  # fmt: skip
        canvas.onto(cells, 0, 0)
        self._limits(cells, quarter, view)
        self._labels(cells, quarter, view)
        if state.motion is not None and state.motion.to_skew_deg is None and view.link_up:
            cells.put(*quarter.cell(state.motion.to_el_deg, 0.9), "+", "accent-strong")
        if target is not None:
            cells.put(*quarter.cell(target), "✕", "target-strong")
        if view.aim is not None and -5.0 <= view.aim[1] <= 95.0:
            cells.put(*quarter.cell(view.aim[1]), "×", "strong")
        if position is not None:
            cells.put(*quarter.cell(0.0, 0.0), view.pointer, "dim" if view.stale else "accent-strong")
        draw_tape(
            cells, cells.height - ROWS, None if position is None else position.el_deg,
            ink="dim" if view.stale else "accent-strong", target_deg=target,
        )  # fmt: skip

    @staticmethod
    def _quarter(width: int, height: int, view: View) -> Quarter:
        return Quarter(width, max(height - ROWS, 1), WITH_HORIZON if view.horizon.mask.is_line else WORDS,
                       view.settings.cell_aspect)  # fmt: skip

    @staticmethod
    def _horizon(canvas: Braille, quarter: Quarter, view: View) -> None:
        """Draw how high trees and roofs stand where the dish looks: outside the arc, for they limit no motion."""
        el_deg = horizon_deg(view)
        if el_deg is None or el_deg <= 0.0:
            return
        outside = (1 + 2.5 / quarter.radius, 1 + 4.5 / quarter.radius)
        count = max(2, round(quarter.radius * math.radians(el_deg)))
        for step in range(count + 1):
            angle = el_deg * step / count
            canvas.line(*quarter.dot(angle, outside[0]), *quarter.dot(angle, outside[1]), "text", 2)
        canvas.line(*quarter.dot(el_deg, 0.75), *quarter.dot(el_deg, outside[1]), "text", 2)

    def _ground(self, quarter: Quarter, view: View) -> Braille:
        """Return the layer that changes only with size and limits."""
        low, high = view.state.el_min_deg, view.state.el_max_deg
        key = (quarter, low, high)
        if self._static is not None and self._static[0] == key:
            return self._static[1]
        canvas = Braille(quarter.width, quarter.height)
        if low is not None and low > 0:
            quarter.hatch(canvas, 0.0, low)
        if high is not None and high < 90:
            quarter.hatch(canvas, high, 90.0)
        count = round(quarter.radius * 1.6)
        canvas.dotted([quarter.dot(90 * step / count) for step in range(count + 1)], "dim", 1.0)
        canvas.line(*quarter.dot(0.0, 0.0), *quarter.dot(0.0, 1.0), "line")
        for el_deg in range(0, 91, 10):
            length = 5.0 if el_deg % 30 == 0 else 3.0
            canvas.line(*quarter.dot(el_deg), *quarter.dot(el_deg, 1 - length / quarter.radius), "dim")
        for limit in (low, high):
            if limit is not None:
                canvas.line(*quarter.dot(limit, 0.25), *quarter.dot(limit, 1.0), "warn", 2)
        self._static = (key, canvas)
        return canvas

    @staticmethod
    def _labels(cells: Cells, quarter: Quarter, view: View) -> None:
        state = view.state
        for limit in (state.el_min_deg, state.el_max_deg):
            if limit is not None:
                x, y = quarter.cell(limit, 1 + 4 / quarter.radius)
                cells.put(min(x + 1, cells.width - 3), y, f"{limit:.0f}°", "warn")
        if quarter.radius >= 24:
            limits = [limit for limit in (state.el_min_deg, state.el_max_deg) if limit is not None]
            for el_deg in (0, 30, 60, 90):
                if any(abs(limit - el_deg) < 5.0 for limit in limits):
                    continue
                x, y = quarter.cell(el_deg, 1 + 4 / quarter.radius)
                text = f"{el_deg}"
                x = min(x + 1, cells.width - len(text)) if el_deg < 90 else max(x - 1, 0)
                left, right = max(x - 1, 0), min(x + len(text) + 2, cells.width)
                if cells.free(left, y, right - left, *QUIET):
                    cells.put(x, y, text, "dim")

    @staticmethod
    def _limits(cells: Cells, quarter: Quarter, view: View) -> None:
        """Say how far it is to ceiling, floor and horizon, where there is room over the quarter."""
        state, position = view.state, view.state.position
        if quarter.height < ROOM:
            return
        rows = [("ceiling", state.el_max_deg), ("floor", state.el_min_deg)]
        if view.horizon.mask.is_line:
            rows.append(("horizon", horizon_deg(view)))
        for y, (name, limit) in enumerate(rows):
            words = f"{name:<8}" + (" --.-" if limit is None else f"{limit:5.1f}°")
            if limit is not None and position is not None and cells.width >= 23:
                words += f" {abs(limit - position.el_deg):4.1f}° off"
            cells.put(max((cells.width - len(words)) // 2, 0), y, words, "dim")

    def on_click(self, event: events.Click) -> None:
        """Open the go-to line with the elevation under the mouse; Enter is still to be pressed."""
        offset = event.get_content_offset(self)
        if self.view is None:
            return
        quarter = self._quarter(self.size.width, self.size.height, self.view)
        el_deg = None if offset is None else quarter.direction(offset.x, offset.y)
        if el_deg is not None:
            event.stop()
            cast(AppHost, self.app).open_goto(f"el={el_deg:.0f}")
