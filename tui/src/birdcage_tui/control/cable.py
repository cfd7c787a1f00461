"""The cable-wrap gauge over the full width: stops, whole turns, where the cable stands, where the target brings it."""

from __future__ import annotations

import math

from birdcage.station.known import CableTurn
from birdcage.station.turning import cable_limits

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.goto.reach import turns_to
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.sky_ground import UNKNOWN_SIGN

ROOM_TO_SAY = 78
"""From this width on a gauge without words says where its figure comes from."""
ENDS = 2
"""Hatched cells beyond each stop."""


class CablePane(Pane):
    """Two rows: the gauge, and the numbers under it; a third in words where there is room."""

    framed = False
    """Whether a frame around it names it."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Cable"

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the gauge, hatched while the turn is not known."""
        state, limits = view.state, cable_limits(view.state)
        known = state.position is not None and state.position.cable_deg is not None
        told = "turn from the last session" if self.framed and known and state.turn is CableTurn.REMEMBERED else ""
        if (self.border_subtitle or "") != told:  # setting it repaints, equal or not
            self.border_subtitle = told
        if limits is None:
            none = state.dish is not None and state.dish.cable_known
            words = "This dish's cable has no stop." if none else "Cable turn unknown."
            cells.put(1, 0, words, "dim")
            return
        turn = state.position.cable_deg if state.position is not None else None
        if turn is None:
            self._unknown(cells, limits, view)
            return
        left, right = max(0.0, turn - limits[0]), max(0.0, limits[1] - turn)
        name = "" if self.framed else "cable "  # its frame names it
        if name and state.turn is CableTurn.REMEMBERED and cells.width >= ROOM_TO_SAY:
            name = "cable, remembered "
        head, tail = f"{name}CCW {left:3.0f}° left ", f" CW {right:3.0f}° left"
        start, width = 1 + len(head), cells.width - 2 - len(head) - len(tail)
        if width < 12:
            return
        near = min(left, right) < 20.0
        cells.put(1, 0, head, "warn" if near and left < right else "text")
        cells.right(cells.width - 1, 0, tail, "warn" if near and right <= left else "text")
        scale = _Scale(limits, start + ENDS, width - 2 * ENDS)
        self._track(cells, scale, limits)
        here, ink = scale.column(turn), "dim" if view.stale else "accent-strong"
        turns = () if state.target_az_deg is None else turns_to(state, state.target_az_deg)
        if turns:
            there = scale.column(turns[0])
            low, high = sorted((here, there))
            cells.put(low, 0, "━" * (high - low + 1), "accent")
            if there != here:
                cells.put(there, 0, "✕", "target-strong")
        cells.put(here, 0, view.pointer, ink)
        if cells.height > 2:
            self._words(cells, view, turn, turns[0] if turns else None, limits)

    @staticmethod
    def _track(cells: Cells, scale: _Scale, limits: tuple[float, float]) -> None:
        """Draw the track between its hatched ends, with a mark at each whole turn and a number under each."""
        cells.put(scale.start - ENDS, 0, "▨" * ENDS, "warn")
        cells.put(scale.start, 0, "─" * scale.width, "line")
        cells.put(scale.start + scale.width, 0, "▨" * ENDS, "warn")
        marks = [*limits, *(360.0 * k for k in range(math.ceil(limits[0] / 360), math.floor(limits[1] / 360) + 1))]
        step = 90.0 if scale.width >= 60 else 180.0
        for k in range(math.ceil(limits[0] / step), math.floor(limits[1] / step) + 1):
            cells.put(scale.column(k * step), 0, "┴", "line")
        for mark in marks:
            column = scale.column(mark)
            text = f"{mark:+.0f}°" if mark else "0"
            if mark not in limits:
                cells.put(column, 0, "┼", "text")
            at = min(max(column - len(text) // 2, 1), cells.width - 1 - len(text))
            if cells.free(at - 1, 1, len(text) + 2):
                cells.put(at, 1, text, "dim")

    def _unknown(self, cells: Cells, limits: tuple[float, float], view: View) -> None:
        """Hatch the whole track: the stops are known, where the cable stands between them is not."""
        waiting = view.waiting or not view.link_up
        by_itself = view.state.dish is not None and view.state.dish.homing_s is None
        how = "this dish doesn't report it" if by_itself else "H homes the dish and finds it"
        words = "turn unknown" if waiting else f"turn unknown: {how}"
        ink = "dim" if view.waiting or by_itself else "warn"
        start = 1 if self.framed else 7
        if not self.framed:
            cells.put(1, 0, "cable", "dim")
        cells.put(start, 0, "▕" + UNKNOWN_SIGN * max(cells.width - start - 3, 0) + "▏", "line")
        low, high = (f"{limit:+.0f}°" if limit else "0°" for limit in limits)
        cells.put(start, 1, low, "dim")
        cells.right(cells.width - 1, 1, high, "dim")
        room = cells.width - start - len(low) - len(high) - 3
        if cells.height > 2:
            cells.put(1, 2, words, ink)
        elif len(words) <= room:
            cells.put(start + len(low) + 2, 1, words, ink)

    @staticmethod
    def _words(cells: Cells, view: View, turn: float, there: float | None, limits: tuple[float, float]) -> None:
        """Say where it stands, and what the target would leave."""
        x = cells.put(1, 2, f"{turn:+.1f}° from home", "dim")
        if there is not None and abs(there - turn) >= 0.05:
            left = f"CCW {there - limits[0]:.0f}°, CW {limits[1] - there:.0f}° left"
            cells.put(x, 2, f"   at the target {there:+.1f}°: {left}", "target")
        elif view.state.target_az_deg is not None and there is None:
            cells.put(x, 2, "   target is beyond the cable stops", "warn")


class _Scale:
    """Where a turn stands on the track."""

    def __init__(self, limits: tuple[float, float], start: int, width: int) -> None:
        self._limits, self.start, self.width = limits, start, max(width, 1)

    def column(self, turn_deg: float) -> int:
        """Return the cell of a turn, on the track."""
        low, high = self._limits
        part = (turn_deg - low) / (high - low) if high > low else 0.5
        return self.start + min(self.width - 1, max(0, round(part * (self.width - 1))))
