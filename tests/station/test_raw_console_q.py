"""No `q` reaches the root prompt unless a person means it."""

from __future__ import annotations

import pytest
from birdcage.base.errors import (
    CommandRefused,
    ConfirmationNeeded,
    NoReply,
)
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import (
    ReleaseLease,
)

from .raw_console_bench import TalkBench


@pytest.fixture
def bench():
    return TalkBench()


@pytest.fixture
def mortal():
    return TalkBench("g2?seed=1&root_q=kill")


def alive(bench):
    return bench.device.truth().shell_alive


def test_q_in_a_submenu_leaves_it_and_never_reaches_the_root(mortal):
    for menu in ("mot", "dvb", "nvs", "os"):
        if mortal.state.menu != menu:
            mortal.type(menu)
        assert mortal.type("q").menu == "root"
        with pytest.raises(ConfirmationNeeded, match="until a power cycle"):
            mortal.type("q")
        with pytest.raises(ConfirmationNeeded):
            mortal.type(" Q ")
    assert alive(mortal)


def test_two_q_in_a_row_do_not_kill_it(mortal):
    first, second = mortal.begin("q"), mortal.begin("q")
    mortal.step(5)
    assert first.result(0).menu == "root"
    assert isinstance(second.exception(0), ConfirmationNeeded)
    assert alive(mortal)


def test_a_word_that_holds_a_q_goes_out_from_a_proven_submenu_only(mortal):
    mortal.type("q")
    mortal.type("dvb")
    assert mortal.type("qls", seconds=60).menu == "dvb"
    mortal.type("q", seconds=60)
    with pytest.raises(ConfirmationNeeded):
        mortal.type("qls")
    assert alive(mortal)


def test_a_reboot_behind_our_back_does_not_make_q_deadly(mortal):
    mortal.type("q")
    mortal.type("dvb")
    mortal.device.shell.menu = "root"
    assert mortal.type("q", seconds=60).menu == "root"
    assert alive(mortal)


def test_a_word_that_holds_a_q_is_kept_back_when_the_dish_turns_out_to_be_at_the_root(mortal):
    mortal.type("q")
    mortal.type("dvb")
    mortal.device.shell.menu = "root"
    with pytest.raises(CommandRefused, match="root menu"):
        mortal.type("qls", seconds=60)
    assert "qls" not in mortal.lines()


def test_a_confirmed_q_at_the_root_is_sent_as_typed(mortal):
    mortal.type("q")
    with pytest.raises(NoReply):
        mortal.type("q", confirmed=Grade.RUINS)
    assert not alive(mortal)
    assert mortal.lines()[-1] == "q"


def test_streams_and_the_end_of_the_talk_leave_the_shell_alive(mortal):
    mortal.type("q")
    mortal.type("dvb")
    mortal.begin("agc")
    mortal.step(3)
    mortal.do(ReleaseLease(CONSOLE))
    mortal.step(30)
    assert alive(mortal)
    assert mortal.state.menu == "mot"
    mortal.session.close()
    assert alive(mortal)
