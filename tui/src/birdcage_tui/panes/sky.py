"""The polar sky: where the dish can point, where it points, where it goes, and the geostationary arc."""

from __future__ import annotations

from birdcage.base.geometry import separation, shortest_turn
from birdcage.sky.geostationary import arc, slots_in_sight
from textual import events

from birdcage_tui.canvas import Braille, Cells
from birdcage_tui.pane import Pane
from birdcage_tui.panes.polar import Polar
from birdcage_tui.view import View

QUIET = ("faint", "line", "dim")
"""Dots that a name may cover."""
ON_SLOT_DEG = 0.75
"""A target closer to a slot than this points at it."""
PATH = 120
"""Pieces that the path of a motion is drawn in."""


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
            polar.hatch(canvas, "faint", 0.0, low)
        if high is not None:
            polar.hatch(canvas, "faint", high, 90.0)
        sector = self._sector(view)
        if sector is not None:
            polar.hatch(canvas, "faint", low or 0.0, high or 90.0, *sector)
        for az_deg in (0.0, 90.0, 180.0, 270.0):
            canvas.line(*polar.dot(az_deg, high or 88.0), *polar.dot(az_deg, low or 0.0), "line", every=4)
        for el_deg in (30.0, 60.0):
            if low is None or high is None or low + 8 < el_deg < high - 8:
                polar.ring(canvas, el_deg, "line", 4.0)
        for edge in (low, high):
            if edge is not None:
                polar.ring(canvas, edge, "line")
        polar.ring(canvas, 0.0, "dim")
        place = view.settings.place
        if place is not None:
            points = arc(place.latitude_deg, place.longitude_deg, 1.5)
            canvas.dotted([polar.dot(az_deg, el_deg) for _, az_deg, el_deg in points], "target", 2.6)
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
            if radius >= 3.5:  # a smaller one hides under the dish's own mark
                x, y = polar.dot(position.az_deg, position.el_deg)
                canvas.circle(x - 0.5, y - 0.5, radius, "dim" if view.stale else "accent")
        motion = state.motion
        if motion is None:
            return
        start_az, start_el = motion.from_az_deg, motion.from_el_deg
        turn = shortest_turn(start_az, motion.to_az_deg)
        points = [
            polar.dot(start_az + turn * part / PATH, start_el + (motion.to_el_deg - start_el) * part / PATH)
            for part in range(PATH + 1)
        ]
        gone = round((view.progress or 0.0) * PATH)
        ink = "accent" if view.link_up else "dim"
        canvas.dotted(points[: gone + 1], ink, 3.5)  # past is dotted, future is solid
        canvas.dotted(points[gone:], ink, 1.0)

    @staticmethod
    def _rim(cells: Cells, polar: Polar, view: View) -> None:
        state = view.state
        for az_deg, name in ((0.0, "N"), (90.0, "E"), (180.0, "S"), (270.0, "W")):
            cells.put(*polar.cell(az_deg, 0.0), name, "strong")
        place = view.settings.place
        away_deg = 45.0 if place is None or place.latitude_deg >= 0 else 135.0  # where the arc is not
        for limit in (state.el_min_deg, state.el_max_deg):
            if limit is not None:
                x, y = polar.cell(away_deg, limit)
                cells.put(x, y, f"{limit:.0f}°", "dim")
        position, dish = state.position, state.dish
        if position is not None and position.cable_deg is not None and dish is not None and dish.cable is not None:
            for end in (dish.cable.min_deg, dish.cable.max_deg):
                cells.put(*polar.cell(position.az_deg + end - position.cable_deg, 0.0), "▨", "warn")

    @staticmethod
    def _marks(cells: Cells, polar: Polar, view: View) -> None:
        state, position = view.state, view.state.position
        motion = state.motion
        if motion is not None and view.progress is not None and view.link_up:
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
            cells.put(
                *polar.cell(position.az_deg, position.el_deg), view.pointer, "dim" if view.stale else "accent-strong"
            )
        elif cells.width >= 30:
            words = " where it points is not known "
            cells.put(polar.width // 2 - len(words) // 2, polar.height // 2, words, "dim")

    def _slots(self, cells: Cells, polar: Polar, view: View) -> None:
        place, state = view.settings.place, view.state
        if place is None:
            return
        low, high = state.el_min_deg or 0.0, state.el_max_deg or 90.0
        named = cells.width >= 84
        slots = []
        for slot, az_deg, el_deg in slots_in_sight(place.latitude_deg, place.longitude_deg, low, high):
            x, y = polar.cell(az_deg, el_deg)
            if cells.free(x, y, 1, *QUIET, "target"):
                cells.put(x, y, "•", "target")
            aimed = (
                state.target_az_deg is not None
                and state.target_el_deg is not None
                and separation(az_deg, el_deg, state.target_az_deg, state.target_el_deg) < ON_SLOT_DEG
            )
            names = (f"{slot.label} {slot.name}", slot.label) if named else (slot.label,)
            slots.append((names, x, y, aimed))
        middle = polar.width // 2
        # The slot that is pointed at is named first, then the ends of the arc, which have the most room.
        for names, x, y, aimed in sorted(slots, key=lambda slot: (not slot[3], -abs(slot[1] - middle))):
            self._label(cells, names, x, y, x - middle, "target" if aimed else "dim")

    @staticmethod
    def _label(cells: Cells, names: tuple[str, ...], x: int, y: int, off: int, ink: str) -> None:
        """Write a slot's name where it lies on nothing: outside the arc if possible, else not at all."""
        for name in names:
            length = len(name)
            beside = x + 2 if off >= 0 else x - 1 - length
            below = x - length // 2
            if abs(off) > 8:
                places = [(beside, y), (beside, y + 1), (below, y + 1)]
            else:
                places = [(below, y + 1), (beside, y + 1), (beside, y), (below, y - 1)]
            for start, row in places:
                if cells.free(start - 2, row, length + 4, *QUIET):
                    cells.put(start, row, name, ink)
                    return

    def on_mouse_move(self, event: events.MouseMove) -> None:
        """Read out the direction under the mouse."""
        found = Polar(self.size.width, self.size.height).direction(event.x - 1, event.y - 1)
        self.border_subtitle = "" if found is None else f"AZ {found[0]:.0f}°  EL {found[1]:.0f}°"

    def on_leave(self) -> None:
        """The mouse is elsewhere."""
        self.border_subtitle = ""
