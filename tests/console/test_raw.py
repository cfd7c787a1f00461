"""A line that a person typed: sent as it is, its reply collected on the side, and no `q` at the root unasked."""

from __future__ import annotations

import pytest
from birdcage.base.errors import CommandRefused, Stopped

D = 2.0


@pytest.fixture
def at(console, clock):
    """A console in step, in the menu that is asked for."""

    def go(menu):
        console.synchronize()
        clock.advance(2 * D)
        console.synchronize()
        console.enter(menu)
        clock.advance(2 * D)
        console.synchronize()
        assert console.is_settled
        return console

    return go


def test_the_reply_comes_while_the_owner_listens(at, clock, dish):
    console = at("mot")
    typed = console.type_line("h 0", takes_s=15.0)
    assert typed.reply is None
    while typed.reply is None:
        console.listen(clock.monotonic() + 1.0)
    assert typed.reply.lines == ("wrap_min:-42333 wrap_max:2333",)
    assert clock.monotonic() - typed.sent == pytest.approx(6.0, abs=0.1)
    assert typed.due == pytest.approx(typed.sent + 17.0)


def test_a_reply_is_kept(at, clock):
    console = at("mot")
    typed = console.type_line("a")
    assert typed.wait(D).lines[0] == "Angle[0] = 180.00"
    assert typed.reply is typed.wait(D)


def test_the_line_goes_out_as_it_was_typed(at, dish):
    console = at("mot")
    assert console.type_line(" a  0   100 ").wait(D) is not None
    assert ("mot", " a  0   100 ") in dish.heard


def test_a_stream_ends_by_enter(at, clock, dish):
    console = at("dvb")
    typed = console.type_line("agc")
    assert typed.wait(3.0) is None
    typed.press_enter()
    reply = typed.wait(D)
    assert len(reply.lines) > 20
    assert reply.menu == "dvb"
    assert console.find_menu() == "dvb"


def test_permit_holds_a_line_back(at, dish):
    console = at("mot")

    def refuse():
        raise Stopped("no")

    before = dish.written
    with pytest.raises(Stopped):
        console.type_line("a 0 100", permit=refuse)
    assert dish.written == before
    assert console.type_line("a").wait(D) is not None


def test_a_silent_dish_is_told_from_a_slow_one(at, dish):
    console = at("mot")
    dish.muted = True
    typed = console.type_line("a")
    assert typed.wait(D) is None
    assert typed.give_up().reason == "silent"


def test_no_line_that_holds_a_q_goes_out_at_the_root(at, dish):
    console = at("root")
    for line in ("q", " q ", "freqs", "Q"):
        with pytest.raises(CommandRefused) as refused:
            console.type_line(line)
        assert refused.value.reason == "wrong_menu"
    assert dish.alive
    assert not any("q" in line.lower() for menu, line in dish.heard if menu == "root")


def test_a_person_may_want_it_at_the_root(at, dish):
    console = at("root")
    typed = console.type_line("q", at_root=True)
    assert typed.wait(D) is None
    assert not dish.alive


def test_in_a_submenu_it_goes_out_once_that_is_proven(at, dish):
    console = at("dvb")
    before = dish.written
    assert console.type_line("freqs").wait(D).menu == "dvb"
    assert dish.written[len(before) :] == b"\rfreqs\r"


def test_after_a_typed_q_the_next_one_waits_until_the_first_is_accounted_for(at, dish, clock):
    console = at("dvb")
    console.type_line("q")
    with pytest.raises(CommandRefused):
        console.type_line("q")
    assert dish.alive
