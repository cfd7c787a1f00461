"""From a dish out of its box to one that points, as a new user would do it; and in two goes."""

from __future__ import annotations

import re

import pytest
from birdcage.base.config import edit
from birdcage.base.geometry import shortest_turn
from birdcage.setup.step import AreaNotClear
from birdcage.sim.almanac import sun
from birdcage.sky.geostationary import look_angle
from birdcage.sky.slots import slots
from birdcage.station.requests import Goto

SEARCH_S = 900.0
"""How long a search may take."""
FRESH = "g2?boot=1&nvs20=0&home_fails=1&heading=30&seed=4"
"""Freshly booted, not homed, its TV search on; its zero looks at 30 degrees true."""


def wires_to_home(house):
    setup = house.setup
    house.run(16)  # it has booted
    assert setup.current == "link"
    assert house.view("link").mark.value == "failed"
    house.choose("link", "probe")
    assert any("115200" in word and "prompt" in word for word in house.view("link").words)
    house.choose("link", "connect")
    house.until(lambda: setup.current == "search")
    assert "02.02.48" in house.view("dish").evidence
    house.until(lambda: house.view("search").choices)
    house.choose("search", "off")
    assert any("nvs-g2-" in words for words in house.view("search").words)
    house.device.power_cycle()
    house.until(lambda: any(each.name == "release" for each in house.view("search").choices))
    house.choose("search", "release")
    house.until(lambda: setup.current == "home")
    assert house.moves() == []
    with pytest.raises(AreaNotClear):
        setup.choose("home", "home")
    setup.clear()
    house.choose("home", "home")
    house.until(lambda: setup.current == "feed")


def feed_to_the_end(house):
    setup = house.setup
    house.choose("feed", "stock")
    house.choose("limits", "own", floor="20")
    house.choose("direction", "start")
    house.choose("direction", "yes")
    house.choose("direction", "yes")
    setup.skip("level")
    house.choose("place", "typed", latitude_deg="39.1", longitude_deg="-95.7", height_m="250")
    assert setup.current == "place"
    house.choose("place", "clock", utc=f"{house.clock.utc():%H:%M:%S}")
    assert setup.current == "north"


def look_at_the_sun(house):
    """Move the dish until it truly looks at the Sun, as a person does by the shadow."""
    for _ in range(3):
        az_deg, el_deg = sun(house.clock.utc(), 39.1, -95.7)
        looks_at = house.looks_at()
        off = shortest_turn(looks_at[0], az_deg), el_deg - looks_at[1]
        house.choose("north", "jog", d_az_deg=f"{off[0]:.2f}", d_el_deg=f"{off[1]:.2f}")


def test_a_dish_out_of_its_box_ends_homed_limited_turned_north_and_pointing(build):
    house = build(FRESH)
    edit(house.paths.config_file, {"dish.baud": 57600})
    house.start()
    wires_to_home(house)
    feed_to_the_end(house)
    look_at_the_sun(house)
    house.run(2)
    house.choose("north", "mark")
    assert house.state.az_offset_deg == pytest.approx(30.0, abs=0.15)
    assert house.setup.current == "first"
    house.choose("first", "point")
    evidence = house.view("first").evidence
    assert evidence.startswith("points at")
    assert house.view("first").words[0] == f"The dish {evidence}."
    slot = next(slot for slot in slots() if slot.label in evidence)
    assert house.looks_at() == pytest.approx(look_angle(39.1, -95.7, slot.longitude_deg), abs=0.25)
    assert not house.setup.finished
    house.choose("first", "search", SEARCH_S, slot="61.5W")
    found = house.view("first")
    assert "locked on transponder 16, SNR" in found.evidence
    assert "network 0x1003" in found.evidence
    assert any(words.startswith("Most likely it is EchoStar 16 (61.5°W)") for words in found.words)
    assert not house.setup.finished, "nobody has said which one it is"
    house.choose("first", "is1")
    assert house.view("first").evidence.endswith("north set by it")
    assert "by the signal of EchoStar 16 (61.5°W)" in house.file().setup.kept("north").evidence
    assert house.setup.finished
    settings = house.file()
    assert settings.problems == ()
    assert (settings.dish.port, settings.dish.baud, settings.dish.firmware) == ("/dev/ttyUSB0", 115200, "g2")
    assert settings.link.usb_identity == "0403:6001:A5"
    assert settings.motion.min_elevation_deg == 20
    assert settings.alignment.az_offset_deg == pytest.approx(30.0, abs=0.25)
    assert house.state.el_min_deg == pytest.approx(20.0, abs=0.1)


def test_killed_half_way_it_goes_on_where_it_was(build):
    house = build(FRESH)
    edit(house.paths.config_file, {"dish.baud": 57600})
    house.start()
    wires_to_home(house)
    house.choose("feed", "stock")
    house.kill()
    house.start().run(8)
    assert house.setup.current == "limits"
    assert {name for name, mark in house.marks().items() if mark == "done"} == {
        "link", "dish", "search", "home", "feed",
    }  # fmt: skip
    assert not house.setup.area_clear
    assert "backup nvs-g2-" in house.view("search").evidence


def test_killed_after_every_single_step_it_ends_the_same(build):
    house = build("g2?nvs20=0&unhomed=1&heading=30")

    def again(step):
        house.kill()
        house.start().run(8)
        assert house.setup.current == step
        house.setup.clear()

    house.up()
    house.choose("link", "keep")
    again("search")
    house.choose("search", "off")
    again("search")
    house.kill()
    house.device.power_cycle()
    house.clock.advance(20.0)  # it starts unwatched
    house.start().run(8)
    assert house.setup.current == "search"
    house.choose("search", "cycled")
    house.until(lambda: house.setup.current == "home")
    again("home")
    house.choose("home", "home")
    again("feed")
    house.choose("feed", "other", name="helix", beam_deg="12")
    again("limits")
    house.choose("limits", "own", ceiling="60", cable_min="-400")
    again("direction")
    house.choose("direction", "start")
    house.choose("direction", "yes")
    again("direction")  # half an answer is none
    for answer in ("start", "yes", "yes"):
        house.choose("direction", answer)
    again("level")
    house.choose("level", "typed", pitch_deg="1", roll_deg="-0.5")
    again("place")
    house.choose("place", "locator", locator="EM29dc")
    again("place")
    house.choose("place", "trust")
    again("north")
    house.choose("north", "typed", az_offset_deg="30", el_offset_deg="0.5")
    again("first")
    house.choose("first", "point")
    house.setup.skip("first")
    assert house.setup.finished
    assert house.state.feed_name == "helix"
    assert house.state.el_max_deg == 60.5
    assert house.looks_at()[0] == pytest.approx(house.state.position.az_deg, abs=0.1)
    assert house.file().problems == ()


TURNED = "g2?heading=40&tilt_north=1.6&tilt_east=-1.2&seed=6"
"""Its zero looks at 40 degrees true, and its axis leans by 2."""


@pytest.mark.parametrize(("compass_deg", "wanted"), [(46.0, "110W"), (35.0, "119W"), (44.0, "61.5W")])
def test_on_a_turned_and_tilted_base_a_bad_compass_is_mended_by_a_satellite(build, compass_deg, wanted):
    house = build(TURNED).up()
    house.setup.clear()
    house.choose("place", "typed", latitude_deg="39.1", longitude_deg="-95.7", height_m="250")
    house.choose("north", "typed", az_offset_deg=f"{compass_deg}")
    house.choose("first", "search", SEARCH_S, slot=wanted)
    found, label = house.view("first"), wanted.replace("W", "°W")
    assert "locked" in found.evidence
    choice = next(each for each in found.choices if label in each.label)
    house.choose("first", choice.name)
    slot = next(slot for slot in slots() if slot.label == label)
    # With the satellite's own direction in force, the dish looks at it when it is sent there.
    house.choose("first", "search", SEARCH_S, slot=wanted)
    assert house.view("first").words[1].startswith(f"Most likely it is {slot.name} ({label})")
    off = re.search(r": ([-+][\d.]+)° in azimuth, ([-+][\d.]+)° in elevation off", house.view("first").words[1])
    assert abs(float(off[1])) < 0.4
    assert abs(float(off[2])) < 0.3


def test_out_of_its_box_on_a_turned_and_tilted_base_it_ends_on_a_satellite_beside_a_stronger_one(build):
    house = build(FRESH.replace("heading=30", "heading=40&tilt_north=1.6&tilt_east=-1.2"))
    edit(house.paths.config_file, {"dish.baud": 57600})
    house.start()
    wires_to_home(house)
    feed_to_the_end(house)
    house.choose("north", "compass", reading_deg="44", declination_deg="2")
    assert house.setup.current == "first"
    house.choose("first", "search", SEARCH_S, slot="110W")
    assert "locked" in house.view("first").evidence
    choice = next(each for each in house.view("first").choices if "110°W" in each.label)
    house.choose("first", choice.name)
    assert house.setup.finished
    assert "by the signal of EchoStar 10 (110°W)" in house.file().setup.kept("north").evidence
    expected = look_angle(39.1, -95.7, -110.0)
    house.station.submit(Goto(*expected, "you"))
    house.run(30)
    truth = house.device.truth()
    assert (truth.beam_az_deg, truth.beam_el_deg) == pytest.approx(expected, abs=0.45)
