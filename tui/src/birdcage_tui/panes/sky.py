"""The polar sky: where the dish can point, where it points, where it goes, and the geostationary arc."""

from __future__ import annotations

import math

from birdcage.base.geometry import shortest_turn
from birdcage.sky.geostationary import arc, slots_in_sight
from textual import events

from birdcage_tui.canvas import Braille, Cells
from birdcage_tui.pane import Pane
from birdcage_tui.panes.polar import Polar
from birdcage_tui.view import View


class SkyPane(Pane):
    """A map of the sky, N up and E right (looking up, east would be left)."""

    TITLE = "Sky  N up, E right  ▨ cannot reach"

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = self.TITLE
        self._static: tuple[object, Braille] | None = None

    def draw(self, cells: Cells, view: View) -> None:
        """Draw grid and limits (kept between frames), then what changes."""
        polar = Polar(cells.width, cells.height)
        if polar.width < 10 or polar.height < 5:
            return
        canvas = self._ground(polar, view).copy()
        self._path(canvas, polar, view)
        canvas.onto(cells, 0, 0)
        self._rim(cells, polar, view)
        self._marks(cells, polar, view)
        self._slots(cells, polar, view)

    def _ground(self, polar: Polar, view: View) -> Braille:
        """Return the layer that changes only with size, limits and place."""
        state = view.state
        key = (polar, state.el_min_deg, state.el_max_deg, self._sector(view), view.settings.place)
        if self._static is not None and self._static[0] == key:
            return self._static[1]
        canvas = Braille(polar.width, polar.height)
        low, high = state.el_min_deg, state.el_max_deg
        if low is not None:
            polar.hatch(canvas, "line", 0.0, low)
        if high is not None:
            polar.hatch(canvas, "line", high, 90.0)
        sector = self._sector(view)
        if sector is not None:
            polar.hatch(canvas, "line", low or 0.0, high or 90.0, *sector)
        for az_deg in (0.0, 90.0, 180.0, 270.0):
            canvas.line(*polar.dot(az_deg, high or 88.0), *polar.dot(az_deg, low or 0.0), "line", every=4)
        for el_deg in (30.0, 60.0):
            if low is None or high is None or low + 4 < el_deg < high - 4:
                polar.ring(canvas, el_deg, "line", 4.0)
        for edge in (low, high):
            if edge is not None:
                polar.ring(canvas, edge, "dim", 2.2)
        polar.ring(canvas, 0.0, "dim", 0.7)
        place = view.settings.place
        if place is not None:
            for _, az_deg, el_deg in arc(place.latitude_deg, place.longitude_deg, 1.5):
                canvas.dot(*polar.dot(az_deg, el_deg), "target")
        self._static = (key, canvas)
        return canvas

    @staticmethod
    def _sector(view: View) -> tuple[float, float] | None:
        """Return azimuth and width of what the cable keeps out of reach on any turn; None when it is nothing."""
        state = view.state
        if state.dish is None or state.dish.cable is None or state.turn.value == "unknown":
            return None
        span = state.dish.cable.max_deg - state.dish.cable.min_deg
        if span >= 360:
            return None
        return round((state.dish.cable.max_deg + state.az_offset_deg) % 360, 1), round(360 - span, 1)

    @staticmethod
    def _path(canvas: Braille, polar: Polar, view: View) -> None:
        state, position = view.state, view.state.position
        if position is not None and state.beam_deg is not None:
            radius = polar.radius * state.beam_deg / 180
            if radius >= 1.5:
                x, y = polar.dot(position.az_deg, position.el_deg)
                canvas.circle(x - 0.5, y - 0.5, radius, "accent", 1.0)
        motion = state.motion
        if motion is None:
            return
        start_az, start_el = motion.from_az_deg, motion.from_el_deg
        turn = shortest_turn(start_az, motion.to_az_deg)
        steps = max(2, math.ceil(max(abs(turn), abs(motion.to_el_deg - start_el)) * polar.radius / 60))
        progress = view.progress or 0.0
        for step in range(steps + 1):
            part = step / steps
            if part < progress and step % 3:
                continue  # past is dotted, future is solid
            canvas.dot(*polar.dot(start_az + turn * part, start_el + (motion.to_el_deg - start_el) * part), "accent")

    @staticmethod
    def _rim(cells: Cells, polar: Polar, view: View) -> None:
        state = view.state
        for az_deg, name in ((0.0, "N"), (90.0, "E"), (180.0, "S"), (270.0, "W")):
            cells.put(*polar.cell(az_deg, 0.0), name, "strong")
        for limit, az_deg in ((state.el_min_deg, 135.0), (state.el_max_deg, 135.0)):
            if limit is not None:
                x, y = polar.cell(az_deg, limit)
                cells.put(x, y, f"{limit:.0f}°", "dim")
        position, dish = state.position, state.dish
        if position is not None and position.cable_deg is not None and dish is not None and dish.cable is not None:
            for end in (dish.cable.min_deg, dish.cable.max_deg):
                cells.put(*polar.cell(position.az_deg + end - position.cable_deg, 0.0), "▨", "warn")

    @staticmethod
    def _marks(cells: Cells, polar: Polar, view: View) -> None:
        state, position = view.state, view.state.position
        motion = state.motion
        if motion is not None and view.progress is not None:
            turn = shortest_turn(motion.from_az_deg, motion.to_az_deg) * view.progress
            el_deg = motion.from_el_deg + (motion.to_el_deg - motion.from_el_deg) * view.progress
            cells.put(*polar.cell(motion.from_az_deg + turn, el_deg), "◌", "accent")
            cells.put(*polar.cell(motion.to_az_deg, motion.to_el_deg), "+", "accent-strong")
        if state.target_az_deg is not None and state.target_el_deg is not None:
            ink = "target-strong"
            x, y = polar.cell(state.target_az_deg, state.target_el_deg)
            at_rest = position is not None and polar.cell(position.az_deg, position.el_deg) == (x, y)
            cells.put(x + 1 if at_rest else x, y, "✕", ink)
        if position is not None:
            cells.put(*polar.cell(position.az_deg, position.el_deg), "◉", "dim" if view.stale else "accent-strong")
        elif cells.width >= 30:
            words = " where it points is not known "
            cells.put(polar.width // 2 - len(words) // 2, polar.height // 2, words, "dim")

    @staticmethod
    def _slots(cells: Cells, polar: Polar, view: View) -> None:
        place, state = view.settings.place, view.state
        if place is None:
            return
        low, high = state.el_min_deg or 0.0, state.el_max_deg or 90.0
        named = cells.width >= 84
        for slot, az_deg, el_deg in slots_in_sight(place.latitude_deg, place.longitude_deg, low, high):
            x, y = polar.cell(az_deg, el_deg)
            if not cells.free(x, y, 1):
                continue
            cells.put(x, y, "•", "target")
            label = f"{slot.label} {slot.name}" if named else slot.label
            # Names stand on the outer side of the arc, where the plot is emptiest.
            start = x + 2 if az_deg <= 180 else x - 1 - len(label)
            for row in (y + 1, y):
                if cells.free(start - 1, row, len(label) + 2):
                    cells.put(start, row, label, "dim")
                    break

    def on_mouse_move(self, event: events.MouseMove) -> None:
        """Read out the direction under the mouse."""
        found = Polar(self.size.width, self.size.height).direction(event.x - 1, event.y - 1)
        self.border_subtitle = "" if found is None else f"AZ {found[0]:.0f}°  EL {found[1]:.0f}°"

    def on_leave(self) -> None:
        """The mouse is elsewhere."""
        self.border_subtitle = ""
