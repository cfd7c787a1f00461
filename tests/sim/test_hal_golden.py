"""The golden transcripts of a Trav'ler: what a public script sends, and what it looks for.

`docs/reference/travler.md`.
"""

from __future__ import annotations

import re

import pytest

AZ, EL = re.compile(r"AZ =(\s+\d+\.\d+)"), re.compile(r"EL =(\s+\d+\.\d+)")
"""What the public scripts search for in 200 bytes (read)."""
INIT = b"q\r\rngsearch\rs\rq\r\r"


def parsed(reply: str) -> tuple[float, float]:
    first = reply[:200]
    return float(AZ.search(first).group(1)), float(EL.search(first).group(1))


@pytest.mark.parametrize(("option", "line"), [("nolnb", "No LNB Voltage"), ("nogps", "NoGPS")])
def test_t_hal205_from_power_up(hal, option, line):
    dish = hal(f"boot=1&boot_home_s=20&boot_line={option}")
    log = ""
    while line not in log:
        heard = dish.listen(5.0)
        assert heard.count("\r\n") > 0, "the log goes on all the while"
        log += heard
    dish.port.write(INIT)  # in one go, with no reads in between
    answers = dish.listen(2.0)
    assert "AZ =" not in answers
    assert not dish.device.firmware.search.running
    dish.port.write(b"motor\r")
    assert dish.listen(0.5) == "motor\r\nMOT>"
    dish.listen(60.0)  # the motors come to rest
    dish.port.write(b"a\r")
    before = parsed(dish.listen(1.0))
    truth = dish.device.truth()
    assert before == pytest.approx((truth.az_deg, truth.el_deg), abs=0.006)
    dish.port.write(b"a 0 180.0\r")
    dish.listen(30.0)
    dish.port.write(b"a\r")
    assert parsed(dish.listen(1.0)) == (180.0, before[1])


def test_the_layout_of_section_3(hal):
    dish = hal("a_layout=lines&az=8.34&el=34.33&sk=0")
    dish.ask("motor", "MOT>")
    assert dish.ask("a", "MOT>") == "a\r\nAZ =   8.34\r\nEL =  34.33\r\nSK =   0.00\r\nWRAP = 455.00\r\nMOT>"


def test_the_layout_of_section_4(hal):
    dish = hal("az=8.34")
    dish.ask("motor", "MOT>")
    assert dish.ask("a", "MOT>") == "a\r\nAZ =   8.34 EL =  45.00 SK =  90.00 WRAP = 455.00\r\nMOT>"


def test_a_tracking_step_of_the_real_log(hal):
    dish = hal("az=8.34&el=34.33")
    dish.ask("motor", "MOT>")
    dish.port.write(b"a 0 8.16\ra 1 35.16\r")
    dish.listen(3.0)
    assert parsed(dish.ask("a", "MOT>")) == (8.16, 35.16)


def test_numbers_as_the_scripts_send_them(hal):
    dish = hal()
    dish.ask("motor", "MOT>")
    for line in ("a 0 8.5", "a 1 35.839999999999996", "a 0 180", "a 0 -0.5"):
        assert dish.ask(line, "MOT>") == f"{line}\r\nOK\r\nMOT>"
    dish.listen(90.0)
    assert parsed(dish.ask("a", "MOT>")) == (359.5, 35.84)


def test_the_init_script_is_harmless_on_a_dish_at_rest(hal):
    dish = hal()
    dish.port.write(INIT)
    dish.listen(1.0)
    truth = dish.device.truth()
    assert (truth.menu, truth.moving, truth.shell_alive) == ("root", False, True)


def test_hal_000_commands_are_unknown_here(hal):
    dish = hal()
    for line in ("mot", "os", "kill Search", "help"):
        assert dish.ask(line, "TRK>") == f"{line}\r\nInvalid command.\r\nTRK>"
