"""`birdcage status` where programs drive several dishes: each is told, by its name; a dish that is named, alone."""

from __future__ import annotations

import json

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.base.paths import Paths
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.station import control_client
from birdcage.station.control_client import NoAnswer, OwnerGone, owner_file, owners_folder
from birdcage.station.report import status_report
from birdcage.station.state import StationState


@pytest.fixture
def drive(tmp_path, monkeypatch):
    """Announce a program at a port, that tells of this dish, or raises; return the port."""
    answers, folder = {}, owners_folder(Paths.default())

    def drive(name, answer):
        port = str(tmp_path / name)
        folder.mkdir(parents=True, exist_ok=True)
        told = {"pid": 1, "tcp_port": 1, "token": "t", "port": port, "asked": port}
        owner_file(folder, port).write_text(json.dumps(told))
        answers[port] = answer
        return port

    def call(owner, _request, by):
        assert by == "birdcage status"
        answer = answers[owner.port]
        if isinstance(answer, Exception):
            raise answer
        return dict(status_report(StationState(port=owner.port, dish=answer), 0.0))

    monkeypatch.setattr(control_client, "call_owner", call)
    return drive


def lines(result):
    assert result.exit_code == 0, result.stderr
    return [json.loads(line) for line in result.stdout.splitlines()]


def test_without_a_port_each_dish_is_told_by_its_name(run, drive):
    north, south = drive("north", CARRYOUT_G2), drive("south", TRAVLER)
    told = lines(run("status", "--json", port="", firmware=""))
    assert [(each["port"], each["firmware"]) for each in told] == [(north, "g2"), (south, "hal205")]
    shown = run("status", port="", firmware="").stdout.splitlines()
    assert shown[0] == f"Carryout G2 at {north}"
    assert shown[shown.index("") + 1] == f"Trav'ler at {south}"
    assert sum(line.startswith("connected ") for line in shown) == 2


def test_a_port_in_the_settings_comes_first_and_hides_no_other(run, drive, tmp_path):
    north, south = drive("north", CARRYOUT_G2), drive("south", TRAVLER)
    file = Paths.default().config_file
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(f'[dish]\nport = "{south}"\n')
    assert [each["port"] for each in lines(run("status", "--json", port="", firmware=""))] == [south, north]
    other = tmp_path / "north.toml"
    other.write_text(f'[dish]\nport = "{north}"\n')
    named = run("status", "--json", "--config", other, port="", firmware="")
    assert [each["port"] for each in lines(named)] == [north]


@pytest.mark.parametrize("how", ["flag", "environment"])
def test_a_port_that_is_named_is_told_alone(run, drive, how):
    drive("north", CARRYOUT_G2)
    south = drive("south", TRAVLER)
    flag, variable = (["--port", south], "") if how == "flag" else ([], south)
    result = run("status", *flag, port=variable, firmware="")
    assert result.stdout.startswith("connected ")
    assert result.stdout.count("connected ") == 1


def test_the_only_dish_that_is_driven_needs_no_port(run, drive):
    north = drive("north", CARRYOUT_G2)
    drive("gone", OwnerGone("process 1 has ended"))
    assert [each["port"] for each in lines(run("status", "--json", port="", firmware=""))] == [north]


@pytest.mark.parametrize(
    ("error", "words", "status"),
    [(NoAnswer("Process 1 does not answer"), "Process 1 does not answer.", 3), (CommandRefused("Older."), "Older.", 1)],
)
def test_a_program_that_tells_nothing_hides_no_other(run, drive, error, words, status):
    north, mute = drive("north", CARRYOUT_G2), drive("mute", error)
    result = run("status", "--json", port="", firmware="")
    told = {each["port"]: each for each in map(json.loads, result.stdout.splitlines())}
    assert (told[north]["firmware"], told[mute]["firmware"], told[mute]["connected"]) == ("g2", None, False)
    assert (words in result.stderr, result.exit_code) == (True, status)
