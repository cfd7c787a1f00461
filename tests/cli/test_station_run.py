"""A station without a face, for the length of a command."""

from __future__ import annotations

import json
import os
import signal

import pytest
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.cli.also import also_wanted
from birdcage.cli.dish import open_dish, open_dishes
from birdcage.cli.exits import EndedBySignal
from birdcage.cli.options import Wanted
from birdcage.cli.station_run import run_station
from birdcage.station.holding import find_held
from birdcage.station.requests import Goto
from birdcage.station.state import LinkPhase
from pty_dish import PtyDish


def wanted(port: str) -> Wanted:
    return Wanted(port, True, "g2", True, None, load(None), Paths.default())


def test_it_runs_until_a_signal_and_stops_what_moves_first(pty_dish, capsys):
    asked = []

    def look():
        if not asked and dish.state.position is not None:
            asked.append(dish.station.submit(Goto(200.0, 45.0, "somebody")))
        if asked and pty_dish.device.truth().moving:
            dish.on_signal(signal.SIGTERM)

    with pytest.raises(EndedBySignal) as ended, open_dish(wanted(pty_dish.path), moves=True) as dish:
        run_station((dish,), each_time=look)
    said = capsys.readouterr()
    assert "link up" in said.err
    assert "control: somebody, before free" in said.err
    assert said.out == ""
    assert ended.value.number == signal.SIGTERM
    assert "The dish was last seen at" in ended.value.__notes__[-1]
    assert not pty_dish.device.truth().moving
    assert abs(pty_dish.device.truth().az_deg - 200.0) > 10.0


def test_a_dish_that_is_not_there_ends_nothing_and_is_found_when_it_comes(pty_dish, capsys, tmp_path):
    port = tmp_path / "dish"
    seen = set()

    def look():
        phase = dish.state.link.state
        if phase is LinkPhase.LOST and not port.exists():
            port.symlink_to(pty_dish.path)
        seen.add(phase)
        if phase is LinkPhase.UP:
            dish.on_signal(signal.SIGINT)

    with pytest.raises(EndedBySignal), open_dish(wanted(str(port)), moves=True) as dish:
        run_station((dish,), as_json=True, each_time=look)
    said = capsys.readouterr()
    events = [json.loads(line) for line in said.out.splitlines()]
    links = [event["link"]["state"] for event in events if event["type"] == "LinkChanged"]
    assert links[0] in ("opening", "lost")
    assert "up" in links
    assert {LinkPhase.LOST, LinkPhase.UP} <= seen


@pytest.fixture
def second_dish():
    dish = PtyDish("seed=2&az=-60&el=30")
    yield dish
    dish.close()


@pytest.fixture
def second_file(tmp_path, second_dish):
    """The `birdcage.toml` of the second dish."""
    file = tmp_path / "second.toml"
    file.write_text(f'[dish]\nport = "{second_dish.path}"\nfirmware = "g2"\n[motion]\nmax_elevation_deg = 60.0\n')
    return file


def both_moving(dishes, ptys, then):
    """Send both dishes off once they answer; `then` again and again once both have begun to move."""
    asked, moved = [], []

    def look():
        if not asked and all(dish.state.position is not None for dish in dishes):
            asked.extend(dish.station.submit(Goto(200.0, 45.0, "somebody")) for dish in dishes)
        if moved or (asked and all(each.device.truth().moving for each in ptys)):
            moved.append(True)
            then()

    return look


@pytest.fixture
def _hears_sigint():
    """A run in the background ignores SIGINT, and so would what it starts."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("_hears_sigint")
def test_one_signal_stops_both_dishes(pty_dish, second_dish, second_file, capsys):
    first = wanted(pty_dish.path)
    second, ptys = also_wanted(first, str(second_file)), (pty_dish, second_dish)
    with pytest.raises(EndedBySignal) as ended, open_dishes((first, second), moves=True) as dishes:
        run_station(
            dishes,
            each_time=both_moving(dishes, ptys, lambda: os.kill(os.getpid(), signal.SIGINT)),
        )
    said = capsys.readouterr().err
    for pty in ptys:
        assert not pty.device.truth().moving
        assert abs(pty.device.truth().az_deg - 200.0) > 10.0
        assert f"{pty.path}: The dish was last seen at" in "\n".join(ended.value.__notes__)
        assert find_held(first.paths, pty.path).note.by.endswith("(Ctrl+C)")
        assert f"{pty.path}: link up" in said


def test_stop_of_another_program_stops_both_and_each_is_released_by_name(
    pty_dish, second_dish, second_file, start, run, capsys
):
    first, ptys = wanted(pty_dish.path), (pty_dish, second_dish)
    asked = []

    def stop():
        if not asked:
            asked.append(start("stop", "--json"))
        elif asked[0].poll() is not None:
            raise EndedBySignal(signal.SIGTERM)

    with (
        pytest.raises(EndedBySignal),
        open_dishes((first, also_wanted(first, str(second_file))), moves=True) as dishes,
    ):
        run_station(dishes, as_json=True, each_time=both_moving(dishes, ptys, stop))
    told = [json.loads(line) for line in asked[0].communicate()[0].splitlines()]
    assert {each["port"] for each in told} == {pty.path for pty in ptys}
    assert all(each["confirmed"] and each["held"] for each in told)
    assert not any(pty.device.truth().moving for pty in ptys)
    events = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert {each["port"] for each in events if each["type"] == "StopSent"} == {pty.path for pty in ptys}
    unnamed = run("release", port="")
    assert (unnamed.exit_code, "2 dishes are held" in unnamed.stderr) == (2, True)
    assert run("release", port=second_dish.path).exit_code == 0
    assert find_held(first.paths, second_dish.path) is None
    assert find_held(first.paths, pty_dish.path) is not None


def test_a_dish_that_is_off_does_not_hinder_the_other(pty_dish, second_file, tmp_path):
    second_file.write_text(f'[dish]\nport = "{tmp_path}/not-plugged-in"\nfirmware = "g2"\n')
    first = wanted(pty_dish.path)

    def look():
        if dishes[0].state.position is not None and dishes[1].state.link.state is LinkPhase.LOST:
            dishes[0].on_signal(signal.SIGTERM)

    with (
        pytest.raises(EndedBySignal),
        open_dishes((first, also_wanted(first, str(second_file))), moves=True) as dishes,
    ):
        run_station(dishes, each_time=look)


def test_a_dish_keeps_to_its_own_settings(pty_dish, second_file):
    second = also_wanted(wanted(pty_dish.path), str(second_file))
    assert second.settings.motion.max_elevation_deg == 60.0
    assert second.load().motion.max_elevation_deg == 60.0
    assert wanted(pty_dish.path).settings.motion.max_elevation_deg is None
    assert second.paths.own != wanted(pty_dish.path).paths.own
    assert second.paths.state == wanted(pty_dish.path).paths.state


@pytest.mark.parametrize(
    ("text", "words"), [(None, "is not a file"), ("", "names no port"), ("FIRST", "as the first dish does")]
)
def test_a_file_that_describes_no_second_dish_is_refused(run, pty_dish, tmp_path, text, words):
    file = tmp_path / "other.toml"
    if text is not None:
        file.write_text(text.replace("FIRST", f'[dish]\nport = "{pty_dish.path}"\n'))
    result = run("station", "run", "--also", file, port=pty_dish.path)
    assert result.exit_code == 2
    assert words in result.stderr


def test_a_unit_for_systemd_names_the_second_dish(run, second_file):
    result = run("station", "run", "--print-systemd", "--also", second_file, port="/dev/ttyUSB0")
    assert f"--also {second_file}" in result.stdout
