"""What the pursuit does now: how far off, what comes next and when, why it waits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.station.pursuit_state import Phase

from birdcage_tui.commands.mending import then_words
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import fit, wrap
from birdcage_tui.drawing.digits import put_big, width_of
from birdcage_tui.shown.pass_words import clock_text, count_text
from birdcage_tui.shown.pursuit import (
    plan_of,
    pursuit_of,
    same_target,
    sample_of,
    shown_is_followed,
    target_place,
)
from birdcage_tui.shown.track_words import (
    ahead_words,
    countdown_s,
    decibels,
    degrees,
    expected_words,
    followed_words,
    headline,
    left_words,
    live_deg,
    live_words,
    los_words,
    next_words,
)
from birdcage_tui.shown.view import View
from birdcage_tui.track.bullseye import draw_bullseye
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.tracking.day import Day
    from birdcage.tracking.plan import Plan

ROOMY = 56
"""From so many columns on the head of the tab tells what helps."""
BIG = 9
"""From so many rows on the error is written in big digits."""

SOON_S = 1800.0
"""What comes into reach later is not in the plan yet, and can't be followed before that."""
SKEW_WIDTH = 70
"""From so many columns on the skew is written out."""
CUT = ("accent-strong", "warn-strong", "warn")
"""Inks of what is cut, with a sign for it, rather than left out."""


class TrackNow(Pane):
    """Words, most important first; the error in big digits where there is room."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Now"

    def draw(self, cells: Cells, view: View) -> None:
        """Write as much as there is room for."""
        y, width = 0, cells.width - 2
        if cells.height >= BIG and self._big(cells, view):
            y = 4
            side = cells.height * 2 + 2
            if draw_bullseye(cells, cells.width - side - 1, side, view):
                width -= side + 2
        for ink, words in self.lines(view, width, big=y > 0):
            rows, left = wrap(words, max(width, 10)), cells.height - y
            left -= ink == "dim" and width < ROOMY  # nothing but a blank row parts words and curves there
            if len(rows) > left:
                if left < 1 or ink not in CUT:
                    continue  # whole, or not at all
                rows = wrap(words, max(width, 10), most=left)
            for row in rows:
                cells.put(1, y, row, ink)
                y += 1

    @staticmethod
    def _big(cells: Cells, view: View) -> bool:
        """Write error and loss, or the seconds until it moves, in big digits; return whether there was any."""
        left_s, sample, pursuit = countdown_s(view), sample_of(view), pursuit_of(view.state)
        if left_s is not None:
            x = put_big(cells, 1, 0, f"{max(left_s, 0.0):.0f}", "warn-strong")
            cells.put(x + 1, 1, "s until it moves", "warn-strong")
            cells.put(x + 1, 2, "Space cancels it", "text")
            return True
        if sample is None or pursuit is None:
            return False
        error_deg = live_deg(sample, pursuit.plan)
        x = put_big(cells, 1, 0, degrees(error_deg), "big")
        cells.put(1, 3, "error now" if error_deg is not None else "error unknown", "dim")
        if sample.loss_db is not None and cells.width - x >= 4 + width_of("-00.00"):
            x = put_big(cells, x + 3, 0, decibels(sample.loss_db).removesuffix(" dB"), "big")
            cells.put(x + 1, 2, "dB", "dim")
            cells.put(x - width_of("0.00"), 3, "of the beam", "dim")
        return True

    @staticmethod
    def lines(view: View, width: int, *, big: bool = False) -> list[tuple[str, str]]:
        """Return (ink, words); without what stands in big digits."""
        desk, pursuit, sample = view.track, pursuit_of(view.state), sample_of(view)
        found: list[tuple[str, str]] = []
        if desk is not None and desk.unfinished is not None and pursuit is None:
            left = desk.unfinished
            left_when = "in mid-pass" if left.reach_end is not None else "while following"
            words = f"{left.name} was left {left_when}, {left_words(left)}"
            found.append(("warn-strong", f"{words}. U: resume. D: dismiss."))
        if desk is not None and desk.problem:
            found.append(("warn", f"▲ {desk.problem}"))
        if desk is not None and desk.note:
            found.append(("warn", f"▲ {desk.note}"))
        if pursuit is None:
            return [*found, *_watched(view, width)]
        head, error = headline(view) or "", live_words(view)
        ink = "warn-strong" if pursuit.phase in (Phase.COUNTDOWN, Phase.INTERRUPTED, Phase.YIELDED) else "accent-strong"
        if sample is not None and not big:
            head = f"{fit(head, width - len(error) - 2)}  {error}"
        found.insert(0, (ink, head))
        coming = next_words(view, width)
        los = los_words(pursuit.plan)
        found.append(("text", f"{coming}   {los}".strip() if len(coming) + len(los) + 3 <= width else coming))
        whole, dish = followed_words(pursuit)
        if pursuit.rms_error_deg is not None:
            words = whole or dish
            if sample is not None and not big:
                lost = decibels(sample.loss_db)
                words = next(each for each in (f"beam {lost}  {words}", f"{lost}  {words}") if len(each) <= width
                             or each.startswith(lost))  # fmt: skip
            found.append(("text", words))
        shown = plan_of(view)
        followable = shown is not None and any(leg.end_s > view.utc.timestamp() for leg in shown.legs)
        if shown is not None and followable and not shown_is_followed(view):
            found.append(("text", then_words(view, f"f and Enter follow {shown.aim.name} instead")))
        always_up = pursuit.plan.day is not None and pursuit.plan.day.always_up
        if always_up:  # no pass to be over before its feed is turned
            found += _skew(pursuit.plan, width)
        if pursuit.why:
            found.append(("dim" if sample is not None else "text", pursuit.why))
        if pursuit.phase in (Phase.YIELDED, Phase.INTERRUPTED):
            again = then_words(view, "f and Enter follow again")
            again = f"{again} x: end."
            found.append(("text", again))
        found += [("dim", dish)] if whole and pursuit.rms_error_deg is not None else []
        if pursuit.controller and width >= ROOMY:
            took = "" if pursuit.latency_s is None else f", {pursuit.latency_s * 1000:.0f} ms a command"
            found.append(("dim", f"{pursuit.controller} controller{took}"))
        found += [] if always_up else _skew(pursuit.plan, width)
        return [*found, *(("dim", note) for note in pursuit.plan.notes)]


def _watched(view: View, width: int) -> list[tuple[str, str]]:
    """Return what there is to say of a target that is only looked at."""
    plan, place, desk = plan_of(view), target_place(view), view.track
    if desk is None or desk.choice is None or plan is None:
        waits = desk is not None and desk.choice is not None and view.settings.place is not None
        return [("dim", "Computing the pass …")] if waits else []
    last = view.state.pursuit
    done = []
    if last is not None and last.phase is Phase.OVER and same_target(plan, last.plan):
        done = [("text", last.why)]
        if last.rms_error_deg is not None:
            done.append(("text", f"Followed: {', '.join(filter(None, followed_words(last)))}."))
    here = "" if place is None else f"  AZ {place[0]:.2f}°  EL {place[1]:.2f}°"
    found = [("target-strong", f"{plan.aim.name}{here}")]
    t_s = view.utc.timestamp()
    chance = _chance(view, plan, t_s)
    found += [("text", chance), *done]
    found += _expected(plan, width)
    found += _skew(plan, width)
    if plan.preposition is not None and plan.legs and plan.legs[0].start_s > t_s:
        point = plan.preposition
        where = f"{point.true_az_deg:.0f}°/{point.true_el_deg:.0f}°"
        found.append(("dim", f"The dish waits at {where}, {point.slew_s:.0f} s away."))
    return [*found, *(("dim", note) for note in plan.notes if note != chance)]


def _expected(plan: Plan, width: int) -> list[tuple[str, str]]:
    """Return the error to expect of a plan, and of the dish alone; first what helps, where the head has no room."""
    from birdcage.tracking.pointing_error import error_words

    pointing = plan.pointing
    if pointing is None:
        return []
    own = f"RMS {degrees(pointing.dish.rms_deg)}, max {degrees(pointing.dish.max_deg)}"
    if pointing.elements is None:
        return [("dim", f"Expected: {own}.")]
    ink, _ = expected_words(plan)
    helps = [(ink, f"{pointing.advice}.")] if pointing.advice and width < ROOMY else []
    words = f"Expected: error {error_words(pointing)}, dish alone {own}."
    return [*helps, (ink, words)]


def _skew(plan: Plan, width: int) -> list[tuple[str, str]]:
    """Return how far to turn the feed for a slot, and what of that is the slot's own."""
    if plan.aim.skew is None:
        return []
    if width < SKEW_WIDTH:
        return [("text", plan.aim.skew.brief())]
    return [("text", f"{name} {words}") for name, words in zip(("Skew", "Tilt"), plan.aim.skew.words(), strict=True)]


def _of_day(view: View, day: Day, t_s: float) -> str:
    """Return the same of what does not pass, by its next 24 hours; empty where its plan tells it better."""
    when = "anyway" if day.hidden else "now"
    follow = then_words(view, "f and Enter follow it", f"f and Enter follow it {when}")
    if day.hidden:
        return f"{_capital(day.standing) or 'Behind the horizon mask'}: {follow}"
    if day.standing:
        return f"{_capital(day.standing)}: {follow}" if day.always_in_reach else f"{_capital(day.standing)}."
    end_s = day.reach_end_s(t_s)
    if end_s is not None:
        return f"In reach for {count_text(end_s - t_s)}: {follow}"
    start_s = day.reach_start_s(t_s)
    if start_s is not None and start_s > t_s + SOON_S:
        return f"In reach in {count_text(start_s - t_s)}, at {clock_text(start_s, seconds=False)}."
    return ""


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _chance(view: View, plan: Plan, t_s: float) -> str:
    """Return when the target can be followed, and what key does it; behind the horizon mask it can be, unheard."""
    from birdcage.tracking.plan_values import is_hidden

    if plan.day is not None and (words := _of_day(view, plan.day, t_s)):
        return words
    spans = [(one.start.timestamp(), one.end.timestamp()) for one in plan.reach.intervals]
    heard = next(((start, end) for start, end in spans if end > t_s), None)
    leg = next((each for each in plan.legs if each.end_s > t_s), None)
    if heard is not None and heard[0] <= t_s:
        does = then_words(view, "f and Enter follow it", "f and Enter follow it now")
        return f"In reach for {count_text(heard[1] - t_s)}: {does}"
    if leg is not None and leg.start_s <= t_s and is_hidden(plan, t_s):
        does = then_words(view, "f and Enter follow it", "f and Enter follow it anyway")
        return f"Behind the horizon mask: {does}"
    starts_s = [*([] if heard is None else [heard[0]]), *([] if leg is None else [leg.start_s])]
    if starts_s and (begins_s := min(starts_s)) > t_s:
        does = then_words(view, "f and Enter wait for it", "f and Enter wait for it and follow")
        what = "In reach" if heard is not None else "Behind the horizon mask"
        return f"{what} in {count_text(begins_s - t_s)}: {does}"
    if plan.passing is None:
        return f"Out of reach for {ahead_words(plan)}."
    return "No longer in reach." if spans or plan.legs else "Never in reach."
