"""Place, clock and north: what is taken, what is kept, and what is refused."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.config import edit
from birdcage.gps.fix import GpsFix
from birdcage.setup.step import NoSuchChoice
from birdcage.setup.steps.north import NotYet, az_offset_deg
from birdcage.sky.sun import sun


def fix(house, ahead_s, height_m):
    """Return what a receiver tells while this machine is so far ahead."""
    utc = house.clock.utc()
    told = None if ahead_s is None else utc - timedelta(seconds=ahead_s)
    return GpsFix(39.1, -95.7, height_m, told, utc, 9, 1.0, "gpsd")


PLACE = {"latitude_deg": "39.1", "longitude_deg": "-95.7", "height_m": "250"}


class TestPlace:
    def test_by_locator(self, house):
        house.choose("place", "locator", locator="jo21jv")
        place = house.file().place
        assert (place.latitude_deg, place.longitude_deg) == (pytest.approx(51.895833), pytest.approx(4.791667))
        assert house.marks()["place"] == "todo"
        house.choose("place", "trust")
        assert house.marks()["place"] == "done"
        assert house.view("place").evidence == "JO21jv, 51.8958 N 4.7917 E, 0 m; clock trusted"

    def test_by_city(self, house):
        house.choose("place", "locator", locator="köln", height_m="60")
        place = house.file().place
        assert (place.latitude_deg, place.height_m) == (pytest.approx(50.93, abs=0.02), 60.0)

    @pytest.mark.parametrize(("typed", "says"), [("springfield", "Which one"), ("JO21", "wide"), ("", "Type latitude")])
    def test_what_is_no_place_is_not_kept(self, house, typed, says):
        with pytest.raises(NoSuchChoice, match=says):
            house.setup.choose("place", "locator", {"locator": typed})
        assert house.file().place.latitude_deg is None

    def test_another_place_has_another_horizon(self, house):
        house.choose("place", "typed", **PLACE)
        edit(house.paths.config_file, {"place.horizon": [(0.0, 5.0)], "place.name": "Roof"})
        house.choose("place", "typed", **{**PLACE, "height_m": "251"})
        assert house.file().place.name == "Roof"
        house.choose("place", "typed", **{**PLACE, "latitude_deg": "40"})
        assert (house.file().place.name, house.file().place.horizon) == (None, ())

    @pytest.mark.parametrize("height_m", [None, 250.0])
    def test_by_gps_with_the_clock(self, house, height_m):
        house.receivers["/dev/ttyACM0"] = fix(house, 0.65, height_m)
        house.choose("place", "gps", receiver="/dev/ttyACM0")
        place = house.file().place
        assert (place.latitude_deg, place.height_m, place.gps) == (39.1, height_m or 0.0, "/dev/ttyACM0")
        assert house.marks()["place"] == "done"
        assert house.view("place").evidence.endswith("clock +0.4 s by GPS")
        assert house.asked == [("/dev/ttyACM0", None)]

    def test_a_clock_that_gps_finds_wrong_is_told_and_the_place_is_kept(self, house):
        house.receivers["gpsd"] = fix(house, -60.0, 1.0)
        house.choose("place", "gps", receiver="")
        assert house.marks()["place"] == "failed"
        assert "60.2 s slow by gpsd" in house.view("place").evidence
        assert house.file().place.latitude_deg == 39.1

    def test_no_fix_says_why(self, house):
        house.choose("place", "gps", receiver="gpsd")
        assert (house.marks()["place"], house.view("place").evidence) == ("failed", "No gpsd here.")
        assert house.file().place.latitude_deg is None

    def test_a_receiver_without_a_time_leaves_the_clock_open(self, house):
        house.receivers["gpsd"] = fix(house, None, 1.0)
        house.choose("place", "gps", receiver="gpsd")
        assert house.marks()["place"] == "todo"
        assert house.view("place").evidence.endswith("clock not compared")

    @pytest.mark.parametrize(("utc", "offset_s"), [("18:20:00", 4.0), ("18:19:50", 14.0), ("18:21", -56.0)])
    def test_the_clock_against_a_watch(self, build, utc, offset_s):
        house = build(utc=datetime(2026, 3, 20, 18, 20, 4, tzinfo=UTC))
        house.setup.choose("place", "typed", PLACE)
        house.setup.choose("place", "clock", {"utc": utc})
        assert house.file().setup.clock_offset_s == offset_s
        assert (house.marks()["place"] == "failed") is (abs(offset_s) > 10)
        if abs(offset_s) > 10:
            assert f"{abs(offset_s):.0f} s" in house.view("place").evidence

    def test_around_midnight(self, build):
        house = build(utc=datetime(2026, 3, 20, 23, 59, 58, tzinfo=UTC))
        house.setup.choose("place", "clock", {"utc": "00:00:01"})
        assert house.file().setup.clock_offset_s == -3.0


class TestNorth:
    @pytest.fixture
    def ready(self, house):
        house.setup.clear()
        house.choose("place", "typed", **PLACE)
        house.choose("place", "trust")
        return house

    @pytest.mark.parametrize(
        ("true_deg", "dish_deg", "offset_deg"),
        [(189.0, 185.8, 3.2), (1.0, 359.0, 2.0), (359.0, 1.0, -2.0), (10.0, 190.5, 179.5), (0.0, 0.0, 0.0)],
    )
    def test_the_offset_goes_the_short_way(self, true_deg, dish_deg, offset_deg):
        assert az_offset_deg(true_deg, dish_deg) == pytest.approx(offset_deg)

    def test_typed(self, ready):
        ready.choose("north", "typed", az_offset_deg="3.2")
        assert ready.view("north").evidence == "az offset +3.20 deg: the dish's 0 is at 3.20 true"
        assert ready.state.az_offset_deg == 3.2
        assert ready.state.position.az_deg == pytest.approx(3.2, abs=0.05)

    def test_a_new_north_drops_the_tilt_that_was_fitted_to_the_old(self, ready):
        ready.setup._bench.write({"alignment.active": "Roof", "alignment.an_deg": 1.0, "alignment.ca_deg": 0.2})
        ready.choose("north", "typed", az_offset_deg="3.2")
        own = ready.file().alignment
        assert (own.az_offset_deg, own.an_deg, own.ca_deg, own.active) == (3.2, 0.0, 0.0, None)
        assert "the tilt of the last calibration is dropped" in ready.file().setup.north
        assert ready.state.alignment.model is None

    @pytest.mark.parametrize("keep", ["n", "y"])
    def test_by_the_sun(self, ready, keep):
        az_deg, el_deg = sun(ready.clock.utc(), 39.1, -95.7)
        ready.choose("north", "jog", d_az_deg=f"{az_deg - 20 - 360:.2f}" if az_deg > 200 else f"{az_deg - 20:.2f}",
                     d_el_deg=f"{el_deg - 46:.2f}")  # fmt: skip
        ready.run(3)
        ready.choose("north", "mark", el=keep)
        assert ready.state.az_offset_deg == pytest.approx(20.0, abs=0.15)
        assert ready.state.el_offset_deg == pytest.approx(1.0 if keep == "y" else 0.0, abs=0.1)
        assert "el off by +" in ready.file().setup.north

    def test_a_feeds_own_offset_is_not_counted_twice(self, ready):
        ready.choose("feed", "other", name="helix", az_offset_deg="2")
        assert ready.state.az_offset_deg == 2.0
        az_deg, el_deg = sun(ready.clock.utc(), 39.1, -95.7)
        ready.choose("north", "jog", d_az_deg=f"{az_deg - 22:.2f}", d_el_deg=f"{el_deg - 45:.2f}")
        ready.run(3)
        seen = ready.state.position.dish_az_deg
        ready.choose("north", "mark")
        az_deg = sun(ready.clock.utc(), 39.1, -95.7)[0]
        assert ready.file().alignment.az_offset_deg == pytest.approx(az_deg - seen, abs=0.1)

    def test_a_dish_that_looks_elsewhere_is_no_mark(self, ready):
        ready.choose("north", "jog", d_el_deg="-20")
        ready.run(2)
        with pytest.raises(NotYet, match="does not point at the Sun"):
            ready.setup.choose("north", "mark")
        assert ready.file().setup.north is None

    def test_a_compass_with_declination(self, ready):
        ready.choose("north", "compass", reading_deg="10", declination_deg="2.5")
        assert ready.state.az_offset_deg == pytest.approx(12.5, abs=0.05)
        assert ready.file().place.declination_deg == 2.5

    def test_the_declination_comes_from_the_model(self, ready):
        ready.choose("north", "compass", reading_deg="10")
        assert ready.state.az_offset_deg == pytest.approx(11.9, abs=0.2)
        assert ready.file().place.declination_deg is None

    def test_without_a_place_there_is_no_sun_and_no_declination(self, house):
        assert {choice.name for choice in house.view("north").choices} == {"jog", "compass", "typed"}
        assert any("step 9" in words for words in house.view("north").words)
        with pytest.raises(NoSuchChoice, match="Declination unknown"):
            house.setup.choose("north", "compass", {"reading_deg": "10"})

    def test_an_unknown_clock_is_no_clock(self, house):
        house.setup.choose("place", "typed", PLACE)
        assert "mark" not in {choice.name for choice in house.view("north").choices}
        assert any("clock is unchecked" in words for words in house.view("north").words)

    @pytest.mark.parametrize(
        ("utc", "words"),
        [
            (datetime(2026, 3, 20, 6, 0, tzinfo=UTC), "below the horizon"),
            (datetime(2026, 3, 20, 13, 30, tzinfo=UTC), "below the dish's floor"),
            (datetime(2026, 6, 21, 18, 20, tzinfo=UTC), "above the dish's ceiling"),
            (datetime(1970, 1, 1, 18, 20, tzinfo=UTC), "clock says 1970"),
        ],
    )
    def test_a_sun_that_the_dish_cannot_see_is_no_mark(self, build, utc, words):
        house = build(utc=utc).up()
        house.setup.choose("place", "typed", PLACE)
        house.setup.choose("place", "trust")
        assert "mark" not in {choice.name for choice in house.view("north").choices}
        assert any(words in each for each in house.view("north").words)

    def test_an_old_position_is_no_mark(self, ready):
        assert "mark" in {choice.name for choice in ready.view("north").choices}
        ready.clock.advance(10.0)
        assert "mark" not in {choice.name for choice in ready.view("north").choices}

    def test_a_letter_alone_does_not_turn_to_the_sun(self, ready):
        assert next(choice for choice in ready.view("north").choices if choice.name == "sun").far

    def test_turns_to_the_sun(self, ready):
        ready.choose("north", "sun")
        az_deg, el_deg = sun(ready.clock.utc(), 39.1, -95.7)
        assert ready.looks_at() == (pytest.approx(az_deg, abs=0.3), pytest.approx(el_deg, abs=0.3))
