"""What a list says of a pass beside the pass itself, with Skyfield as the oracle for light and Sun."""

from __future__ import annotations

import csv
import io
import json
from datetime import UTC, datetime, timedelta
from importlib.resources import files

import numpy as np
import pytest
from birdcage.sky.doppler import doppler_hz
from birdcage.sky.elements import ElementSet
from birdcage.sky.export.as_csv import passes_csv
from birdcage.sky.export.as_ics import passes_ics
from birdcage.sky.export.fields import iso, values_of
from birdcage.sky.illumination import sunlit
from birdcage.sky.observer import Observer
from birdcage.sky.pass_row import ORDERS, row_of
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet, satrec, track
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.sun_crossing import sun_approach

HERE = Observer(40.0, -105.0, 1650.0, "yard")
EPOCH = datetime(2026, 11, 21, 12, tzinfo=UTC)
ISS = ElementSet("ISS", 25544, EPOCH, 51.64, 247.46, 0.0007, 130.5, 325.0, 15.72, 1e-4, source="test")
LIMITS = ReachLimits(el_floor_deg=18.0, el_ceiling_deg=65.0)


@pytest.fixture(scope="module")
def passes():
    return list(search(Fleet([ISS]), HERE, EPOCH, 72.0))


@pytest.fixture(scope="module")
def rows(passes):
    return [row_of(one, ISS, HERE, LIMITS) for one in passes]


@pytest.fixture(scope="module")
def oracle():
    """Skyfield: satellite, place, Earth and Sun on the same excerpt of DE421."""
    from skyfield.api import EarthSatellite, load, load_file, wgs84

    ephemeris = load_file(str(files("birdcage.sky") / "data" / "de421_2020_2053.bsp"))
    scale = load.timescale(builtin=True)
    place = wgs84.latlon(HERE.latitude_deg, HERE.longitude_deg, HERE.height_m)
    return EarthSatellite.from_satrec(satrec(ISS), scale), place, ephemeris, scale


def test_the_shadow_of_the_earth_is_skyfields(oracle):
    satellite, _place, ephemeris, scale = oracle
    t_s = EPOCH.timestamp() + np.arange(0.0, 86_400.0, 60.0)
    seen = track(ISS, HERE, t_s)
    ours = sunlit(HERE, t_s, seen.az_deg, seen.el_deg, seen.range_km)
    theirs = satellite.at(scale.from_datetimes([datetime.fromtimestamp(t, UTC) for t in t_s])).is_sunlit(ephemeris)
    # They may differ within some seconds of a shadow's edge, of which there are 31 in a day.
    assert np.count_nonzero(ours != theirs) <= 8
    assert 0.4 < ours.mean() < 0.9


def test_a_pass_by_night_in_midwinter_is_dark_and_one_by_day_lit(rows):
    local = {row: (row.passing.tca - timedelta(hours=7)).hour for row in rows}
    assert {row.sunlit_share for row, hour in local.items() if 10 <= hour < 15} == {1.0}
    assert {row.sunlit_share for row, hour in local.items() if hour in (23, 0, 1)} <= {0.0}


def test_the_nearest_approach_to_the_sun_is_skyfields(rows, oracle):
    satellite, place, ephemeris, scale = oracle
    by_day = [row for row in rows if row.sun is not None]
    assert by_day
    assert any(row.sun is None for row in rows)
    for row in by_day:
        assert row.passing.aos <= row.sun.at <= row.passing.los
        about = [row.sun.at + timedelta(seconds=second) for second in np.arange(-5.0, 5.01, 0.5)]
        times = scale.from_datetimes([max(min(when, row.passing.los), row.passing.aos) for when in about])
        here = (satellite - place).at(times)
        sun = (ephemeris["earth"] + place).at(times).observe(ephemeris["sun"]).apparent()
        assert row.sun.separation_deg == pytest.approx(here.separation_from(sun).degrees.min(), abs=0.05)


def test_a_track_straight_through_the_sun_comes_to_nothing():
    from birdcage.sky.sun import sun

    noon = datetime(2026, 6, 21, 19, tzinfo=UTC)
    az, el = sun(noon, HERE.latitude_deg, HERE.longitude_deg)

    class Across:
        t_s = noon.timestamp() + np.array([-10.0, -3.0, 7.0, 12.0])
        az_deg = np.full(4, az)
        el_deg = el + np.array([-10.0, -3.0, 7.0, 12.0])

    found = sun_approach(Across(), HERE)
    assert found.separation_deg < 0.05
    assert abs((found.at - noon).total_seconds()) < 0.1


def test_doppler_is_high_while_it_comes_and_low_while_it_goes(rows):
    row = max(rows, key=lambda one: one.passing.max_elevation_deg)
    shifts = [doppler_hz(145.8e6, one.range_rate_km_s) for one in (row.at_aos, row.at_tca, row.at_los)]
    assert shifts[0] == pytest.approx(3_350, abs=250)  # 6.9 km/s at 145.8 MHz
    assert shifts[2] == pytest.approx(-3_350, abs=250)
    assert abs(shifts[1]) < 120
    assert doppler_hz(100e6, 299_792.458 / 1000) == pytest.approx(-100e3)


def test_range_is_what_the_propagator_says(rows):
    row = rows[0]
    for when, distance in ((row.passing.aos, row.at_aos), (row.passing.tca, row.at_tca), (row.passing.los, row.at_los)):
        looks = Fleet([ISS]).look(HERE, when)
        assert distance.range_km == pytest.approx(looks.range_km[0], abs=0.05)


def test_a_countdown_names_what_it_counts(rows):
    row = next(one for one in rows if one.reach.intervals)
    stretch = row.reach.intervals[0]
    second = timedelta(seconds=1)
    assert row.next_event(row.passing.aos - second) == row.next_event(row.passing.aos + second)
    assert (row.next_event(row.passing.aos).name, row.next_event(row.passing.aos).at) == ("reach", stretch.start)
    inside = row.next_event(stretch.start + second)
    assert (inside.name, inside.at) == ("reach ends", stretch.end)
    last = row.reach.intervals[-1].end
    assert row.next_event(last + second).name == "LOS"
    assert row.next_event(row.passing.los + second) is None
    low = next(one for one in rows if not one.reach.intervals)
    assert low.next_event(low.passing.aos - second).name == "AOS"


def test_lists_sort_by_rise_height_and_reach(rows):
    by_reach = sorted(rows, key=ORDERS["reach"])
    assert [row.reach.total_s for row in by_reach] == sorted((row.reach.total_s for row in rows), reverse=True)
    assert min(rows, key=ORDERS["max"]).passing.max_elevation_deg == max(r.passing.max_elevation_deg for r in rows)
    assert sorted(rows, key=ORDERS["aos"]) == rows


def test_the_age_of_the_elements_counts_to_the_pass_and_may_be_negative(passes):
    assert row_of(passes[0], ISS, HERE, LIMITS).epoch_age_s == (passes[0].tca - EPOCH).total_seconds()
    early = next(iter(search(Fleet([ISS]), HERE, EPOCH - timedelta(days=1), 12.0)))
    assert row_of(early, ISS, HERE, LIMITS).epoch_age_s < 0.0


# --- exports

PROMISED = [
    "name", "norad_id", "aos", "tca", "los", "aos_azimuth_deg", "tca_azimuth_deg", "los_azimuth_deg",
    "max_elevation_deg", "duration_s", "reach", "reach_s", "max_reach_elevation_deg",
]  # fmt: skip


def test_the_values_are_those_promised_and_go_through_json(rows):
    for row in rows:
        values = json.loads(json.dumps(values_of(row)))
        assert list(values)[: len(PROMISED)] == PROMISED
        assert abs((datetime.fromisoformat(values["aos"]) - row.passing.aos).total_seconds()) <= 0.0005
        spans = [(datetime.fromisoformat(one["end"]) - datetime.fromisoformat(one["start"])) for one in values["reach"]]
        assert sum(span.total_seconds() for span in spans) == pytest.approx(values["reach_s"], abs=0.005)
        assert (values["max_reach_elevation_deg"] is None) == (values["reach"] == [])
        assert "aos_doppler_hz" not in values
    assert values_of(rows[0], 145.8e6)["tca_doppler_hz"] is not None


def test_times_are_utc_to_the_millisecond():
    assert iso(datetime(2026, 1, 2, 3, 4, 5, 999_600, tzinfo=UTC)) == "2026-01-02T03:04:06.000Z"


def test_csv_has_a_line_a_pass_and_a_calendar_reads_back(rows):
    import icalendar

    table = list(csv.DictReader(io.StringIO(passes_csv(rows, 145.8e6), newline="")))
    assert [line["aos"] for line in table] == [iso(row.passing.aos) for row in rows]
    reached = next(index for index, row in enumerate(rows) if row.reach.intervals)
    first = rows[reached].reach.intervals[0]
    assert table[reached]["reach"].startswith(f"{first.start:%Y-%m-%dT%H:%M:%SZ}/{first.end:%H:%M:%SZ}")
    assert passes_csv([]) == ""

    made = datetime(2026, 11, 20, tzinfo=UTC)
    data = passes_ics(rows, HERE, made, "Old elements.")
    assert data == passes_ics(rows, HERE, made, "Old elements.")
    events = icalendar.Calendar.from_ical(data).walk("VEVENT")
    assert len(events) == len(rows)
    assert len({str(event["uid"]) for event in events}) == len(rows)
    for event, row in zip(events, rows, strict=True):
        assert abs((event.decoded("dtstart") - row.passing.aos).total_seconds()) <= 0.5
        assert abs((event.decoded("dtend") - row.passing.los).total_seconds()) <= 0.5
        assert str(event["summary"]) == f"ISS {row.passing.max_elevation_deg:.0f}°"
        assert "Old elements." in str(event["description"])
        assert ("Not in reach" in str(event["description"])) == (not row.reach.intervals)
        assert str(event["location"]) == "yard"
