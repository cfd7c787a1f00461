"""How far off old elements are: the station as measured, others in proportion, and nothing invented beyond."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.sky.age import expected_error
from birdcage.sky.elements import ElementSet

EPOCH = datetime(2026, 11, 14, 12, tzinfo=UTC)
STATION = ElementSet("ISS", 25544, EPOCH, 51.6, 0, 0.0005, 0, 0, 15.4995, mean_motion_dot=1.75e-4)
METOP = ElementSet("METOP-B", 38771, EPOCH, 98.7, 0, 0.0001, 0, 0, 14.215, mean_motion_dot=3e-6)
GPS = ElementSet("GPS", 28874, EPOCH, 55, 0, 0.01, 0, 0, 2.0057)
GOES = ElementSet("GOES 19", 60133, EPOCH, 0.1, 0, 0.0001, 0, 0, 1.0027)
MOLNIYA = ElementSet("ARKTIKA-M 1", 47719, EPOCH, 63, 0, 0.72, 270, 0, 2.006)


def after(elements, hours, range_km=None):
    return expected_error(elements, EPOCH + timedelta(hours=hours), range_km)


@pytest.mark.parametrize(
    ("hours", "median_km", "p90_km", "median_deg", "p90_deg"),
    [(6, 0.7, 2.3, 0.10, 0.31), (24, 1.9, 15.8, 0.26, 2.2), (48, 6.0, 104, 0.8, 14), (168, 125, 1818, 17, 77)],
)
def test_the_station_is_as_the_reference_measured_it(hours, median_km, p90_km, median_deg, p90_deg):
    found = after(STATION, hours, range_km=420.0)
    assert found.along_track_median_km == pytest.approx(median_km)
    assert found.along_track_p90_km == pytest.approx(p90_km)
    assert found.pointing_median_deg == pytest.approx(median_deg, rel=0.05)
    assert found.pointing_p90_deg == pytest.approx(p90_deg, rel=0.05)
    assert found.measured


def test_between_the_lines_of_the_table_it_lies_between_them_and_younger_than_the_first_it_stays():
    assert 1.9 < after(STATION, 36).along_track_median_km < 6.0
    assert after(STATION, 34).along_track_median_km == pytest.approx((1.9 * 6.0) ** 0.5, rel=0.01), "half way, in logs"
    assert after(STATION, 0).along_track_median_km == 0.7


def test_an_epoch_that_is_still_to_come_is_as_far_off_as_one_that_is_past():
    found = after(STATION, -24)
    assert found.along_track_median_km == after(STATION, 24).along_track_median_km
    assert found.age_s == -86400
    assert found.words.startswith("epoch 24 h ahead, ±0.2")


def test_grades_follow_the_error_and_have_each_their_glyph():
    grades = [(after(STATION, hours).grade, after(STATION, hours).glyph) for hours in (6, 24, 72, 168)]
    assert grades == [("fresh", "●"), ("usable", "◐"), ("doubtful", "○"), ("useless", "✗")]


def test_a_week_says_it_in_words():
    assert after(STATION, 168).words == "7 d old, ±17° (90 %: 77°) at closest"
    assert after(METOP, 24).words.startswith("24 h old, about ±0.1"), "an estimate says so"


def test_less_drag_means_less_error_by_the_decay_or_by_the_height_where_none_is_published():
    week = [after(each, 168).along_track_median_km for each in (STATION, METOP)]
    assert week[1] < week[0] / 10
    low = replace(METOP, mean_motion_rev_day=15.2, mean_motion_dot=0.0)
    high = replace(METOP, mean_motion_dot=0.0)
    assert after(low, 168).along_track_median_km > 2 * after(high, 168).along_track_median_km
    assert not after(METOP, 168).measured


def test_a_stranger_in_the_stations_orbit_gets_the_stations_figures_as_an_estimate():
    stranger = replace(STATION, norad_id=99999)
    assert after(stranger, 72).along_track_p90_km == pytest.approx(388)
    assert "about" in after(stranger, 72).words


def test_more_drag_than_the_stations_grows_faster_from_the_same_error_at_epoch():
    sinking = replace(STATION, norad_id=99999, mean_motion_dot=5 * STATION.mean_motion_dot)
    assert after(sinking, 1).along_track_median_km == pytest.approx(0.7)
    assert after(sinking, 24).along_track_median_km == pytest.approx(1.9 + 4 * (1.9 - 0.7))


def test_without_air_it_grows_by_the_scatter_of_the_fit_a_day_and_is_small_in_degrees():
    for elements, orbit in ((GPS, "MEO"), (GOES, "GEO")):
        found = after(elements, 72)
        assert found.orbit == orbit
        assert found.grade == "fresh"
        assert found.pointing_p90_deg < 0.2
    size = 42164 / 6795
    assert after(GOES, 72).along_track_median_km == pytest.approx(0.7 * size * 4, rel=0.01)


def test_an_eccentric_orbit_is_judged_at_perigee_where_an_error_of_time_is_longest():
    found = after(MOLNIYA, 24)
    assert found.orbit == "HEO"
    assert found.along_track_median_km > 2 * after(GPS, 24).along_track_median_km


def test_nothing_is_said_beyond_a_week_but_what_it_was_then():
    found = after(METOP, 12 * 24)
    assert found.along_track_median_km is found.pointing_p90_deg is None
    assert found.words.startswith("12 d old, error unknown: figures end at 7 d with about ±0.5")
    assert found.grade == "doubtful"
    assert after(STATION, 12 * 24).grade == "useless", "it was so after a week already"
    assert after(METOP, 60 * 24).grade == "useless"
    assert after(GOES, 60 * 24).grade == "doubtful"


def test_of_what_is_about_to_fall_nothing_is_known_however_young():
    falling = replace(STATION, norad_id=99999, mean_motion_rev_day=16.2, mean_motion_dot=0.01)
    found = after(falling, 1)
    assert found.along_track_median_km is None
    assert found.grade == "useless"
    assert "falling too fast" in found.words


def test_farther_away_the_same_kilometres_are_fewer_degrees():
    assert after(STATION, 48, 2000).words.startswith("2 d old, ±0.17° (90 %: ")
    assert after(STATION, 48, 2000).pointing_median_deg < after(STATION, 48, 500).pointing_median_deg / 3.5


def test_an_epoch_far_ahead_says_that_date_or_clock_is_wrong():
    found = expected_error(STATION, STATION.epoch - timedelta(days=30))
    assert found.words == "epoch 30 d ahead, its date or this computer's clock is wrong"
    assert found.grade == "useless"
    assert "wrong" not in expected_error(STATION, STATION.epoch - timedelta(days=6)).words
