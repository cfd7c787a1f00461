"""`birdcage scan` as a process on a pty: killed, hung up, unplugged, beside a station; other dishes by a receiver."""

from __future__ import annotations

import signal
import threading
import time

import pytest
from birdcage.base.paths import Paths
from birdcage.skymap.map_file import list_maps, read_map
from birdcage.station.control_client import find_owner, owners_folder

from tests.shared.pty_dish import PtyDish

REGION = ("scan", "--az", "150:166", "--el", "30:36", "--step", "2")
CELLS = 36


def until(seen, within_s=60.0) -> None:
    end = time.monotonic() + within_s
    while not seen():
        assert time.monotonic() < end, "not seen in time"
        threading.Event().wait(0.05)


def heard() -> int:
    maps = list_maps(Paths.default().signal_recordings)
    return maps[0].heard if maps else 0


def whole(number=1) -> list[int]:
    """The cells of a map in the order in which they were heard."""
    return [each.cell for each in read_map(Paths.default().signal_recordings, number).samples]


@pytest.mark.parametrize(
    "end", ["SIGKILL", *(pytest.param(each, marks=pytest.mark.soak) for each in ("SIGHUP", "SIGTERM"))]
)
def test_a_map_that_was_cut_short_goes_on_where_it_was(run, start, pty_dish, end) -> None:
    process = start(*REGION, "--port", pty_dish.path, "--firmware", "g2")
    until(lambda: heard() >= 8)
    process.send_signal(getattr(signal, end))
    process.communicate(timeout=30)
    first = read_map(Paths.default().signal_recordings, 1).samples
    assert 8 <= len(first) < CELLS
    result = run("scan", "--resume", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert f"{CELLS - len(first)} directions, about" in result.stderr
    assert read_map(Paths.default().signal_recordings, 1).samples[: len(first)] == first
    assert sorted(whole()) == list(range(CELLS))


@pytest.mark.soak
def test_ctrl_c_is_stop_and_it_goes_on_after_release(run, start, pty_dish) -> None:
    process = start(*REGION, "--port", pty_dish.path, "--firmware", "g2")
    until(lambda: heard() >= 8)
    process.send_signal(signal.SIGINT)
    _out, err = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "directions are kept." in err
    held = run("scan", "--resume", port=pty_dish.path)
    assert held.exit_code != 0
    assert "release" in held.stderr
    assert run("release", port=pty_dish.path).exit_code == 0
    assert run("scan", "--resume", port=pty_dish.path).exit_code == 0
    assert sorted(whole()) == list(range(CELLS))


@pytest.mark.soak
def test_a_cable_that_is_pulled_is_told_and_the_map_can_be_resumed(run, start, pty_dish) -> None:
    process = start(*REGION, "--port", pty_dish.path, "--firmware", "g2")
    until(lambda: heard() >= 8)
    pty_dish.unplug()
    told = ""
    while "Link lost" not in told:
        told = process.stderr.readline()
        assert told, "it has ended"
    assert told.strip() == "Link lost: the dish stays still. Release it, and the map goes on."
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=30)
    first = read_map(Paths.default().signal_recordings, 1).samples
    assert 8 <= len(first) < CELLS
    with_cable = PtyDish("seed=1")
    try:
        run("release", port=with_cable.path)
        assert run("scan", "--resume", port=with_cable.path).exit_code == 0
    finally:
        with_cable.close()
    assert read_map(Paths.default().signal_recordings, 1).samples[: len(first)] == first
    assert sorted(whole()) == list(range(CELLS))


@pytest.mark.soak
def test_a_terminal_that_closes_beside_a_station_leaves_the_map_to_it(start, pty_dish) -> None:
    start("station", "run", "--port", pty_dish.path, "--firmware", "g2", "--skip-init")
    until(lambda: find_owner(owners_folder(Paths.default()), pty_dish.path) is not None)
    process = start(*REGION, "--port", pty_dish.path)
    until(lambda: heard() >= 5)
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=30)
    assert heard() < CELLS
    until(lambda: heard() == CELLS)
    assert sorted(whole()) == list(range(CELLS))


@pytest.mark.parametrize(
    ("firmware", "speed"), [("carryout", 10.0), pytest.param("hal205", 10.0, marks=pytest.mark.soak)]
)
def test_a_dish_without_a_tuner_makes_a_map_by_a_receiver(run, tmp_path, firmware, speed) -> None:
    dish = PtyDish("seed=1", firmware, speed)
    file = tmp_path / "own.toml"
    asked = "sh -c 'while read _; do echo -41.5; done'"
    file.write_text(f'[signal.meter]\ncommand = "{asked}"\nask = true\nevery_s = 0.1\n')
    try:
        words = ("--config", file, "scan", "--az", "150:154", "--el", "30:34", "--step", "2", "--source", "meter")
        result = run(*words, "--reads", 2, port=dish.path, firmware=firmware)
        assert result.exit_code == 0, result.stderr
    finally:
        dish.close()
    made = read_map(Paths.default().signal_recordings, 1)
    assert sorted(each.cell for each in made.samples) == list(range(9))
    assert (made.source, made.decibels) == ("meter", True)
    assert {each.n for each in made.samples} == {2}
