"""What is asked for when a map is to be made: its values, its way back from the file, and its estimate."""

from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.base.beam import Beam
from birdcage.skymap.map_file import MapWriter, NewMap, find_map
from birdcage.skymap.map_request import MapRequest, again, estimate, usual_step_deg, within_reach
from birdcage.skymap.map_times import typed_times
from birdcage.skymap.plan import MapOrder, MapPlan
from birdcage.station.known import model_of
from birdcage.station.state import StationState

from tests.skymap.made import sample

PLAN = MapPlan(160.0, 220.0, 25.0, 55.0, 1.0)


def state(firmware="g2", **other):
    return StationState(dish=model_of(firmware), **other)


def test_an_unfinished_map_is_asked_for_again_as_it_was(tmp_path):
    wanted = MapRequest(
        PLAN, "k1", reads=2, details=True, reference=(170.0, 40.0), reference_every_s=1800.0, quiet=True
    )
    path = tmp_path / "signal.sqlite"
    writer = MapWriter(path, NewMap("k1", PLAN, "tuner", "counts", decibels=False, demo=True, about=wanted.values()))
    writer.add(sample(0, 160.0, 25.0, 400.0), {})
    writer.close()
    assert again(find_map(path, "k1")) == replace(wanted, source="tuner")
    assert MapRequest(PLAN).values()["key"] != MapRequest(PLAN).values()["key"]


def test_the_usual_step_is_a_third_of_the_narrower_beam():
    assert usual_step_deg(state(beam=Beam(7.7, 6.57))) == pytest.approx(2.1)


def test_what_the_dish_cannot_reach_falls_off_by_whole_rows():
    reach = state(el_min_deg=18.0, el_max_deg=50.5)
    assert within_reach(PLAN, reach) == replace(PLAN, y_high_deg=50.0)
    with pytest.raises(ValueError, match=r"reaches 18 to 50\.5"):
        within_reach(MapPlan(160.0, 170.0, 60.0, 70.0, 1.0), reach)


def test_the_estimate_goes_by_the_speeds_of_the_dish_and_what_is_left():
    quick = estimate(MapRequest(PLAN), state(), dwell_s=None)
    assert quick.directions == 61 * 31
    assert 0.6 < quick.seconds / quick.directions < 0.9
    slow = estimate(MapRequest(PLAN), state("hal205"), dwell_s=1.0)
    assert slow.seconds > 2.0 * quick.seconds
    half = estimate(MapRequest(PLAN), state(), dwell_s=None, heard=PLAN.sequence[:1000])
    assert half.directions == 891
    assert half.words == "891 directions, about 10 min"
    quiet = estimate(MapRequest(PLAN, quiet=True), state(), dwell_s=None)
    assert quiet.seconds > quick.seconds + 10.0
    rows = estimate(MapRequest(replace(PLAN, order=MapOrder.ROWS)), state(), dwell_s=None)
    assert rows.seconds < quick.seconds
    crosses = estimate(MapRequest(PLAN, reference=(170.0, 40.0), reference_every_s=600.0), state(), dwell_s=None)
    assert crosses.seconds > quick.seconds + 3 * 10 * 0.6


NOW_S = datetime(2026, 11, 27, 22, 0, tzinfo=UTC).timestamp()


def test_times_are_the_next_ones_in_utc():
    assert typed_times("", "", NOW_S) == (0.0, 0.0)
    assert typed_times("23:00", "05:30", NOW_S) == (NOW_S + 3600.0, NOW_S + 7.5 * 3600.0)
    assert typed_times("", "21:59", NOW_S) == (0.0, NOW_S + 23 * 3600.0 + 59 * 60.0)
    assert typed_times("2026-11-28T01:00+01:00", "", NOW_S)[0] == NOW_S + 2 * 3600.0


@pytest.mark.parametrize(("start", "until", "words"), [
    ("25:00", "", "is not a time. Type 23:00"), ("soon", "", "is not a time"), ("11", "", "is not a time"),
    ("2026-11-29T01:00Z", "2026-11-28T01:00Z", "end after the start"),
])  # fmt: skip
def test_what_is_no_time_is_refused(start, until, words):
    with pytest.raises(ValueError, match=words):
        typed_times(start, until, NOW_S)
