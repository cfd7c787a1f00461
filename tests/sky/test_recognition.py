"""Which satellite somebody follows: the right one, or none."""

from __future__ import annotations

import random
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import Fleet, track
from birdcage.sky.recognition import AskedDirection, recognise

HERE = Observer(52.0, 5.0)
START = datetime(2026, 11, 24, tzinfo=UTC)


def low_orbits(count, seed=3):
    """Orbits in the shells in which most satellites are."""
    dice = random.Random(seed)
    return [
        ElementSet(
            f"LOW {number}", number, START - timedelta(hours=dice.uniform(0.0, 72.0)),
            dice.choice((43.0, 53.0, 70.0, 86.4, 97.6, 98.2)), dice.uniform(0.0, 360.0), dice.uniform(0.0, 0.004),
            dice.uniform(0.0, 360.0), dice.uniform(0.0, 360.0), dice.uniform(13.5, 15.6), 1e-5,
        )
        for number in range(1, count + 1)
    ]  # fmt: skip


ORBITS = low_orbits(3000)
FLEET = Fleet(ORBITS)


class Sky:
    """The way of one satellite, as a program that follows it computes it."""

    def __init__(self, elements, begin_s, seconds=900.0):
        seen = track(elements, HERE, np.arange(begin_s - 10.0, begin_s + seconds, 0.5))
        self._t_s, self._az, self._el = seen.t_s, np.unwrap(seen.az_deg, period=360.0), seen.el_deg
        below = np.flatnonzero((seen.el_deg < 0.0) & (seen.t_s > begin_s + 60.0))
        self.end_s = float(seen.t_s[below[0]] if len(below) else seen.t_s[-1])

    def at(self, t_s):
        return float(np.interp(t_s, self._t_s, self._az)) % 360.0, float(np.interp(t_s, self._t_s, self._el))


def passes(count, seed, orbits=ORBITS, fleet=FLEET):
    """Return satellites that rise, with when each is seen low in the sky."""
    dice, found = random.Random(seed), []
    while len(found) < count:
        at = START + timedelta(seconds=dice.uniform(0.0, 86_400.0))
        seen = fleet.look(HERE, at)
        up = np.flatnonzero((seen.el_deg > 3.0) & (seen.el_deg < 25.0) & (seen.range_rate_km_s < -3.0))
        if len(up):
            found.append((int(dice.choice(up.tolist())), at.timestamp()))
    return found


def wishes_for_now(sky, begin_s, end_s, dice, *, every_s=1.0, threshold_deg=0.0, digits=2, late_s=0.15, lead_s=0.0):
    asked, told, t_s = [], (-999.0, 0.0), begin_s
    while t_s < end_s:
        az, el = (round(angle, digits) for angle in sky.at(t_s + lead_s))
        if max(abs(az - told[0]), abs(el - told[1])) > threshold_deg:
            told = az, el
            asked.append(AskedDirection(t_s + dice.uniform(0.0, late_s), az % 360.0, el))
        t_s += every_s
    return asked


def wishes_of_gpredict(sky, begin_s, end_s, dice, threshold_deg):
    """Gpredict's (reference 2.1): beyond the threshold, where that is reached again; sent up to 1.6 s later."""
    asked, told, t_s = [], (-999.0, 0.0), begin_s
    while t_s < end_s:
        az, el = sky.at(t_s)
        if max(abs(az - told[0]), abs(el - told[1])) > threshold_deg:
            ahead_s = step_s = (sky.end_s - t_s) / 2.0
            found = az, el
            while step_s > 0.25:
                found = sky.at(t_s + ahead_s)
                off = abs(az - found[0]) > threshold_deg or abs(el - found[1]) > threshold_deg or found[1] < 0.0
                step_s /= 2.0
                ahead_s += -step_s if off else step_s
            told = round(found[0], 2), max(round(found[1], 2), 0.0)
            asked.append(AskedDirection(t_s + dice.uniform(0.0, 1.6), *told))
        t_s += 1.0
    return asked


PROGRAMS = {
    "Gpredict, 5": lambda *of: wishes_of_gpredict(*of, 5.0),
    "Gpredict, 2.5": lambda *of: wishes_of_gpredict(*of, 2.5),
    "Gpredict, 1": lambda *of: wishes_of_gpredict(*of, 1.0),
    "SatNOGS": lambda *of: wishes_for_now(*of, every_s=3.0, threshold_deg=4.0),
    "SatDump": wishes_for_now,
    "to a tenth": lambda *of: wishes_for_now(*of, digits=1),
    "ahead by its own latency": lambda *of: wishes_for_now(*of, lead_s=0.7),
}


def recognised(asked, fleet=FLEET, offsets=None):
    """Return what is recognised first as the wishes come, and after how many."""
    for count in range(3, len(asked) + 1):
        if (found := recognise(fleet, HERE, asked[:count], offsets)) is not None:
            return found, count
    return None, len(asked)


@pytest.mark.parametrize("program", PROGRAMS)
def test_of_three_thousand_it_is_the_right_one(program):
    dice, right = random.Random(7), 0
    for index, begin_s in passes(6, 11):
        sky = Sky(ORBITS[index], begin_s)
        asked = PROGRAMS[program](sky, begin_s, min(sky.end_s, begin_s + 240.0), dice)
        found, _ = recognised(asked[:: 1 if len(asked) < 60 else 3])
        assert found is None or found.index == index
        right += found is not None
    assert right >= 5, "and that of nearly all"


@pytest.mark.parametrize("program", PROGRAMS)
def test_one_that_is_not_in_the_catalogue_is_taken_for_no_other(program):
    dice = random.Random(5)
    for index, begin_s in passes(4, 23):
        sky = Sky(ORBITS[index], begin_s)
        others = Fleet([*ORBITS[:index], *ORBITS[index + 1 :]])
        asked = PROGRAMS[program](sky, begin_s, sky.end_s, dice)
        found, _ = recognised(asked[:: 1 if len(asked) < 60 else 9], others)
        assert found is None


def test_the_threshold_of_gpredict_is_told_and_what_its_steps_leave():
    index, begin_s = passes(1, 11)[0]
    sky = Sky(ORBITS[index], begin_s)
    found, count = recognised(wishes_of_gpredict(sky, begin_s, sky.end_s, random.Random(1), 5.0))
    assert found.threshold_deg == pytest.approx(5.0, abs=0.5)
    assert 1.0 < found.steps_deg < 4.5
    assert count <= 6
    assert found.chance < 1e-4
    now, _ = recognised(wishes_for_now(sky, begin_s, sky.end_s, random.Random(1)))
    assert now.threshold_deg is None


def test_across_north_too():
    dice, seen = random.Random(2), 0
    for index, begin_s in passes(40, 31):
        sky = Sky(ORBITS[index], begin_s)
        azimuths = [sky.at(t_s)[0] for t_s in np.arange(begin_s, sky.end_s, 5.0)]
        if max(azimuths) < 350.0 or min(azimuths) > 10.0:
            continue
        seen += 1
        found, _ = recognised(wishes_of_gpredict(sky, begin_s, sky.end_s, dice, 5.0))
        assert found is None or found.index == index
    assert seen >= 3


def test_a_time_offset_of_the_catalogue_counts():
    index, begin_s = passes(1, 11)[0]
    late = Sky(ORBITS[index], begin_s - 20.0)
    asked = [
        AskedDirection(each.t_s + 20.0, each.az_deg, each.el_deg)
        for each in wishes_for_now(late, begin_s - 20.0, begin_s + 200.0, random.Random(1))
    ]
    assert recognised(asked[::3])[0] is None
    assert recognised(asked[::3], offsets={index: 20.0})[0].index == index


def test_modules_of_one_station_are_one_and_the_first_of_them_counts():
    index, begin_s = passes(1, 11)[0]
    docked = replace(ORBITS[index], name="DOCKED", norad_id=90_000)
    fleet = Fleet([docked, *ORBITS])
    found, _ = recognised(wishes_for_now(Sky(docked, begin_s), begin_s, begin_s + 120.0, random.Random(1)), fleet)
    assert fleet[found.index].norad_id == ORBITS[index].norad_id


@pytest.mark.parametrize("gap_s", [1.0, 2.0, 5.0])
def test_of_a_train_it_is_the_right_one_or_none(gap_s):
    dice = random.Random(6)
    for index, begin_s in passes(4, 17):
        leader = ORBITS[index]
        behind_deg = 360.0 * gap_s / leader.period_s
        train = [replace(leader, norad_id=90_000 + place, mean_anomaly_deg=leader.mean_anomaly_deg - place * behind_deg)
                 for place in range(1, 6)]  # fmt: skip
        fleet = Fleet([*ORBITS[:index], *ORBITS[index + 1 :], *train])
        for program in ("Gpredict, 5", "Gpredict, 1", "SatDump", "SatNOGS"):
            asked = PROGRAMS[program](Sky(train[2], begin_s), begin_s, begin_s + 150.0, dice)
            found, _ = recognised(asked[:: 1 if len(asked) < 60 else 5], fleet)
            assert found is None or fleet[found.index].norad_id == 90_003


def test_what_is_fixed_or_goes_with_the_stars_is_no_satellite():
    begin_s = START.timestamp()
    dice = random.Random(9)
    for _ in range(20):
        az, el = dice.uniform(0.0, 360.0), dice.uniform(20.0, 70.0)
        star = [AskedDirection(begin_s + 2.0 * n, az + 2.0 * n / 240.0, el) for n in range(120)]
        assert recognised(star[::8])[0] is None
        assert recognise(FLEET, HERE, star) is None


def test_a_hand_that_scans_and_one_that_jumps_follow_nothing():
    dice, begin_s = random.Random(4), START.timestamp()
    for run in range(20):
        az, el, asked = dice.uniform(0.0, 360.0), dice.uniform(10.0, 60.0), []
        rate = dice.uniform(-0.8, 0.8), dice.uniform(-0.3, 0.3)
        for n in range(60):
            jump = dice.uniform(-5.0, 5.0) if run % 2 and n % 10 == 0 else 0.0
            az, el = (az + rate[0] + jump) % 360.0, min(max(el + rate[1], 1.0), 89.0)
            asked.append(AskedDirection(begin_s + 1.0 * n, round(az, 2), round(el, 2)))
        for count in range(5, 61, 5):
            assert recognise(FLEET, HERE, asked[:count]) is None


@pytest.mark.parametrize("asked", [
    [], [AskedDirection(START.timestamp(), 180.0, 45.0)],
    [AskedDirection(START.timestamp(), 180.0 + n, 45.0) for n in range(20)],
    [AskedDirection(START.timestamp() + n, 180.0 + n, -5.0) for n in range(20)],
], ids=["none", "one", "at once", "below"])  # fmt: skip
def test_too_little_tells_nothing(asked):
    assert recognise(FLEET, HERE, asked) is None
    assert recognise(Fleet([]), HERE, asked) is None
