"""The polar sky: where the dish can point, where it points, where it goes; the geostationary arc and what is up."""

from __future__ import annotations

from birdcage.base.geometry import separation
from birdcage.sky.geostationary import slots_in_sight
from textual import events

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.polar import Polar
from birdcage_tui.panes.sky_up import OLD_SIGN, draw_trails, draw_up
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.track_words import plain_name
from birdcage_tui.shown.view import View
from birdcage_tui.track.path import Points
from birdcage_tui.track.plot import draw_pursuit, draw_times
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.sky_ground import (
    QUIET,
    SkyBackdrop,
    has_stops,
    label,
    name_target,
    rim,
    sky_titles,
    title_for,
)

ON_SLOT_DEG = 0.75
"""A target closer to a slot than this points at it."""
TITLES = sky_titles("Sky")
OLD = (f"{OLD_SIGN} place uncertain: old elements", f"{OLD_SIGN} old elements")
"""The legend of what is not to be believed, from all of it to the least."""
PATH = 120
"""Pieces that the path of a motion is drawn in."""


class SkyPane(Pane):
    """A map of the sky, N up and E right (looking up, east would be left)."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = TITLES[0]
        self._ground = SkyBackdrop()
        self._points = Points()
        self._legend = ""
        self._pointed = False
        """Whether the mouse is over the map."""
        self._named: dict[tuple[int, int], str] = {}
        """What stands in which cell: read out under the mouse."""

    def draw(self, cells: Cells, view: View) -> None:
        """Draw grid and limits (kept between frames), then what changes."""
        polar = Polar(cells.width, cells.height, view.settings.cell_aspect)
        if polar.width < 10 or polar.height < 5:
            return
        title = title_for(TITLES, cells.width, stops=has_stops(view))
        if title != self.border_title:  # setting it repaints, equal or not
            self.border_title = title
        canvas = self._ground.draw(polar, view)
        draw_trails(canvas, polar, view)
        pursued = pursuit_of(view.state) is not None
        if pursued:
            draw_pursuit(canvas, polar, view, self._points)
        self._path(canvas, polar, view)
        canvas.onto(cells, 0, 0)
        rim(cells, polar, view)
        self._marks(cells, polar, view)
        target = self._target(cells, polar, view)
        if pursued:
            draw_times(cells, polar, view, self._points)
        self._slots(cells, polar, view)
        self._named = draw_up(cells, polar, view, target)
        self._tell_old(cells.width, view)

    def _tell_old(self, width: int, view: View) -> None:
        """Say in the frame what the sign of old elements means, while one is on the map."""
        any_old = target_is_old(view) or (view.sky is not None and any(one.old for one in view.sky.up))
        legend = next((words for words in OLD if len(words) <= width - 4), OLD[-1]) if any_old else ""
        if legend != self._legend:
            self._legend = legend
            if not self._pointed:
                self.border_subtitle = legend

    @staticmethod
    def _path(canvas: Braille, polar: Polar, view: View) -> None:
        state, position = view.state, view.state.position
        if position is not None and state.beam is not None:
            ink = "dim" if view.stale else "accent"
            # A smaller one hides under the dish's own mark.
            polar.beam(canvas, position.az_deg, position.el_deg, state.beam, ink, least=7.0)
        motion = state.motion
        if motion is None or motion.az_way_deg is None:
            return  # which way round it goes is not known yet
        start_az, start_el, turn = motion.from_az_deg, motion.from_el_deg, motion.az_way_deg
        points = [
            polar.dot(start_az + turn * part / PATH, start_el + (motion.to_el_deg - start_el) * part / PATH)
            for part in range(PATH + 1)
        ]
        gone = round((view.progress or 0.0) * PATH)
        ink = "accent" if view.link_up else "dim"
        canvas.dotted(points[: gone + 1], ink, 3.5)  # past is dotted, future is solid
        canvas.dotted(points[gone:], ink, 1.0)

    @staticmethod
    def _marks(cells: Cells, polar: Polar, view: View) -> None:
        state, position = view.state, view.state.position
        motion = state.motion
        if motion is not None and view.progress is not None and view.link_up:
            el_deg = motion.from_el_deg + (motion.to_el_deg - motion.from_el_deg) * view.progress
            if motion.az_way_deg is not None:
                turn = motion.az_way_deg * view.progress
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
            words = " position unknown "
            cells.put(polar.width // 2 - len(words) // 2, polar.height // 2, words, "dim")

    @staticmethod
    def _target(cells: Cells, polar: Polar, view: View) -> str:
        """Mark the target of a pursuit, and name it, or the preset that the dish was sent to; return the name."""
        pursuit, state = pursuit_of(view.state), view.state
        t_s = view.utc.timestamp()
        if pursuit is not None and pursuit.plan.sky.start_s <= t_s <= pursuit.plan.sky.end_s:
            az_deg, el_deg = pursuit.plan.sky.at(t_s)
            if el_deg > -1.0:
                x, y = polar.cell(az_deg, max(el_deg, 0.0))
                here = state.position
                x += here is not None and polar.cell(here.az_deg, here.el_deg) == (x, y)
                cells.put(x, y, "✕", "target-strong")
                name = plain_name(pursuit.plan.aim.name)
                old = target_is_old(view)
                name_target(cells, polar, f"{OLD_SIGN} {name}" if old else name, x, y)
                return name
        if state.target_az_deg is None or state.target_el_deg is None:
            return ""
        sent = state.target_az_deg, state.target_el_deg
        preset = next((one.name for one in view.presets if separation(one.az_deg, one.el_deg, *sent) < ON_SLOT_DEG), "")
        if preset:
            name_target(cells, polar, preset, *polar.cell(*sent))
        return preset

    @staticmethod
    def _slots(cells: Cells, polar: Polar, view: View) -> None:
        place, state = view.settings.place, view.state
        if place is None:
            return
        low, high = state.el_min_deg or 0.0, state.el_max_deg or 90.0
        named = cells.width >= 84
        slots = []
        pursuit = pursuit_of(view.state)
        followed = None if pursuit is None else pursuit.plan.sky.at(view.utc.timestamp())
        for slot, az_deg, el_deg in slots_in_sight(place.latitude_deg, place.longitude_deg, low, high):
            x, y = polar.cell(az_deg, el_deg)
            if cells.free(x, y, 1, *QUIET):
                cells.put(x, y, "•", "dim")
            aimed = (
                state.target_az_deg is not None
                and state.target_el_deg is not None
                and separation(az_deg, el_deg, state.target_az_deg, state.target_el_deg) < ON_SLOT_DEG
            )
            names = (f"{slot.label} {slot.name}", slot.label) if named else (slot.label,)
            if followed is None or separation(az_deg, el_deg, *followed) >= ON_SLOT_DEG:  # its name stands there
                slots.append((names, x, y, aimed))
        middle = polar.width // 2
        # The slot that is pointed at is named first, then the ends of the arc, which have the most room.
        for names, x, y, aimed in sorted(slots, key=lambda slot: (not slot[3], -abs(slot[1] - middle))):
            if not label(cells, names, x, y, x - middle, "target-strong" if aimed else "dim") and aimed:
                name_target(cells, polar, names[-1], x, y)

    def on_mouse_move(self, event: events.MouseMove) -> None:
        """Read out the direction under the mouse."""
        if self.view is None:
            return
        self._pointed = True
        polar = Polar(self.size.width, self.size.height, self.view.settings.cell_aspect)
        found = polar.direction(event.x - 1, event.y - 1)
        name = self._named.get((event.x - 1, event.y - 1), "")
        self.border_subtitle = "" if found is None else f"AZ {found[0]:.0f}°  EL {found[1]:.0f}°  {name}".rstrip()

    def on_leave(self) -> None:
        """The mouse is elsewhere."""
        self._pointed = False
        self.border_subtitle = self._legend


def target_is_old(view: View) -> bool:
    """Return whether what is followed is followed by elements that are too old, or by those that ship."""
    pursuit = pursuit_of(view.state)
    if pursuit is None:
        return False
    plan = pursuit.plan
    if plan.elements is not None and plan.elements.closest.grade == "useless":
        return True
    aim, up = plan.aim, () if view.sky is None else view.sky.up
    return any(one.old and (one.norad_id == aim.norad_id if aim.norad_id else one.name == aim.name) for one in up)
