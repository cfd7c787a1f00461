"""Azimuth, elevation and error over time: what is planned, what was, and what will happen, before it does."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from birdcage.base.geometry import shortest_turn

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.shown.error_scale import error_top, shown_deg, window
from birdcage_tui.shown.pass_words import clock_text
from birdcage_tui.shown.pursuit import beam_of, plan_of, shown_is_followed, target_place
from birdcage_tui.shown.track_words import degrees, drifts, left_text
from birdcage_tui.shown.view import View
from birdcage_tui.track.path import Points, Spot
from birdcage_tui.track.still import draw_still
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.tracking.plan import Incident, Plan

LEFT, RIGHT = 8, 8
"""Columns of name and scale, and of the figures of now and the loss: no name ever stands on a figure."""
TWO_ROWS = 10
"""From so many rows on, events and times have a row each on the time axis."""
PEAK_S = 120.0
"""What is cut off so near to the worst belongs to the same peak."""
APART = 2
"""Blanks between two words on the time axis."""
TICKS_S = (10.0, 20.0, 30.0, 60.0, 120.0, 300.0, 600.0, 900.0, 1800.0, 3600.0)
TITLE = "Azimuth, elevation, error"
MARKS = {"keyhole": "warn", "rewind": "warn", "unreach": "text", "reach": "text"}
"""What is written on the time axis, most important first, and its ink."""

Series = Sequence[tuple[float, float]]
"""Times and angles."""


class TrackStrips(Pane):
    """Three strips over one time axis: future is solid, past dotted, the dish in its own ink."""

    HELP = (
        "Yellow is the target, blue the dish: plan and past. Below, the pointing error in degrees, with the loss in "
        "decibels at the right. Dim is the error that the plan expects. Of a target that is always up: signal and "
        "error of the last 20 minutes, and its drift in the next 24 hours."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = TITLE
        self._points = Points()

    def draw(self, cells: Cells, view: View) -> None:
        """Share the rows out, draw the strips, then the line of now over all of them."""
        plan = plan_of(view)
        width = cells.width - LEFT - RIGHT
        rows = cells.height - (2 if cells.height >= TWO_ROWS else 1)
        if plan is None or width < 12 or rows < 3:
            cells.put(1, 0, "Select a target to see its curves."[: cells.width - 2], "dim")
            return
        day = plan.day
        title = TITLE if day is None or not day.always_up else f"Signal and error{', drift' if drifts(day) else ''}"
        if title != self.border_title:
            self.border_title = title
        if day is not None and day.always_up:
            draw_still(cells, view, plan, day, followed=shown_is_followed(view))
            return
        heights = [rows // 3 + (extra < rows % 3) for extra in (2, 1, 0)]  # the error has what is left over
        start_s, end_s = window(plan, view)
        x_of = _across(start_s, end_s, width)
        spots = [spot for spot in self._points.of(plan, view) if start_s <= spot.t_s <= end_s]
        self._lines(cells, plan, x_of, rows, width)
        y = 0
        for index, (name, height) in enumerate(zip(("AZ", "EL"), heights[:2], strict=True)):
            _angles(cells, view, spots, index, (y, height, width), x_of, name)
            y += height
        _errors(cells, view, plan, (y, heights[2], width), x_of)
        self._axis(cells, plan, view, (start_s, end_s), x_of, rows)
        now_s = view.utc.timestamp()
        if start_s <= now_s <= end_s:
            column = LEFT + min(int(x_of(now_s)) // 2, width - 1)
            for row in range(rows):
                if cells.free(column, row, 1, "line", "dim", "faint", "target"):
                    cells.put(column, row, "│", "strong")

    @staticmethod
    def _lines(cells: Cells, plan: Plan, x_of: Callable[[float], float], rows: int, width: int) -> None:
        for each in plan.incidents:
            column = int(x_of(each.at_s)) // 2
            if each.what in MARKS and 0 <= column < width:
                for row in range(rows):
                    cells.put(LEFT + column, row, "┆", "line" if MARKS[each.what] == "text" else "warn")

    @staticmethod
    def _axis(cells: Cells, plan: Plan, view: View, span: tuple[float, float], x_of: Callable[[float], float],
              y: int) -> None:  # fmt: skip
        """Write what happens, where it fits, and round times in the gaps or in a row of their own."""
        width, now_s = cells.width - LEFT - RIGHT, view.utc.timestamp()
        at_now = int(x_of(now_s)) // 2
        if span[0] <= now_s <= span[1]:
            cells.put(LEFT + min(at_now, width - 1), y, "▲", "strong")
        elif now_s < span[0]:
            cells.put(1, y, f"◀ rises in {left_text(span[0] - now_s)}", "strong")
        order = list(MARKS)
        coming = sorted((each for each in plan.incidents if each.what in MARKS), key=lambda one: order.index(one.what))
        for each in coming:
            _write(cells, y, each, x_of, width, past=each.at_s < now_s)
        row = y + 1 if y + 1 < cells.height else y
        every = next((each for each in TICKS_S if each * width / max(span[1] - span[0], 1.0) >= 11), TICKS_S[-1])
        at_s = (span[0] // every + 1) * every
        while at_s < span[1]:
            words = clock_text(at_s, seconds=every < 60.0)
            x = LEFT + int(x_of(at_s)) // 2 - len(words) // 2
            if _fits(cells, x, row, words):
                cells.put(x, row, words, "dim")
            at_s += every


def _fits(cells: Cells, x: int, y: int, words: str) -> bool:
    """Return whether words are whole there, and apart from those beside them."""
    first, end = max(x - APART, 0), min(x + len(words) + APART, cells.width)
    return x >= 0 and x + len(words) <= cells.width and cells.free(first, y, end - first)


def _across(start_s: float, end_s: float, width: int) -> Callable[[float], float]:
    scale = (width * 2 - 1) / max(end_s - start_s, 1.0)
    return lambda t_s: (t_s - start_s) * scale


def _write(cells: Cells, y: int, what: Incident, x_of: Callable[[float], float], width: int, *, past: bool) -> None:
    column = int(x_of(what.at_s)) // 2
    if not 0 <= column < width:
        return
    ink = "dim" if past else MARKS[what.what]
    for words in dict.fromkeys((what.text, what.text.partition(",")[0], what.text.rpartition(" the ")[2])):
        for x in (LEFT + column - len(words) // 2, LEFT + column, LEFT + column - len(words) + 1):
            if x >= 1 and _fits(cells, x, y, words):
                cells.put(x, y, words, ink)
                return
    if cells.free(LEFT + column - 1, y, 3):  # within words it would look like a letter of theirs
        cells.put(LEFT + column, y, "╵", ink)


def _scaled(low: float, high: float, dots: int) -> Callable[[float], float]:
    return lambda deg: dots * (1.0 - (min(max(deg, low), high) - low) / max(high - low, 1e-6))


def _angles(cells: Cells, view: View, spots: Sequence[Spot], axis: int, box: tuple[int, int, int],
            x_of: Callable[[float], float], name: str) -> None:  # fmt: skip
    """Draw one axis: the target's way, the dish's planned one, and where the dish was."""
    y, height, width = box
    if not spots or height < 1:
        return
    target = [(spot.t_s, (spot.az_deg, spot.el_deg)[axis]) for spot in spots]
    planned = [(spot.t_s, spot.course[axis]) for spot in spots if spot.course is not None]
    was: list[tuple[float, float]] = []
    if shown_is_followed(view):
        index = 0
        for look in view.followed:
            while index + 1 < len(spots) and spots[index + 1].t_s <= look.utc.timestamp():
                index += 1
            reported = look.reported_el_deg
            if axis == 0:
                reported = spots[index].az_deg + shortest_turn(spots[index].az_deg, look.reported_az_deg)
            was.append((look.utc.timestamp(), reported))
    values = [deg for _, deg in (*target, *planned)]
    low, high = min(values), max(values)
    canvas, now_s = Braille(width, height), view.utc.timestamp()
    up = _scaled(low, high, height * 4 - 1)
    _curve(canvas, target, x_of, up, "target", lambda t_s: t_s < now_s)
    _curve(canvas, planned, x_of, up, "accent", lambda _: True, beside=target)
    _curve(canvas, was, x_of, up, "accent", lambda _: False)
    canvas.onto(cells, LEFT, y)
    # Over north the lower end is negative: a scale from 351° up to 154° is none.
    north = high // 360.0 * 360.0 if axis == 0 else 0.0
    if height > 1:
        cells.right(LEFT - 1, y, f"{high - north:.0f}°", "dim")
        cells.right(LEFT - 1, y + height - 1, f"{low - north:.0f}°", "dim")
    at_north = y + int(up(north)) // 4
    if axis == 0 and low < north < high and y < at_north < y + height - 1:
        cells.right(LEFT - 1, at_north, "N", "dim")
    cells.put(0, y + (height - 1) // 2 if height > 2 else y, name, "strong")
    place = target_place(view)
    if place is not None and spots[0].t_s <= now_s <= spots[-1].t_s:
        cells.right(cells.width, y + (height - 1) // 2, f"{place[axis]:.2f}°", "target")


def _curve(canvas: Braille, series: Series, x_of: Callable[[float], float], up: Callable[[float], float], ink: str,
           dotted: Callable[[float], bool], beside: Series = ()) -> None:  # fmt: skip
    """Draw a curve; every third dot where it is dotted; nothing where it lies within a dot of the one `beside` it."""
    near = dict(beside)
    before: tuple[float, float] | None = None
    for t_s, deg in series:
        here = float(int(x_of(t_s))), up(deg)  # whole columns: a line between fractions of them would leave some out
        hidden = t_s in near and abs(here[1] - up(near[t_s])) < 1.0
        # Two looks that are far apart in time are not joined: what lies between was not seen.
        if before is not None and not hidden and here[0] - before[0] < canvas.width:
            if not dotted(t_s):
                canvas.line(*before, *here, ink)
            elif int(here[0]) % 3 == 0:
                canvas.dot(*here, ink)
        before = here


def _errors(cells: Cells, view: View, plan: Plan, box: tuple[int, int, int], x_of: Callable[[float], float]) -> None:
    """Draw the error: expected, and as it was; degrees at the left, dB of the beam at the right.

    Where that of the elements is unknown it is the dish's own, called so, and its cost is unknown.
    """
    y, height, width = box
    pointing = plan.pointing
    level = None if pointing is None else pointing.median
    expected: list[tuple[float, float]] = []
    if pointing is not None:
        times = pointing.dish.t_s.tolist()
        errors = (pointing.dish if level is None else level).error_deg.tolist()
        pairs, every = list(zip(times, errors, strict=True)), max(1, len(times) // (width * 4))
        expected = [max(pairs[at : at + every], key=lambda pair: pair[1]) for at in range(0, len(pairs), every)]
    worst: dict[int, tuple[float, float]] = {}  # of each column of dots: what lies between is not to be seen
    if shown_is_followed(view):
        for look in view.followed:
            t_s, column = look.utc.timestamp(), int(x_of(look.utc.timestamp()))
            worst[column] = max(worst.get(column, (t_s, 0.0)), (t_s, shown_deg(look)), key=lambda pair: pair[1])
    both = [*expected, *worst.values()]
    top = error_top([deg for _, deg in both])
    canvas, up = Braille(width, height), _scaled(0.0, top, height * 4 - 1)
    _curve(canvas, expected, x_of, up, "dim", lambda _: False)
    _curve(canvas, list(worst.values()), x_of, up, "accent", lambda _: False)
    canvas.onto(cells, LEFT, y)
    if height > 1:
        cells.right(LEFT - 1, y, degrees(top) if top < 10 else f"{top:.0f}°", "dim")
    unknown, beam = pointing is not None and level is None, beam_of(view)
    lost = None if unknown or beam is None else beam.most_loss_db(top)
    cells.right(cells.width, y, "" if lost is None else _decibels(lost), "dim")
    if height > 1:
        cells.right(LEFT - 1, y + height - 1, "0", "dim")
        cells.right(cells.width, y + height - 1, "" if lost is None else "0 dB", "dim")
    cells.put(0, y + (height - 1) // 2 if height > 2 else y + height - 1, "dish" if unknown else "err", "strong")
    _peak(cells, both, top, (y, width), x_of)


def _peak(cells: Cells, errors: Series, top: float, box: tuple[int, int], x_of: Callable[[float], float]) -> None:
    """Write beside a peak that is cut off how high it goes."""
    t_s, deg = max(errors, key=lambda pair: pair[1], default=(0.0, 0.0))
    if deg <= top:
        return
    y, width = box
    beyond = [int(x_of(each)) // 2 for each, error_deg in errors if error_deg > top and abs(each - t_s) < PEAK_S]
    words = f"↑ {degrees(deg)}"
    for x in (LEFT + max(beyond) + 1, LEFT + min(beyond) - len(words)):
        if x >= LEFT and x + len(words) <= LEFT + width and cells.free(x, y, len(words), "dim", "line", "faint"):
            cells.put(x, y, words, "warn")
            return
    column = LEFT + int(x_of(t_s)) // 2
    cells.put(min(max(column - len(words) // 2, LEFT), LEFT + width - len(words)), y, words, "warn")


def _decibels(lost_db: float) -> str:
    """Return what is lost, as a level: `-0.04 dB`, `-44 dB`; the least that shows is a hundredth."""
    return f"-{lost_db:.0f} dB" if lost_db >= 9.995 else f"-{lost_db:.2f} dB" if lost_db >= 0.005 else "<0.01 dB"
