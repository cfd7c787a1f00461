"""A console that is not the one of the dialect says so, whatever of it looks alike."""

from __future__ import annotations

import pytest
from birdcage.station.state import LinkPhase

from .conftest import Bench

BAUDS = {"g2": 115200, "hal205": 57600, "hal000": 57600}


@pytest.mark.parametrize("left_in", ["root", "motor"])
@pytest.mark.parametrize("prompts", ["named", "alike"])
def test_a_travler_that_is_spoken_to_as_a_g2(left_in, prompts):
    bench = Bench(f"hal205?seed=1&search_finds=0&prompts={prompts}", {"baud": BAUDS["hal205"]}, firmware="g2")
    bench.device.shell.menu = left_in if left_in != "root" else bench.device.shell.menu
    bench.step(12.0)
    assert (bench.state.link.state, bench.state.link.reason) == (LinkPhase.SILENT, "wrong_firmware")
    assert "--firmware hal205" in bench.state.link.detail
    assert not [line for line in bench.lines() if line not in ("", "mot", "a")], "nothing that changes anything"


def test_a_g2_that_is_spoken_to_as_a_travler():
    bench = Bench("g2?seed=1", {"baud": BAUDS["g2"]}, firmware="hal205")
    bench.step(12.0)
    assert (bench.state.link.state, bench.state.link.reason) == (LinkPhase.SILENT, "wrong_firmware")
    assert "--firmware g2" in bench.state.link.detail


@pytest.mark.parametrize("prompts", ["named", "alike"])
def test_an_older_travler_that_is_spoken_to_as_a_g2(prompts):
    bench = Bench(f"hal000?seed=1&search_finds=0&prompts={prompts}", {"baud": BAUDS["hal000"]}, firmware="g2")
    bench.step(12.0)
    assert bench.state.link.state is LinkPhase.SILENT
    assert (bench.state.link.reason, "--firmware hal000" in bench.state.link.detail) == ("wrong_firmware", True)
    assert not [line for line in bench.lines() if line not in ("", "mot", "a")], "nothing that changes anything"


@pytest.mark.parametrize(("there", "named"), [("hal205", "hal000"), ("hal000", "hal205"), ("g2", "hal000")])
def test_one_that_is_spoken_to_as_its_relative(there, named):
    bench = Bench(f"{there}?seed=1", {"baud": BAUDS[there]}, firmware=named)
    bench.step(12.0)
    assert (bench.state.link.state, bench.state.link.reason) == (LinkPhase.SILENT, "wrong_firmware")
    assert f"{there}" in bench.state.link.detail
    assert not [line for line in bench.lines() if line not in ("", "?")]


def test_one_refusal_of_the_motor_menu_is_a_damaged_line():
    bench = Bench()
    shell = bench.device.shell
    menu = shell._menus["root"]
    run, refused = menu.run, []

    def refuse_once(words):
        if words[:1] == ["mot"] and not refused:
            refused.append(words)
            yield "Invalid command.\n"
        else:
            yield from run(words)

    menu.run = refuse_once
    bench.connect()
    assert refused
