"""The older Trav'ler at a terminal: its golden transcript, its tasks, and in what it differs from HAL 2.05."""

from __future__ import annotations

import re

import pytest

from .conftest import Terminal

AZ, EL = re.compile(r"AZ =(\s+\d+\.\d+)"), re.compile(r"EL =(\s+\d+\.\d+)")
"""What the public script searches for in 200 bytes (read)."""
INIT = b"q\r\ros\rkill Search\rq\r\r"


def older(options=""):
    return Terminal(options, firmware="hal000")


def parsed(reply):
    first = reply[:200]
    return float(AZ.search(first).group(1)), float(EL.search(first).group(1))


def test_t_hal000_from_power_up():
    dish = older("boot=1&boot_home_s=20&search_finds=0")
    log = ""
    while "NoGPS" not in log:
        heard = dish.listen(5.0)
        assert heard.count("\r\n") > 0, "the log goes on all the while"
        log += heard
    assert "No LNB Voltage" not in log
    dish.port.write(INIT)  # in one go, with no reads in between
    assert "AZ =" not in dish.listen(2.0)
    assert not dish.device.firmware.search.running
    dish.listen(60.0)  # the motors come to rest
    dish.port.write(b"mot\r")
    assert dish.listen(0.5) == "mot\r\nMOT>"
    dish.port.write(b"a\r")
    truth = dish.device.truth()
    assert parsed(dish.listen(1.0)) == pytest.approx((truth.az_deg, truth.el_deg), abs=0.006)


def test_the_position_of_the_log_and_a_step_of_it():
    dish = older("az=8.34&el=34.33&sk=0")
    dish.ask("mot", "MOT>")
    assert dish.ask("a", "MOT>") == "a\r\nAZ =   8.34\r\nEL =  34.33\r\nSK =   0.00\r\nWRAP = 455.00\r\nMOT>"
    dish.port.write(b"a 0 8.16\ra 1 35.16\r")
    dish.listen(3.0)
    assert parsed(dish.ask("a", "MOT>")) == (8.16, 35.16)


def test_tasks_are_listed_and_killed():
    dish = older("searching=1&search_finds=0")
    dish.ask("os", "OS>")
    assert dish.ask("tasks", "OS>") == "tasks\r\nShell\r\nSearch\r\nOS>"
    assert "Invalid parameter." in dish.ask("kill", "OS>")
    assert "No such task." in dish.ask("kill search", "OS>")
    assert dish.device.truth().moving
    assert dish.ask("kill Search", "OS>") == "kill Search\r\nTask killed.\r\nOS>"
    assert dish.ask("tasks", "OS>") == "tasks\r\nShell\r\nOS>"
    dish.listen(2.0)
    still = dish.device.truth()
    dish.listen(300.0)
    assert dish.device.truth() == still
    assert "No such task." in dish.ask("kill Search", "OS>")
    dish.ask("kill Shell")
    assert not dish.device.truth().shell_alive


def test_the_words_of_the_other_firmware_are_unknown_here():
    dish = older()
    for line in ("motor", "ngsearch", "s", "help"):
        assert dish.ask(line, "TRK>") == f"{line}\r\nInvalid command.\r\nTRK>"


def test_a_combined_move_ends_at_any_byte():
    dish = older()
    dish.ask("mot", "MOT>")
    dish.type("g 300 60 90\r")
    dish.listen(3.0)
    dish.type("x")
    dish.listen(2.0)
    truth = dish.device.truth()
    assert not truth.moving
    assert 180.0 < truth.az_deg < 290.0
