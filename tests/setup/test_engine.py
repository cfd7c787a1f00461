"""What the engine promises whoever drives it."""

from __future__ import annotations

import pytest
from birdcage.base.config import edit, load
from birdcage.base.errors import BirdcageError, ConfigError
from birdcage.setup.engine import STEPS, Setup
from birdcage.setup.first_run import is_first_run
from birdcage.setup.step import NAMES, AreaNotClear, Mark, NoSuchChoice
from birdcage.station.requests import Goto
from birdcage.station.state import LinkPhase

TYPED = {
    "port": "/dev/ttyUSB0", "baud": "115200", "name": "helix", "band": "1670 to 1710 MHz", "beam_deg": "12",
    "lo_hz": "9750 MHz",
    "floor": "20", "ceiling": "60", "cable_min": "-400", "cable_max": "20", "pitch_deg": "1", "roll_deg": "1",
    "latitude_deg": "39.1", "longitude_deg": "-95.7", "locator": "EM29dc", "utc": "18:20:40", "el": "n",
    "reading_deg": "12", "declination_deg": "2", "el_offset_deg": "0",
}  # fmt: skip
"""Something sensible for every field."""


def test_there_are_always_eleven_in_order(build):
    house = build()
    views = house.setup.steps()
    assert tuple(step.name for step in STEPS) == NAMES
    assert [view.name for view in views] == list(NAMES)
    assert [view.number for view in views] == list(range(1, 12))


def test_keys_are_one_letter_and_never_those_of_the_face(house):
    house.setup.clear()
    house.choose("place", "typed", latitude_deg="39.1", longitude_deg="-95.7")
    house.choose("place", "trust")
    for view in house.setup.steps():
        keys = [choice.key for choice in view.choices]
        assert len(keys) == len(set(keys)), view
        assert all(key == "enter" or (len(key) == 1 and key not in "sbolq") for key in keys), view


def test_an_answer_returns_at_once_and_the_wire_is_left_to_the_station(house):
    house.setup.clear()
    sent = len(house.lines())
    house.setup.choose("home", "home")
    assert len(house.lines()) == sent
    assert house.view("home").busy
    assert house.view("home").choices == ()
    with pytest.raises(NoSuchChoice, match="Wait: homing"):
        house.setup.choose("level", "typed", {"pitch_deg": "0", "roll_deg": "0"})


@pytest.mark.parametrize(("step", "choice"), [("home", "home"), ("direction", "start"), ("north", "jog")])
def test_nothing_moves_before_the_area_is_clear(house, step, choice):
    with pytest.raises(AreaNotClear):
        house.setup.choose(step, choice)
    house.run(3)
    assert [line for line in house.moves() if line != "a"] == []
    house.setup.clear()
    house.setup.choose(step, choice)


@pytest.mark.parametrize("address", ["g2?seed=1", "g2?unhomed=1&nvs20=0", "g2?boot=1&nvs20=0&home_fails=1"])
def test_no_answer_that_claims_to_move_nothing_moves_the_dish(build, address):
    house = build(address)
    house.run(12)
    for name in NAMES * 2:
        for choice in house.view(name).choices:
            values = {field.name: field.value or TYPED[field.name] for field in choice.fields}
            try:
                house.setup.choose(name, choice.name, values)
            except AreaNotClear:
                assert choice.moves
            except BirdcageError:
                assert not choice.moves
            house.until(lambda: not house.setup.busy)
    house.run(5)
    assert [line for line in house.moves() if line != "a"] == []
    assert not house.setup.area_clear


def test_clear_holds_for_one_run(house):
    house.setup.clear()
    assert not house.start().setup.area_clear


@pytest.mark.parametrize(
    ("step", "choice", "values", "words"),
    [
        ("hom", "home", {}, "no step 'hom'"),
        ("home", "fly", {}, "no answer 'fly' now; there are home"),
        ("level", "typed", {"pitch_deg": "1", "roll": "2"}, "Nothing to type for roll"),
        ("level", "typed", {"pitch_deg": "1"}, "roll: type a number"),
        ("level", "typed", {"pitch_deg": "steep", "roll_deg": "0"}, "'steep' is not a number"),
        ("level", "typed", {"pitch_deg": "nan", "roll_deg": "0"}, "does not lie between"),
        ("feed", "other", {"name": "a.b"}, "without a full stop"),
        ("feed", "other", {"name": "helix", "lo_hz": "fast"}, "is not a frequency"),
        ("feed", "other", {"name": "helix", "stow": "maybe"}, "answer y or n"),
        ("limits", "own", {"floor": "50", "ceiling": "40"}, "is not below"),
        ("place", "locator", {"locator": "ZZ99"}, "not a Maidenhead locator"),
        ("place", "locator", {"locator": "EM29"}, "2° wide"),
        ("place", "clock", {"utc": "25:00"}, "not a time"),
        ("north", "typed", {"az_offset_deg": ""}, "type a number"),
        ("link", "other", {"port": " "}, "Type a port"),
        ("link", "other", {"port": "COM4", "baud": "fast"}, "is not a speed"),
    ],
)
def test_what_cannot_be_used_is_said_and_nothing_is_kept(house, step, choice, values, words):
    before = house.paths.config_file.read_bytes()
    with pytest.raises(NoSuchChoice, match=words):
        house.setup.choose(step, choice, values)
    assert house.paths.config_file.read_bytes() == before
    assert not house.setup.busy


def test_skip_back_and_go(house):
    setup = house.setup
    house.choose("link", "keep")
    assert setup.current == "feed"
    setup.skip("feed")
    assert (setup.current, house.marks()["feed"]) == ("limits", "skipped")
    setup.back()
    assert setup.current == "feed"
    setup.go("level")
    house.run(2)
    assert setup.current == "level"
    setup.skip("home")
    assert house.marks()["home"] == "done"
    house.start().run(6)
    assert house.marks()["feed"] == "skipped"
    house.choose("feed", "stock")
    assert house.marks()["feed"] == "done"


def test_finished_counts_done_and_skipped(house):
    for name in NAMES:
        assert not house.setup.finished
        house.setup.skip(name)
    assert house.setup.finished
    assert house.marks()["first"] == "skipped"


def test_on_a_dish_without_a_tuner_the_first_satellite_is_for_later(build):
    house = build("hal205?seed=1").up()
    for name in NAMES[:-1]:
        house.setup.skip(name)
    assert house.setup.finished
    assert house.marks()["first"] == "later"
    assert house.setup.current == "first"
    words = " ".join(house.view("first").words)
    assert "This dish has no tuner to search with." in words
    assert 'signal = "rigctl" in [feed.stock-ku] hears by a receiver.' in words


def test_a_damaged_file_is_said_and_left_alone(house):
    file = house.paths.config_file
    file.write_text("[dish\n")
    with pytest.raises(ConfigError, match="Fix that file"):
        house.setup.choose("feed", "stock")
    with pytest.raises(ConfigError, match="Fix that file"):
        house.setup.skip("level")
    assert file.read_text() == "[dish\n"


def test_what_could_not_be_kept_by_itself_is_kept_when_the_file_is_mended(build):
    house = build()
    house.paths.config_file.parent.mkdir(exist_ok=True)
    house.paths.config_file.write_text("[dish\n")
    house.run(8)
    assert house.marks()["dish"] == "failed"
    assert "Fix that file" in house.view("dish").evidence
    house.paths.config_file.write_text("")
    house.run(1)
    assert house.marks()["dish"] == "done"
    assert house.file().setup.kept("dish").evidence == "Carryout G2 02.02.48 (12-IN G2)"


def test_control_is_given_back_after_each_answer(house):
    house.setup.clear()
    house.choose("north", "jog", d_az_deg="5")
    house.run(1)
    assert house.state.holder is None
    house.station.submit(Goto(20.0, 45.0, "you"))
    house.run(3)
    assert house.state.position.az_deg == pytest.approx(20.0, abs=0.1)


def test_stop_ends_what_the_setup_moves_and_the_step_says_so(build):
    house = build("g2?az_speed=3").up()
    house.setup.clear()
    house.setup.choose("north", "jog", {"d_az_deg": "60"})
    house.run(2)
    house.station.stop("you")
    house.run(3)
    assert house.marks()["north"] == "failed"
    assert "STOP by you" in house.view("north").evidence
    house.choose("north", "release")
    assert house.state.held is None


def test_a_resumed_setup_goes_to_the_link_when_that_is_broken(house):
    house.choose("link", "keep")
    house.plugged = []
    house.start().run(3)
    assert house.state.link.state is LinkPhase.LOST
    assert house.setup.current == "link"
    assert house.setup.causes()[0].title == "The adapter is out"


def test_a_variable_over_what_was_written_is_said(house):
    house.environ["BIRDCAGE_ALIGNMENT_AZ_OFFSET_DEG"] = "7"
    house.start().up()
    house.choose("north", "typed", az_offset_deg="3")
    assert house.file().alignment.az_offset_deg == 3.0
    assert "an environment variable sets alignment.az_offset_deg" in house.file().setup.north
    assert house.state.az_offset_deg == 7.0


def test_a_flag_gives_way_to_what_was_chosen(build):
    house = build()
    settings = load(house.paths.config_file, {}, {"dish.port": "COM9"})
    setup = Setup(house.session, settings, house.paths, environ={}, flags={"dish.port": "COM9"}, ports=list)
    house.setup = setup
    house.run(6)
    house.choose("link", "keep")
    assert setup.settings.dish.port == "/dev/ttyUSB0"


def test_first_run(tmp_path, build):
    house = build()
    file = house.paths.config_file

    def first():
        return is_first_run(load(file, {}), house.paths)

    assert first()
    edit(file, {"app.theme": "night"})
    assert first()
    edit(file, {"dish.port": "COM4"})
    assert not first()
    edit(file, {"dish.port": None, "setup.level": "skipped 2026-03-20T12:00Z"})
    assert not first()


def test_views_are_plain_values(house):
    view = house.view("home")
    house.device.reboot()
    house.run(12)
    assert view.mark is Mark.DONE
    assert house.view("home").mark is Mark.TODO
