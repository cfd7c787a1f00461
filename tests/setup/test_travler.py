"""The eleven steps with a Trav'ler: what it does by itself, what only lasts until power-up, where its limits are."""

import pytest
from birdcage.base.config import edit
from birdcage.setup.engine import clear_question
from birdcage.setup.step import NoSuchChoice
from birdcage.sky.geostationary import look_angle
from birdcage.sky.slots import slots
from birdcage.station.state import LinkPhase, TvSearch

from tests.signal.test_peak_by_source import Planted


@pytest.fixture
def travler(build):
    return build("hal205?seed=1").up()


def test_its_search_is_ended_at_once_and_said_to_come_back(travler):
    words = " ".join(travler.view("search").words)
    assert "comes back at each power-up" in words
    assert "NVS 20" not in words
    travler.choose("search", "end")
    assert travler.state.search is TvSearch.OFF_UNTIL_POWER_UP
    assert travler.marks()["search"] == "done"
    assert "begins again at each power-up" in travler.view("search").evidence
    assert "ngsearch" in travler.lines()


def test_that_it_was_ended_once_is_no_proof_after_the_next_power_up(travler, build):
    travler.choose("search", "end")
    travler.kill()
    again = build("hal205?seed=1").up()
    assert again.state.search is not TvSearch.OFF_UNTIL_POWER_UP
    assert again.marks()["search"] == "todo"


def test_there_is_nothing_to_press_for_homing(travler):
    step = travler.view("home")
    assert step.mark.value == "done"
    assert step.evidence.startswith("homed by itself at power-up, now at AZ ")
    assert step.choices == ()
    with pytest.raises(NoSuchChoice):
        travler.setup.choose("home", "home")
    assert travler.moves() == []


def test_its_limits_are_its_own_and_name_their_source(travler):
    travler.until(lambda: travler.state.surveyed)
    assert travler.view("limits").evidence.startswith("el 15.00 to 90.00 (")
    assert "NVS 12" in travler.view("limits").evidence
    assert "cable +0 to +455" in travler.view("limits").evidence


def test_a_dish_that_tells_no_version_need_not_be_waited_for(travler):
    travler.until(lambda: travler.view("dish").mark.value == "done")
    assert travler.view("dish").evidence == "Trav'ler, speaks hal205; it tells no version"
    assert travler.file().dish.firmware == "hal205"


def test_direction_is_tried_by_moving_and_back(travler):
    travler.until(lambda: travler.state.surveyed)
    travler.setup.clear()
    start = travler.looks_at()
    for answer in ("start", "yes", "yes"):
        travler.choose("direction", answer, 120.0)
    assert travler.marks()["direction"] == "done"
    assert travler.looks_at() == pytest.approx(start, abs=0.1)


def test_another_dish_than_was_thought_is_chosen_and_kept_and_asks_for_a_new_session(build):
    house = build("hal205?seed=1", firmware="g2")
    house.until(lambda: house.state.link.state is LinkPhase.SILENT)
    choice = next(each for each in house.view("link").choices if each.name == "firmware-hal205")
    assert "Trav'ler" in choice.label
    assert house.setup.begin_anew == ""
    house.choose("link", "firmware-hal205")
    assert house.setup.begin_anew == "hal205"
    assert house.file().dish.firmware == "hal205"
    assert house.file().dish.baud is None
    assert house.moves() == []
    house.kill()
    again = build("hal205?seed=1").up()
    assert again.setup.begin_anew == ""


def test_a_travler_heard_at_its_own_rate_is_offered_as_one_and_not_as_a_g2_at_that_rate(build):
    house = build("hal205?seed=1", firmware="g2")
    house.until(lambda: house.state.link.state is LinkPhase.SILENT)
    house.choose("link", "probe")
    house.until(lambda: house.state.link.state is LinkPhase.SILENT)
    enter = next(each for each in house.view("link").choices if each.key == "enter")
    assert enter.label == "It is a Trav'ler (hal205)"
    assert "not the one you chose" in house.view("link").words[0]
    keys = [each.key for each in house.view("link").choices]
    assert len(keys) == len(set(keys)), keys
    assert house.moves() == []


def test_a_dish_that_answers_as_another_is_not_called_mute(build):
    house = build("hal205?seed=1", firmware="g2")
    house.until(lambda: house.state.link.state is LinkPhase.SILENT)
    house.choose("link", "other", port=house.state.port, baud="57600")
    step = house.view("link")
    assert "no dish answers" not in step.evidence
    assert "The wires are right" in step.words[0]
    assert house.setup.causes() == ()
    enter = next(each for each in step.choices if each.key == "enter")
    assert enter.name in ("firmware-hal000", "firmware-hal205"), "nothing seen so far tells them apart"


CLEARANCE = "Nothing taller than 8 in (20 cm) may stand within 32.5 in (83 cm) of the centre of its base."


def test_before_it_homes_by_its_power_its_papers_say_what_to_clear_and_to_fix(build):
    words = " ".join(build("hal205?seed=1&boot=1&boot_home_s=600").view("home").words)
    assert CLEARANCE in words
    assert "45 lb (20 kg): fix its base" in words


def test_before_the_first_motion_its_clearance_is_asked_for(travler):
    assert CLEARANCE in clear_question(travler.state.dish)
    assert "hand near its power switch" in clear_question(travler.state.dish)


def test_the_feed_step_says_what_the_coax_carries(travler, build):
    assert "coax carries 12 to 18 V: connect no 5 V LNA" in " ".join(travler.view("feed").words)
    assert "coax carries 13 or 18 V: connect no 5 V LNA" in " ".join(build("g2?seed=1").up().view("feed").words)


def test_the_north_step_names_the_mark_on_the_base(travler, build):
    assert travler.view("north").words[0].startswith("BACK on its base is azimuth 0")
    assert "BACK" not in " ".join(build("g2?seed=1").up().view("north").words)


def test_a_failed_homing_is_told_with_its_remedy_at_the_step(build):
    house = build("hal205?seed=1&boot=1&boot_home_s=20&home_fails=1")
    house.run(40.0)
    assert "choose INSTALLATION, then Calibrate EL" in " ".join(house.view("home").words)


def test_its_first_satellite_is_found_by_a_receiver(build):
    """The feed names a receiver, so the last step has something to hear by; north is 4 degrees off."""
    house = build("hal205?seed=1")
    edit(house.paths.config_file, {"feed.stock-ku.signal": "gqrx"})
    house.beside = Planted((0.0, 0.0))
    house.start().up()
    house.choose("place", "typed", latitude_deg="39.1", longitude_deg="-95.7", height_m="250")
    house.choose("north", "typed", az_offset_deg="0")
    house.setup.clear()
    slot = next(each for each in slots() if each.longitude_deg == -119.0)
    az_deg, el_deg = look_angle(39.1, -95.7, slot.longitude_deg)
    house.beside.to = (az_deg + 4.0, el_deg - 1.0)
    assert house.marks()["first"] == "todo"
    house.choose("first", "search", 900.0, slot="119W")
    found = house.view("first")
    assert found.evidence.startswith("found at")
    assert any(words.startswith("Most likely it is") and slot.label in words for words in found.words), found.words
    house.choose("first", "is1")
    settings = house.file()
    assert settings.alignment.az_offset_deg == pytest.approx(-4.0, abs=0.2)
    assert settings.alignment.el_offset_deg == pytest.approx(1.0, abs=0.2)
    assert house.marks()["first"] == "done"
