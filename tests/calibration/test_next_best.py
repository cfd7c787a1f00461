"""The next object is the one after which the whole sky is known best."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.config import FeedProfile
from birdcage.base.config.feeds import STOCK_FEED
from birdcage.base.config.sections import AlignmentSettings
from birdcage.calibration.candidates import CalibrationObject, candidates
from birdcage.calibration.fit import fit
from birdcage.calibration.next_best import enough, rank, sky_error_deg
from birdcage.calibration.peak import MeasuredPeak
from birdcage.calibration.terms import priors_of
from birdcage.sky.observer import Observer
from birdcage.sky.targets.model import Fixed

WHEN = datetime(2026, 3, 20, 18, 30, tzinfo=UTC)
HERE = Observer(39.1, -95.7)
REACH = (18.0, 65.0)


def at(az, el, sigma=0.1):
    return CalibrationObject(Fixed(f"{az:.0f}/{el:.0f}", az, el), az, el, sigma, None)


def peak(az, el, sigma=0.1):
    return MeasuredPeak(WHEN, "x", az, el, az, el, sigma)


def order(found, peaks):
    priors = priors_of(AlignmentSettings(), peaks)
    return [each.candidate.name for each in rank(found, peaks, priors, Alignment(), REACH)]


def test_the_one_across_the_sky_comes_before_the_one_beside():
    peaks = [peak(150.0, 35.0), peak(180.0, 40.0)]
    assert order([at(165.0, 38.0), at(60.0, 30.0), at(185.0, 40.0)], peaks)[0] == "60/30"


def test_a_faint_one_is_worth_less():
    assert order([at(60.0, 30.0, sigma=3.0), at(150.0, 30.0)], [peak(180.0, 40.0)])[0] == "150/30"


def now(peaks, settings=None):
    """The error to expect over the sky with these peaks."""
    settings = settings or AlignmentSettings()
    return rank([at(60.0, 30.0)], peaks, priors_of(settings, peaks), Alignment(), REACH)[0].error_now_deg


def test_what_is_promised_is_what_comes():
    peaks = [peak(180.0, 40.0), peak(230.0, 30.0)]
    best = rank([at(60.0, 30.0)], peaks, priors_of(AlignmentSettings(), peaks), Alignment(), REACH)[0]
    assert best.error_then_deg == pytest.approx(now([*peaks, peak(60.0, 30.0)]))
    assert 0.0 < best.gain_deg < best.error_now_deg


def test_a_fit_is_as_good_as_was_promised():
    peaks = [peak(180.0, 40.0), peak(230.0, 30.0), peak(60.0, 30.0), peak(120.0, 50.0)]
    fitted = fit(peaks, priors_of(AlignmentSettings(), peaks), Alignment())
    assert sky_error_deg(fitted, REACH) == pytest.approx(now(peaks))


def test_a_base_that_was_leveled_is_known_better_from_the_start():
    one = [peak(180.0, 40.0)]
    assert now(one, AlignmentSettings(pitch_deg=0.0, roll_deg=0.0)) < now(one) / 2


def test_only_what_the_feed_may_hear_and_the_dish_reaches():
    everywhere = lambda _az, _el: True  # noqa: E731
    ku = {each.name for each in candidates(HERE, WHEN, STOCK_FEED, everywhere)}
    assert "Sun" in ku
    assert any("EchoStar 10" in name for name in ku)
    assert not any("Galaxy 3C" in name for name in ku), "linear, below 12.2 GHz"
    linear = FeedProfile(freq_min_hz=11.7e9, freq_max_hz=12.2e9, polarization="linear")
    fss = {each.name for each in candidates(HERE, WHEN, linear, everywhere)}
    assert any("Galaxy 3C" in name for name in fss)
    assert not any("EchoStar 10" in name for name in fss)
    assert not any("GOES" in name or "formerly" in name or "Astra" in name for name in ku)
    l_band = {
        each.name for each in candidates(HERE, WHEN, FeedProfile(freq_min_hz=1.6e9, freq_max_hz=1.72e9), everywhere)
    }
    assert any("GOES" in name for name in l_band)
    assert not any("SES 1" in name for name in l_band)
    anything = {each.name for each in candidates(HERE, WHEN, FeedProfile(), everywhere)}
    assert anything > l_band
    south = candidates(HERE, WHEN, STOCK_FEED, lambda az, _el: 170.0 < az < 190.0)
    assert south
    assert all(170.0 < each.az_deg < 190.0 for each in south)


def test_the_air_lifts_what_is_low():
    sun = next(each for each in candidates(HERE, WHEN, STOCK_FEED, lambda _az, _el: True) if each.name == "Sun")
    bare = next(
        each for each in candidates(HERE, WHEN, STOCK_FEED, lambda _az, _el: True, "none") if each.name == "Sun"
    )
    assert 0.01 < sun.el_deg - bare.el_deg < 0.1


def test_many_peaks_are_enough():
    some = [peak(180.0, 40.0), peak(230.0, 30.0)]
    many = [peak(az, el) for az in range(0, 360, 30) for el in (25.0, 50.0)]
    across = [at(60.0, 30.0)]
    assert not enough(rank(across, some, priors_of(AlignmentSettings(), some), Alignment(), REACH))
    assert enough(rank(across, many, priors_of(AlignmentSettings(), many), Alignment(), REACH))
