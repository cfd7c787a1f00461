"""`birdcage acquire`: a satellite is found near where it should be, named, and north set by it."""

from __future__ import annotations

import re
from datetime import UTC, datetime

import pytest
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.cli.commands.acquire import _tell_who
from birdcage.signal.acquired import acquired
from birdcage.signal.slots_heard import seen_from, slot_typed
from birdcage.sky.observer import Observer
from birdcage.station.state import Pointing

SEEN = seen_from(Observer(39.1, -95.7), "radio")
KANSAS = ("place", "add", "home", "39.1 -95.7", "--use")


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


@pytest.fixture
def at_home(run):
    assert run(*KANSAS).exit_code == 0
    return run


def test_it_is_found_named_and_north_set_by_it(at_home, as_json):
    result = at_home("acquire", "61.5W", "--json", "--set-north", port="sim:g2?seed=4&heading=5")
    told = as_json(result)
    assert (told["lock"], told["network"], told["transponder"], told["may_be"][0]) == (True, "0x1003", 16.0, -61.5)
    assert told["az_offset_deg"] == pytest.approx(5.0, abs=0.4)
    assert told["demo"] is True
    assert re.search(r"61\.5°W EchoStar 16 should be at 132\.8\d°/32\.6\d°\.", result.stderr)
    assert re.search(
        r"If it is 61\.5°W, it was found [45]\.\d\d° left of its place, 0\.\d\d° (above|below)\.", result.stderr
    )
    assert f"Set: az offset {told['az_offset_deg']:+.2f}°, el offset" in result.stderr
    kept = load(Paths.default().config_file).alignment
    assert (kept.az_offset_deg, kept.el_offset_deg) == (told["az_offset_deg"], told["el_offset_deg"])


def found(label, *, right_deg=0.0, up_deg=0.0, network="none"):
    """What was found so far from a slot's place."""
    one = slot_typed(label, SEEN)
    az_deg, el_deg = one.az_deg + right_deg, one.el_deg + up_deg
    told = {"az_deg": az_deg, "el_deg": el_deg, "sigma_deg": 0.05, "rise": 100.0, "network": network}
    return acquired(told, Pointing(az_deg, el_deg, az_deg, el_deg, 0.0, datetime.now(UTC)), SEEN, 15.0)


def said_of(what, label, wants, capsys, *, set_north):
    _tell_who(what, slot_typed(label, SEEN), wants, set_north=set_north)
    return capsys.readouterr().err


@pytest.mark.parametrize("set_north", [False, True])
def test_what_stands_too_high_is_not_taken_for_it(capsys, set_north):
    said = said_of(found("61.5W", up_deg=25.0), "61.5W", None, capsys, set_north=set_north)
    assert said == (
        "By height and network this is not 61.5°W. No known satellite fits: are place and level right? "
        "Nothing was set.\n"
    )


def test_a_likelier_one_is_named_and_nothing_is_set_unasked(capsys):
    said = said_of(found("101W"), "110W", None, capsys, set_north=False)
    assert re.search(r"If it is 110°W, it was found \d+\.\d\d° left of its place", said)
    assert "By its place it is more likely 101°W" in said
    assert said.endswith("Is it 110°W? The same with --set-north sets the alignment by it.\n")


def test_another_networks_satellite_is_left_out(capsys):
    said = said_of(found("101W", network="0x1004"), "101W", None, capsys, set_north=True)
    assert said.startswith("By height and network this is not 101°W. It may be 110°W")
    assert said.endswith("Nothing was set.\n")


def test_where_nothing_is_heard_it_says_so_with_status_1(at_home):
    result = at_home("acquire", "61.5W", "--within", "0", "--up-down", "0", port="sim:g2?seed=4&heading=40")
    assert (result.exit_code, result.stdout) == (1, "")
    assert "No signal stands out within 0° to the sides and 0° up and down." in result.stderr


@pytest.mark.parametrize(("target", "words"), [
    ("moon", "is no geostationary satellite. Name one: `birdcage acquire 119W`."),
    ("19.2E", "is below the horizon here, always."),
])  # fmt: skip
def test_what_can_not_be_found_is_refused_before_the_dish_moves(at_home, target, words):
    result = at_home("acquire", target)
    assert result.exit_code == 2
    assert words in " ".join(result.stderr.split())


def test_a_dish_without_a_tuner_is_not_moved(at_home):
    result = at_home("acquire", "61.5W", port="sim:hal205", firmware="hal205")
    assert result.exit_code == 1
    assert "has no tuner to read. With --source your receiver is heard. Nothing was sent." in result.stderr


def test_without_a_place_it_says_what_to_do(run):
    result = run("acquire", "61.5W")
    assert result.exit_code != 0
    assert "No place is set." in result.stderr
