"""`birdcage track` and `autotrack` beside a station that has the port: it follows, and goes on without them."""

from __future__ import annotations

import json
import signal
import threading
import time
from datetime import UTC, datetime

import pytest
from birdcage.base.paths import Paths
from birdcage.pursuit.attached_desk import AttachedDesk
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer
from birdcage.station.attached import AttachedStation
from birdcage.station.control_client import find_owner, owners_folder

PLACE = '[place]\nname = "Bench"\nlatitude_deg = 47.0\nlongitude_deg = 8.0\n'
SLOT = "19.2E"
"""Always up there, at 165° of azimuth and 35° of elevation."""


def until(seen, within_s=40.0) -> None:
    end = time.monotonic() + within_s
    while not seen():
        assert time.monotonic() < end, "not seen in time"
        threading.Event().wait(0.02)


@pytest.fixture
def station(start, pty_dish):
    config = Paths.default().config_file
    config.parent.mkdir(parents=True, exist_ok=True)
    config.write_text(PLACE)
    process = start("station", "run", "--port", pty_dish.path, "--firmware", "g2", "--skip-init")
    until(lambda: find_owner(owners_folder(Paths.default()), pty_dish.path) is not None)
    return process


def told(process, words) -> None:
    """Wait until a command says something on stderr."""
    for line in process.stderr:
        if words in line:
            return
    raise AssertionError(f"never said {words!r}")


@pytest.mark.parametrize("pty_dish", ["seed=1&az_speed=30"], indirect=True)
@pytest.mark.parametrize("end", ["SIGHUP", "SIGTERM", "SIGKILL"])
def test_what_it_follows_goes_on_when_the_command_is_gone(start, pty_dish, station, end) -> None:
    process = start("track", SLOT, "--engage", "--port", pty_dish.path)
    told(process, f"birdcage station run (process {station.pid}) follows it.")
    pty_dish.wait_for_motion()
    process.send_signal(getattr(signal, end))
    process.communicate(timeout=30)
    pty_dish.wait_for(lambda truth: not truth.moving and abs(truth.az_deg - 164.84) < 0.3)
    assert pty_dish.device.truth().el_deg == pytest.approx(34.9, abs=0.3)
    assert process.returncode in (128 + getattr(signal, end), -signal.SIGKILL)


@pytest.mark.parametrize("pty_dish", ["seed=1&az_speed=10"], indirect=True)
def test_ctrl_c_is_stop(run, as_json, start, pty_dish, station) -> None:
    process = start("track", SLOT, "--engage", "--json", "--port", pty_dish.path)
    told_first = process.stdout.readline()
    pty_dish.wait_for_motion()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 130
    pty_dish.wait_for(lambda truth: not truth.moving)
    assert abs(pty_dish.device.truth().az_deg - 164.84) > 10.0
    assert as_json(run("status", "--json", port=pty_dish.path))["held"] is True
    assert "plan" in [json.loads(line)["event"] for line in (told_first + out).splitlines()]
    assert "The dish was last seen at" in err


@pytest.mark.parametrize("words", [("--lat", 50, "--lon", 10), ("--controller", "fast")])
def test_what_only_a_desk_of_its_own_takes_is_refused(run, pty_dish, station, words) -> None:
    result = run("track", SLOT, "--engage", *words, port=pty_dish.path)
    assert result.exit_code == 2
    assert "follows from its own place. Leave out" in result.stderr
    assert pty_dish.moves() == []


def test_a_station_that_ends_meanwhile_is_told(start, pty_dish, station) -> None:
    process = start("track", SLOT, "--engage", "--port", pty_dish.path)
    told(process, "follows it.")
    pty_dish.wait_for_motion()
    station.kill()
    _out, err = process.communicate(timeout=30)
    assert process.returncode == 3
    assert "No birdcage program drives the dish now." in err


def test_a_program_without_a_tracker_is_told_of(run, pty_dish, owner) -> None:
    Paths.default().config_file.parent.mkdir(parents=True, exist_ok=True)
    Paths.default().config_file.write_text(PLACE)
    result = run("track", SLOT, "--engage", port=pty_dish.path)
    assert result.exit_code == 3
    assert "`birdcage station run` does" in result.stderr
    assert pty_dish.moves() == []


@pytest.fixture
def desk(station, pty_dish):
    """The station's desk, as another face has it."""
    face = AttachedStation(Paths.default(), pty_dish.path)
    desk = AttachedDesk(face, lambda _now: None)
    desk.start()
    yield desk
    desk.close()
    face.close()


@pytest.mark.parametrize("pty_dish", ["seed=1&az_speed=30"], indirect=True)
def test_autotrack_is_switched_on_there_and_off_by_ctrl_c(start, pty_dish, desk) -> None:
    orbits = demo_orbits(datetime.now(UTC), Observer(47.0, 8.0))
    with Catalogue(Paths.default().catalogue) as catalogue:
        catalogue.add(orbits)
        for each in orbits:
            catalogue.set_favourite(each.norad_id)
    process = start("autotrack", "--engage", "--port", pty_dish.path)
    told(process, "follows them.")
    pty_dish.wait_for_motion()
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=30)
    assert desk.now.autotrack
    again = start("autotrack", "--engage", "--port", pty_dish.path)
    told(again, "follows them.")
    told(again, "follow")  # the schedule: what that program does
    again.send_signal(signal.SIGINT)
    again.communicate(timeout=30)
    assert again.returncode == 130
    until(lambda: desk.now.autotrack is False)
