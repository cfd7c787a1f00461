"""`birdcage ready`: what is missing before one leaves home, and the command that mends each."""

from __future__ import annotations

import re
import socket
import threading
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import birdcage.gps.clock_check
import pytest
from birdcage.base.paths import Paths
from birdcage.gps.verdict import ClockVerdict
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.elements import ElementSet

NOW = datetime.now(UTC)
STATION = ElementSet("ISS (ZARYA)", 25544, NOW - timedelta(hours=6), 51.6, 0, 0.0005, 0, 0, 15.4995)
SETTINGS = """
[dish]
port = "{port}"
firmware = "g2"
[motion]
cable_min_deg = -360.0
cable_max_deg = 20.0
min_elevation_deg = 18.0
[place]
name = "Field"
latitude_deg = 52.0
longitude_deg = 5.0
[feed]
active = "helix"
[feed.helix]
freq_min_hz = 1.67e9
freq_max_hz = 1.71e9
[setup]
search = "done 2026-11-01T10:00Z: NVS 20 TRUE"
"""


@pytest.fixture(autouse=True)
def at_home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    return tmp_path


@pytest.fixture(autouse=True)
def clock(monkeypatch):
    """Let the system say of its clock what a test wants."""

    def say(verdict):
        monkeypatch.setattr(birdcage.gps.clock_check, "check_clock", lambda _now, _state: verdict)

    say(ClockVerdict("network", "network time (chrony)", NOW, None, 0.01))
    return say


@pytest.fixture
def prepared(at_home):
    """Set everything up: what is taken away afterwards is missing."""
    (at_home / "tty").touch()
    (at_home / "birdcage.toml").write_text(SETTINGS.format(port=at_home / "tty"))
    with Catalogue(Paths.in_folder(at_home).catalogue) as catalogue:
        # Not the age at import: a suite may have run for minutes since.
        catalogue.add([replace(STATION, epoch=datetime.now(UTC) - timedelta(hours=6))])
        catalogue.set_favourite(25544)
    return at_home


@pytest.fixture
def ready(run, as_json):
    """Return the exit status and the checks by name."""

    def ready(*words):
        result = run("ready", "--json", *words, port=None, firmware="")
        return result.exit_code, {each["name"]: each for each in as_json(result)["checks"]}

    return ready


def test_all_is_well(run, prepared):
    result = run("ready", port=None, firmware="")
    told = [" ".join(line.split()) for line in result.stdout.splitlines()]
    assert all(line.startswith("✓") for line in told), result.stdout
    assert "✓ place Field: 52.000, 5.000, 0 m, flat horizon" in told
    assert "✓ TV search NVS 20 TRUE (2026-11-01)" in told
    assert "✓ limits cable -360° to +20°, elevation 18° to -" in told
    assert "✓ elements one satellite, 6 h old" in told
    assert any(line.startswith("✓ ISS (ZARYA) ● fresh: 6 h old, ±0.10° (90 %:") for line in told)
    assert result.stderr.strip() == "Ready."
    assert result.exit_code == 0


def test_nothing_at_all_names_what_must_be_done_and_the_command_for_each(ready):
    status, found = ready()
    assert status == 1
    assert {name for name, each in found.items() if each["state"] == "must"} == {"place", "elements"}
    assert found["elements"]["remedy"] == "birdcage elements update"
    assert found["place"]["remedy"] == "birdcage place add"
    assert {name for name, each in found.items() if each["state"] == "look"} == {
        "dish", "port", "TV search", "limits", "feed",
    }  # fmt: skip
    assert all(each["remedy"] for each in found.values() if each["state"] != "good")


def test_what_is_only_worth_a_look_leaves_the_exit_status_at_0(ready, prepared):
    (prepared / "tty").unlink()
    status, found = ready()
    assert found["port"]["state"] == "look"
    assert "not plugged in" in found["port"]["words"]
    assert status == 0


def test_a_favourite_whose_elements_are_useless_must_be_updated(ready, prepared):
    with Catalogue(Paths.in_folder(prepared).catalogue) as catalogue:
        catalogue.remove([25544])
        catalogue.add([replace(STATION, epoch=NOW - timedelta(days=10))])
        catalogue.set_time_offset(25544, 1.5, now=datetime(2026, 11, 1, tzinfo=UTC))
    status, found = ready()
    assert status == 1
    assert found["ISS (ZARYA)"]["state"] == "must"
    assert found["ISS (ZARYA)"]["words"].startswith("✗ useless: 10 d old, error unknown: figures end at 7 d with ±17°")
    assert found["ISS (ZARYA)"]["words"].endswith("; your offset +1.5 s is of 2026-11-01")
    assert found["elements"]["state"] == "look", "its age alone is worth a look"


def test_the_few_that_ship_are_no_elements(ready, prepared):
    from birdcage.sky.frozen import frozen

    with Catalogue(Paths.in_folder(prepared).catalogue) as catalogue:
        catalogue.remove([25544])
        catalogue.add(frozen())
    assert ready()[1]["elements"]["state"] == "must"


def test_a_damaged_catalogue_is_told_and_the_rest_goes_on(ready, prepared):
    Paths.in_folder(prepared).catalogue.write_bytes(b"no database" * 100)
    status, found = ready()
    assert status == 1
    assert "can't be read" in found["elements"]["words"]
    assert found["ephemeris"]["state"] == "good"


@pytest.mark.parametrize(
    ("verdict", "state"),
    [
        (ClockVerdict("unknown", "none", NOW, doubt="Nobody knows."), "look"),
        (ClockVerdict("remembered", "gpsd", NOW, 5.0, 0.1, doubt="The clock is 5.0 s fast: set it."), "must"),
    ],
)
def test_a_clock_that_is_wrong_must_be_set_and_one_of_which_nobody_knows_is_worth_a_look(
    ready, prepared, clock, verdict, state
):
    clock(verdict)
    found = ready()[1]["clock"]
    assert (found["state"], found["words"]) == (state, verdict.doubt)
    assert "birdcage clock" in found["remedy"]


def test_a_port_that_may_not_be_used_must_be_mended(ready, prepared, monkeypatch):
    monkeypatch.setattr("os.access", lambda _path, _mode: False)
    status, found = ready()
    assert status == 1
    assert "you may not open it" in found["port"]["words"]


def test_a_port_that_is_an_address_is_not_asked(ready, prepared):
    status, found = ready("--port", "socket://dish.local:4000")
    assert status == 0
    assert found["port"]["state"] == "look"
    assert "only when opened" in found["port"]["words"]


def test_settings_that_limit_motion_and_cannot_be_read_must_be_mended(ready, prepared):
    with (prepared / "birdcage.toml").open("a") as file:
        file.write("\n[alignment]\naz_offset_deg = 'north'\n")
    status, found = ready()
    assert status == 1
    assert found["config"]["state"] == "must"
    assert "alignment.az_offset_deg" in found["config"]["words"]


def test_a_firmware_that_nobody_speaks_must_be_mended(ready, prepared):
    assert ready("--firmware", "g9")[1]["dish"]["state"] == "must"


def test_ones_own_table_of_downlinks_is_read(ready, prepared):
    (prepared / "downlinks.toml").write_text("[[downlink]]\n")
    found = ready()[1]["downlinks"]
    assert found["state"] == "look"
    assert "satellite is missing" in found["words"] or "freq_mhz is missing" in found["words"]


RADIO = "\n[radio]\nrigctld = '127.0.0.1:{}'\n"


@pytest.fixture
def set_up(prepared):
    def set_up(text):
        with (prepared / "birdcage.toml").open("a") as file:
            file.write(text)

    return set_up


def test_without_receiver_and_hooks_there_is_nothing_to_check(ready, prepared):
    assert not {"radio", "hooks"} & ready()[1].keys()


@pytest.mark.parametrize(
    ("reply", "state", "words"),
    [
        (b"137912500\n", "good", "answers, tuned to 137.9125 MHz"),
        (b"RPRT -11\n", "good", "answers"),
        (b"220 ftp ready\n", "look", "that is not rigctld"),
        (b"", "look", "has not answered within 1 s|No answer to 'f' within 1 s"),
    ],
)
def test_the_receiver_is_asked_whether_it_is_there(ready, set_up, reply, state, words):
    heard = []

    def serve(listening):
        client, _ = listening.accept()
        with client:
            heard.append(client.recv(100))
            client.sendall(reply)
            client.recv(100)

    with socket.create_server(("127.0.0.1", 0)) as listening:
        serving = threading.Thread(target=serve, args=(listening,), daemon=True)
        serving.start()
        set_up(RADIO.format(listening.getsockname()[1]))
        status, found = ready()
        serving.join(5.0)
    assert (status, found["radio"]["state"]) == (0, state)
    assert re.search(words, found["radio"]["words"])
    assert heard == [b"f\n"]


def test_a_receiver_that_is_not_there(ready, set_up):
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    set_up(RADIO.format(port))
    found = ready()[1]["radio"]
    assert found["state"] == "look"
    assert f"Nothing listens at 127.0.0.1:{port}" in found["words"]
    assert "SDR++" in found["remedy"]


@pytest.mark.parametrize(
    ("command", "state", "words"),
    [
        ("sh -c 'true'", "good", "at_tca can be started"),
        ("no-such-recorder --now", "look", "there is no program 'no-such-recorder'"),
        ("sh -c 'true", "look", "cannot be read"),
    ],
)
def test_hooks_are_looked_for_and_not_run(ready, set_up, command, state, words):
    set_up(f'\n[hooks]\nat_tca = "{command}"\n')
    found = ready()[1]["hooks"]
    assert found["state"] == state
    assert words in found["words"]


def test_no_network_is_touched_and_no_file_is_made(ready, at_home, monkeypatch):
    def refuse(*_args):
        raise AssertionError("a socket was opened")

    monkeypatch.setattr(socket.socket, "connect", refuse)
    ready()
    assert list(at_home.iterdir()) == []
