"""Missing, busy, forbidden, silent: one sentence, what to do, exit status 3."""

from __future__ import annotations

import os

import pytest
import serial


@pytest.mark.parametrize("words", [("pos",), ("move", "--az", 10, "--el", 40), ("stop",), ("init",), ("home", "--yes")])
def test_a_missing_port(run, words) -> None:
    result = run(*words, port="/dev/no-such-port")
    assert (result.exit_code, result.stdout) == (3, "")
    assert result.stderr.startswith("/dev/no-such-port does not exist: ")
    assert len([line for line in result.stderr.splitlines() if line]) == 1


def test_a_busy_port_names_who_has_it(run, pty_dish) -> None:
    with serial.Serial(pty_dish.path, exclusive=True):
        result = run("pos", port=pty_dish.path)
    assert result.exit_code == 3
    assert str(os.getpid()) in result.stderr or "this program" in result.stderr
    assert "end that program first" in result.stderr


def test_a_port_that_is_none(run, tmp_path) -> None:
    (tmp_path / "file").touch()
    result = run("pos", port=str(tmp_path / "file"))
    assert result.exit_code == 3
    assert "not a serial port" in result.stderr


def test_a_silent_dish(run, pty_dish) -> None:
    pty_dish.device.power_off()
    result = run("pos", port=pty_dish.path)
    assert (result.exit_code, result.stdout) == (3, "")
    assert "power" in result.stderr


def test_status_of_nothing_is_all_unknown(run, as_json) -> None:
    result = run("status", "--json", port="/dev/no-such-port")
    assert result.exit_code == 3
    status = as_json(result)
    assert status["connected"] is False
    assert status["azimuth_deg"] is status["homed"] is status["search"] is status["activity"] is None


def test_details_are_told_on_stderr_only_when_asked(run) -> None:
    result = run("-v", "pos")
    assert result.exit_code == 0
    assert result.stdout == "AZ: 0.0\nEL: 45.0\n"
