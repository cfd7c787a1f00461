"""What of a pass a dish can follow, on passes drawn by hand and against brute force."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from datetime import UTC, datetime

import numpy as np
import pytest
from birdcage.base.no_go import NoGoSector
from birdcage.sky.elements import ElementSet
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet, track
from birdcage.sky.reach import reach, sample_times
from birdcage.sky.reach_cable import runs_of
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.reach_model import Lost
from birdcage.sky.reach_speed import azimuth_room, too_fast
from hypothesis import given
from hypothesis import strategies as st

T0 = 1_800_000_000.0


@dataclass(frozen=True)
class Sky:
    """A track as `birdcage.sky.propagate` gives one."""

    t_s: np.ndarray
    az_deg: np.ndarray
    el_deg: np.ndarray


def flyover(top_deg=60.0, towards_deg=0.0, step_s=2.0):
    """A straight line 500 km up at 7.5 km/s over a flat Earth, from 300 s before culmination to 300 s after."""
    t = np.arange(-300.0, 300.0 + step_s / 2, step_s)
    along, beside = 7.5 * t, 500.0 / np.tan(np.radians(top_deg))
    az = (np.degrees(np.arctan2(beside, along)) + towards_deg) % 360.0
    return Sky(t + T0, az, np.degrees(np.arctan2(500.0, np.hypot(along, beside))))


def when_at(el_deg, top_deg=60.0):
    """Seconds from culmination to an elevation of that flyover."""
    ground, beside = 500.0 / np.tan(np.radians(el_deg)), 500.0 / np.tan(np.radians(top_deg))
    return float(np.sqrt(ground**2 - beside**2) / 7.5)


def seconds(moment):
    return moment.timestamp() - T0


def shown(found):
    """Intervals and losses as (start, end, turn or reason), in seconds from culmination."""
    spans = [
        (seconds(one.start), seconds(one.end), one.cause.words if isinstance(one, Lost) else None) for one in found
    ]
    return [(pytest.approx(start, abs=0.1), pytest.approx(end, abs=0.1), reason) for start, end, reason in spans]


class Wall:
    """A mask of 40 degrees in the eastern half."""

    def at(self, az_deg):
        return 40.0 if 0.0 < az_deg < 180.0 else 0.0


def test_a_dish_without_limits_reaches_the_whole_pass():
    found = reach(flyover(), ReachLimits())
    assert found.total_s == pytest.approx(600.0, abs=1e-3)
    assert (found.lost, found.reasons, found.best_el_deg) == ((), (), pytest.approx(60.0, abs=0.01))


def test_floor_and_ceiling_cut_where_the_satellite_crosses_them():
    found = reach(flyover(80.0), ReachLimits(el_floor_deg=18.0, el_ceiling_deg=65.0))
    low, high = when_at(18.0, 80.0), when_at(65.0, 80.0)
    assert [(-low, -high, None), (high, low, None)] == shown(found.intervals)
    assert [(-300.0, -low, "floor"), (-high, high, "ceiling"), (low, 300.0, "floor")] == shown(found.lost)
    assert found.total_s == pytest.approx(2 * (low - high), abs=0.1)
    assert found.best_el_deg == pytest.approx(65.0, abs=0.01)


def test_a_pass_below_the_floor_is_not_reached_at_all():
    found = reach(flyover(30.0), ReachLimits(el_floor_deg=45.0))
    assert (found.intervals, found.total_s, found.best_el_deg, found.reasons) == ((), 0.0, None, ("floor",))


@pytest.mark.parametrize("step_s", [1.0, 5.0, 10.0])
def test_edges_do_not_depend_on_the_samples(step_s):
    found = reach(flyover(60.0, step_s=step_s), ReachLimits(el_floor_deg=20.0))
    assert seconds(found.intervals[0].start) == pytest.approx(-when_at(20.0), abs=0.02)
    assert seconds(found.intervals[0].end) == pytest.approx(when_at(20.0), abs=0.02)


def test_of_two_limits_between_two_samples_both_must_be_kept():
    found = reach(
        flyover(60.0, step_s=10.0), ReachLimits(el_floor_deg=20.0, horizon=HorizonMask([(0.0, 20.5), (180.0, 20.5)]))
    )
    assert seconds(found.intervals[0].start) == pytest.approx(-when_at(20.5), abs=0.02)
    assert seconds(found.intervals[0].end) == pytest.approx(when_at(20.5), abs=0.02)


def test_what_is_lost_after_the_last_but_one_sample_is_named_too():
    edge = float(flyover(60.0, step_s=10.0).el_deg[0])
    limits = ReachLimits(el_floor_deg=0.0, horizon=HorizonMask([(0.0, edge + 0.05), (180.0, edge + 0.05)]))
    found = reach(flyover(60.0, step_s=10.0), limits)
    assert 0.0 < seconds(found.intervals[0].start) + 300.0 < 10.0
    assert [one.reason for one in found.lost] == ["horizon", "horizon"]


def test_the_horizon_and_what_stands_there_are_named():
    # It rises in the south (180), passes through the east and sets in the north.
    behind_wall = reach(flyover(60.0), ReachLimits(horizon=Wall(), el_floor_deg=15.0))
    clear = when_at(40.0)
    assert [(-clear, clear, None)] == shown(behind_wall.intervals)
    assert behind_wall.reasons == ("floor", "horizon")
    mast = NoGoSector(60.0, 120.0, 90.0, "mast")
    cut = reach(flyover(60.0), ReachLimits(no_go=(mast,)))
    # Azimuth 120 is where along = -beside / tan 60.
    at_120 = 500.0 / np.tan(np.radians(60.0)) / np.tan(np.radians(60.0)) / 7.5
    assert [(-300.0, -at_120, None), (at_120, 300.0, None)] == shown(cut.intervals)
    assert [(-at_120, at_120, "no-go: mast")] == shown(cut.lost)


def test_a_sector_may_contain_north_and_may_be_passed_over():
    low_mast = NoGoSector(350.0, 10.0, 30.0)
    found = reach(flyover(60.0, towards_deg=270.0), ReachLimits(no_go=(low_mast,)))
    assert found.lost == ()
    assert reach(flyover(25.0, towards_deg=270.0), ReachLimits(no_go=(low_mast,))).words() == ("no-go",)


def test_a_turn_that_holds_the_whole_pass_is_found():
    sky = flyover(60.0, towards_deg=-100.0)  # from 80 down to 0 and on to 260
    found = reach(sky, ReachLimits(cable_min_deg=0.0, cable_max_deg=455.0, turn_known=True))
    assert (found.lost, len(found.intervals)) == ((), 1)
    narrow = ReachLimits(cable_min_deg=0.0, cable_max_deg=360.0, turn_known=True, az_rate_deg_s=65.0)
    assert reach(sky, narrow).reasons == ("cable",)


def test_where_no_turn_holds_it_a_rewind_is_left_out():
    # 180 degrees of azimuth, from 290 down to 110, on a cable that ends at 200 and 460: one rewind of 360 degrees.
    limits = ReachLimits(cable_min_deg=-160.0, cable_max_deg=200.0, turn_known=True, az_rate_deg_s=36.0)
    found = reach(flyover(60.0, towards_deg=110.0), limits)
    stop = [one for one in found.lost if one.reason == "cable"]
    assert len(stop) == 1
    assert found.reasons == ("cable",)
    assert seconds(stop[0].end) - seconds(stop[0].start) == pytest.approx(10.0, abs=2.1)  # a sample is 2 s
    assert [one.turn for one in found.intervals] == [-1, 0]
    # At the stop, azimuth 200, and not before it.
    before = (200.0 - 110.0) % 360.0
    assert seconds(stop[0].start) == pytest.approx(
        500.0 / np.tan(np.radians(60.0)) / np.tan(np.radians(before)) / 7.5, abs=0.1
    )


def test_the_rewind_is_done_while_the_satellite_is_above_the_ceiling():
    limits = ReachLimits(
        el_ceiling_deg=50.0, cable_min_deg=-160.0, cable_max_deg=200.0, turn_known=True, az_rate_deg_s=36.0
    )
    assert reach(flyover(60.0, towards_deg=110.0), limits).reasons == ("ceiling",)


def test_an_unknown_turn_counts_only_what_is_safe_for_every_turn():
    # From 350 down to 170: at 350 the cable may stand at 350 or at -10, and the latter ends at -100, azimuth 260.
    cable = {"cable_min_deg": -100.0, "cable_max_deg": 400.0, "az_rate_deg_s": 50.0}
    sky = flyover(60.0, towards_deg=170.0)
    assert reach(sky, ReachLimits(**cable, turn_known=True)).lost == ()
    unknown = reach(sky, ReachLimits(**cable, turn_known=False))
    assert [
        (pytest.approx(start, abs=0.1), pytest.approx(end, abs=2.1), reason)
        for start, end, reason in [(seconds(one.start), seconds(one.end), one.reason) for one in unknown.lost]
    ] == [(0.0, 10.0, "cable")]
    assert [stretch.turn for stretch in unknown.intervals] == [None, None]


def test_less_than_a_circle_of_cable_of_unknown_turn_reaches_nothing():
    cable = {"cable_min_deg": 0.0, "cable_max_deg": 300.0, "az_rate_deg_s": 30.0}
    assert reach(flyover(), ReachLimits(**cable)).reasons == ("cable",)
    assert reach(flyover(), ReachLimits(**cable, turn_known=True)).lost == ()


def test_the_cable_is_the_dishes_own_and_the_sky_true():
    """An offset of 100 degrees puts the dish's stop elsewhere in the sky."""
    sky = flyover(60.0, towards_deg=10.0)  # true 190 down to 10
    cable = {"cable_min_deg": 0.0, "cable_max_deg": 200.0, "turn_known": True, "az_rate_deg_s": 30.0}
    assert reach(sky, ReachLimits(**cable)).lost == ()
    turned = reach(sky, ReachLimits(**cable, az_offset_deg=100.0))  # the dish's own 90 down to -90
    assert shown(turned.intervals) == [(-300.0, 0.0, None)]
    assert turned.reasons == ("cable",)
    whole = ReachLimits(0.0, cable_min_deg=0.0, cable_max_deg=360.0, turn_known=True, az_offset_deg=250.0)
    assert [one.turn for one in reach(sky, whole).intervals] == [1]  # 300 down to 120


def test_a_slow_dish_loses_the_keyhole_and_a_fast_one_does_not():
    high = flyover(88.0, step_s=0.5)
    slow = reach(high, ReachLimits(az_rate_deg_s=5.0))
    assert slow.reasons == ("keyhole",)
    hole = slow.lost[0]
    assert -25.0 < seconds(hole.start) < seconds(hole.end) < 25.0
    assert 10.0 < slow.lost[0].end.timestamp() - hole.start.timestamp() < 36.0
    assert reach(high, ReachLimits(az_rate_deg_s=65.0)).lost == ()
    slower = reach(high, ReachLimits(az_rate_deg_s=3.0))
    assert slower.total_s < slow.total_s
    assert reach(high, ReachLimits(az_rate_deg_s=5.0, tolerance_deg=5.0)).lost == ()


def test_intervals_and_losses_are_the_whole_pass():
    limits = ReachLimits(
        el_floor_deg=15.0, el_ceiling_deg=75.0, horizon=Wall(), no_go=(NoGoSector(100.0, 140.0, 50.0, "mast"),),
        cable_min_deg=-100.0, cable_max_deg=300.0, turn_known=True, az_rate_deg_s=4.0, el_rate_deg_s=4.0,
    )  # fmt: skip
    for top, towards in itertools.product((20.0, 50.0, 70.0, 85.0), range(0, 360, 30)):
        found = reach(flyover(top, towards), limits)
        spans = sorted([*found.intervals, *found.lost], key=lambda span: span.start)
        assert (seconds(spans[0].start), seconds(spans[-1].end)) == (-300.0, 300.0)
        for before, after in itertools.pairwise(spans):
            assert seconds(after.start) == pytest.approx(seconds(before.end), abs=0.01)


# --- against brute force on a real orbit

ISS = ElementSet("ISS", 25544, datetime(2026, 11, 21, 12, tzinfo=UTC), 51.64, 247.46, 0.0007, 130.5, 325.0, 15.72, 1e-4)
HIGH = replace(ISS, name="Molniya", inclination_deg=63.4, eccentricity=0.7, mean_motion_rev_day=2.006, bstar=0.0)


@pytest.mark.parametrize("elements", [ISS, HIGH], ids=lambda one: one.name)
def test_reach_is_where_brute_force_finds_the_direction_allowed(elements):
    here = Observer(40.0, -105.0, 1650.0)
    mask = HorizonMask([(0, 20), (90, 35), (91, 10), (200, 10), (300, 25)])
    limits = ReachLimits(
        el_floor_deg=18.0, el_ceiling_deg=65.0, horizon=mask,
        no_go=(NoGoSector(330.0, 20.0, 50.0), NoGoSector(150.0, 170.0, 40.0)),
        cable_min_deg=-423.33, cable_max_deg=23.33, turn_known=True, az_rate_deg_s=65.0, el_rate_deg_s=45.0,
    )  # fmt: skip
    reached = 0
    for one in search(Fleet([elements]), here, elements.epoch, 72.0):
        found = reach(track(elements, here, sample_times(one)), limits)
        step = 0.1 if one.duration_s < 3600 else 2.0
        t = np.arange(one.aos.timestamp(), one.los.timestamp(), step)
        dense = track(elements, here, t)
        az, el = dense.az_deg, dense.el_deg
        allowed = (el >= 18.0) & (el <= 65.0) & (el >= np.array([mask.at(each) for each in az.tolist()]))
        allowed &= ~(((az >= 330.0) | (az <= 20.0)) & (el < 50.0)) & ~((az >= 150.0) & (az <= 170.0) & (el < 40.0))
        inside = np.zeros(len(t), dtype=bool)
        for stretch in found.intervals:
            inside |= (t >= stretch.start.timestamp()) & (t <= stretch.end.timestamp())
        # At each edge the two may differ by a tenth of a second. Only the cable may take more.
        edges = 1 + 2 * (len(found.intervals) + len(found.lost))
        assert np.count_nonzero(inside & ~allowed) * step <= edges * max(0.1, step)
        if "cable" not in found.reasons:
            assert np.count_nonzero(allowed & ~inside) * step <= edges * max(0.1, step)
        reached += bool(found.intervals)
    assert reached >= 2


# --- the cable against brute force


def best_by_brute_force(t, dish, allowed, low, high, rewind_s):
    """The longest time that can be followed: every choice of a turn at each sample, a rewind between two."""
    turns = range(-3, 4)
    best = {}
    for i in range(len(t)):
        for turn in turns:
            options = [0.0]
            inside = allowed[i] and low <= dish[i] + 360 * turn <= high
            if i:
                was = allowed[i - 1] and low <= dish[i - 1] + 360 * turn <= high
                options = [best[i - 1, turn] + (t[i] - t[i - 1] if inside and was else 0.0)]
            options += [
                best[j, other] for other in turns for j in range(i)
                if other != turn and t[i] - t[j] >= abs(other - turn) * rewind_s
            ]  # fmt: skip
            best[i, turn] = max(options)
    return max(best[len(t) - 1, turn] for turn in turns)


@given(
    start=st.floats(0.0, 360.0), swing=st.floats(-300.0, 300.0), low=st.floats(-500.0, 0.0),
    span=st.floats(200.0, 500.0),
    gap=st.tuples(st.integers(0, 20), st.integers(0, 8)), rate=st.sampled_from([10.0, 40.0]),
)  # fmt: skip
def test_the_cable_follows_as_long_as_brute_force(start, swing, low, span, gap, rate):
    t = np.arange(0.0, 75.0, 3.0)
    dish = start + swing * np.arange(len(t)) / len(t)
    allowed = np.ones(len(t), dtype=bool)
    allowed[gap[0] : gap[0] + gap[1]] = False
    limits = ReachLimits(cable_min_deg=low, cable_max_deg=low + span, turn_known=True, az_rate_deg_s=rate)
    runs = runs_of(t, dish, allowed, limits)
    followed = 0.0
    for run in runs:
        (turn,) = run.turns
        inside = allowed & (dish + 360 * turn >= low) & (dish + 360 * turn <= low + span)
        part = inside[run.first : run.last + 1]
        followed += float(np.sum((part[1:] & part[:-1]) * np.diff(t[run.first : run.last + 1])))
    for before, after in itertools.pairwise(runs):
        wait = abs(after.turns[0] - before.turns[0]) * max(span, 360.0) / rate
        assert t[after.first] - t[before.last] >= wait - 1e-9
    assert followed == pytest.approx(best_by_brute_force(t, dish, allowed, low, low + span, max(span, 360.0) / rate))


# --- the rate limit


@given(
    wanted=st.lists(st.floats(-90.0, 90.0), min_size=4, max_size=14), room=st.floats(0.1, 20.0),
    rate=st.floats(1.0, 20.0),
)  # fmt: skip
def test_the_keyhole_is_a_shortest_window_and_its_rest_can_be_followed(wanted, room, rate):
    t = np.arange(len(wanted), dtype=float)
    low, high = np.array(wanted) - room, np.array(wanted) + room

    def feasible(keep):
        return all(low[j] - high[i] <= rate * abs(t[i] - t[j]) + 1e-6 for i in keep for j in keep)

    spans = too_fast(t, low, high, rate)
    gone = {i for i in range(len(t)) for start, end in spans if start < t[i] < end}
    gone |= {0} if spans and spans[0][0] == t[0] and not feasible(sorted(set(range(len(t))) - gone)) else set()
    gone |= (
        {len(t) - 1} if spans and spans[-1][1] == t[-1] and not feasible(sorted(set(range(len(t))) - gone)) else set()
    )
    assert feasible([i for i in range(len(t)) if i not in gone])
    if len(spans) == 1:
        windows = [(a, b) for a in range(len(t)) for b in range(a, len(t))]
        good = [(a, b) for a, b in windows if feasible([i for i in range(len(t)) if not a <= i <= b])]
        shortest = min(t[min(b + 1, len(t) - 1)] - t[max(a - 1, 0)] for a, b in good)
        assert spans[0][1] - spans[0][0] == pytest.approx(shortest)
    if not spans:
        assert feasible(range(len(t)))


@given(el=st.floats(0.0, 89.9), tolerance=st.floats(0.2, 5.0), ceiling=st.sampled_from([65.0, 80.0, 90.0]))
def test_the_room_in_azimuth_is_the_widest_that_keeps_the_tolerance(el, tolerance, ceiling):
    el = min(el, ceiling)
    room = float(azimuth_room(np.array([el]), tolerance, ceiling)[0])
    heights = np.radians(np.linspace(max(el - tolerance, -90.0), min(el + tolerance, ceiling), 400))

    def nearest(d_az):
        cosine = np.sin(np.radians(el)) * np.sin(heights) + np.cos(np.radians(el)) * np.cos(heights) * np.cos(
            np.radians(d_az)
        )
        return np.degrees(np.arccos(np.clip(cosine.max(), -1, 1)))

    assert nearest(room) <= tolerance + 1e-3
    if room < 179.9:
        assert nearest(min(room * 1.02 + 0.05, 180.0)) > tolerance - 1e-6
