"""What a fit makes of positions that were read while an axis moved."""

from __future__ import annotations

import random

import pytest
from birdcage.diagnostics.motion_fit import MeasuredWay, TimedReading, fit_motion
from birdcage.kinematics import plan_slew


def ways(speed, acceleration, way_deg, count=3, share=1.0, seed=1, longest_s=0.1):
    """Make ways as a dish would print them; `share` of an exchange after which it reads, None for any."""
    rng, made = random.Random(seed), []
    for number in range(count):
        start_s, end_deg = 100.0 * number + rng.uniform(0.0, 1.0), way_deg + 0.03
        slew = plan_slew(0.0, end_deg, speed, acceleration)
        now_s, readings = start_s - 0.3, []
        while now_s < start_s + slew.duration_s + 0.5:
            lasts_s = rng.uniform(0.02, longest_s)
            at_s = now_s + lasts_s * (rng.random() if share is None else share)
            readings.append(TimedReading(now_s, now_s + lasts_s, round(slew.at(at_s - start_s)[0], 2)))
            now_s += lasts_s + 0.002
        made.append(MeasuredWay(0.0, end_deg, tuple(readings)))
    return made


@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
@pytest.mark.parametrize(("speed", "acceleration", "way_deg"), [
    (65.0, 400.0, 60.0), (45.0, 400.0, 46.0), (20.0, 100.0, 60.0), (80.0, 250.0, 60.0), (2.0, 1.0, 30.0),
])  # fmt: skip
def test_the_true_figures_are_found(speed, acceleration, way_deg, share):
    fit = fit_motion(ways(speed, acceleration, way_deg, share=share))
    assert fit.speed_deg_s == pytest.approx(speed, rel=0.005)
    assert fit.acceleration_deg_s2 == pytest.approx(acceleration, rel=0.02)
    assert fit.rms_deg < 0.02


def test_the_other_way_is_the_same():
    turned = [
        MeasuredWay(0.0, -way.end_deg, tuple(TimedReading(e.asked_s, e.answered_s, -e.deg) for e in way.readings))
        for way in ways(65.0, 400.0, 60.0)
    ]
    assert fit_motion(turned).speed_deg_s == pytest.approx(65.0, rel=0.005)


@pytest.mark.parametrize("seed", range(6))
def test_where_no_time_of_reading_is_known_the_sigma_says_so(seed):
    fit = fit_motion(ways(65.0, 400.0, 60.0, share=None, seed=seed))
    assert abs(fit.speed_deg_s - 65.0) < 4.0 * fit.speed_sigma
    assert fit.speed_sigma > 0.2
    assert fit.rms_deg > 0.3


@pytest.mark.parametrize("seed", range(4))
def test_a_way_that_never_reaches_its_greatest_speed_tells_none(seed):
    fit = fit_motion(ways(65.0, 400.0, 8.0, seed=seed))
    assert (fit.speed_deg_s, fit.speed_sigma) == (None, None)
    assert fit.acceleration_deg_s2 == pytest.approx(400.0, rel=0.03)


def test_ramps_that_no_reading_saw_tell_no_acceleration():
    fit = fit_motion(ways(20.0, 40000.0, 60.0))
    assert fit.speed_deg_s == pytest.approx(20.0, rel=0.01)
    assert (fit.acceleration_deg_s2, fit.acceleration_sigma) == (None, None)


def test_too_few_readings_tell_nothing():
    one = ways(65.0, 400.0, 60.0, count=1)[0]
    fit = fit_motion([MeasuredWay(0.0, one.end_deg, one.in_motion[::5])])
    assert (fit.speed_deg_s, fit.acceleration_deg_s2, fit.readings) == (None, None, 0)
    assert fit_motion([MeasuredWay(0.0, 0.0, one.readings[:2])]).readings == 0
    assert fit_motion([]).readings == 0


def test_a_damaged_digit_counts_for_nothing():
    made = ways(65.0, 400.0, 60.0)
    readings = list(made[1].readings)
    middle = len(readings) // 2
    readings[middle] = TimedReading(readings[middle].asked_s, readings[middle].answered_s, readings[middle].deg + 9.0)
    whole = fit_motion(made)
    damaged = fit_motion([made[0], MeasuredWay(0.0, made[1].end_deg, tuple(readings)), made[2]])
    assert damaged.readings == whole.readings - 1
    assert damaged.speed_deg_s == pytest.approx(65.0, rel=0.005)


def test_readings_at_rest_do_not_make_it_look_surer():
    one = ways(65.0, 400.0, 60.0, count=1, share=None)[0]
    last = one.readings[-1]
    longer = one.readings + tuple(
        TimedReading(last.answered_s + n, last.answered_s + n + 0.05, last.deg) for n in range(50)
    )
    assert fit_motion([MeasuredWay(0.0, one.end_deg, longer)]) == fit_motion([one])
