"""The compass rose: where the dish points, to the tenth of a degree, where it was sent, and what is in the way."""

from __future__ import annotations

from typing import cast

from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.sky.sun import sun
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.turning import cable_limits
from textual import events

from birdcage_tui.control.compass import Compass
from birdcage_tui.control.horizon_draw import draw_skyline
from birdcage_tui.control.tape import ROWS, draw_tape
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cell_len
from birdcage_tui.drawing.needle import draw_needle
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.pursuit import aimed_at
from birdcage_tui.shown.state_words import home_hint, uncertainty_text, unhomed_word
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.sky_ground import STOP_SIGN

STOP_WEDGE_DEG = 7.0
"""How much of the rose beyond a stop of the cable is hatched."""
UNDER_DEG = 3.0
"""A target nearer than this lies under the needle: its ray would only break it."""
QUIET = ("faint", "line", "dim")
_LOST = {
    "released": "MOTORS RELEASED",
    "unhomed": "NOT HOMED",
    "unreadable": "UNREADABLE",
    "stowing": "STOWING",
    "raw": "AFTER A RAW LINE",
    "raw command": "AFTER A RAW LINE",
}
"""Why there is no needle, by why the position was lost."""


class RosePane(Pane, can_focus=True):
    """A dial as large as its pane, over a scale with tenths."""

    HELP = (
        "Arrows or h j k l step the dish; - and + change the step. "
        "A click on the rose opens the go-to line with that azimuth."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Azimuth"
        self._static: tuple[object, Braille] | None = None

    @staticmethod
    def _compass(width: int, height: int, view: View) -> Compass:
        return Compass(width, max(height - ROWS, 1), view.settings.cell_aspect)

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the dial, kept between frames, then what changes, then the scale."""
        compass, state = self._compass(cells.width, cells.height, view), view.state
        position, target = state.position, aimed_at(view)
        canvas = self._dial(compass, view).copy()
        self._travel(canvas, compass, view)
        if position is not None:
            ink = "dim" if view.stale else "accent"
            if state.az_offset_deg:
                canvas.line(
                    *compass.dot(position.dish_az_deg, 0.12), *compass.dot(position.dish_az_deg, 0.72), "dim", 2
                )
            draw_needle(canvas, *compass.middle, position.az_deg, compass.radius * 0.84, compass.radius * 0.2, ink,
                        hollow=position.modelled, dot_aspect=compass.dot_aspect)  # fmt: skip
        canvas.onto(cells, 0, 0)
        self._letters(cells, compass)
        self._rim(cells, compass, view)
        self._sectors(cells, compass, view)
        self._marks(cells, compass, view)
        self._words(cells, compass, view)
        draw_tape(
            cells, cells.height - ROWS, None if position is None else position.az_deg,
            ink="dim" if view.stale else "accent-strong", target_deg=target and target[0], fold=wrap_360,
        )  # fmt: skip

    def _dial(self, compass: Compass, view: View) -> Braille:
        state = view.state
        limits = cable_limits(state)
        mask = view.horizon.mask
        key = (compass, limits, state.no_go_sectors, state.az_offset_deg, mask)
        if self._static is not None and self._static[0] == key:
            return self._static[1]
        canvas = Braille(compass.width, compass.height)
        if limits is not None and limits[1] - limits[0] < 360.0:
            compass.hatch(canvas, "line", limits[1] + state.az_offset_deg, 360.0 - limits[1] + limits[0], 0.3, 0.97)
        for low, high, *_ in state.no_go_sectors:
            compass.hatch(canvas, "warn", low, (high - low) % 360.0, 0.6, 0.95)
            for edge in (low, high):
                canvas.line(*compass.dot(edge, 0.6), *compass.dot(edge, 0.97), "warn")
        compass.ticks(canvas)
        draw_skyline(canvas, compass, mask)
        self._static = (key, canvas)
        return canvas

    @staticmethod
    def _travel(canvas: Braille, compass: Compass, view: View) -> None:
        """Draw the target's ray, the way there (past dotted, future solid), and the wedges beyond the stops."""
        state = view.state
        if view.aim is not None:
            canvas.line(*compass.dot(view.aim[0], 0.3), *compass.dot(view.aim[0], 0.93), "text", 5)
        here, target = state.position, aimed_at(view)
        if target is not None and (here is None or abs(shortest_turn(here.az_deg, target[0])) > UNDER_DEG):
            canvas.line(*compass.dot(target[0], 0.3), *compass.dot(target[0], 0.93), "target", 3)
        motion = state.motion
        if motion is not None and motion.az_way_deg is not None and view.link_up:
            way = motion.az_way_deg
            gone = way * (view.progress or 0.0)
            compass.arc(canvas, motion.from_az_deg, gone, 0.55, "accent", 4.0)
            compass.arc(canvas, motion.from_az_deg + gone, way - gone, 0.55, "accent", 1.0)
        for az_deg, beyond_deg in _stops(view):
            start = az_deg if beyond_deg > 0 else az_deg - STOP_WEDGE_DEG
            compass.hatch(canvas, "warn", start, STOP_WEDGE_DEG, 0.45, 0.97, every=3)
            canvas.line(*compass.dot(az_deg, 0.4), *compass.dot(az_deg, 0.97), "warn")

    @staticmethod
    def _letters(cells: Cells, compass: Compass) -> None:
        for az_deg, name in ((0.0, "N"), (90.0, "E"), (180.0, "S"), (270.0, "W")):
            cells.put(*compass.cell(az_deg), name, "strong")
        if compass.radius >= 30:
            inner = 1 - 13.0 / compass.radius
            for az_deg in range(0, 360, 30):
                text = str(az_deg)
                x, y = compass.cell(az_deg, inner)
                x -= len(text) // 2
                if az_deg % 90 and cells.free(x, y, len(text), *QUIET):
                    cells.put(x, y, text, "dim")

    @staticmethod
    def _rim(cells: Cells, compass: Compass, view: View) -> None:
        """Write presets, stops and the Sun on the rim."""
        place = view.settings.place
        for preset in view.presets:
            cells.put(*compass.cell(preset.az_deg, 1 - 5.0 / compass.radius), "◆", "text")
        for az_deg, _ in _stops(view):
            cells.put(*compass.cell(az_deg), STOP_SIGN, "warn")
        if place is not None:
            az_deg, el_deg = sun(view.utc, place.latitude_deg, place.longitude_deg)
            if el_deg > 0:
                cells.put(*compass.cell(az_deg), "☼", "strong")

    @staticmethod
    def _sectors(cells: Cells, compass: Compass, view: View) -> None:
        """Say beside each no-go sector why it is one, and below which elevation, as far as there is room."""
        for low, high, below, reason in view.state.no_go_sectors:
            middle = low + (high - low) % 360.0 / 2
            limit = f"below {below:.0f}°"
            for words in (f"{reason} {limit}".strip(), reason, limit):
                places = [compass.cell(middle, part) for part in (0.5, 0.42, 0.34, 0.26)] if words else []
                length, outward = cell_len(words), 1 if middle % 360.0 < 180.0 else -1
                spots = [
                    (x - length // 2 + outward * away, y, () if away else QUIET)  # moved aside, it covers no line
                    for away in range(length // 2 + 1)
                    for x, y in places
                ]
                spot = next(((x, y) for x, y, over in spots if cells.free(x - 1, y, length + 2, *over)), None)
                if spot is not None:
                    cells.put(*spot, words, "warn")
                    break

    @staticmethod
    def _marks(cells: Cells, compass: Compass, view: View) -> None:
        state, target = view.state, aimed_at(view)
        if state.motion is not None and state.motion.to_skew_deg is None and view.link_up:
            cells.put(*compass.cell(state.motion.to_az_deg, 0.9), "+", "accent-strong")
        if target is not None:
            cells.put(*compass.cell(target[0]), "✕", "target-strong")
        if view.aim is not None:
            cells.put(*compass.cell(view.aim[0]), "×", "strong")
        if state.position is not None:
            cells.put(*compass.cell(0.0, 0.0), view.pointer, "dim" if view.stale else "accent-strong")

    @staticmethod
    def _words(cells: Cells, compass: Compass, view: View) -> None:
        """Say in the corners what the second needle is and which preset this is; in the middle why there is none."""
        state, position = view.state, view.state.position
        if view.horizon.recording:
            cells.right(compass.width, compass.height - 1, "● recording", "warn-strong")
        if position is None:
            rows = _why_unknown(view)
            for offset, words in enumerate(rows):
                text = f" {words} "
                x = compass.width // 2 - len(text) // 2
                y = compass.height // 2 - len(rows) // 2 + offset
                cells.put(x, y, text, "dim" if view.waiting or offset else "warn-strong")
            return
        if state.az_offset_deg:
            cells.put(0, compass.height - 1, f"dish {position.dish_az_deg:.1f}°", "dim")
        if position.modelled:
            words = f"modelled {uncertainty_text(position)}".rstrip()
            cells.put(0, 0, words if len(words) < compass.width // 3 else "modelled", "text")
        named = next((p.name for p in view.presets if abs(shortest_turn(p.az_deg, position.az_deg)) < 0.5), "")
        if named and cells.free(cells.width - cell_len(named) - 1, 0, cell_len(named) + 1, *QUIET):
            cells.right(cells.width, 0, named, "text")

    def on_click(self, event: events.Click) -> None:
        """Open the go-to line with the azimuth under the mouse; Enter is still to be pressed."""
        offset = event.get_content_offset(self)
        if offset is None or self.view is None:
            return
        az_deg = self._compass(self.size.width, self.size.height, self.view).direction(offset.x, offset.y)
        if az_deg is not None:
            event.stop()
            cast(AppHost, self.app).open_goto(f"az={az_deg:.0f}")


def _stops(view: View) -> list[tuple[float, float]]:
    """Return the true azimuths of the stops that lie within a turn, and the direction (+1, -1) in which they stop."""
    position, limits = view.state.position, cable_limits(view.state)
    if position is None or position.cable_deg is None or limits is None:
        return []
    return [
        (position.az_deg + end - position.cable_deg, sign)
        for end, sign in zip(limits, (-1.0, 1.0), strict=True)
        if abs(end - position.cable_deg) < 360.0
    ]


def _why_unknown(view: View) -> tuple[str, ...]:
    """Return a word for why the position is not known, and what would make it known."""
    state = view.state
    if view.waiting:
        return "NOT READ YET", "opening the port"
    if state.link.state is LinkPhase.LOST:
        return "LINK LOST", "plug the cable in"
    if state.link.state is LinkPhase.SILENT:
        return "SILENT", "the dish is silent"
    if state.activity is Activity.HOMING:
        return "HOMING", "keep its swing clear"
    if state.dish is not None and state.dish.no_direction:
        return "NO DIRECTION", "no azimuth and elevation"
    if state.awaits_first_move:
        moves = state.motion is not None or state.activity is Activity.UNKNOWN
        return "UNKNOWN", "on its way" if moves else "send it somewhere first"
    if state.homed is False:
        return unhomed_word(view), *home_hint(view).split(": ")
    if state.position_lost in _LOST:
        return _LOST[state.position_lost], *home_hint(view).split(": ")
    return "UNKNOWN", "not read yet"
