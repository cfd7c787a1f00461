"""Autotrack's choice of passes, by examples."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta

from birdcage.base.config.tracking_sections import AutotrackSettings
from birdcage.pursuit.schedule import Direction, KeptPass, ScheduleCandidate, schedule
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import LossReason, Lost, PassReach, Stretch

NOW = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
RULES = AutotrackSettings(min_elevation_deg=10.0, min_duration_s=120.0, hysteresis_s=60.0, hours=24.0)


def at(seconds):
    return NOW + timedelta(seconds=seconds)


def one(name, start, end, priority=0, top=50.0, number=None, gap=None):
    """Return a candidate in reach from `start` to `end` seconds after NOW, but for a gap; it culminates in between."""
    middle, half = (start + end) / 2.0, (end - start) / 2.0
    spans = [(start, end)] if gap is None else [(start, gap[0]), (gap[1], end)]
    number = number if number is not None else sum(map(ord, name))
    passing = Pass(name, number, at(start - 60), at(middle), at(end + 60), 0.0, 90.0, 180.0, top)

    def where(moment):
        off = ((moment - NOW).total_seconds() - middle) / half
        return Direction(90.0 + 90.0 * off, top - (top - 5.0) * off * off)

    reach = PassReach(
        tuple(Stretch(at(a), at(b)) for a, b in spans), (Lost(at(start - 60), at(start), LossReason.FLOOR),), top
    )
    return ScheduleCandidate(passing, reach, priority, where)


def told(rows):
    return [(row.name, row.kept, row.why) for row in rows]


def seconds(row):
    return (row.reach_start - NOW).total_seconds(), (row.reach_end - NOW).total_seconds()


def test_passes_apart_are_all_kept_in_order_of_time():
    rows = schedule([one("B", 2000, 2600), one("A", 100, 700)], RULES, 20.0, NOW)
    assert told(rows) == [("A", True, ""), ("B", True, "")]
    assert (rows[0].reach_start, rows[0].reach_end, rows[0].max_reach_elevation_deg) == (at(100), at(700), 50.0)


def test_the_longer_of_two_is_kept_and_the_other_says_why():
    rows = schedule([one("SHORT", 500, 900), one("LONG", 100, 700)], RULES, 20.0, NOW)
    assert told(rows) == [("LONG", True, ""), ("SHORT", False, "overlaps LONG (priority 0)")]


def test_two_short_ones_are_worth_more_than_the_one_between():
    passes = [one("A", 0, 400), one("MIDDLE", 300, 900), one("C", 800, 1200)]
    assert [row.kept for row in schedule(passes, RULES, 20.0, NOW)] == [True, False, True]


def test_equal_length_goes_by_elevation():
    rows = schedule([one("LOW", 0, 400, top=30.0), one("HIGH", 100, 500, top=60.0)], RULES, 20.0, NOW)
    assert [row.name for row in rows if row.kept] == ["HIGH"]


def test_too_low_and_too_short_say_so():
    rows = schedule([one("LOW", 0, 400, top=9.5), one("SHORT", 1000, 1085)], RULES, 20.0, NOW)
    assert told(rows) == [
        ("LOW", False, "up to 9.5° within reach, under 10°"),
        ("SHORT", False, "85 s within reach, under 120 s"),
    ]


def test_what_never_comes_within_reach_or_is_over_or_too_far_ahead_is_no_candidate():
    never = replace(one("NEVER", 100, 500), reach=PassReach((), (Lost(at(100), at(500), LossReason.FLOOR),), None))
    assert schedule([never, one("OVER", -900, -300), one("FAR", 90_000, 90_600)], RULES, 20.0, NOW) == ()


def test_turning_round_takes_its_time():
    passes = [one("A", 0, 600), one("B", 610, 1100)]
    assert told(schedule(passes, RULES, 20.0, NOW))[1] == ("B", False, "no time to turn round after A (priority 0)")
    assert [row.kept for row in schedule(passes, RULES, 10.0, NOW)] == [True, True]


def test_the_way_decides_how_long_turning_round_takes():
    passes = [one("A", 0, 600), one("B", 610, 1100)]  # from 180° to 0°

    def slew(one, other):
        return abs(one.az_deg - other.az_deg) / rate

    rate = 15.0
    assert [row.kept for row in schedule(passes, RULES, slew, NOW)] == [True, False]
    rate = 20.0
    assert [row.kept for row in schedule(passes, RULES, slew, NOW)] == [True, True]


def test_a_higher_priority_cuts_a_lower_one_short():
    rows = schedule([one("LONG", 0, 900), one("SHORT", 600, 800, priority=2)], RULES, 30.0, NOW)
    assert told(rows) == [("LONG", True, "cut short for SHORT (priority 2)"), ("SHORT", True, "")]
    assert seconds(rows[0]) == (0.0, 570.0)
    rows = schedule([one("LONG", 100, 900), one("SHORT", 50, 300, priority=2)], RULES, 30.0, NOW)
    assert told(rows) == [("SHORT", True, ""), ("LONG", True, "joined after SHORT (priority 2)")]
    assert seconds(rows[1]) == (330.0, 900.0)


def test_a_cut_that_leaves_too_little_leaves_the_pass_out():
    rows = schedule([one("LONG", 0, 700), one("SHORT", 100, 650, priority=2)], RULES, 30.0, NOW)
    assert told(rows)[0] == ("LONG", False, "overlaps SHORT (priority 2), which leaves 70 s, up to 21.2°")
    rows = schedule([one("LONG", 0, 700), one("SHORT", 0, 700, priority=2)], RULES, 30.0, NOW)
    assert told(rows)[0] == ("LONG", False, "overlaps SHORT (priority 2)")


def test_the_low_end_of_a_high_pass_is_not_followed_below_the_least_elevation():
    """After the cut 140 s remain, but below 20 degrees."""
    passes = [one("LONG", 0, 1000, top=60.0), one("SHORT", 170, 1000, priority=1)]
    rules = replace(RULES, min_elevation_deg=39.0)
    assert [row.kept for row in schedule(passes, RULES, 30.0, NOW)] == [True, True]
    assert told(schedule(passes, rules, 30.0, NOW))[0][1] is False


def test_a_cut_lands_within_reach():
    """What is left begins where reach begins again, not in the gap that the dish cannot reach."""
    passes = [one("GAP", 0, 1000, gap=(300, 500)), one("FIRST", -200, 370, priority=1)]
    rows = schedule(passes, RULES, 30.0, NOW)
    assert seconds(next(row for row in rows if row.name == "GAP")) == (500.0, 1000.0)


def test_only_the_longest_piece_is_followed():
    rows = schedule([one("ALL DAY", 0, 9000), one("SHORT", 3000, 3600, priority=1)], RULES, 30.0, NOW)
    assert [seconds(row) for row in rows if row.name == "ALL DAY"] == [(3630.0, 9000.0)]


def test_what_has_begun_is_joined_if_enough_is_left():
    rows = schedule([one("A", -400, 130)], RULES, 30.0, NOW)
    assert (told(rows), seconds(rows[0])) == ([("A", True, "")], (-400.0, 130.0))
    assert told(schedule([one("A", -400, 110)], RULES, 30.0, NOW)) == [
        ("A", False, "110 s within reach, under 120 s")
    ]  # fmt: skip


def kept(name, passes, following, rules=RULES):
    return KeptPass(next(row for row in schedule(passes, rules, 20.0, NOW) if row.name == name), following)


def test_the_next_pass_is_not_dropped_for_one_that_is_hardly_better():
    first = [one("A", 300, 700), one("B", 400, 795)]
    present = kept("A", first, following=False)
    for better, expected in ((50, "A"), (59, "A"), (61, "B")):
        passes = [one("A", 300, 700), one("B", 400, 800 + better)]
        assert [row.name for row in schedule(passes, RULES, 20.0, NOW, present) if row.kept] == [expected]
        assert [row.name for row in schedule(passes, RULES, 20.0, NOW) if row.kept] == ["B"]


def test_a_higher_priority_pre_empts_the_next_pass_but_not_the_one_that_is_followed():
    alone, late = one("A", -100, 300), one("VIP", 0, 350, priority=9)
    present = kept("A", [alone], following=True)
    assert told(schedule([alone, late], RULES, 20.0, NOW, replace(present, following=False))) == [
        ("A", False, "overlaps VIP (priority 9)"),
        ("VIP", True, ""),
    ]
    assert told(schedule([alone, late], RULES, 20.0, NOW, present)) == [
        ("A", True, ""),
        ("VIP", False, "overlaps A (priority 0), which leaves 30 s, up to 19.1°"),
    ]


def test_the_followed_pass_stays_to_its_end_though_little_is_left():
    alone = one("A", -500, 60)
    present = KeptPass(schedule([alone], RULES, 20.0, at(-300))[0], following=True)
    assert told(schedule([alone], RULES, 20.0, NOW, present)) == [("A", True, "")]
    assert told(schedule([alone], RULES, 20.0, NOW))[0][1] is False


def test_the_followed_pass_ends_where_it_was_to_be_cut_short():
    passes = [one("A", -100, 900), one("VIP", 500, 900, priority=1)]
    present = kept("A", passes, following=True)
    assert present.scheduled.reach_end == at(480)
    again = schedule(passes, RULES, 20.0, NOW, present)
    assert told(again) == [("A", True, "cut short for VIP (priority 1)"), ("VIP", True, "")]
    assert again[0].reach_end == at(480)


def test_a_present_pass_that_is_no_candidate_any_more_counts_for_nothing():
    present = kept("A", [one("A", -100, 600)], following=True)
    assert told(schedule([one("B", 100, 500)], RULES, 20.0, NOW, present)) == [("B", True, "")]


def test_a_gap_counts_neither_for_how_long_a_pass_is_in_reach_nor_for_its_maximum():
    candidate = one("GAP", 100, 500, gap=(200, 280))
    candidate = replace(candidate, passing=replace(candidate.passing, max_elevation_deg=80.0))
    (row,) = schedule([candidate], RULES, 20.0, NOW)
    assert (row.reach_s, row.max_elevation_deg, row.max_reach_elevation_deg) == (320.0, 80.0, 50.0)
    (begun,) = schedule([candidate], RULES, 20.0, at(150))
    assert begun.reach_s == 320.0
