"""Which passes of the favourites are followed unless a person chooses: autotrack's plan, as a pure function.

The rules:

1. What never comes within reach is no candidate. What has less than `min_duration_s` of reach left, or stays below
   `min_elevation_deg` within it, is left out, and so is what is known to be off the air.
2. The pass being followed stays until its end, as it was planned: nothing pre-empts it, whatever its priority.
3. Priorities are arranged one after the other, the highest first, each in the time that those above it leave. A pass is
   cut short for one of a higher priority if the longest piece that remains still keeps to rule 1; only that piece is
   followed. For one of its own priority no pass is cut: it is followed whole, or not at all.
4. Within a priority the greatest total time within reach wins; then the greatest sum of highest elevations; then
   whatever a fixed order of the passes (start, end, number, name) finds first.
5. The pass planned next counts `hysteresis_s` more than it has, so that a catalogue update, which shifts passes by
   seconds, does not throw the plan over. A pass of a higher priority pre-empts it all the same: it has not begun.
6. Between the end of one pass and the beginning of the next the dish has time to turn round.
"""

from __future__ import annotations

from bisect import insort
from collections.abc import Sequence
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.pursuit.now import SAME_PASS, Scheduled
from birdcage.pursuit.schedule_model import Direction, KeptPass, ScheduleCandidate, Slew
from birdcage.pursuit.schedule_piece import Piece, Turning, pieces_in, whole

if TYPE_CHECKING:
    from birdcage.base.config.tracking_sections import AutotrackSettings

__all__ = ["Direction", "KeptPass", "ScheduleCandidate", "Scheduled", "Slew", "schedule"]

_Value = tuple[int, int]
"""What a piece is worth: compared by the first number, then by the second; whole, so that sums are exact."""


def schedule(
    candidates: Sequence[ScheduleCandidate],
    rules: AutotrackSettings,
    slew_s: Slew | float,
    now: datetime,
    present: KeptPass | None = None,
) -> tuple[Scheduled, ...]:
    """Choose among passes; the result has each that comes within reach in the next `rules.hours`, in order of time.

    `slew_s`: how long the dish takes from one direction to another, in seconds; or one time for all. `present`: see
    rules 2 and 5; it counts for nothing when its pass is not among the candidates any more. The order of the
    candidates makes no difference.
    """
    until = now + timedelta(hours=rules.hours)
    pieces = [piece for one in candidates if (piece := whole(one, now)) is not None and piece.start < until]
    held = _found(pieces, present)
    turning = Turning(slew_s)
    settled: list[Piece] = []
    rows: list[Scheduled] = []
    if held is not None and present is not None and present.following:
        pieces.remove(held)
        settled.append(_as_planned(held, present.scheduled))
        rows.append(_row(settled[0], present.scheduled.why, is_part=present.scheduled.is_part))
    for priority in sorted({piece.candidate.priority for piece in pieces}, reverse=True):
        same = [piece for piece in pieces if piece.candidate.priority == priority]
        offered, refused = _offered(same, rules, settled, turning)
        bonus = timedelta(seconds=rules.hysteresis_s)
        values = [_value(each, bonus if held and each.candidate is held.candidate else timedelta()) for each in offered]
        chosen = [offered[index] for index in _best_chain(offered, values, turning)]
        rows += refused
        rows += [_row(each, _cut_short(each, settled), is_part=each.late or each.short) for each in chosen]
        rows += [_row(each, _overlapped(each, chosen, turning), kept=False) for each in offered if each not in chosen]
        settled = sorted((*settled, *chosen), key=lambda piece: piece.order)
    return tuple(sorted(rows, key=lambda row: (row.reach_start, row.reach_end, row.norad_id, row.name)))


def _offered(
    pieces: Sequence[Piece], rules: AutotrackSettings, settled: Sequence[Piece], turning: Turning
) -> tuple[list[Piece], list[Scheduled]]:
    """Return the longest piece that settled passes leave of each pass, and the rows of those of which too little is."""
    offered: list[Piece] = []
    refused: list[Scheduled] = []
    for piece in pieces:
        if why := _below_minima(piece, rules):
            refused.append(_row(piece, why, kept=False))
            continue
        rest = max(pieces_in(piece, settled, turning), key=lambda each: each.followed, default=None)
        if rest is None or _below_minima(rest, rules):
            refused.append(_row(piece, _left_out(piece, rest, settled), kept=False))
        else:
            offered.append(rest)
    return offered, refused


def _value(piece: Piece, bonus: timedelta) -> _Value:
    """Return what a piece is worth: microseconds and thousandths of a degree, so that sums are exact."""
    return (piece.followed + bonus) // timedelta(microseconds=1), round(piece.best_el_deg * 1000.0)


def _best_chain(pieces: Sequence[Piece], values: Sequence[_Value], turning: Turning) -> list[int]:
    """Return which pieces, in order of time, are worth the most together, each following the one before it.

    Weighted interval scheduling, exact: with the pieces in order of time, the best chain that ends with piece j is
    best[j] = value[j] + max of best[i] over every i that j can follow.

    Of equals the one is taken that is found first, in the order of `Piece.order`. The first number of each value is
    positive.
    """
    order = sorted(range(len(pieces)), key=lambda index: pieces[index].order)
    previous: dict[int, int | None] = {}
    # The best chain that ends with each piece; the best one first, and of equals the one that was found first.
    ranking: list[tuple[int, int, int, int]] = []
    for place, index in enumerate(order):
        seconds, height = values[index]
        last = next((each for each in ranking if turning.follows(pieces[each[3]], pieces[index])), None)
        previous[index] = None if last is None else last[3]
        if last is not None:
            seconds, height = seconds - last[0], height - last[1]
        insort(ranking, (-seconds, -height, place, index))
    chain: list[int] = []
    at = ranking[0][3] if ranking else None
    while at is not None:
        chain.append(at)
        at = previous[at]
    return chain[::-1]


def _found(pieces: Sequence[Piece], present: KeptPass | None) -> Piece | None:
    """Return the piece that is the present pass, maybe by newer elements."""
    if present is None:
        return None
    was = present.scheduled

    def shift(piece: Piece) -> timedelta:
        return min(abs(piece.told_start - was.reach_start), abs(piece.end - was.reach_end))

    near = [
        piece for piece in pieces
        if _is_of(piece, was)
        and piece.told_start < was.reach_end + SAME_PASS and was.reach_start - SAME_PASS < piece.end
    ]  # fmt: skip
    return min(near, key=shift, default=None)


def _is_of(piece: Piece, was: Scheduled) -> bool:
    passing = piece.candidate.passing
    if passing.norad_id:
        return passing.norad_id == was.norad_id
    return not was.norad_id and passing.name == was.name


def _as_planned(piece: Piece, was: Scheduled) -> Piece:
    """Return the pass that is followed: to its end by the newest elements, or to where it was to be cut short."""
    if not was.is_part:
        return piece
    return piece.part(piece.start, was.reach_end) or piece


def _row(piece: Piece, why: str, *, kept: bool = True, is_part: bool = False) -> Scheduled:
    passing, reach = piece.candidate.passing, piece.candidate.reach
    # What was missed of a pass that has begun does not make it a lower one.
    best_el_deg = piece.best_el_deg
    if reach.best_el_deg is not None and not piece.late and not piece.short:
        best_el_deg = reach.best_el_deg
    return Scheduled(
        passing.name, passing.norad_id, piece.told_start, piece.end, piece.told.total_seconds(),
        passing.max_elevation_deg, best_el_deg, piece.candidate.priority, kept, why, is_part,
    )  # fmt: skip


def _below_minima(piece: Piece, rules: AutotrackSettings) -> str:
    """Return why a piece is not worth following: silent, or which minimum it does not reach; else an empty text."""
    if piece.candidate.silence:
        return piece.candidate.silence
    followed_s = piece.followed.total_seconds()
    if followed_s < rules.min_duration_s:
        return f"{followed_s:.0f} s within reach, under {rules.min_duration_s:g} s"
    if piece.best_el_deg < rules.min_elevation_deg:
        return f"up to {piece.best_el_deg:.1f}° within reach, under {rules.min_elevation_deg:g}°"
    return ""


def _left_out(piece: Piece, rest: Piece | None, settled: Sequence[Piece]) -> str:
    """Return why a pass is left out of which settled ones leave too little: the `rest`, or nothing."""
    words = f"overlaps {_named(_nearest(piece, settled))}"
    if rest is None:
        return words
    return f"{words}, which leaves {rest.followed.total_seconds():.0f} s, up to {rest.best_el_deg:.1f}°"


def _cut_short(piece: Piece, settled: Sequence[Piece]) -> str:
    """Return for whom a piece that is followed is less than its pass; an empty text where it is all of it."""
    words = []
    if piece.late:
        before = [each for each in settled if each.end <= piece.start]
        words.append(f"joined after {_named(before[-1])}")
    if piece.short:
        after = [each for each in settled if each.start >= piece.end]
        words.append(f"cut short for {_named(after[0])}")
    return ", ".join(words)


def _overlapped(piece: Piece, kept: Sequence[Piece], turning: Turning) -> str:
    """Return which of the passes of the same priority that were chosen stands in the way of one that was not."""
    in_the_way = [each for each in kept if not turning.follows(each, piece) and not turning.follows(piece, each)]
    who = _nearest(piece, in_the_way)
    if who.end <= piece.start:
        return f"no time to turn round after {_named(who)}"
    if who.start >= piece.end:
        return f"no time to turn round for {_named(who)}"
    return f"overlaps {_named(who)}"


def _nearest(piece: Piece, others: Sequence[Piece]) -> Piece:
    """Return whom it overlaps most."""
    return max(others, key=lambda each: min(each.end, piece.end) - max(each.start, piece.start))


def _named(piece: Piece) -> str:
    passing = piece.candidate.passing
    return f"{passing.name or passing.norad_id} (priority {piece.candidate.priority})"
