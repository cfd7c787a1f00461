"""`birdcage sim`: a dish for every other program."""

from __future__ import annotations

import json
import signal
from pathlib import Path

import pytest
import serial
from birdcage.sim.port import firmware_names


@pytest.mark.parametrize("before", [True, False])
def test_one_line_of_json_names_the_port_that_pos_then_reads(start, run, tmp_path, before) -> None:
    link = tmp_path / "dish"
    options = ("--firmware", "g2", "--json")
    words = (*options, "sim") if before else ("sim", *options)
    process = start(*words, "--link", link, "-o", "az=-90", "-o", "el=30")
    told = json.loads(process.stdout.readline())
    assert set(told) == {"port", "firmware", "control"}
    assert (told["port"], told["firmware"]) == (str(link), "g2")
    assert run("pos", port=told["port"]).stdout == "AZ: 270.0\nEL: 30.0\n"
    process.send_signal(signal.SIGTERM)
    assert process.wait(10) == 0
    assert not Path(link).is_symlink()


def test_its_options_reach_the_dish(start, run) -> None:
    process = start("sim", "--unhomed", "--seed", "7", "--json")
    port = json.loads(process.stdout.readline())["port"]
    assert run("pos", port=port).exit_code == 4


def test_the_other_firmware_speaks_at_its_own_rate(start) -> None:
    process = start("sim", "--firmware", "hal205", "--json", "-o", "az=8.34")
    told = json.loads(process.stdout.readline())
    assert told["firmware"] == "hal205"
    with serial.serial_for_url(told["port"], baudrate=57600, timeout=5) as port:
        port.write(b"motor\ra\r")
        assert b"AZ =   8.34 EL =" in port.read_until(b"WRAP")


def test_a_carryout_of_2003_tells_where_it_is_while_it_moves(start) -> None:
    process = start("sim", "--firmware", "carryout", "--json", "-o", "az=100")
    told = json.loads(process.stdout.readline())
    assert told["firmware"] == "carryout"
    with serial.serial_for_url(told["port"], baudrate=57600, timeout=5) as port:
        port.write(b"target\rg 101.5 45\r")
        assert b"az = 10150   el = 4500\r\n" in port.read_until(b"az = 10150   el = 4500\r\n")


def test_a_carryout_of_2003_has_no_position_to_print(run) -> None:
    driven = run("pos", port="sim:carryout", firmware="carryout")
    assert driven.exit_code != 0
    assert "This dish does not tell where it points." in driven.stderr


def test_a_dish_that_is_not_simulated_is_answered_with_the_names_of_those_that_are(run) -> None:
    told = run("sim", "--firmware", "xyz").stderr
    for name in firmware_names():
        assert name in told


@pytest.mark.parametrize("words", [
    ("--speed", 0), ("-o", "no"), ("-o", "nothing=1"), ("-o", "az=180"), ("-o", "el=90"),
    ("--port", "x"), ("--firmware", "nosuch"),
])  # fmt: skip
def test_it_refuses_what_it_cannot(run, words) -> None:
    result = run("sim", *words)
    assert result.exit_code == 2, result.stderr
    assert "Traceback" not in result.stderr


def test_a_port_before_it_is_refused_too(run) -> None:
    assert run("--port", "/dev/ttyUSB0", "sim").exit_code == 2


def test_its_help_and_its_complaints_agree_with_what_it_does(run) -> None:
    told = run("sim", "--help").stdout
    assert "[default: g2]" in told
    assert "hal205]" not in told
    assert run("sim", "--firmware", "hal2050").stderr.rstrip().endswith("did you mean hal205?")


def test_the_help_tells_how_a_dish_that_waits_for_its_motor_is_simulated(run) -> None:
    told = " ".join(run("sim", "--help").stdout.split())
    assert "-o second_move=block makes a G2 refuse motor commands on the axis that runs" in told
    assert "-o second_other=block those on the other axis" in told
    assert "-o move_reply=none" in told
