"""The peak that is held: an average, not the highest reading; its direction; which part of it is heard now."""

from __future__ import annotations

import math
import random

import pytest
from birdcage.signal.peak_hold import STEP_S, PeakHold, Trend
from birdcage.signal.source import Scale

NOISE = 0.65


class Beam:
    """A satellite of so many counts at azimuth 180, elevation 40, heard ten times a second through a beam of 6.4°."""

    def __init__(self, counts=150.0, floor=400.0, seed=1, hz=10.0):
        self.counts, self.floor, self.period_s, self.rng = counts, floor, 1.0 / hz, random.Random(seed)
        self.at, self.hold = 1000.0, PeakHold(None)

    def level(self, az_deg, el_deg):
        off2 = ((az_deg - 180.0) * math.cos(math.radians(40.0))) ** 2 + (el_deg - 40.0) ** 2
        return self.floor + self.counts * math.exp(-4.0 * math.log(2.0) * off2 / 6.4**2)

    def listen(self, az_deg, el_deg, seconds=2.0):
        for _ in range(round(seconds / self.period_s)):
            self.at += self.period_s
            self.hold.hear(self.at, self.level(az_deg, el_deg) + self.rng.gauss(0.0, NOISE), az_deg, el_deg)
        return self.hold.now()


def test_nothing_is_known_before_the_first_reading():
    assert PeakHold(None).now() is None


def test_of_noise_alone_no_part_of_a_peak_is_claimed_and_no_step_is_hotter():
    beam = Beam(counts=0.0)
    for step in range(60):
        now = beam.listen(170.0 + 0.2 * step, 40.0)
        assert now.share is None
    assert now.noise == pytest.approx(NOISE, rel=0.15)
    assert now.floor == pytest.approx(400.0, abs=0.7)
    trends = []
    for seed in range(200):
        one = Beam(counts=0.0, seed=seed)
        one.listen(180.0, 40.0)
        trends.append(one.listen(180.2, 40.0).trend)
    assert sum(trend is not Trend.SAME for trend in trends) <= 12


def test_the_peak_is_where_the_signal_was_strongest_and_the_share_follows_the_beam():
    beam = Beam()
    beam.listen(165.0, 40.0, 5.0)
    for az_deg in (176.0, 178.0, 179.0, 180.0, 181.0, 182.0):
        beam.listen(az_deg, 40.0)
    now = beam.listen(183.2, 40.0)
    assert (now.peak.az_deg, now.peak.el_deg) == (180.0, 40.0)
    assert now.peak.value == pytest.approx(550.0, abs=0.7)
    assert now.share == pytest.approx((beam.level(183.2, 40.0) - 400.0) / 150.0, abs=0.02)
    assert now.level == pytest.approx(beam.level(183.2, 40.0), abs=1.0)


def test_each_step_towards_it_is_hotter_and_away_from_it_colder():
    beam = Beam()
    beam.listen(177.0, 40.0)
    assert beam.listen(178.0, 40.0).trend is Trend.HOTTER
    assert beam.listen(177.0, 40.0).trend is Trend.COLDER
    assert beam.listen(177.0, 41.0).trend is Trend.COLDER


def test_a_signal_that_outruns_the_averaged_peak_is_the_peak_and_no_more():
    beam = Beam()
    beam.listen(170.0, 40.0, 5.0)
    beam.listen(176.0, 40.0, 3.0)
    shares = [beam.listen(180.0, 40.0, 0.1).share for _ in range(20)]
    assert max(shares) == 1.0
    assert min(shares) > 0.98


def test_what_a_step_did_is_told_for_a_while_and_again_after_the_next():
    beam = Beam()
    beam.listen(177.0, 40.0)
    assert beam.listen(178.0, 40.0, STEP_S).trend is Trend.HOTTER
    assert beam.listen(178.0, 40.0, 1.0).trend is Trend.SAME
    assert beam.listen(177.0, 40.0).trend is Trend.COLDER


def test_one_wild_reading_is_no_peak():
    beam = Beam()
    beam.listen(165.0, 40.0, 10.0)
    beam.listen(180.0, 40.0)
    beam.listen(165.0, 40.0)
    beam.at += 0.1
    beam.hold.hear(beam.at, 650.0, 165.0, 40.0)
    now = beam.listen(165.0, 40.0, 5.0)
    assert now.peak.az_deg == 180.0


def test_forgetting_begins_anew():
    beam = Beam()
    beam.listen(180.0, 40.0)
    beam.listen(165.0, 40.0)
    beam.hold.forget()
    assert beam.hold.now() is None
    assert beam.listen(170.0, 40.0).peak.az_deg == 170.0


def test_the_rate_is_what_really_came():
    assert Beam(hz=8.0).listen(180.0, 40.0, 10.0).rate_hz == pytest.approx(8.0, rel=0.05)
    slow = Beam(hz=1.0)
    assert slow.listen(180.0, 40.0, 10.0).rate_hz == pytest.approx(1.0, rel=0.05)


def test_a_source_that_tells_once_a_second_has_a_peak_too():
    beam = Beam(hz=1.0)
    for az_deg in (170.0, 175.0, 180.0, 185.0):
        now = beam.listen(az_deg, 40.0, 4.0)
    assert now.peak.az_deg == 180.0
    assert now.share is not None


def test_decibels_are_powers():
    hold = PeakHold(Scale.LOG)
    for index, value in enumerate((-50.0, -50.01, -50.0, -49.99, -40.0, -40.0, -40.01)):
        hold.hear(float(index), value, 100.0 if value < -45.0 else 110.0, 30.0)
    for index in range(7, 11):
        hold.hear(float(index), -43.0103, 105.0, 30.0)
    assert hold.now().share == pytest.approx((10**-4.30103 - 1e-5) / (1e-4 - 1e-5), abs=0.01)


def test_across_north_a_direction_is_the_same():
    hold = PeakHold(None)
    for index, az_deg in enumerate((359.99, 0.0, 0.01, 359.99, 0.0)):
        hold.hear(0.1 * index, 400.0 + index % 2, az_deg, 30.0)
    assert hold.now().noise is not None


def test_without_a_direction_level_and_peak_hold_all_the_same():
    hold = PeakHold(None)
    for index in range(40):
        hold.hear(0.1 * index, 400.0 + index % 2)
    assert hold.now().peak.az_deg is None
    assert hold.now().trend is Trend.SAME


def around(beam):
    """Listen at eight directions around a satellite, none of them on it, as a person who searches does."""
    for az_deg, el_deg in ((176.5, 38.0), (179.0, 38.0), (182.0, 38.0), (184.0, 40.5), (182.0, 42.5), (178.0, 42.5)):
        beam.listen(az_deg, el_deg, 2.5)
    return beam.listen(176.0, 41.0, 2.5)


def test_the_middle_is_known_before_anybody_has_pointed_there():
    now = around(Beam())
    assert (now.fit.az_deg, now.fit.el_deg) == (pytest.approx(180.0, abs=0.15), pytest.approx(40.0, abs=0.1))
    assert now.fit.sigma_deg < 0.15
    assert now.peak.az_deg != 180.0


def test_of_noise_no_middle_is_claimed():
    assert all(around(Beam(counts=0.0, seed=seed)).fit is None for seed in range(30))


def test_decibels_are_fitted_as_powers():
    rng, hold, at = random.Random(1), PeakHold(Scale.LOG), 0.0
    beam = Beam(counts=8.0, floor=1.0)
    for az_deg, el_deg in [(176.0 + 2.0 * i, 37.0 + 3.0 * j) for i in range(5) for j in range(3)]:
        for _ in range(12):
            at += 0.1
            hold.hear(at, 10.0 * math.log10(beam.level(az_deg, el_deg)) + rng.gauss(0.0, 0.1), az_deg, el_deg)
    fit = hold.now().fit
    assert (fit.az_deg, fit.el_deg) == (pytest.approx(180.0, abs=0.1), pytest.approx(40.0, abs=0.1))
    assert fit.width_deg == pytest.approx(6.4, rel=0.05)


def test_two_satellites_heard_in_turn_are_not_taken_for_one_between_them():
    for seed in range(10):
        beam = Beam(seed=seed)
        around(beam)
        here, beam.level = beam.level, lambda az_deg, el_deg, level=beam.level: level(az_deg - 14.0, el_deg)
        for az_deg, el_deg in (
            (190.5, 38.0),
            (193.0, 38.0),
            (196.0, 38.0),
            (198.0, 40.5),
            (196.0, 42.5),
            (192.0, 42.5),
        ):
            now = beam.listen(az_deg, el_deg, 2.5)
        assert now.fit is None or min(abs(now.fit.az_deg - at) for at in (180.0, 194.0)) < 1.0
        assert here(180.0, 40.0) == pytest.approx(550.0)
