"""The sky of the chosen target: its path, the dish's, where both are now, and how far from each other they were."""

from __future__ import annotations

from birdcage.station.pursuit_state import Phase

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.polar import Polar
from birdcage_tui.shown.pass_words import clock_text
from birdcage_tui.shown.pursuit import plan_of, pursuit_of, sample_of, shown_is_followed, target_place
from birdcage_tui.shown.view import View
from birdcage_tui.track.path import Points, draw_path, ticks
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.sky_ground import QUIET, SkyBackdrop, has_stops, name_target, rim, sky_titles, title_for

TITLES = sky_titles("Sky")
PATHS = ("target", "accent", "text", "strong", "warn", "target-strong", "accent-strong")
"""Inks of dots that a tick may cover."""
TRAIL = 120
"""Looks that the trail is made of."""


def draw_pursuit(canvas: Braille, polar: Polar, view: View, points: Points) -> None:
    """Draw the path of the plan, and where the dish was: what every map of the sky shows of a pursuit."""
    plan = plan_of(view)
    if plan is None:
        return
    draw_path(canvas, polar, points.of(plan, view), view.utc.timestamp())
    if shown_is_followed(view):
        for look in list(view.followed)[-TRAIL:]:
            canvas.dot(*polar.dot(look.reported_az_deg, look.reported_el_deg), "accent")


def draw_times(cells: Cells, polar: Polar, view: View, points: Points) -> None:
    """Write round times beside the path that is to come, where they lie on nothing."""
    plan = plan_of(view)
    if plan is None:
        return
    middle = polar.width // 2
    for at_s, az_deg, el_deg in ticks(points.of(plan, view), view.utc.timestamp()):
        x, y = polar.cell(az_deg, el_deg)
        words = clock_text(at_s, seconds=at_s % 60 != 0)
        if not cells.free(x, y, 1, *QUIET, *PATHS):
            continue  # a label stands there, or the dish
        right, left = x + 2, x - 1 - len(words)
        for start in (right, left) if x >= middle else (left, right):
            if start >= 0 and start + len(words) <= polar.width and cells.free(start, y, len(words), *QUIET):
                cells.put(start, y, words, "dim")
                cells.put(x, y, "┼", "target")
                break


class TrackSky(Pane):
    """A map of the sky, N up and E right."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._ground = SkyBackdrop(with_arc=False)
        self._points = Points()

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the ground, the plan, what moves, and the times."""
        title = title_for(TITLES, cells.width, stops=has_stops(view))
        if title != self.border_title:
            self.border_title = title
        polar = Polar(cells.width, cells.height, view.settings.cell_aspect)
        if polar.width < 10 or polar.height < 5:
            return
        canvas = self._ground.draw(polar, view)
        draw_pursuit(canvas, polar, view, self._points)
        self._beam(canvas, polar, view)
        canvas.onto(cells, 0, 0)
        rim(cells, polar, view)
        self._ends(cells, polar, view)
        self._marks(cells, polar, view)
        draw_times(cells, polar, view, self._points)
        self._legend(cells)

    @staticmethod
    def _legend(cells: Cells) -> None:
        """Name the marks where the corners are free."""
        rows = (("◉", "accent-strong", "dish"), ("+", "accent-strong", "command"), ("✕", "target-strong", "target"))
        if cells.width < 44 or not all(cells.free(0, y, len(words) + 3) for y, (_, _, words) in enumerate(rows)):
            return
        for y, (sign, ink, words) in enumerate(rows):
            cells.put(0, y, sign, ink)
            cells.put(2, y, words, "dim")

    @staticmethod
    def _beam(canvas: Braille, polar: Polar, view: View) -> None:
        position, beam = view.state.position, view.state.beam
        if position is not None and beam is not None:
            ink = "dim" if view.stale else "accent"
            # A smaller one hides under the dish's own mark.
            polar.beam(canvas, position.az_deg, position.el_deg, beam, ink, least=4.0)

    @staticmethod
    def _ends(cells: Cells, polar: Polar, view: View) -> None:
        """Write when it rises and sets, at the rim."""
        plan = plan_of(view)
        if plan is None or plan.passing is None:
            return
        passing, middle = plan.passing, polar.width // 2
        for az_deg, at, known in ((passing.aos_azimuth_deg, passing.aos, not passing.already_up),
                                  (passing.los_azimuth_deg, passing.los, not passing.still_up)):  # fmt: skip
            x, y = polar.cell(az_deg, 0.0)
            words = f"{at:%H:%M}"
            beside = x + 2 if x >= middle else x - 1 - len(words)
            inward = x - 1 - len(words) if x >= middle else x + 2
            for start in (beside, inward) if known else ():
                if start >= 0 and start + len(words) <= polar.width and cells.free(start, y, len(words), *QUIET):
                    cells.put(start, y, words, "text")
                    break

    @staticmethod
    def _marks(cells: Cells, polar: Polar, view: View) -> None:
        """Draw target, command and dish. While all three stand in one cell, the dish wins, and the target is beside."""
        state, position, pursuit = view.state, view.state.position, pursuit_of(view.state)
        sample = sample_of(view) if shown_is_followed(view) else None
        command = None
        if sample is not None:
            command = sample.commanded_az_deg, sample.commanded_el_deg
        elif state.motion is not None:
            command = state.motion.to_az_deg, state.motion.to_el_deg
        elif pursuit is not None and pursuit.phase in (Phase.WAITING, Phase.COUNTDOWN):
            point = pursuit.plan.preposition
            command = None if point is None else (point.true_az_deg, point.true_el_deg)
        if command is not None:
            cells.put(*polar.cell(*command), "+", "accent-strong")
        here = None if position is None else polar.cell(position.az_deg, position.el_deg)
        target = target_place(view)
        shown = None if target is None or target[1] <= -1.0 else polar.cell(target[0], max(target[1], 0.0))
        if shown is not None:
            shown = shown[0] + (shown == here), shown[1]
            cells.put(*shown, "✕", "target-strong")
        if here is not None:
            cells.put(*here, view.pointer, "dim" if view.stale else "accent-strong")
        plan = plan_of(view)
        if shown is not None and plan is not None:  # last: a name keeps off the dish
            name_target(cells, polar, plan.aim.name, *shown)
