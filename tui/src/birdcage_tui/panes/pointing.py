"""The headline numbers: azimuth, elevation, what it is doing, what stops it, how much cable is left."""

from __future__ import annotations

from itertools import pairwise

from birdcage.station.known import CableTurn

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cell_len, cut, fit, pad
from birdcage_tui.drawing.digits import angle_text, put_big, width_of
from birdcage_tui.shown.error_scale import legible_deg
from birdcage_tui.shown.pursuit import pursuit_of, sample_of
from birdcage_tui.shown.state_words import age_text, motion_text, uncertainty_text
from birdcage_tui.shown.stop_words import stop_text
from birdcage_tui.shown.track_words import headline, live_words, los_words, next_words
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.skew import has_skew, skew_row
from birdcage_tui.widgets.sky_ground import UNKNOWN_SIGN

ROOM_TO_SAY = 52
"""From this width on the gauge says where its figure comes from, unless it was counted from a homing just now."""
LEAST_STRIP_WIDTH, MOST_STRIP_WIDTH = 24, 60
LEAST_TOP_DEG = 0.1
"""What the top of the strip of errors stands for at least: a good pursuit must look like one."""
GAP_S = 5.0
"""Errors further apart are not joined by a line."""


def motion_ink(view: View) -> str:
    """Return the ink of the line that says what it does."""
    if view.waiting:
        return "dim"
    if not view.link_up:
        return "warn"
    return "accent-strong" if view.moving else "text"


def cable_gauge(cells: Cells, y: int, view: View) -> None:
    """Draw where the cable stands between its two stops; hatched when its turn is not known."""
    state = view.state
    cable = state.dish.cable if state.dish is not None else None
    if state.dish is not None and cable is None:
        words = "this dish has no stop" if state.dish.cable_known else "no range is known; watch it"
        cells.put(1, y, f"cable: {words}", "dim")
        return
    turn = state.position.cable_deg if state.position is not None else None
    if cable is None or turn is None:
        told = view.waiting or (state.dish is not None and state.dish.homing_s is None)  # nothing that a person mends
        words, ink = " turn unknown", "dim" if told else "warn"
        low, high = ("", "") if cable is None else (f"{cable.min_deg:.0f}°", f"{cable.max_deg:.0f}°")
        x = cells.put(cells.put(1, y, "cable ", "dim"), y, low, "dim")
        width = cells.width - 3 - x - len(high) - len(words)
        x = cells.put(x, y, "▕" + UNKNOWN_SIGN * max(width, 0) + "▏", "line")
        cells.put(x, y, high, "dim")
        cells.put(cells.width - 1 - len(words), y, words, ink)
        return
    left, right = turn - cable.min_deg, cable.max_deg - turn
    tail = f" {right:3.0f}° CW"
    remembered = state.turn is CableTurn.REMEMBERED and cells.width >= ROOM_TO_SAY
    x = cells.put(1, y, "cable, remembered " if remembered else "cable ", "dim")
    x = cells.put(x, y, f"CCW {left:3.0f}° ", "text")
    width = cells.width - 1 - x - len(tail) - 2
    if width < 3:
        return
    mark = min(width - 1, max(0, int(left / (left + right) * width)))
    cells.put(x, y, "▕" + "─" * width + "▏", "dim")
    cells.put(x + 1 + mark, y, view.pointer, "dim" if view.stale else "accent")
    cells.put(x + width + 2, y, tail, "text")


def _error_strip(cells: Cells, x: int, height: int, view: View) -> None:
    """Draw a heading and the pointing error of the last seconds, a second a column of dots, in the rows 0 to `height`.

    Nothing unless the dish follows now.
    """
    width = min(cells.width - 1 - x, MOST_STRIP_WIDTH)
    if width < LEAST_STRIP_WIDTH or height < 4 or not view.link_up or sample_of(view) is None:
        return
    shown = [look for look in view.followed if view.now - look.at < width * 2]
    if len(shown) < 2:
        return
    x = cells.width - 1 - width
    worst = max(look.error_deg for look in shown)
    top_deg = max(LEAST_TOP_DEG, legible_deg([look.error_deg for look in shown]) * 1.1)
    canvas, dots = Braille(width, height - 1), (height - 1) * 4 - 1

    def at(at_s: float, error_deg: float) -> tuple[float, float]:
        return width * 2 - 1 - (view.now - at_s), dots * (1 - min(error_deg / top_deg, 1.0))

    canvas.line(0, dots, width * 2 - 1, dots, "line", every=4)
    for one, other in pairwise(shown):
        if other.at - one.at <= GAP_S:
            canvas.line(*at(one.at, one.error_deg), *at(other.at, other.error_deg), "accent")
    cells.put(x, 0, f"error  max {worst:.2f}° in {view.now - shown[0].at:.0f} s"[:width], "dim")
    canvas.onto(cells, x, 1)


class PointingPane(Pane):
    """Big digits, the motion with its bar, STOP's power, the cable gauge."""

    with_skew = True
    """Whether the third axis belongs in here, because no pane of its own shows it."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Pointing"

    def draw(self, cells: Cells, view: View) -> None:
        """Fill from the top; a tall pane gets air between the groups."""
        air = 1 if cells.height >= 10 else 0
        large = cells.width >= 55 and cells.height >= 12
        y = self._digits(cells, view, large=large)
        if self.with_skew and has_skew(view) and cells.height >= y + 5:
            skew_row(cells, 1, y, view)
            y += 1
        y += air if cells.height >= y + air + 4 else 0
        cells.put(1, y, cut(motion_text(view), cells.width - 2), motion_ink(view))
        if not self._pursuit(cells, y, view):
            self._bar(cells, y + 1, view)
        x = cells.put(
            1, y + 2, cut(stop_text(view, cells.width - 2), cells.width - 2), "text" if view.moving else "dim"
        )
        pursuit = pursuit_of(view.state)
        los = "" if pursuit is None or not view.link_up else los_words(pursuit.plan)
        if x + len(los) + 3 <= cells.width:
            cells.right(cells.width - 1, y + 2, los, "dim")
        cable_gauge(cells, min(y + 3 + air, cells.height - 1), view)

    @staticmethod
    def _digits(cells: Cells, view: View, *, large: bool) -> int:
        position = view.state.position
        ink = "dim" if view.stale else "big"
        # Unknown azimuth is `--.--` too: an angle not known has no hundreds. Elevation keeps its column.
        az = " --.-- " if position is None else angle_text(position.az_deg, 3) + "°"
        el = "--.--" if position is None else angle_text(position.el_deg, 2) + "°"
        widest = width_of("000.00°00.00°", large=large)
        gap = max(2, min(8, cells.width - 2 - widest))
        left = 1
        put_big(cells, left, 0, az.rstrip(), ink, large=large)
        start_el = left + width_of("000.00°", large=large) + gap
        put_big(cells, start_el, 0, el, ink, large=large)
        y = 5 if large else 3
        _error_strip(cells, start_el + width_of("00.00°", large=large) + 3, y + 1, view)
        age_s = view.position_age_s
        if position is not None and position.modelled:
            for x in (left, start_el):
                cells.put(x - 1, 1, "~", "strong")
        unsure = ""
        if position is None:
            note, note_ink = "unknown", "dim" if view.waiting else "warn"
        elif position.modelled and view.link_up:
            told = "read" if view.state.dish is None or view.state.dish.tells_at_rest else "sent"
            note, note_ink = f"~ modelled, {told} {age_text(age_s or 0.0)} ago", "text"
            if len(note) >= start_el - left - 9:
                note = "~ modelled"
            unsure = uncertainty_text(position)
        elif view.stale and age_s is not None:
            note, note_ink = f"{age_text(age_s)} old", "warn"
        else:
            note, note_ink = "", "dim"
        state = view.state
        known = state.az_offset_deg == 0 and state.el_offset_deg == 0 and state.alignment.model is None
        blank = len(az) - len(az.lstrip(" ")) if position is not None and not note else 0
        under = left + width_of(" " * blank, large=large)  # the first digit, not the room for a hundred
        cells.put(under, y, "azimuth" if known or note else "azimuth true", "dim")
        cells.put(start_el + width_of(" " * (len(el) - len(el.lstrip(" "))), large=large), y, "elevation", "dim")
        cells.put(left + 9, y, note, note_ink)
        cells.put(start_el + 10, y, unsure, "text")
        return y + 1

    @staticmethod
    def _pursuit(cells: Cells, y: int, view: View) -> bool:
        """Write what happens next in the pursuit, where there is one.

        The error stands at the right end of the row above: it is looked at most.
        """
        pursuit = pursuit_of(view.state)
        if pursuit is None or not view.link_up:
            return False
        name, error = headline(view) or "", live_words(view)
        if error:
            room = cells.width - 4 - len(error)
            if cell_len(name) > room:
                name = headline(view, brief=True) or ""
            cells.put(1, y, pad(fit(name, room), cells.width - 2), "accent-strong")
            cells.right(cells.width - 1, y, error, "accent-strong")
        cells.put(1, y + 1, cut(next_words(view, cells.width - 2), cells.width - 2), "text")
        return True

    @staticmethod
    def _bar(cells: Cells, y: int, view: View) -> None:
        """Draw a thin line: what has passed of the motion's time, and what is left."""
        width = max(cells.width - 2, 0)
        progress = view.progress if view.link_up else None
        if progress is None:
            cells.put(1, y, "─" * width, "line")
            return
        done = round(progress * width)
        cells.put(1, y, "━" * done, "accent")
        cells.put(1 + done, y, "─" * (width - done), "line")
