"""The chosen pass over the sky: its path, what of it is in reach, and the figures."""

from __future__ import annotations

from textual.geometry import Size

from birdcage_tui.canvas import Braille, Cells
from birdcage_tui.cell_text import cell_len, cut, wrap
from birdcage_tui.pane import Pane
from birdcage_tui.panes.polar import Polar
from birdcage_tui.panes.sky_ground import QUIET, Ground, has_stops, name_target, rim, sky_titles, title_for
from birdcage_tui.passes.desk import Desk
from birdcage_tui.passes.figures import brief
from birdcage_tui.passes.model import Row
from birdcage_tui.passes.words import (
    EDGES,
    EVENT_WORDS,
    clock_text,
    count_text,
    length_text,
    reach_sign,
    reach_text,
    standing_text,
)
from birdcage_tui.view import View

WORDS = 25
"""Columns that the figures need beside the disc."""
LINES = 4
"""Rows that they need under it."""
TITLES = sky_titles("Path")
STEPS = 160
"""Pieces that a path is drawn in."""


class PassSky(Pane):
    """A map of the sky with one pass on it, N up and E right."""

    def __init__(self, desk: Desk, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._desk = desk
        self.alone = True
        """Whether no other pane shows the figures."""
        self._ground = Ground(with_arc=False)

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
        row = self._desk.chosen(view)
        t_s = self._desk.time(view)
        canvas = self._ground.draw(polar, view)
        if row is not None and row.path is not None:
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
        width, moment = cells.width - x, "now" if self._desk.machine.is_now else "then"
        lines = _tall(row, t_s, width, moment) if beside else _low(row, t_s, width)
        if beside:
            lines += _losses(row, edges=False)
            lines += [*self._more(row, view, width, cells.height - y - len(lines)), *_losses(row, edges=True)]
        for ink, words in lines[: cells.height - y]:
            cells.put(x, y, cut(words, width), ink)
            y += 1

    def _more(self, row: Row, view: View, width: int, room: int) -> list[tuple[str, str]]:
        """Return (ink, words) of range, Doppler, signal, clock and Sun; without the signal where that has no room.

        Nothing where that has none either.
        """
        for signal in (True, False) if self.alone else ():
            lines = [
                (ink, each)
                for ink, words in brief(row, view.state.beam, signal=signal)
                for each in wrap(words, width, indent="  ")
            ]
            if len(lines) <= room:
                return lines
        return []

    @staticmethod
    def _path(canvas: Braille, polar: Polar, row: Row, t_s: float) -> None:
        """Draw the way: bright in reach, quiet outside; gone is dotted."""
        assert row.path is not None
        span = row.los_s - row.aos_s
        pieces: list[tuple[str, float, list[tuple[float, float]]]] = []
        for step in range(STEPS + 1):
            at_s = row.aos_s + span * step / STEPS
            place = row.path.at(min(max(at_s, row.path.t_s[0]), row.path.t_s[-1]))
            if place is None:
                continue
            loud = row.reach is not None and row.reach.holds(at_s)
            look = ("target" if loud else "text", 3.5 if at_s < t_s else 1.0 if loud else 2.4)
            dot = polar.dot(place[0], max(place[1], 0.0))
            if pieces and pieces[-1][:2] == look:
                pieces[-1][2].append(dot)
            else:
                start = [pieces[-1][2][-1]] if pieces else []
                pieces.append((*look, [*start, dot]))
        for ink, spacing, dots in pieces:
            canvas.dotted(dots, ink, spacing)

    @staticmethod
    def _ends(cells: Cells, polar: Polar, row: Row) -> None:
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
    def _marks(cells: Cells, polar: Polar, view: View, row: Row | None, t_s: float) -> None:
        position = view.state.position
        if position is not None:
            ink = "dim" if view.stale else "accent-strong"
            cells.put(*polar.cell(position.az_deg, position.el_deg), view.pointer, ink)
        if row is None or row.path is None:
            return
        place = row.path.at(t_s)
        if place is not None:
            x, y = polar.cell(*place)
            cells.put(x, y, "✕", "target-strong")
            name_target(cells, polar, row.name, x, y)


def _who(row: Row, t_s: float, width: int) -> list[tuple[str, str]]:
    """Return (ink, words) of which satellite it is, and what comes next."""
    name = f"{'★ ' if row.favourite else ''}{row.name}"
    number = f"  {row.norad_id}" if row.norad_id else ""
    event = row.next_event(t_s)
    words = standing_text(row) if event is None else f"{EVENT_WORDS[event[1]]} in {count_text(event[0] - t_s)}"
    return [("strong", f"{name}{number}" if cell_len(name + number) <= width else name), ("target", words)]


def _held(row: Row) -> str:
    """Return how much of it is in reach, or why nothing."""
    if row.reach is None:
        return "computing the reach …"
    if not row.reach.intervals:
        return f"{'always out of' if row.stays else 'never in'} reach: {reach_sign(row.reach)[2]}"
    if row.stays and not row.reach.lost:
        return "always in reach"
    return f"{'in parts' if row.stays else reach_text(row)} in reach, best {row.reach.best_el_deg or 0.0:.0f}°"


def _low(row: Row, t_s: float, width: int) -> list[tuple[str, str]]:
    """Return (ink, words) for the rows under the picture."""
    who, (ink, words) = _who(row, t_s, width)
    age = "" if row.age is None else f" {row.age.glyph} {row.age.short}"
    rise = "" if row.already_up else f"{clock_text(row.aos_s, seconds=False)} "
    fall = "later" if row.still_up else clock_text(row.los_s, seconds=False)
    span = f"max {row.max_el_deg:.0f}°" if row.stays else f"up {rise}to {fall}, max {row.max_el_deg:.0f}°"
    return [who, (ink, words + age if len(words + age) <= width else words), ("text", _held(row)), ("dim", span)]


def _tall(row: Row, t_s: float, width: int, moment: str) -> list[tuple[str, str]]:
    """Return (ink, words) for beside the picture: when and where it rises and sets, what is in reach."""
    place = None if row.path is None else row.path.at(t_s)
    began = "already up" if row.already_up else f"{clock_text(row.aos_s)}  {row.aos_az_deg:5.1f}°"
    ends = "later" if row.still_up else f"{clock_text(row.los_s)}  {row.los_az_deg:5.1f}°"
    lines = [
        *_who(row, t_s, width),
        ("text", f"{moment} AZ {place[0]:.1f}°  EL {place[1]:.1f}°" if place is not None else ""),
    ]
    if row.stays:
        lines += [("dim", f"max {row.max_el_deg:.1f}° at {clock_text(row.tca_s, seconds=False)}")]
    else:
        lines += [
            ("dim", f"AOS  {began}"),
            ("dim", f"TCA  {clock_text(row.tca_s)}  {row.tca_az_deg:5.1f}°"),
            ("dim", f"LOS  {ends}"),
            ("dim", f"max {row.max_el_deg:.1f}°, {length_text(row.los_s - row.aos_s)} up"),
        ]
    lines.append(("text", _held(row)))
    if row.reach is not None and not (row.stays and not row.reach.lost):
        lines += [("text", f"  {clock_text(start)} to {clock_text(end)}") for start, end in row.reach.intervals[:3]]
    if row.age is not None:
        told = wrap(f"{row.age.glyph} elements {row.age.words}", width, indent="  ")
        lines += [(row.age.ink, each) for each in told]
    if row.hears:
        lines += [("text", each) for each in wrap(f"sends {row.hears}", width, indent="  ")]
    return lines


def _losses(row: Row, *, edges: bool) -> list[tuple[str, str]]:
    """Return (ink, words) of each part in which the dish cannot follow; those at the ends, or the others."""
    if row.reach is None:
        return []
    return [
        ("dim", f"{lost.reason} {clock_text(lost.start_s)}, {length_text(lost.end_s - lost.start_s)}")
        for lost in row.reach.lost if lost.end_s - lost.start_s >= 1.0 and (lost.reason in EDGES) == edges
    ]  # fmt: skip
