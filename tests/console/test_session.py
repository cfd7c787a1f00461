"""The session: deadlines, menus, late replies, interjected lines, streams."""

from __future__ import annotations

import pytest
from birdcage.base.errors import Cancelled, CommandRefused, Held, NoReply

D = 2.0


def late(seconds):
    return lambda byte: [(seconds, bytes([byte]))]


def on_time(byte):
    return [(0.0, bytes([byte]))]


def lines(dish):
    return dish.written.decode().split("\r")[:-1]


def calm(console, clock):
    """Let the doubt that every new session begins with pass."""
    console.synchronize()
    clock.advance(2 * D)
    console.synchronize()
    assert console.is_settled


def test_one_command_is_one_line_on_the_wire(console, dish):
    console.enter("mot")
    before = len(lines(dish))
    assert console.run("mot", "a").lines == ("Angle[0] = 180.00", "Angle[1] = 45.00")
    assert lines(dish)[before:] == ["a"]


def test_help_is_read_whole(console):
    console.enter("mot")
    assert console.exchange("?").lines == (
        "help [<command>]",
        "Enter <dvb> - DVB Tuner",
        "Enter <mot> - Motor>",
        "a > b",
    )
    assert console.place == "mot"


def test_in_step_a_menu_is_left_at_once_and_only_after_looking(console, dish, clock):
    calm(console, clock)
    console.enter("mot")
    began, before = clock.monotonic(), len(lines(dish))
    console.enter("dvb")
    assert lines(dish)[before:] == ["", "q", "dvb"]
    assert clock.monotonic() == pytest.approx(began)
    assert console.is_settled


def test_nothing_is_sent_to_leave_the_root(console, dish):
    console.synchronize()
    before = len(lines(dish))
    console.leave()
    assert lines(dish)[before:] == []


@pytest.mark.parametrize("line", ["q", "freqs", "q 3"])
def test_a_line_that_could_be_a_q_is_refused_at_the_root(console, dish, line):
    with pytest.raises(CommandRefused, match="was not sent"):
        console.exchange(line)
    assert "q" not in dish.written.decode()


def test_a_late_reply_is_discarded_and_shifts_nothing(console, dish, clock):
    console.enter("mot")
    dish.out_fault = late(1.9)
    dish.in_fault = late(1.9)
    with pytest.raises(NoReply):
        console.exchange("a 0 99")
    dish.out_fault = dish.in_fault = on_time
    assert console.exchange("a 0 11").lines == ("Angle = 11",)
    assert console.exchange("a 0 12").lines == ("Angle = 12",)


def test_the_menu_is_what_the_last_fresh_prompt_named(console, dish, clock):
    console.enter("mot")
    dish.menu = "root"
    dish.say("Bootloader\r\nTRK>")
    assert console.run("mot", "a").menu == "mot"
    assert [line for line in lines(dish) if line == "mot"] == ["mot", "mot"]


def test_the_firmwares_error_is_never_a_reply(console):
    console.enter("mot")
    with pytest.raises(CommandRefused, match="Invalid command") as caught:
        console.exchange("warp 9")
    assert caught.value.reason == "unknown_command"
    assert console.exchange("a").lines


def test_a_command_may_take_its_time(console, clock):
    console.enter("mot")
    heard, began = [], clock.monotonic()
    console.exchange("h 0", takes_s=15.0, on_line=heard.append)
    assert heard == ["wrap_min:-42333 wrap_max:2333"]
    assert clock.monotonic() - began == pytest.approx(6.0)


def test_a_permit_holds_the_line_back(console, dish):
    console.enter("mot")

    def held():
        raise Held("STOP")

    with pytest.raises(Held):
        console.exchange("a 0 12", permit=held)
    assert "a 0 12" not in lines(dish)
    assert console.owed == 0


def test_silence_garbage_and_own_echo_are_told_apart(console, dish, clock):
    console.synchronize()
    dish.muted = True
    with pytest.raises(NoReply, match="power") as silent:
        console.synchronize()
    dish.in_fault = lambda byte: dish.say("\xf0\x81\x00") or []
    with pytest.raises(NoReply, match="baud") as garbage:
        console.synchronize()
    dish.in_fault = lambda byte: dish.say(chr(byte)) or []
    with pytest.raises(NoReply, match="Only our own") as echo:
        console.synchronize()
    dish.in_fault = lambda byte: dish.say("SPI1 init\r\n") or []
    with pytest.raises(NoReply, match="may be starting") as blocked:
        console.synchronize()
    assert [e.value.reason for e in (silent, garbage, echo, blocked)] == ["silent", "garbage", "echo", "blocked"]


def test_silence_is_told_within_d(console, dish, clock):
    dish.muted = True
    began = clock.monotonic()
    with pytest.raises(NoReply):
        console.synchronize()
    assert clock.monotonic() - began == pytest.approx(D)


def test_lines_interjected_in_mid_exchange_go_out_at_once_and_both_are_answered(console, owner, dish, clock):
    console.enter("mot")
    owner.nudge, clock.countdown = "interject", 2
    assert console.exchange("h 0", takes_s=15.0).lines == ("wrap_min:-42333 wrap_max:2333",)
    assert lines(dish)[-3:] == ["h 0", "a 0 12", "a 1 30"]
    assert [reply.lines for reply in console.settle(D)] == [("Angle = 12",), ("Angle = 30",)]
    assert console.settle(D) == ()
    assert console.exchange("a").lines[0] == "Angle[0] = 180.00"


def test_interjected_lines_that_are_not_answered_are_said_so(console, dish):
    console.enter("mot")
    dish.muted = True
    console.interject(["a 0 12"])
    with pytest.raises(NoReply):
        console.settle(1.0)
    with pytest.raises(ValueError, match="leave"):
        console.interject(["q"])


@pytest.mark.parametrize("how", ["timeout", "cancel"])
def test_an_interrupted_stream_leaves_the_next_exchange_clean(console, owner, dish, clock, how):
    console.enter("dvb")
    heard = []
    if how == "cancel":
        owner.nudge, clock.countdown = "cancel", 5
        with pytest.raises(Cancelled):
            console.stream("agc", heard.append, clock.monotonic() + 60)
    else:
        console.stream("agc", heard.append, clock.monotonic() + 0.45)
    assert set(heard) <= {"AGC: 42"}
    assert console.run("mot", "a").lines == ("Angle[0] = 180.00", "Angle[1] = 45.00")
    assert dish.alive


def test_a_q_without_an_answer_is_accounted_for_before_another(console, dish, clock):
    calm(console, clock)
    console.enter("mot")
    dish.out_fault = lambda byte: [(1.9, bytes([byte]))] if dish.menu == "mot" and dish.heard[-1][1] != "q" else []
    with pytest.raises(NoReply):
        console.leave()
    dish.out_fault = on_time
    console.leave()
    assert console.place == "root"
    assert lines(dish).count("q") == 1
    assert dish.alive


def test_before_closing_no_q_goes_out_that_cannot_be_proven_in_time(console, dish, clock):
    console.enter("mot")
    assert console.leave_all(within_s=1.0) is False
    assert "q" not in lines(dish)
    calm(console, clock)
    assert console.leave_all(within_s=1.0) is True
    assert dish.menu == "root"
