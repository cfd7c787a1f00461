"""Undeclared prompts, their own or all alike, and the menus that only help tells (decision 0010)."""

from __future__ import annotations

import sys

import pytest
from birdcage.base.errors import CommandRefused, NoReply

bench, scripted = sys.modules["console_bench"], sys.modules["console_scripted"]
D = bench.D


@pytest.fixture(params=["named", "alike", "long"])
def dish(clock, request):
    prompts = {
        "named": scripted.MENUS,
        "alike": scripted.ALIKE,
        "long": {menu: f"HAL 2.05 {menu} # " for menu in scripted.MENUS},
    }[request.param]
    return scripted.Dish(clock, prompts=prompts, help_of=scripted.HELP_OF)


@pytest.fixture
def owner(dish, clock):
    return bench.Owner(dish, clock, bench.LEARNT)


def lines(dish):
    return dish.written.decode().split("\r")[:-1]


def calm(console, clock):
    console.synchronize()
    clock.advance(2 * D)
    console.synchronize()
    assert console.is_settled


def test_the_root_is_found_in_less_than_a_second(console, dish, clock):
    began = clock.monotonic()
    assert console.synchronize() == "root"
    assert lines(dish) == ["", "", "?"]
    assert clock.monotonic() - began < 1.0


def test_once_learnt_a_command_is_one_line_and_takes_no_time(console, dish, clock):
    console.enter("mot")
    before, began = len(lines(dish)), clock.monotonic()
    for _ in range(3):
        reply = console.run("mot", "a")
        assert reply.lines == ("Angle[0] = 180.00", "Angle[1] = 45.00")
        assert (reply.menu, reply.token) == ("mot", dish.prompts["mot"].strip())
    assert lines(dish)[before:] == ["a"] * 3
    assert clock.monotonic() == began


def test_menus_are_entered_left_and_entered_again(console, dish, clock):
    calm(console, clock)
    for menu in ("mot", "dvb", "nvs", "mot", "root", "dvb"):
        console.enter(menu)
        assert (dish.menu, console.place) == (menu, menu)
    assert dish.alive


def test_a_submenu_is_left_only_after_help_has_shown_it(console, dish, clock):
    calm(console, clock)
    console.enter("mot")
    before = len(lines(dish))
    console.leave()
    assert lines(dish)[before:] == ["?", "q", "?"]


def test_a_dish_that_was_left_in_a_submenu_is_brought_to_the_root(console, dish):
    dish.menu = "nvs"
    assert console.synchronize() not in scripted.MENUS
    console.enter("mot")
    assert (dish.menu, console.place, dish.alive) == ("mot", "mot", True)


@pytest.mark.parametrize("line", ["q", "freqs", "q 3"])
def test_a_line_that_could_be_a_q_is_refused_at_the_root(console, dish, line):
    with pytest.raises(CommandRefused, match="was not sent"):
        console.exchange(line)
    assert "q" not in dish.written.decode()


def test_after_a_reboot_the_menu_is_asked_for_before_anything_else(console, dish, clock):
    calm(console, clock)
    console.enter("mot")
    dish.menu = "root"
    dish.say("HAL 2.05.003\r\n" + dish.prompts["root"])
    clock.advance(0.1)
    assert console.run("mot", "a").menu == "mot"
    assert dish.menu == "mot"
    assert dish.alive


def test_an_unasked_line_leaves_the_menu_in_doubt(console, dish, clock):
    calm(console, clock)
    console.enter("mot")
    dish.say("HAL 2.05.003\r\n")
    console.listen(clock.monotonic() + 0.1)
    assert console.place is None
    before = len(lines(dish))
    assert console.run("mot", "a").menu == "mot"
    assert lines(dish)[before:] == ["?", "a"]


def test_a_quiet_reboot_ends_no_shell(console, dish, clock):
    calm(console, clock)
    console.enter("mot")
    dish.menu = "root"
    console.leave()
    assert dish.alive
    assert "q" not in lines(dish)


def test_a_raw_line_that_enters_a_menu_is_noticed(console, dish, clock):
    calm(console, clock)
    console.type_line("dvb").wait(D)
    assert dish.menu == "dvb"
    assert console.find_menu() != "root"
    assert console.run("mot", "a").lines
    assert dish.alive


def test_a_menu_that_is_not_there_is_refused(console, dish, monkeypatch, clock):
    calm(console, clock)
    monkeypatch.setitem(scripted.HELP_OF, "os", ())
    with pytest.raises(CommandRefused):
        console.enter("os")


def test_a_late_reply_is_discarded_and_the_prompt_learnt_anew(console, dish, clock):
    console.enter("mot")
    dish.out_fault = dish.in_fault = lambda byte: [(1.9, bytes([byte]))]
    with pytest.raises(NoReply):
        console.exchange("a 0 99")
    dish.out_fault = dish.in_fault = scripted.clean
    assert console.run("mot", "a 0 11").lines == ("Angle = 11",)


def test_two_enters_in_mid_exchange_are_answered_at_once(console, dish, clock):
    console.enter("mot")
    console.interject(("", ""))
    began = clock.monotonic()
    assert len(console.settle(D)) == 2
    assert clock.monotonic() - began < 0.5
    assert console.run("mot", "a").lines


def test_an_enter_that_was_swallowed_is_answered_by_the_other(console, dish, clock):
    console.enter("dvb")
    dish._stream_next = clock.monotonic()  # it prints until a key comes, which it takes for itself
    console.interject(("", ""))
    began = clock.monotonic()
    assert len(console.settle(D)) == 2
    assert clock.monotonic() - began < 0.5


@pytest.mark.parametrize("menu", ["root", "mot", "dvb", "nvs"])
def test_another_firmware_is_told_by_its_help_and_never_left_for_dead(clock, menu):
    help_of = {**scripted.HELP_OF, "mot": ("a [<motor>]", "g <az> <el>", "q")}
    dish = scripted.Dish(clock, help_of=help_of)
    dish.menu = menu
    console = bench.Owner(dish, clock, bench.HAL).console
    for _ in range(4):
        with pytest.raises(NoReply) as caught:
            console.enter("motor")
        clock.advance(5.0)
    if menu in ("root", "mot"):
        assert caught.value.reason == "wrong_firmware"
        assert "(prompt `TRK>`)" in str(caught.value)
    assert dish.alive
    assert ("root", "q") not in dish.heard


def test_a_root_without_its_marks_is_never_taken_for_a_submenu(clock):
    help_of = {**scripted.HELP_OF, "root": ("move", "tune", "nvs", "q")}
    dish = scripted.Dish(clock, prompts=scripted.ALIKE, help_of=help_of)
    console = bench.Owner(dish, clock, bench.LEARNT).console
    for _ in range(4):
        with pytest.raises(NoReply, match="does not tell which menu"):
            console.leave()
        clock.advance(5.0)
    assert "q" not in dish.written.decode()


def test_words_that_nobody_knows_are_no_menu(clock):
    help_of = dict.fromkeys(scripted.MENUS, ("Pardon, ?",))
    dish = scripted.Dish(clock, prompts=scripted.ALIKE, help_of=help_of)
    console = bench.Owner(dish, clock, bench.LEARNT).console
    with pytest.raises(NoReply, match="does not tell which menu"):
        console.leave()
    assert "q" not in dish.written.decode()


def test_silence_is_told_as_ever(console, dish, clock):
    dish.muted = True
    with pytest.raises(NoReply) as caught:
        console.synchronize()
    assert caught.value.reason in {"silent", "echo"}
