"""Autotrack's choice of passes against its own rules, and against trying everything."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from itertools import combinations, pairwise

from birdcage.base.config.tracking_sections import AutotrackSettings
from birdcage.pursuit.schedule import Direction, KeptPass, ScheduleCandidate, schedule
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import PassReach, Stretch
from hypothesis import given, settings
from hypothesis import strategies as st

NOW = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
RULES = AutotrackSettings(min_elevation_deg=10.0, min_duration_s=120.0, hysteresis_s=60.0, hours=24.0)
EXAMPLES = settings(max_examples=150, deadline=None)


def at(seconds):
    return NOW + timedelta(seconds=seconds)


def seconds(moment):
    return (moment - NOW).total_seconds()


def candidate(number, start, length, priority, top, turned=0.0, gap=None):
    """Return a pass that culminates in its middle, 15 degrees at both ends or its top if that is less."""
    middle, half, low = start + length / 2.0, length / 2.0, min(top, 15.0)
    spans = [(start, start + length)]
    if gap is not None:
        spans = [(start, start + gap * length), (start + (gap + 0.2) * length, start + length)]
    passing = Pass(f"SAT {number}", 1000 + number, at(start), at(middle), at(start + length), 0.0, 0.0, 0.0, top)

    def where(moment):
        off = (seconds(moment) - middle) / half
        return Direction((turned + 120.0 * off) % 360.0, top - (top - low) * off * off)

    inside = [min(max(passing.tca, at(a)), at(b)) for a, b in spans]
    best = max(where(moment).el_deg for moment in inside)
    return ScheduleCandidate(
        passing, PassReach(tuple(Stretch(at(a), at(b)) for a, b in spans), (), best), priority, where
    )


def passes(most=9, priorities=(0, 1, 2), gaps=True, starts=(-600, 6000)):
    one = st.tuples(
        st.integers(*starts), st.integers(60, 1200), st.sampled_from(priorities), st.integers(5, 90),
        st.integers(0, 359), st.sampled_from((None, 0.1, 0.4, 0.7)) if gaps else st.none(),
    )  # fmt: skip
    return st.lists(one, max_size=most).map(
        lambda values: [candidate(number, *value) for number, value in enumerate(values)]
    )


def slew(one, other):
    az = abs((other.az_deg - one.az_deg + 180.0) % 360.0 - 180.0)
    return 5.0 + max(az / 5.0, abs(other.el_deg - one.el_deg) / 3.0)


@EXAMPLES
@given(passes(), st.one_of(st.integers(0, 200).map(float), st.just(slew)))
def test_kept_passes_never_overlap_and_keep_to_the_minima(candidates, turn):
    by_number = {one.passing.norad_id: one for one in candidates}
    rows = schedule(candidates, RULES, turn, NOW)
    kept = [row for row in rows if row.kept]
    for before, after in pairwise(kept):
        need = turn
        if callable(turn):
            one, other = by_number[before.norad_id], by_number[after.norad_id]
            need = turn(one.where(before.reach_end), other.where(after.reach_start))
        assert seconds(after.reach_start) - seconds(before.reach_end) >= need - 1e-5
    for row in kept:
        one = by_number[row.norad_id]
        inside = [
            (max(seconds(each.start), seconds(row.reach_start), 0.0), min(seconds(each.end), seconds(row.reach_end)))
            for each in one.reach.intervals
        ]
        inside = [(low, high) for low, high in inside if low < high]
        assert sum(high - low for low, high in inside) >= RULES.min_duration_s - 1e-5
        samples = [low + (high - low) * step / 500 for low, high in inside for step in range(501)]
        assert max(one.where(at(each)).el_deg for each in samples) >= RULES.min_elevation_deg - 0.05
        assert any(each.start <= row.reach_start <= each.end for each in one.reach.intervals)
        assert any(each.start <= row.reach_end <= each.end for each in one.reach.intervals)


@EXAMPLES
@given(passes(), st.randoms())
def test_every_pass_has_one_row_and_what_is_left_out_says_why(candidates, random):
    rows = schedule(candidates, RULES, 30.0, NOW)
    ahead = [one for one in candidates if one.reach.intervals[-1].end > NOW]
    assert sorted(row.norad_id for row in rows) == sorted(one.passing.norad_id for one in ahead)
    assert all(row.why for row in rows if not row.kept)
    whole = {one.passing.norad_id: one.reach.intervals for one in candidates}
    for row in rows:
        left = [each for each in whole[row.norad_id] if each.end > NOW]
        cut = (row.reach_start, row.reach_end) != (left[0].start, left[-1].end)
        assert row.why or not cut
    shuffled = list(candidates)
    random.shuffle(shuffled)
    assert schedule(shuffled, RULES, 30.0, NOW) == rows


def worth(chain):
    return sum(round(each[2] * 1e6) for each in chain), sum(round(each[3] * 1000) for each in chain)


def everything_tried(offered, settled, turn):
    """Return the most that a set of (start, end, followed, elevation) is worth, of all sets that fit together."""
    best = (0, 0)
    for size in range(1, len(offered) + 1):
        for chain in combinations(offered, size):
            both = sorted([*chain, *settled])
            if all(b[0] - a[1] >= turn - 1e-9 for a, b in pairwise(both)):
                best = max(best, worth(chain))
    return best


@EXAMPLES
@given(passes(priorities=(0,)), st.integers(0, 200))
def test_within_a_priority_nothing_is_better(candidates, turn):
    rows = schedule(candidates, RULES, float(turn), NOW)
    offered = {}
    for one in candidates:
        inside = [(max(seconds(each.start), 0.0), seconds(each.end)) for each in one.reach.intervals]
        inside = [(low, high) for low, high in inside if low < high]
        followed = sum(high - low for low, high in inside)
        if followed < RULES.min_duration_s:
            continue
        top = seconds(one.passing.tca)
        best = max(one.where(at(min(max(top, low), high))).el_deg for low, high in inside)
        if best >= RULES.min_elevation_deg:
            offered[one.passing.norad_id] = (inside[0][0], inside[-1][1], followed, best)
    kept = [offered[row.norad_id] for row in rows if row.kept]
    assert worth(kept) == everything_tried(list(offered.values()), [], turn)


@EXAMPLES
@given(passes(most=8, gaps=False, starts=(0, 4000)), st.integers(0, 200))
def test_each_priority_has_the_most_of_what_those_above_leave(candidates, turn):
    """By another way of cutting: every moment of a grid of one second is tried as the start and end of a pass."""
    rows = schedule(candidates, RULES, float(turn), NOW)
    settled = []
    for priority in (2, 1, 0):
        offered = {}
        for one in (each for each in candidates if each.priority == priority):
            start, end = seconds(one.passing.aos), seconds(one.passing.los)
            if end - start < RULES.min_duration_s or one.reach.best_el_deg < RULES.min_elevation_deg:
                continue
            free = [
                all(moment >= b + turn or moment <= a - turn for a, b, *_ in settled)
                for moment in range(int(start), int(end) + 1)
            ]
            runs, begin = [], None
            for index, each in enumerate([*free, False]):
                if each and begin is None:
                    begin = index
                elif not each and begin is not None:
                    runs.append((begin, index - 1))
                    begin = None
            low, high = max(runs, key=lambda run: run[1] - run[0], default=(0, 0))
            low, high = start + low, start + high
            top = one.where(at(min(max(seconds(one.passing.tca), low), high))).el_deg
            if high - low >= RULES.min_duration_s and top >= RULES.min_elevation_deg:
                offered[one.passing.norad_id] = (low, high, high - low, top)
        kept = [row for row in rows if row.kept and row.priority == priority]
        found = [offered[row.norad_id] for row in kept]
        assert worth(found) == everything_tried(list(offered.values()), settled, turn)
        settled += found
    assert sorted((seconds(row.reach_start), seconds(row.reach_end)) for row in rows if row.kept) == sorted(
        (low, high) for low, high, *_ in settled
    )


def spans(candidates):
    return {one.passing.norad_id: (seconds(one.passing.aos), seconds(one.passing.los), one.passing.duration_s,
                                   one.reach.best_el_deg) for one in candidates}  # fmt: skip


@EXAMPLES
@given(passes(priorities=(0,), gaps=False, starts=(0, 3000)), st.data())
def test_the_next_pass_is_dropped_only_for_what_is_better_by_the_hysteresis(candidates, data):
    offered = spans(
        one for one in candidates if one.passing.duration_s >= 120.0 and one.passing.max_elevation_deg >= 10
    )
    if not offered:
        return
    number = data.draw(st.sampled_from(sorted(offered)))
    alone = schedule([one for one in candidates if one.passing.norad_id == number], RULES, 30.0, NOW)
    rows = schedule(candidates, RULES, 30.0, NOW, KeptPass(alone[0], following=False))
    present = offered[number]
    others = [each for key, each in offered.items() if key != number]
    without = everything_tried(others, [], 30.0)
    around = [each for each in others if each[0] - present[1] >= 30.0 or present[0] - each[1] >= 30.0]
    with_it = everything_tried(around, [present], 30.0)[0] + round(present[2] * 1e6)
    kept = {row.norad_id for row in rows if row.kept}
    assert worth([offered[key] for key in kept])[0] == (with_it if number in kept else without[0])
    if number in kept:
        assert without[0] <= with_it + 60e6
    else:
        assert without[0] >= with_it + 60e6


JITTER = st.lists(st.tuples(*[st.integers(-14, 14)] * 4), min_size=2, max_size=8)


@EXAMPLES
@given(JITTER, st.integers(0, 300))
def test_catalogue_updates_that_shift_passes_by_seconds_change_nothing(updates, apart):
    """Two passes that overlap, of about 400 s: whichever was chosen first stays chosen."""

    def catalogue(a, b, c, d):
        return [candidate(0, 600 + a, 400 + b, 0, 50), candidate(1, 600 + apart + c, 400 + d, 0, 50)]

    present, names = None, set()
    for update in updates:
        rows = schedule(catalogue(*update), RULES, 30.0, NOW, present)
        (chosen,) = [row for row in rows if row.kept]
        present = KeptPass(chosen, following=False)
        names.add(chosen.name)
    assert len(names) == 1


def test_without_hysteresis_such_updates_do_change_the_choice():
    def chosen(longer, present=None):
        passes = [candidate(0, 600, 400 + longer, 0, 50), candidate(1, 700, 400, 0, 50)]
        return next(row for row in schedule(passes, RULES, 30.0, NOW, present) if row.kept)

    assert (chosen(5).name, chosen(-5).name) == ("SAT 0", "SAT 1")
    assert chosen(-5, KeptPass(chosen(5), following=False)).name == "SAT 0"


def test_a_stretch_that_is_over_is_not_told_as_the_beginning_of_what_is_left():
    short = candidate(4, 0, 120, 0, 10)
    gap = candidate(5, -61, 604, 0, 10, gap=0.1)
    rows = schedule([short, gap], RULES, 0.0, NOW)
    assert [(row.name, seconds(row.reach_start), row.kept) for row in rows] == [
        ("SAT 4", 0.0, True), ("SAT 5", 120.2, True),
    ]  # fmt: skip
