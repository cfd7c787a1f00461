"""What the reference crosses of a map tell, and the map without the drift that they tell."""

import math
from datetime import timedelta

import pytest
from birdcage.skymap.drift import crosses_in, drift_of, without_drift
from birdcage.skymap.plan import MapPlan
from birdcage.skymap.sky_map import SkyMap

from tests.skymap.made import BEGUN, sample

AZ, EL, WIDTH, FLOOR, RISE = 170.0, 40.0, 6.0, 400.0, 150.0
STEPS = (-4.0, -2.0, 0.0, 2.0, 4.0)


def level(az_deg, el_deg, gain=1.0, right_deg=0.0):
    x = (az_deg - AZ) * math.cos(math.radians(EL)) - right_deg
    return gain * (FLOOR + RISE * math.exp(-4.0 * math.log(2.0) * (x * x + (el_deg - EL) ** 2) / WIDTH**2))


def cross(number, at_s, **how):
    across = [(AZ + step / math.cos(math.radians(EL)), EL) for step in STEPS]
    up = [(AZ, EL + step) for step in STEPS]
    return [
        sample(None, az, el, level(az, el, **how), cross_number=number, utc=BEGUN + timedelta(seconds=at_s))
        for az, el in across + up
    ]


def drifting(gain_at):
    """A map of twenty directions, whose gain is `gain_at` seconds, with a cross before and one after."""
    plan = MapPlan(165.0, 184.0, 40.0, 40.0, 1.0)
    samples = tuple(
        sample(cell, *plan.at(cell), level(*plan.at(cell), gain=gain_at(100.0 + 10.0 * cell)),
               utc=BEGUN + timedelta(seconds=100.0 + 10.0 * cell))
        for cell in plan.sequence
    )  # fmt: skip
    crosses = (*cross(0, 100.0, gain=gain_at(100.0)), *cross(1, 290.0, gain=gain_at(290.0)))
    return SkyMap(1, plan, BEGUN, None, "tuner", "counts", False, True, samples=samples, crosses=crosses)


def made_in(sky_map):
    return crosses_in(sky_map.crosses, decibels=sky_map.decibels)


def changes_in(sky_map):
    return drift_of(made_in(sky_map), decibels=sky_map.decibels)


def test_a_cross_finds_its_source():
    made = made_in(drifting(lambda _s: 1.0))
    assert [each.number for each in made] == [0, 1]
    assert made[0].fit.az_deg == pytest.approx(AZ, abs=0.05)
    assert made[0].fit.rise == pytest.approx(RISE, rel=0.05)


def test_gain_that_falls_is_told_and_taken_out():
    drift = drifting(lambda at_s: 1.0 - (at_s - 100.0) / 1000.0)
    assert [round(each.gain, 3) for each in changes_in(drift)] == [1.0, 0.81]
    assert not any(each.lost_steps for each in changes_in(drift))
    flat = without_drift(drift)
    assert max(each.value for each in drift.samples) - min(each.value for each in drift.samples) > 100.0
    for each in flat.samples:
        assert each.value == pytest.approx(level(each.az_deg, each.el_deg), abs=1.5)
    assert flat.about["drift_removed"] is True


def test_a_dish_that_lost_steps_is_told():
    still = drifting(lambda _s: 1.0)
    lost = SkyMap(1, still.plan, BEGUN, None, "tuner", "counts", False, True,
                  crosses=(*cross(0, 0.0), *cross(1, 3600.0, right_deg=0.8)))  # fmt: skip
    drift = changes_in(lost)[1]
    assert drift.right_deg == pytest.approx(0.8, abs=0.05)
    assert drift.lost_steps


def test_decibels_have_the_gain_subtracted():
    def decibels(samples):
        return tuple(
            sample(each.cell, each.az_deg, each.el_deg, 10.0 * math.log10(each.value), utc=each.utc, scatter=None,
                   cross_number=each.cross_number)
            for each in samples
        )  # fmt: skip

    linear = drifting(lambda at_s: 1.0 - (at_s - 100.0) / 1000.0)
    told = SkyMap(1, linear.plan, BEGUN, None, "rigctl", "dB", True, True, samples=decibels(linear.samples),
                  crosses=decibels(linear.crosses))  # fmt: skip
    for each in without_drift(told).samples:
        assert each.value == pytest.approx(10.0 * math.log10(level(each.az_deg, each.el_deg)), abs=0.06)


def test_one_cross_alone_takes_nothing_out():
    sky_map = drifting(lambda _s: 1.0)
    lone = SkyMap(1, sky_map.plan, BEGUN, None, "tuner", "counts", False, True, samples=sky_map.samples,
                  crosses=sky_map.crosses[:10])  # fmt: skip
    assert without_drift(lone) is lone
