"""A satellite that has re-entered by its own elements says so, though SGP4 still answers."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta

import pytest
from birdcage.sky.age import error_values, expected_error
from birdcage.sky.decay import reentry, reentry_warning, reentry_words
from birdcage.sky.frozen import frozen
from birdcage.sky.observer import Observer
from birdcage.sky.targets.model import Satellite

ISS = next(each for each in frozen() if each.norad_id == 25544)
METOP = next(each for each in frozen() if each.norad_id == 38771)
HERE = Observer(52.0, 5.0)


def after(elements, days):
    return elements.epoch + timedelta(days=days)


def test_sgp4_still_answers_where_the_hint_begins():
    when = after(ISS, 2000)
    assert Satellite(ISS).look(HERE, when).range_km > 0.0
    at = reentry(ISS, when)
    assert at is not None
    assert timedelta(days=1900) < at - ISS.epoch < timedelta(days=2000)
    assert reentry(ISS, after(ISS, 1800)) is None


def test_it_is_useless_with_a_reason_instead_of_a_number():
    found = expected_error(ISS, after(ISS, 2000))
    assert (found.grade, found.glyph, found.pointing_median_deg) == ("useless", "✗", None)
    assert found.words == "2000 d old, by its elements it re-entered about 1 March 2032, unless it was boosted"
    assert error_values(found)["reentry_by_elements"] == "2032-03-01"


def test_high_orbits_and_young_elements_get_no_hint():
    assert reentry(METOP, after(METOP, 3228)) is None
    assert reentry(ISS, after(ISS, 3)) is None
    assert all(reentry(each, after(each, 3228)) is None for each in frozen() if each.mean_motion_rev_day < 6.4)
    assert reentry(ISS, after(ISS, -400)) is None


def test_a_published_decay_counts_where_the_drag_term_is_missing():
    sinking = replace(ISS, bstar=0.0, mean_motion_dot=2e-3)
    at = reentry(sinking, after(sinking, 400))
    assert at is not None
    assert (at - sinking.epoch).days == pytest.approx((16.49 - ISS.mean_motion_rev_day) / 4e-3, rel=0.02)
    assert reentry(replace(sinking, mean_motion_dot=0.0), after(sinking, 400)) is None


def test_elements_that_are_no_orbit_are_not_taken_for_a_re_entry():
    assert reentry(replace(ISS, eccentricity=1.2), after(ISS, 30)) is None


def test_what_is_lower_than_any_orbit_lasts_comes_down_now():
    low = replace(ISS, mean_motion_rev_day=16.5)
    assert reentry(low, after(low, 0.1)) == low.epoch
    assert reentry_words(low.epoch, after(low, 0.1)) == "by its elements it re-enters about now, unless it is boosted"


def test_the_warning_names_each_once_and_at_most_four():
    when = after(ISS, 2000)
    assert reentry_warning([(METOP, when)]) is None
    rows = [(replace(ISS, name=name), when) for name in ("A", "B", "A", "C", "D", "E", "F")]
    assert ": A, B, C, D, 2 more. `birdcage elements update`" in reentry_warning(rows)
