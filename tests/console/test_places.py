"""Which menu a help tells, with bytes lost and with other lines among it."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest
from birdcage.console.places import MenuPlaces, commands

bench = sys.modules["console_bench"]
ROOT = ("motor", "ngsearch", "nvs", "reboot", "stow", "q")
MOTOR = ("a [<motor> <angle>]", "g <az> <el> <sk>", "q")


@pytest.fixture
def places():
    return MenuPlaces(bench.HAL)


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("Enter <dvb> - DVB Tuner", {"dvb"}),
        ("a [<motor> <angle>] - moves", {"a"}),
        ("g <az> <el>", {"g"}),
        ("stow: folds the dish", {"stow"}),
        ("motor  ngsearch  nvs ? q", {"motor", "ngsearch", "nvs", "q"}),
    ],
)
def test_commands_of_a_help_line(line, found):
    assert commands([line]) == found


@pytest.mark.parametrize("root", [ROOT, ("motor ngsearch nvs q",), ("Enter <motor> - x", "Enter <ngsearch> - y")])
def test_the_root_is_told_at_once(places, root):
    assert places.judge(root) == "root"


def test_a_submenu_that_was_not_seen_before_must_show_twice(places):
    assert places.judge(MOTOR) is None
    assert places.judge(("d [<index>]", "e <index>", "s")) is None
    assert places.judge(MOTOR) is None
    told = places.judge(MOTOR)
    assert told not in (None, "root")
    places.entered("motor", ">")
    assert places.judge((*MOTOR, "AZ calibrating")) == "motor"


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize(
    "lines",
    [
        ("moor", "ngsarch", "nvs", "reboot", "stow", "q"),
        ("mtr", "ngseach", "nvs", "reboot", "stw", "q"),
        ("nvs", "reboot", "q"),
        ("motor", "q"),
        ("Invalid command", "q"),
        (),
    ],
)
def test_a_root_with_bytes_lost_is_never_a_submenu(places, lines, known):
    if known:
        places.judge(ROOT)
    assert [places.judge(lines) for _ in range(4)] == [None] * 4


def test_a_prompt_tells_a_menu_only_when_the_root_shows_another(places):
    places.at_end("root", ">")
    places.entered("motor", ">")
    assert not places.is_told_by(">", "motor")
    places.entered("motor", "MOT>")
    assert places.is_told_by("MOT>", "motor")
    assert not places.is_told_by("MOT>", "nvs")


SEARCH, NVS = ("s", "q"), ("d [<index>]", "e <index> [<value>]", "s", "q")


@pytest.fixture
def knowing(places):
    """A dish all of whose menus were seen."""
    places.judge(ROOT)
    for menu, lines in (("ngsearch", SEARCH), ("motor", MOTOR), ("nvs", NVS)):
        places.judge(lines)
        places.judge(lines)
        places.entered(menu, ">")
    return places


@pytest.mark.parametrize(
    "lines",
    [
        ("a [<motor> <angle>]", "g <az> <el> <s>", "q"),
        ("d [<>]", "e < > [< >]", "s", "q"),
        ("motor!", "n gse~rch", "nvs", "reb[oot", "s tow", "q"),
    ],
)
def test_a_short_help_is_not_told_by_a_damaged_one_that_holds_its_words(knowing, lines):
    assert knowing.judge(lines) is None


@pytest.mark.parametrize(("menu", "lines"), [("ngsearch", SEARCH), ("motor", MOTOR), ("nvs", NVS)])
def test_each_help_is_told_from_those_that_it_holds(knowing, menu, lines):
    assert knowing.judge(lines) == menu


def test_a_letter_that_noise_cut_off_the_roots_help_hides_no_submenu(places):
    places.judge(("motor", "ngsearch", "n vs", "reboot", "s tow", "q"))
    assert places.judge(SEARCH) is None
    assert places.judge(SEARCH) is not None


def test_the_root_of_another_firmware_is_no_submenu_however_often_it_shows():
    """A `q` would go out from a submenu: at this root it may end the shell."""
    places = MenuPlaces(replace(bench.HAL, stranger_marks=frozenset({"mot"})))
    other = ("Enter <mot> - motors", "Enter <dvb> - tuner", "Enter <eeprom> - table", "q")
    assert places.judge(ROOT) == "root"
    assert [places.judge(other) for _ in range(3)] == [None, None, None]
    assert places.is_stranger(other)
