"""A mark: its echo says that all that was sent before was heard, so that a `q` need not wait for a quiet line."""

from __future__ import annotations

import sys

import pytest
from birdcage.console.codec import MARK, Codec
from birdcage.console.events import Reply
from birdcage.console.session import Console

bench, scripted = sys.modules["console_bench"], sys.modules["console_scripted"]

MARKED = MARK.encode() + b"\r"


class Dish(scripted.Dish):
    """One that tells at once when a `q` kills its shell."""

    def __setattr__(self, name, value):
        assert name != "alive" or value, "a `q` reached the root menu"
        super().__setattr__(name, value)


def a_dish_left_in(menu, clock, **options):
    dish = Dish(clock, **options)
    dish.menu = menu
    return dish


def session(dish, clock, dialect=bench.DIALECT):
    return Console(dish, clock, dialect, delay_s=bench.D)


def test_a_new_session_leaves_a_submenu_at_once(clock):
    dish = a_dish_left_in("mot", clock)
    began = clock.monotonic()
    session(dish, clock).enter("dvb")
    assert dish.menu == "dvb"
    assert dish.written == b"\r" + MARKED + b"\rq\rdvb\r"
    assert clock.monotonic() - began < 0.1


@pytest.mark.parametrize("lag_s", [0.1, 0.5, 1.0, 1.9])
@pytest.mark.parametrize(
    "earlier", [b"q\r", b"\rq\r", b"\r\r\r\r\r\r\r\rq\r", b"a\rq\r", b"\r\r\r\r\r\rq", b"q\rmot\r"]
)
def test_what_an_earlier_program_sent_is_waited_for(clock, lag_s, earlier):
    """Its `q` is under way when the new session begins: the prompts before it must not send another after it."""
    dish = a_dish_left_in("mot", clock)
    dish.in_fault = lambda byte: [(lag_s, bytes([byte]))]
    dish.write(earlier)
    dish.in_fault = scripted.clean
    console = session(dish, clock)
    console.enter("dvb")
    clock.advance(30.0)
    dish.pending()
    assert dish.alive
    assert dish.menu == "dvb"


@pytest.mark.parametrize("enters", range(3, 10))
def test_the_answers_to_an_earlier_programs_enters_are_not_taken_for_the_marks(clock, enters):
    """They come one by one while the new session asks, each as the answer to a bare Enter would; then comes the `q`."""
    dish = a_dish_left_in("mot", clock)
    for at, byte in enumerate(b"\r" * enters + b"q\r", 1):
        dish.in_fault = lambda value, late_s=0.2 * at: [(late_s, bytes([value]))]
        dish.write(bytes([byte]))
    dish.in_fault = scripted.clean
    session(dish, clock).enter("dvb")
    clock.advance(30.0)
    dish.pending()
    assert dish.alive
    assert dish.menu == "dvb"


@pytest.mark.parametrize("url", ["socket://10.0.0.2:4001", "rfc2217://10.0.0.2:4001"])
def test_a_server_may_mix_what_programs_send_so_its_line_must_fall_quiet_first(clock, url):
    dish = a_dish_left_in("mot", clock)
    dish.name = url
    began = clock.monotonic()
    console = session(dish, clock)
    console.leave()
    assert clock.monotonic() - began >= 2 * bench.D
    assert dish.menu == "root"


def test_a_console_that_echoes_no_blanks_is_waited_for_as_before(clock):
    class Trims(Dish):
        def say(self, text, at=None):
            super().say(text if text.strip(" ") else "", at)

    dish = Trims(clock)
    dish.menu = "mot"
    began = clock.monotonic()
    session(dish, clock).leave()
    assert clock.monotonic() - began >= 2 * bench.D
    assert dish.menu == "root"


def test_a_mark_is_no_byte_for_a_command_that_still_has_its_time(clock):
    dish = a_dish_left_in("mot", clock)
    console = session(dish, clock)
    typed = console.type_line("h 0", takes_s=10.0)
    assert not console.leave_all(0.5)
    assert MARKED not in dish.written
    assert not typed.is_over


BEFORE = b"\r\nMOT>"


@pytest.mark.parametrize(("heard", "answers"), [
    (BEFORE + MARK.encode() + b"\r\nMOT>", True),
    (BEFORE + b" " + MARK.encode() + b"\r\nMOT>", True),
    (BEFORE + b"\r\nMOT>", False),
    (BEFORE + MARK.encode()[1:] + b"\r\nMOT>", False),
    (BEFORE + b"  " + MARK.encode() + b"\r\nMOT>", False),
    (MARK.encode() + b"\r\nMOT>", False),
    (BEFORE + b"q" + MARK.encode() + b"\r\nMOT>", False),
    (BEFORE + b"help\r\n" + MARK.encode() + b"\r\nMOT>", False),
])  # fmt: skip
def test_only_the_whole_mark_behind_a_prompt_is_its_echo(heard, answers):
    codec = Codec(bench.DIALECT)
    ticket = codec.expect_mark()
    events = codec.feed(heard)
    assert any(isinstance(event, Reply) and event.ticket == ticket for event in events) is answers
