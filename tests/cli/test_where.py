"""`birdcage where`: look angle, rates, rise and reach of anything, without a dish and without a network."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

HOUSTON = ("--lat", 29.76, "--lon", -95.37)
AT = ("--at", "2026-11-21T18:00:00Z")

ISS = """ISS (ZARYA)
1 25544U 98067A   26325.50000000  .00016717  00000-0  30000-3 0  9990
2 25544  51.6400 210.0000 0004000  60.0000 300.0000 15.50000000400009
"""


@pytest.fixture(autouse=True)
def at_home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    return tmp_path


@pytest.fixture
def where(run):
    def where(*words, firmware="", **more):
        return run("where", *words, firmware=firmware, **more)

    return where


@pytest.fixture
def tle(tmp_path):
    path = tmp_path / "iss.tle"
    lines = [line[:68] + str(_checksum(line)) if line[:2] in ("1 ", "2 ") else line for line in ISS.splitlines()]
    path.write_text("\n".join(lines) + "\n")
    return path


def _checksum(line):
    return sum(int(each) if each.isdigit() else each == "-" for each in line[:68]) % 10


def test_the_sun_as_json(where, as_json):
    told = as_json(where("sun", *HOUSTON, *AT, "--json", firmware="g2"))
    assert (told["name"], told["kind"], told["at"]) == ("Sun", "body", "2026-11-21T18:00:00.000Z")
    assert told["azimuth_deg"] == pytest.approx(177.5, abs=1.0)
    assert told["elevation_deg"] == pytest.approx(40.3, abs=0.5)
    assert told["range_km"] == pytest.approx(147.8e6, rel=0.001)
    assert told["azimuth_rate_deg_s"] > 0.004
    assert 1.0 < told["rise_db"] < 2.5
    assert told["sidereal_time_h"] == pytest.approx(15.71, abs=0.02)
    assert (told["epoch"], told["age_s"], told["skew_deg"], told["in_reach"]) == (None, None, None, True)


def test_the_sun_for_people(where):
    result = where("Sun", *HOUSTON, *AT, firmware="g2")
    assert (result.exit_code, result.stderr) == (0, "")
    assert "2026-11-21 18:00:00 UTC, sidereal 15h41m31s" in result.stdout
    assert "29.7600°N 95.3700°W" in result.stdout
    assert "rise       2.0 dB to expect with feed stock Ku LNB, 100 K of noise assumed" in result.stdout
    assert "beam       5.5° x 5.5° from reflector and frequency" in result.stdout
    assert "           6.4° x 6.3° measured in counts: upper bound" in result.stdout


def test_the_sun_is_louder_in_the_narrower_beam_of_a_travler(where, as_json):
    told = as_json(where("sun", *HOUSTON, *AT, "--json", firmware="hal205"))
    assert told["rise_db"] == pytest.approx(6.1, abs=0.2)
    assert (told["beam"]["az_deg"], told["beam"]["el_deg"]) == pytest.approx((2.01, 2.89), abs=0.01)
    assert (told["beam"]["origin"], told["beam"]["az_at_most_deg"]) == ("reflector and frequency", None)
    assert "beam       2.0° x 2.9° from reflector and frequency\nrise       6." in (
        where("sun", *HOUSTON, *AT, firmware="hal205").stdout
    )


def test_without_a_dish_no_beam_is_made_up(where):
    told = where("sun", *HOUSTON, *AT).stdout
    assert "rise       - (name the dish with --firmware: its reflector makes the beam)" in told


def test_the_moon_is_a_twentieth_of_a_decibel_and_that_is_said(where):
    result = where("moon", *HOUSTON, *AT, firmware="g2")
    assert "rise       0.06 dB" in result.stdout
    assert "too little to see without averaging" in result.stdout


def test_the_noise_and_the_place_come_from_the_settings(where, at_home):
    (at_home / "birdcage.toml").write_text(
        '[place]\nname = "Field"\nlatitude_deg = 29.76\nlongitude_deg = -95.37\nheight_m = 20\n'
        '[feed]\nactive = "big"\n[feed.big]\nbeam_deg = 2.0\nfreq_min_hz = 11e9\nfreq_max_hz = 12e9\nsystem_k = 80\n'
    )
    result = where("moon", *AT)
    assert "20 m Field" in result.stdout
    assert "feed big, 80 K of noise\n" in result.stdout


def test_a_feed_without_a_beam_promises_nothing(where, at_home):
    (at_home / "birdcage.toml").write_text('[feed]\nactive = "bare"\n[feed.bare]\nfreq_min_hz = 1e9\n')
    assert "rise       -" in where("sun", *HOUSTON, *AT).stdout


def test_a_slot_with_its_skew(where, as_json):
    told = as_json(where("28.2E", "--lat", 51.5, "--lon", -0.1, "--json"))
    assert told["name"] == "28.2°E Astra 28"
    assert (told["azimuth_deg"], told["elevation_deg"]) == pytest.approx((145.45, 25.41), abs=0.04)
    assert told["skew_deg"] == pytest.approx(-20.84, abs=0.05)
    assert told["rise_db"] is None
    assert (told["slot_tilt_deg"], told["feed_skew_deg"]) == (7.0, pytest.approx(-13.84, abs=0.05))
    text = where("28.2E", "--lat", 51.5, "--lon", -0.1).stdout
    assert "skew       20.8° counterclockwise by geometry" in text
    assert "tilt       7.0° clockwise of the slot's own: 13.8° counterclockwise in all" in text


def test_a_slot_whose_tilt_no_source_tells(where, as_json):
    told = as_json(where("13E", "--lat", 51.5, "--lon", -0.1, "--json"))
    assert told["skew_deg"] == pytest.approx(-10.2, abs=0.2)
    assert (told["slot_tilt_deg"], told["feed_skew_deg"]) == (None, None)
    assert "tilt       the slot's own is not known" in where("13E", "--lat", 51.5, "--lon", -0.1).stdout


@pytest.mark.parametrize(
    ("words", "azimuth", "elevation"),
    [
        (("az", "180", "el", "45"), 180.0, 45.0),
        (("az 180 el 45",), 180.0, 45.0),
        (("az", "-90", "el", "-3.5"), 270.0, -3.5),
    ],
)
def test_a_target_may_be_several_words_with_negative_numbers(where, as_json, words, azimuth, elevation):
    told = as_json(where(*words, *HOUSTON, "--json"))
    assert (told["azimuth_deg"], told["elevation_deg"]) == (azimuth, elevation)


def test_a_mistyped_option_is_no_target(where):
    result = where("sun", "--latt", 3)
    assert result.exit_code == 2
    assert "No such option '--latt'" in result.stderr or "No such option: --latt" in result.stderr


def test_a_satellite_of_a_file(where, as_json, tle):
    told = as_json(where("25544", *HOUSTON, *AT, "--elements", tle, "--json"))
    assert (told["name"], told["norad_id"], told["kind"]) == ("ISS (ZARYA)", 25544, "satellite")
    assert told["epoch"] == "2026-11-21T12:00:00.000Z"
    assert told["age_s"] == 6 * 3600
    assert 400.0 < told["range_km"] < 13_200.0
    assert abs(told["range_rate_km_s"]) < 8.0
    text = where("iss", *HOUSTON, *AT, "--elements", tle)
    assert "Warning" not in text.stderr
    assert "elements   epoch 2026-11-21 12:00 UTC, 6 h old\n" in text.stdout


def test_a_satellite_of_the_catalogue_with_its_time_offset(where, as_json, tle, at_home):
    from birdcage.base.paths import Paths
    from birdcage.sky.catalogue import Catalogue
    from birdcage.sky.formats import read_path

    before = as_json(where("25544", *HOUSTON, *AT, "--elements", tle, "--json"))
    with Catalogue(Paths.in_folder(at_home).catalogue) as catalogue:
        catalogue.add(read_path(tle).elements)
        assert as_json(where("25544", *HOUSTON, *AT, "--json"))["azimuth_deg"] == before["azimuth_deg"]
        catalogue.set_time_offset(25544, 20.0)
    late = as_json(where("25544", *HOUSTON, *AT, "--json"))
    assert late["time_offset_s"] == 20.0
    assert late["elevation_deg"] != pytest.approx(before["elevation_deg"], abs=0.2)
    then = as_json(where("25544", *HOUSTON, "--at", "2026-11-21T17:59:40Z", "--elements", tle, "--json"))
    assert late["range_km"] == pytest.approx(then["range_km"], abs=12.0), "the Earth turns 9 km meanwhile"
    assert abs(late["range_km"] - before["range_km"]) > 30.0
    assert "comes 20 s later than computed" in where("25544", *HOUSTON, *AT).stdout


def test_frozen_elements_are_marked_with_their_epoch_and_warned_of(where, as_json, at_home):
    result = where("25544", *HOUSTON, "--at", "2026-10-01")
    assert "epoch 2026-09-20" in result.stdout
    assert "FROZEN" in result.stdout
    assert "frozen elements" in result.stderr
    assert "epoch 2026-09-20" in result.stderr
    assert as_json(where("25544", *HOUSTON, "--at", "2026-10-01", "--json"))["source"] == "frozen"
    assert not list(at_home.rglob("*.sqlite")), "looking makes no file"


def test_what_this_dish_cannot_reach_is_said(where, as_json, at_home):
    low, high = ("az 180 el 10", *HOUSTON), ("az 180 el 45", *HOUSTON)
    assert "this dish  -" in where(*low).stdout
    assert "cannot point there: below the floor of 18°" in where(*low, firmware="g2").stdout
    assert "can point there" in where(*high, firmware="g2").stdout
    assert "above the ceiling of 65°" in where("az 180 el 80", *HOUSTON, firmware="g2").stdout
    assert as_json(where("az 180 el -1", *HOUSTON, "--json"))["in_the_way"] == "below the horizon"
    (at_home / "birdcage.toml").write_text(
        '[motion]\nmin_elevation_deg = 20\nno_go_sectors = [[170, 190, 50, "mast"]]\n[alignment]\nel_offset_deg = 5\n'
        "[place]\nhorizon = [[0, 0], [90, 40], [120, 0]]\n"
    )
    assert "below the floor of 25°" in where("az 0 el 24", *HOUSTON).stdout
    assert "below the floor of 25°" in where("az 0 el 24", *HOUSTON, firmware="g2").stdout, "the narrower counts"
    assert "no-go: mast" in where(*high).stdout
    assert "behind the horizon" in where("az 90 el 39", *HOUSTON).stdout
    assert as_json(where("az 300 el 30", *HOUSTON, "--json"))["in_reach"] is True


def test_without_a_place_it_says_how_to_set_one(where):
    result = where("sun")
    assert result.exit_code == 2
    assert "--lat and --lon" in result.stderr
    assert "birdcage place add home WHERE --use" in result.stderr


def test_what_nothing_is_called_names_what_would_be_understood(where):
    result = where("nonsense", *HOUSTON)
    assert result.exit_code == 2
    assert "az 180 el 45" in result.stderr
    assert result.stdout == ""


def test_outside_the_ephemeris_it_says_so(where):
    result = where("mars", *HOUSTON, "--at", "2060-01-01")
    assert result.exit_code == 1
    assert "2020-01-02 to 2053-10-08" in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize(
    "words",
    [("where", "moon"), ("where", "25544"), ("where", "gal 120,-5"), ("sky",)],
    ids=lambda words: " ".join(words),
)
def test_no_socket_is_made(words, at_home):
    code = f"""
import sys
tried = []
sys.addaudithook(lambda event, args: tried.append(event) if event.startswith("socket.") else None)
from birdcage.cli.app import cli
cli({[*words, "--lat", "52", "--lon", "4", "--json"]!r}, standalone_mode=False)
print("sockets:", tried)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    first, last = done.stdout.splitlines()
    assert json.loads(first)
    assert last == "sockets: []", done.stderr
