"""The chosen pass over the sky: its path, what of it is in reach, and the figures."""

from __future__ import annotations

from textual.geometry import Size

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.polar import Polar, WayDot, draw_way
from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.passes.told import LINES, PassText
from birdcage_tui.shown.pass_words import clock_text
from birdcage_tui.shown.sky_picture import ShownPass
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.sky_ground import QUIET, SkyBackdrop, has_stops, name_target, rim, sky_titles, title_for

WORDS = 25
"""Columns that the figures need beside the disc."""
TITLES = sky_titles("Path")
STEPS = 160
"""Pieces that a path is drawn in."""


class PassSky(Pane):
    """A map of the sky with one pass on it, N up and E right."""

    def __init__(self, selection: PassSelection, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._selection = selection
        self.alone = True
        """Whether no other pane shows the figures."""
        self._ground = SkyBackdrop(with_arc=False)

    @staticmethod
    def disc(size: Size, aspect: float) -> tuple[Polar, bool]:
        """Return the disc, and whether the figures stand beside it."""
        round_width = round(size.height * aspect) + 3
        beside = size.width - round_width >= WORDS
        if beside:
            return Polar(round_width, size.height, aspect), True
        return Polar(size.width, size.height - LINES, aspect), False

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the ground, the path, what moves on it, and the figures."""
        title = title_for(TITLES, cells.width, stops=has_stops(view))
        if title != self.border_title:
            self.border_title = title
        polar, beside = self.disc(Size(cells.width, cells.height), view.settings.cell_aspect)
        if polar.width < 10 or polar.height < 5:
            return
        row = self._selection.chosen(view)
        t_s = self._selection.time(view)
        canvas = self._ground.draw(polar, view)
        if row is not None:
            self._path(canvas, polar, row, t_s)
        canvas.onto(cells, 0, 0)
        rim(cells, polar, view)
        self._marks(cells, polar, view, row, t_s)
        if row is not None:
            self._ends(cells, polar, row)  # last: a time gives way to the name
        x, y = (polar.width + 1, 0) if beside else (1, polar.height)
        if row is None:
            cells.put(x, y, "No pass selected.", "dim")
            return
        moment = "now" if self._selection.machine.is_now else "then"
        told = PassText(row, t_s, moment, view.state.beam, everything=self.alone)
        for ink, words in told.lines(cells.width - x, cells.height - y, beside=beside):
            cells.put(x, y, words, ink)
            y += 1

    @staticmethod
    def _path(canvas: Braille, polar: Polar, row: ShownPass, t_s: float) -> None:
        """Draw the way."""
        span, way = row.los_s - row.aos_s, []
        for step in range(STEPS + 1):
            at_s = row.aos_s + span * step / STEPS
            place = row.path.at(min(max(at_s, row.path.t_s[0]), row.path.t_s[-1]))
            if place is not None:
                held = row.reach.holds(at_s)
                way.append(WayDot(polar.dot(place[0], max(place[1], 0.0)), held, at_s < t_s))
        draw_way(canvas, way)

    @staticmethod
    def _ends(cells: Cells, polar: Polar, row: ShownPass) -> None:
        """Write when it rises and sets, at the rim, where that lies on nothing."""
        middle = polar.width // 2
        for az_deg, at_s, known in ((row.aos_az_deg, row.aos_s, not row.already_up),
                                    (row.los_az_deg, row.los_s, not row.still_up)):  # fmt: skip
            if not known:
                continue
            x, y = polar.cell(az_deg, 0.0)
            words = clock_text(at_s, seconds=False)
            beside = x + 2 if x >= middle else x - 1 - len(words)
            inward = x - 1 - len(words) if x >= middle else x + 2
            for start in (beside, inward):
                if start >= 0 and start + len(words) <= polar.width and cells.free(start, y, len(words), *QUIET):
                    cells.put(start, y, words, "text")
                    break

    @staticmethod
    def _marks(cells: Cells, polar: Polar, view: View, row: ShownPass | None, t_s: float) -> None:
        position = view.state.position
        if position is not None:
            ink = "dim" if view.stale else "accent-strong"
            cells.put(*polar.cell(position.az_deg, position.el_deg), view.pointer, ink)
        if row is None:
            return
        place = row.path.at(t_s)
        if place is not None:
            x, y = polar.cell(*place)
            cells.put(x, y, "✕", "target-strong")
            name_target(cells, polar, row.name, x, y)
