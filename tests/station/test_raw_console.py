"""Somebody talks to the firmware past the station: warned, marked, and alone on the wire."""

from __future__ import annotations

import pytest
from birdcage.base.errors import (
    CommandRefused,
    ConfirmationNeeded,
    Held,
    LeaseDenied,
    LinkError,
)
from birdcage.station.events import TranscriptLine
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import (
    AcquireLease,
    Goto,
    ListCommands,
    Release,
    ReleaseLease,
)
from birdcage.station.state import LinkPhase as LinkNow

from .raw_console_bench import TalkBench, lines_since


@pytest.fixture
def bench():
    return TalkBench()


# --- a line and its reply


def test_a_line_brings_its_reply(bench):
    reply = bench.type("mv")
    assert reply.line == "mv"
    assert reply.lines[0].startswith("Max Vel [0]")
    assert (reply.menu, reply.prompt, reply.ended_by_key) == ("mot", "MOT>", False)
    assert 0 < reply.took_s < 0.5
    assert bench.state.holder == CONSOLE


def test_what_the_dish_refuses_is_a_reply_too(bench):
    assert bench.type("frob", confirmed=Grade.RUINS).lines == ("Invalid command.",)


def test_submenus_work_and_the_menu_is_shown(bench):
    assert bench.type("q").menu == "root"
    assert bench.type("os").prompt == "OS>"
    assert bench.state.menu == "os"
    assert any("Antenna ID" in line for line in bench.type("id").lines)
    assert bench.type("q").menu == "root"


def test_a_bare_enter_shows_the_prompt(bench):
    assert bench.type("").prompt == "MOT>"


def test_what_cannot_be_typed_is_refused(bench):
    with pytest.raises(CommandRefused, match="printable"):
        bench.type("a\x08")


# --- warnings


def test_what_is_not_harmless_wants_a_persons_word(bench):
    since = bench.clock.monotonic()
    with pytest.raises(ConfirmationNeeded, match="fall under its own weight"):
        bench.type("r")
    with pytest.raises(ConfirmationNeeded, match="Undocumented command"):
        bench.type("frob")
    assert not {"r", "frob"} & set(lines_since(bench, since))


def test_a_motion_beyond_a_limit_is_warned_of_and_marked_when_sent(bench):
    verdict = bench.station.judge("a 0 9999")
    assert verdict.grade is Grade.MOVES
    assert "9639.00° beyond the limit of 360.00°" in verdict.limit
    with pytest.raises(ConfirmationNeeded, match=r"9639\.00° beyond"):
        bench.type("a 0 9999")
    sent = []
    original = bench.sim.write
    bench.sim.write = lambda data: (sent.append((len(bench.remarks), data)), original(data))
    bench.type("a 0 9999", confirmed=Grade.RUINS)
    mark = (
        "raw by console: a 0 9999 (MOVES, confirmed; "
        "Azimuth 9999.00 deg is 9639.00 deg beyond the limit of 360.00 deg.)"
    )
    assert mark in bench.remarks
    assert sent[0] == (bench.remarks.index(mark) + 1, b"a 0 9999\r")  # the remark stands before the bytes
    assert mark in [e.text for e in bench.events if isinstance(e, TranscriptLine) and e.direction == "#"]


def test_unreadable_settings_are_a_limit_of_every_raw_motion():
    bench = TalkBench(refuse_motion="The section [motion] cannot be read.")
    assert "cannot be read" in bench.station.judge("a 0 100").limit
    assert bench.station.judge("a").limit == ""


def test_while_held_questions_and_settings_go_and_motions_do_not(bench):
    bench.station.stop("you")
    bench.step(2)
    assert bench.type("mv").lines
    assert bench.type("w 0 on", confirmed=Grade.RUINS)
    since = bench.clock.monotonic()
    for line in ("a 0 100", "h 0", "r", "sw 0 0"):
        with pytest.raises(Held):
            bench.type(line, confirmed=Grade.RUINS)
    assert not {"a 0 100", "h 0", "r", "sw 0 0"} & set(lines_since(bench, since))
    bench.do(Release("you"))
    bench.type("a 0 100", confirmed=Grade.RUINS)
    assert "a 0 100" in bench.lines()


# --- whose console it is


def test_nobody_types_while_another_has_control(bench):
    bench.do(AcquireLease("tracker"))
    with pytest.raises(LeaseDenied, match="tracker"):
        bench.type("a")
    bench.do(AcquireLease(CONSOLE, take_over=True))
    assert bench.type("a").lines


def test_while_somebody_talks_nothing_is_sent_that_was_not_typed(bench):
    bench.watch("position", "rssi")
    bench.step(3)
    bench.do(AcquireLease(CONSOLE))
    since = bench.clock.monotonic()
    bench.step(20)
    assert lines_since(bench, since) == []
    bench.type("mv")
    bench.step(20)
    assert lines_since(bench, since) == ["mv"]
    assert bench.state.position is not None
    assert bench.state.position_lost is None  # it only grows old
    assert bench.clock.monotonic() - bench.state.position.at > 39


def test_after_30_s_without_a_line_the_console_is_given_back_and_looked_at(bench):
    bench.type("q")
    bench.type("dvb")
    bench.step(29.5)
    assert bench.state.holder == CONSOLE
    since = bench.clock.monotonic()
    bench.step(3)
    assert bench.state.holder is None
    assert bench.state.menu == "mot"
    assert "a" in lines_since(bench, since)


def test_giving_the_lease_back_ends_it_too(bench):
    bench.type("q")
    before = len(bench.lines())
    bench.do(ReleaseLease(CONSOLE))
    bench.step(1)
    assert bench.lines()[before:][:2] == ["mot", "a"]
    assert bench.do(Goto(100, 40, "you"))


def test_no_line_goes_out_while_the_station_moves_the_dish(bench):
    future = bench.station.submit(Goto(200, 45, "you"))
    bench.step(0.5)
    bench.do(AcquireLease(CONSOLE, take_over=True))
    with pytest.raises(CommandRefused, match="birdcage is moving the dish") as refused:
        bench.type("mv")
    assert refused.value.reason == "moving"
    bench.step(20)
    assert future.result(0)
    assert bench.type("mv").lines


def test_without_a_link_nothing_is_said(bench):
    bench.device.unplug()
    bench.step(1)
    with pytest.raises(LinkError):
        bench.type("a")


# --- commands


def test_the_commands_of_a_menu_are_known_before_the_dish_is_asked(bench):
    since = bench.clock.monotonic()
    commands = {command.name: command for command in bench.station.commands("mot")}
    assert commands["a"].usage == "a [<motor> <angle>]"
    assert not commands["a"].told_by_dish
    assert lines_since(bench, since) == []
    assert bench.station.commands("nonsense") == ()


def test_the_dish_is_asked_for_its_commands_once(bench):
    told = {command.name: command for command in bench.do(ListCommands())}
    assert told["motorboth"].told_by_dish
    assert told["q"].help  # the documentation says what the dish does not
    assert not told["?"].told_by_dish
    assert bench.lines().count("?") == 1
    bench.do(ListCommands())
    assert bench.lines().count("?") == 1
    assert any(command.told_by_dish for command in bench.station.commands("mot"))


def test_the_root_menu_lists_its_submenus(bench):
    bench.type("q")
    told = {command.name: command for command in bench.do(ListCommands())}
    assert told["dvb"].told_by_dish
    assert told["dvb"].help == "DVB Tuner"
    assert bench.type("mot").menu == "mot"


def test_the_tuner_lists_its_commands_page_by_page(bench):
    bench.type("q")
    bench.type("dvb")
    assert any(command.told_by_dish for command in bench.do(ListCommands()))
    assert bench.state.link.state is LinkNow.UP


def test_a_line_that_would_do_worse_than_what_was_confirmed_is_not_sent(bench):
    since = bench.clock.monotonic()
    with pytest.raises(ConfirmationNeeded, match=r"more dangerous now.*fall under its own weight"):
        bench.type("r", confirmed=Grade.SETTING)
    assert "r" not in lines_since(bench, since)
    bench.type("r", confirmed=Grade.MOVES)
    assert "r" in lines_since(bench, since)


def test_what_was_confirmed_in_one_menu_is_not_sent_in_another_where_it_is_worse(bench):
    bench.type("q")
    assert bench.type("nvs").menu == "nvs"
    assert bench.station.judge("e 1 2").grade is Grade.SETTING
    bench.device.shell.menu = "mot"  # somebody else at the dish: another prompt is seen with the next line
    bench.type("")
    with pytest.raises(ConfirmationNeeded, match="more dangerous now"):
        bench.type("e 1 2", confirmed=Grade.SETTING)


def test_a_machine_without_a_console_says_so_and_nothing_is_sent(bench):
    bench.station._antenna.raw = None
    since = bench.clock.monotonic()
    assert bench.station.judge("a 0 100").grade is Grade.HARMLESS  # it is never sent
    with pytest.raises(CommandRefused, match="no console") as refused:
        bench.type("a 0 100", confirmed=Grade.RUINS)
    assert refused.value.reason == "unsupported"
    with pytest.raises(CommandRefused, match="no console"):
        bench.do(ListCommands())
    assert bench.state.holder is None
    assert not {"a 0 100", "?"} & set(lines_since(bench, since))
