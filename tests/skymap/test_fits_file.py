"""A map as FITS: where a pixel lies, when and where it was heard, and what must not be in it."""

from __future__ import annotations

import io
import socket
import warnings
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from astropy.io import fits
from astropy.wcs import WCS
from birdcage.skymap.combine import mean_of
from birdcage.skymap.fits_file import as_fits
from birdcage.skymap.place_blur import blurred
from birdcage.skymap.plan import MapFrame, MapPlan
from birdcage.tracking.planning.refraction import lift_deg

from tests.skymap.made import BEGUN, made_map, sample

ABOUT = {
    "dish": "Carryout G2", "feed": "own", "firmware": "02.02.48", "source_label": "dish tuner", "target": "",
    "latitude_deg": 52.01234, "longitude_deg": 4.35678, "height_m": 37.0, "beam_az_deg": 3.0, "beam_el_deg": 3.2,
    "freq_hz": 12.45e9, "az_offset_deg": 1.5, "el_offset_deg": -0.25, "ca_deg": 0.1, "an_deg": 0.02, "aw_deg": -0.03,
}  # fmt: skip


@pytest.fixture(autouse=True)
def no_network(monkeypatch):
    def refuse(*_):
        raise AssertionError("a file of a map asks nobody")

    monkeypatch.setattr(socket, "getaddrinfo", refuse)
    monkeypatch.setattr(socket.socket, "connect", refuse)


def opened(sky_map):
    units = fits.open(io.BytesIO(as_fits(sky_map)))
    units.verify("exception")
    return units


def grid_of(header):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that it fills in other forms of times and places
        return WCS(header)


PLANS = (
    MapPlan(160.0, 220.0, 25.0, 50.0, 1.0), MapPlan(350.0, 380.0, 20.0, 70.0, 1.5),
    MapPlan(-20.0, 20.0, 0.0, 90.0, 2.5), MapPlan(0.0, 360.0, 5.0, 70.0, 5.0),
    MapPlan(90.0, 110.0, 30.0, 40.0, 0.2, y_step_deg=1 / 3),
)  # fmt: skip


@pytest.mark.parametrize("plan", PLANS, ids=str)
def test_the_pixel_of_a_planted_source_is_where_the_source_is(plan):
    for column, row in ((0, 0), (plan.columns // 3, plan.rows // 2), (plan.columns - 1, plan.rows - 1)):
        az, el = plan.at(row * plan.columns + column)
        sky_map = made_map(plan, lambda x, y, az=az, el=el: 1000.0 if (x, y) == (az, el) else 400.0)
        header, values = opened(sky_map)[0].header, opened(sky_map)[0].data
        y, x = np.unravel_index(np.nanargmax(values), values.shape)
        told_az, told_el = grid_of(header).wcs_pix2world([[x, y]], 0)[0]
        assert abs((told_az - az + 180.0) % 360.0 - 180.0) < 0.01
        assert told_el == pytest.approx(el, abs=0.01)
        back = grid_of(header).wcs_world2pix([[az % 360.0, el]], 0)[0]
        if plan.x_high_deg - plan.x_low_deg < 360.0:
            assert tuple(back) == pytest.approx((x, y), abs=0.01 / plan.step_deg)
        assert (header["CTYPE1"], header["CTYPE2"], header["CRVAL2"]) == ("ALON-CAR", "ALAT-CAR", 0.0)


def test_around_a_target_the_axes_are_offsets():
    plan = MapPlan(-3.0, 2.0, -1.0, 1.5, 0.5, frame=MapFrame.TARGET)
    header = opened(made_map(plan, lambda x, y: x + y, about={"target": "Sun"}))[0].header
    assert grid_of(header).wcs_pix2world([[0, 0], [10, 5]], 0).tolist() == [[-3.0, -1.0], [2.0, 1.5]]
    assert (header["CTYPE1"], header["OBJECT"]) == ("XOFFSET", "Sun")


def test_the_header_says_when_where_and_how():
    sky_map = made_map(MapPlan(160.0, 165.0, 25.0, 30.0, 1.0), lambda az, el: az, number=12, heard=20, about=ABOUT)
    header, values = opened(sky_map)[0].header, opened(sky_map)[0].data
    assert {key: header[key] for key in (
        "BUNIT", "DATE-OBS", "DATE-AVG", "DATE-END", "TIMESYS", "EXPTIME", "FREQ", "BMAJ", "BMIN", "BPA", "OBSGEO-B",
        "OBSGEO-L", "OBSGEO-H", "PTAZOFF", "PTELOFF", "PTCA", "PTAN", "PTAW", "TELESCOP", "INSTRUME", "OBJECT",
        "ORIGIN", "MAPNUM", "NHEARD", "NCELLS", "SIMULATE", "LOGSCALE",
    )} == {
        "BUNIT": "count", "DATE-OBS": "2026-03-20T05:59:59.750", "DATE-AVG": header["DATE-AVG"],
        "DATE-END": header["DATE-END"], "TIMESYS": "UTC", "EXPTIME": 10.0, "FREQ": 12.45e9, "BMAJ": 3.2, "BMIN": 3.0,
        "BPA": 0.0, "OBSGEO-B": 52.01234, "OBSGEO-L": 4.35678, "OBSGEO-H": 37.0, "PTAZOFF": 1.5, "PTELOFF": -0.25,
        "PTCA": 0.1, "PTAN": 0.02, "PTAW": -0.03, "TELESCOP": "Carryout G2", "INSTRUME": "dish tuner",
        "OBJECT": "az 160:165 el 25:30", "ORIGIN": "birdcage", "MAPNUM": 12, "NHEARD": 20, "NCELLS": 36,
        "SIMULATE": True, "LOGSCALE": False,
    }  # fmt: skip
    times = [each.utc.timestamp() for each in sky_map.samples]
    middle = datetime.fromisoformat(header["DATE-AVG"]).replace(tzinfo=UTC).timestamp()
    assert middle == pytest.approx(sum(times) / len(times), abs=0.001)
    assert "DEMO: a simulated dish" in str(header["COMMENT"])
    assert np.isnan(values).sum() == 16
    real = opened(replace(sky_map, demo=False))[0].header
    assert (real["SIMULATE"], "COMMENT" in real) == (False, False)


def test_what_is_not_known_is_not_in_the_header():
    header = opened(made_map(MapPlan(160.0, 162.0, 25.0, 26.0, 1.0), lambda az, el: az, number=None))[0].header
    assert not {"FREQ", "BMAJ", "OBSGEO-L", "OBSGEO-H", "PTCA", "TELESCOP", "MAPNUM"} & set(header)


def test_the_table_has_every_sample_and_what_was_not_known_is_no_number():
    cross = sample(None, 170.0, 40.0, 900.0, cross_number=1, lock=True, snr_db=9.5, polarisation="H", scatter=None)
    sky_map = made_map(MapPlan(160.0, 162.0, 25.0, 26.0, 1.0), lambda az, el: az, about=ABOUT)
    units = opened(replace(sky_map, crosses=(cross,), settings=({"transponder": "1", "lnb": "18 V – ok"},)))
    table = units["SAMPLES"].data
    assert len(table) == 7
    assert table["utc"][0] == "2026-03-20T06:00:00.000"
    assert (table["cell"][6], table["cross_number"][6], table["lock"][6], table["polarisation"][6]) == (-1, 1, 1, "H")
    assert np.isnan(table["scatter"][6])
    assert np.isnan(table["snr_db"][0])
    assert units["SAMPLES"].header["TNULL1"] == -1
    assert [tuple(row) for row in units["SETTINGS"].data] == [(0, "transponder", "1"), (0, "lnb", "18 V ? ok")]


def test_right_ascension_is_that_of_a_star_that_was_looked_at():
    """Skyfield says where a star stands; the air lifts it; the table has its catalogue place."""
    from importlib.resources import files

    from skyfield.api import Star, load, load_file, wgs84

    stars = ((83.822, -5.391), (201.365, -43.019), (299.868, 40.734), (266.417, -29.008))
    earth = load_file(str(files("birdcage.sky") / "data" / "de421_2020_2053.bsp"))["earth"]
    place = earth + wgs84.latlon(ABOUT["latitude_deg"], ABOUT["longitude_deg"], ABOUT["height_m"])
    heard = []
    for hour in range(24):
        utc = BEGUN + timedelta(hours=hour)
        time = load.timescale(builtin=True).from_datetime(utc)
        for ra_deg, dec_deg in stars:
            alt, az, _ = place.at(time).observe(Star(ra_hours=ra_deg / 15.0, dec_degrees=dec_deg)).apparent().altaz()
            if alt.degrees > 3.0:
                seen = alt.degrees + float(lift_deg(alt.degrees))
                heard.append((ra_deg, dec_deg, sample(0, az.degrees, seen, 1.0, utc=utc)))
    assert len(heard) > 20
    sky_map = made_map(MapPlan(0.0, 0.0, 20.0, 20.0, 1.0), lambda az, el: 1.0, about=ABOUT)
    table = opened(sky_map.with_samples(tuple(each for _ra, _dec, each in heard)))["SAMPLES"].data
    for row, (ra_deg, dec_deg, _) in zip(table, heard, strict=True):
        assert (row["ra_deg"], row["dec_deg"]) == pytest.approx((ra_deg, dec_deg), abs=0.003)
    centre = [row for row, told in zip(table, heard, strict=True) if told[:2] == stars[3]]
    for row in centre:
        assert (row["glon_deg"] + 180.0) % 360.0 - 180.0 == pytest.approx(-0.056, abs=0.01)
        assert row["glat_deg"] == pytest.approx(-0.046, abs=0.01)


def test_a_time_beyond_all_tables_is_no_reason_to_ask_the_network():
    sky_map = made_map(MapPlan(0.0, 0.0, 20.0, 20.0, 1.0), lambda az, el: 1.0, about=ABOUT)
    late = replace(sky_map.samples[0], utc=datetime(2060, 1, 1, tzinfo=UTC))
    assert np.isfinite(opened(sky_map.with_samples((late,)))["SAMPLES"].data["ra_deg"][0])


@pytest.mark.parametrize("frame", MapFrame)
def test_a_blurred_place_is_whole_degrees_and_nothing_tells_it_better(frame):
    aim = {"aim_az_deg": 171.25, "aim_el_deg": 33.5}
    sky_map = made_map(MapPlan(10.0, 12.0, 5.0, 6.0, 1.0, frame=frame), lambda az, el: az, about=ABOUT)
    sky_map = sky_map.with_samples(tuple(replace(each, **aim) for each in sky_map.samples))
    plain = opened(sky_map)["SAMPLES"].columns.names
    units = opened(blurred(sky_map))
    header, left = units[0].header, units["SAMPLES"].columns.names
    assert (header["OBSGEO-B"], header["OBSGEO-L"], "OBSGEO-H" in header) == (52.0, 4.0, False)
    assert "rounded to whole degrees" in str(header["COMMENT"])
    gone = {"ra_deg", "dec_deg", "glon_deg", "glat_deg"}
    gone |= {"az_deg", "el_deg", "aim_az_deg", "aim_el_deg"} if frame is MapFrame.TARGET else set()
    assert set(plain) - set(left) == gone
    if frame is MapFrame.AZEL:
        assert np.isnan(units["SAMPLES"].data["aim_az_deg"]).all()


def test_a_mean_has_begin_and_end_and_no_place_in_the_sky():
    plan = MapPlan(160.0, 162.0, 25.0, 26.0, 1.0)
    maps = [made_map(plan, lambda az, el: az, number=each, about=ABOUT, ended=BEGUN + timedelta(hours=each))
            for each in (3, 4)]  # fmt: skip
    units = opened(mean_of(maps))
    header = units[0].header
    assert (header["MEANOF"], header["DATE-OBS"], header["DATE-END"], "DATE-AVG" in header) == (
        "3 4", "2026-03-20T06:00:00.000", "2026-03-20T10:00:00.000", False,
    )  # fmt: skip
    assert "ra_deg" not in units["SAMPLES"].columns.names


def test_the_same_map_makes_the_same_file():
    sky_map = made_map(MapPlan(160.0, 162.0, 25.0, 26.0, 1.0), lambda az, el: az, about=ABOUT)
    assert as_fits(sky_map) == as_fits(sky_map)


def test_an_empty_map_is_a_file_too():
    empty = made_map(MapPlan(160.0, 162.0, 25.0, 26.0, 1.0), lambda az, el: az, heard=0, about=ABOUT)
    assert np.isnan(opened(empty)[0].data).all()
    assert len(opened(empty)["SAMPLES"].data) == 0
