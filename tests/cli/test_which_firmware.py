"""Every command finds out which firmware answers, when none is named."""

from __future__ import annotations

import json
import os
import threading

import pytest
from birdcage.base.geometry import shortest_turn
from birdcage.cli import which
from birdcage.detection.detecting import Detection
from installed_toys import installed
from pty_dish import PtyDish

pytest.importorskip("termios", reason="a pseudo terminal is needed")
import termios
import tty

SLOW = "seed=1&az_speed=4&el_speed=4"


@pytest.fixture(autouse=True)
def _short_waits(monkeypatch) -> None:
    """Wait less for a dish that might be starting, or busy."""
    monkeypatch.setattr("birdcage.detection.detecting.LOG_S", 0.3)
    monkeypatch.setattr("birdcage.cli.commands.stop.PATIENCE_S", 8.0)


@pytest.fixture
def unnamed(run):
    """Run `birdcage` with no firmware in flag, variable or settings."""
    return lambda *words, port, **more: run(*words, port=port, firmware="", **more)


@pytest.fixture
def foreign():
    """Something on a pseudo terminal that is no dish: it answers every write with what it is told to say."""
    made = []

    def foreign(answer: bytes) -> tuple[str, list[bytes]]:
        master, slave = os.openpty()
        tty.setraw(slave)
        heard: list[bytes] = []

        def serve() -> None:
            while (data := os.read(master, 100)) != b"\x04":
                heard.append(data)
                os.write(master, answer)

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        made.append((master, slave, thread))
        return os.ttyname(slave), heard

    yield foreign
    for master, slave, thread in made:
        os.write(slave, b"\x04")
        thread.join(5)
        os.close(slave)
        os.close(master)


def test_pos_speaks_what_answers(unnamed, pty_dish) -> None:
    result = unnamed("pos", port=pty_dish.path)
    assert (result.exit_code, result.stdout) == (0, "AZ: 0.0\nEL: 45.0\n"), result.stderr
    assert "is a Carryout G2 (g2): `?` lists" in result.stderr
    assert pty_dish.moves() == []


def test_a_travler_is_found_too(unnamed, pty_travler) -> None:
    result = unnamed("pos", port=pty_travler.path)
    assert (result.exit_code, result.stdout) == (0, "AZ: 180.0\nEL: 45.0\nSK: 90.0\n"), result.stderr


def test_move_speaks_what_answers(unnamed, pty_dish) -> None:
    result = unnamed("move", "--az", 10, "--el", 40, port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert pty_dish.device.truth().az_deg == pytest.approx(10.0, abs=0.1)


def test_home_of_a_travler_is_refused_once_it_is_found(unnamed, pty_travler) -> None:
    result = unnamed("home", "--yes", port=pty_travler.path)
    assert result.exit_code == 4
    assert "homes only at power-up" in result.stderr
    assert set(pty_travler.lines()) <= {"", "?"}


@pytest.mark.parametrize("pty_dish", [SLOW], indirect=True)
@pytest.mark.parametrize("named", ["", "hal205"])
def test_stop_without_an_owner_stops_a_g2_whatever_was_named(run, pty_dish, named) -> None:
    assert run("move", "--az", 90, "--el", 30, "--no-wait", port=pty_dish.path).exit_code == 0
    pty_dish.wait_for_motion()
    result = run("stop", "--json", port=pty_dish.path, firmware=named)
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["confirmed"] is True
    truth = pty_dish.device.truth()
    assert not truth.moving
    assert abs(shortest_turn(truth.az_deg, 90.0)) > 20.0, "it was stopped, and did not arrive"


def test_stop_goes_by_the_name_where_the_console_leaves_several_open(run) -> None:
    dish = PtyDish("seed=1&az_speed=4&el_speed=4", "g2plus")
    assert run("move", "--az", 90, "--el", 30, "--no-wait", port=dish.path, firmware="g2plus").exit_code == 0
    dish.wait_for_motion()
    result = run("stop", "--json", port=dish.path, firmware="g2plus")
    dish.close()
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["confirmed"] is True
    assert "may be any of" not in result.stderr


def test_stop_of_a_misnamed_dish_asks_again_where_the_first_answer_is_lost(run, pty_dish, monkeypatch) -> None:
    ask, asked = which.ask_port, []

    def asking(wanted, clock, **more):
        found = ask(wanted, clock, **more)
        asked.append(found)
        return found if len(asked) > 1 else Detection(pty_dish.path, None, "Nothing answers.")

    monkeypatch.setattr(which, "ask_port", asking)
    result = run("stop", "--json", port=pty_dish.path, firmware="hal205")
    assert result.exit_code == 0, result.stderr
    assert len(asked) == 2
    assert json.loads(result.stdout)["confirmed"] is True


def test_stop_without_an_owner_ends_the_slew_of_a_travler(unnamed, pty_travler) -> None:
    port = os.open(pty_travler.path, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(port)
    speed = termios.tcgetattr(port)
    speed[4] = speed[5] = termios.B57600
    termios.tcsetattr(port, termios.TCSANOW, speed)
    os.write(port, b"motor\r")
    pty_travler.wait_for(lambda _truth: "motor" in pty_travler.lines())
    os.write(port, b"g 350 60 90\r")
    pty_travler.wait_for_motion()
    os.close(port)
    result = unnamed("stop", "--json", port=pty_travler.path)
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["confirmed"] is True
    truth = pty_travler.device.truth()
    assert not truth.moving
    assert truth.az_deg != pytest.approx(350.0, abs=1.0)


def test_stop_of_what_is_no_dish_says_so_and_sends_nothing_that_moves(unnamed, foreign) -> None:
    port, heard = foreign(b"\r\npi@raspberrypi:~$ ")
    result = unnamed("stop", "--json", port=port)
    assert result.exit_code == 1, result.stderr
    told = json.loads(result.stdout)
    assert told["confirmed"] is None
    assert "cut its power" in told["sentence"]
    assert set(b"".join(heard)) == {ord("\r")}


@pytest.mark.parametrize("words", [("pos",), ("move", "--az", 10, "--el", 40), ("home", "--yes")])
def test_what_is_no_dish_is_not_taken_for_one(unnamed, foreign, words) -> None:
    port, heard = foreign(b"\r\nraspberrypi login: ")
    result = unnamed(*words, port=port)
    assert result.exit_code == 2, result.stderr
    assert "raspberrypi login:" in result.stderr
    assert set(b"".join(heard)) == {ord("\r")}


def test_where_nothing_answers_the_default_is_tried_and_named(unnamed) -> None:
    result = unnamed("pos", port="sim:g2?wrong_baud=silent", env={"BIRDCAGE_BAUD": "9600"})
    assert result.exit_code == 3
    assert "so hal205 was tried" in result.stderr
    assert "birdcage detect" in result.stderr


def test_detect_tells_what_it_saw(run, pty_dish) -> None:
    result = run("detect", port=pty_dish.path, firmware="")
    assert result.exit_code == 0
    first, *speeds = result.stdout.splitlines()
    assert first.startswith(f"{pty_dish.path} is a Carryout G2 (g2): `?` lists `a3981`, `dvb`, `mot`; prompt `TRK>`")
    assert speeds[0].startswith("  115200: prompt `TRK>`; `?` lists a3981, adc, dipswitch, dvb")
    assert set(pty_dish.lines()) <= {"", "?"}


def test_detect_in_json(run, as_json, pty_travler) -> None:
    found = as_json(run("detect", "--json", port=pty_travler.path, firmware=""))
    assert (found["firmware"], found["candidates"], found["baud"]) == ("hal205", ["hal205"], 57600)
    assert {"firmware": "hal205", "seen": "`?` lists `motor`, `ngsearch`"} in found["clues"]
    assert [each["baud"] for each in found["speeds"]] == [115200, 57600]
    assert {"motor", "ngsearch"} <= set(found["speeds"][1]["commands"])


def test_detect_of_what_is_no_dish(run, foreign) -> None:
    port, _ = foreign(b"RPRT -1\n")
    result = run("detect", port=port, firmware="")
    assert result.exit_code == 1
    assert "RPRT -1" in result.stdout


def test_detect_of_a_port_that_is_not_there(run) -> None:
    result = run("detect", port="/dev/none", firmware="")
    assert result.exit_code == 3
    assert "/dev/none" in result.stdout


def test_stop_sends_no_enter_to_a_named_machine_that_has_no_console(run, foreign, monkeypatch, tmp_path) -> None:
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.2")
    port, heard = foreign(b"K")
    with installed(tmp_path):
        result = run("stop", port=port, firmware="pushy")
    assert "Pushy says nothing" in result.stderr, "a machine that only pushes is heard as what it was named"
    assert heard == []
