"""A plain line terminal: no prompt, echo or menus, and the same warnings, lease, HELD and transcript."""

from __future__ import annotations

import pytest
from birdcage.base.errors import ConfirmationNeeded, Held, LinkError
from birdcage.station.events import TranscriptLine
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import AcquireLease, ListCommands, ReleaseLease
from birdcage.station.state import LinkPhase as LinkNow

from .line_bench import LineBench
from .raw_console_bench import lines_since


@pytest.fixture(params=[b"\r", b"\n", b"\r\n"])
def bench(request, monkeypatch):
    return LineBench(monkeypatch, request.param)


def heard(bench):
    return [event.text for event in bench.events if isinstance(event, TranscriptLine) and event.direction == "<"]


def test_a_line_brings_what_comes_until_it_is_quiet(bench):
    reply = bench.type("GS")
    assert reply.lines == ("GS2", "motors on")
    assert (reply.menu, reply.prompt, reply.ended_by_key) == (None, "", False)
    assert 0.5 < reply.took_s < 0.7
    assert bench.state.holder == CONSOLE
    assert bench.state.menu is None
    assert not bench.station.has_prompt


def test_a_line_that_is_not_answered_is_done_all_the_same(bench):
    assert bench.type("SA SE", confirmed=Grade.SETTING).lines == ()
    assert bench.state.link.state is LinkNow.UP
    assert bench.type("VE").lines == ("VE1.2",)


def test_a_line_without_an_end_is_heard_too(bench):
    bench.machine.say(b"VE1", 0.1)
    assert bench.type("").lines == ("VE1",)


def test_a_machine_that_prints_on_by_itself_holds_nobody_up(bench):
    bench.machine.push("AZ180.0 EL45.0", 0.2)
    reply = bench.type("VE")
    assert "VE1.2" in reply.lines
    assert reply.took_s == pytest.approx(2.0, abs=0.3)
    assert bench.machine.lines()[-1] == "VE"  # no key was sent to end it
    before = len(heard(bench))
    bench.step(2)
    assert len(heard(bench)) > before + 5


def test_what_comes_unasked_is_told_while_somebody_talks(bench):
    bench.do(AcquireLease(CONSOLE))
    bench.machine.say(b"LIMIT west\r\n", 1.0)
    bench.step(3)
    assert "LIMIT west" in heard(bench)


def test_a_line_that_moves_is_warned_of_marked_and_refused_while_held(bench):
    since = bench.clock.monotonic()
    with pytest.raises(ConfirmationNeeded, match="Turns an axis at once"):
        bench.type("AZ100.0")
    bench.type("AZ100.0", confirmed=Grade.MOVES)
    assert "raw by console: AZ100.0 (MOVES, confirmed)" in bench.remarks
    assert lines_since(bench, since) == ["AZ100.0"]
    assert bench.state.raw_motion
    bench.station.stop("you")
    bench.step(10)  # it looks whether the machine stands
    since = bench.clock.monotonic()
    with pytest.raises(Held, match="STOP is latched: `EL30` was not sent"):
        bench.type("EL30", confirmed=Grade.RUINS)
    assert bench.type("VE").lines == ("VE1.2",)
    assert "EL30" not in lines_since(bench, since)


def test_stop_goes_out_at_once_while_a_line_waits_for_its_answer(bench):
    bench.machine.push("AZ180.0 EL45.0", 0.2)  # it never falls quiet
    seen = []

    def stop():
        bench.station.stop("you")
        seen.append(bench.machine.lines()[-2:])

    bench.later(0.3, stop)
    assert "AZ180.0 EL45.0" in bench.type("EL60.0", confirmed=Grade.MOVES).lines
    assert seen == [["EL60.0", "SA SE"]]
    assert bench.state.held is not None


def test_a_motion_beyond_a_limit_is_warned_of(bench):
    assert "above the limit of 65.00°" in bench.station.judge("EL80").limit
    assert bench.station.judge("EL50").limit == ""
    assert "is not an angle" in bench.station.judge("AZ1e999").limit


def test_q_means_nothing_there(bench):
    since = bench.clock.monotonic()
    with pytest.raises(ConfirmationNeeded, match="Undocumented command"):
        bench.type("q")
    assert bench.type("q", confirmed=Grade.SETTING).lines == ("ERR unknown",)
    assert lines_since(bench, since) == ["q"]
    assert bench.type("VE").lines == ("VE1.2",)


def test_only_what_was_typed_is_sent_until_30_s_of_idleness(bench):
    bench.do(AcquireLease(CONSOLE))
    since = bench.clock.monotonic()
    bench.step(20)
    assert lines_since(bench, since) == []
    bench.type("VE")
    bench.step(29)
    assert lines_since(bench, since) == ["VE"]
    assert bench.state.holder == CONSOLE
    bench.step(3)
    assert bench.state.holder is None
    assert "AZ EL" in lines_since(bench, since)  # it looks where the machine is


def test_leaving_gives_the_wire_back_at_once(bench):
    bench.type("VE")
    since = bench.clock.monotonic()
    bench.do(ReleaseLease(CONSOLE))
    bench.step(1)
    assert lines_since(bench, since)[0] == "AZ EL"


def test_its_commands_are_the_documented_ones_and_nothing_is_asked(bench):
    since = bench.clock.monotonic()
    assert [command.usage for command in bench.station.commands(None)] == ["AZ<deg>", "VE"]
    assert not any(command.told_by_dish for command in bench.do(ListCommands()))
    assert lines_since(bench, since) == []


def test_boot_text_in_an_answer_is_a_restart(bench):
    bench.machine.say(b"READY 1.2\r\n", 0.1)
    bench.type("VE")
    assert bench.state.fault is not None
    assert bench.state.fault.reason == "reboot"


def test_a_machine_that_is_unplugged_ends_the_line(bench):
    bench.later(0.2, lambda: setattr(bench.machine, "gone", True))
    with pytest.raises(LinkError):
        bench.type("VE")
    bench.step(1)
    assert bench.state.link.state is LinkNow.LOST


def test_what_only_asks_is_known_without_a_prompt(bench):
    assert bench.station.only_asks("AZ EL", "")
    assert not bench.station.only_asks("AZ100", "")
    assert not bench.station.only_asks("q", "")
