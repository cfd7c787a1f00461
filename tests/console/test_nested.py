"""Menus two deep: entered one after the other, left one by one, each `q` from a proven submenu, none at the root."""

from __future__ import annotations

import sys

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.console.dialect import ConsoleDialect

bench, nested = sys.modules["console_bench"], sys.modules["console_nested"]
D = bench.D
CASES = {
    "known": (nested.KNOWN, nested.NAMED),
    "learnt": (nested.LEARNT, nested.NAMED),
    "alike": (nested.LEARNT, nested.ALIKE),
    "alike below the root": (nested.LEARNT, nested.TWO),
}


@pytest.fixture(params=CASES)
def case(request):
    return CASES[request.param]


@pytest.fixture
def dish(clock, case):
    return nested.Dish(clock, prompts=case[1])


@pytest.fixture
def owner(dish, clock, case):
    return bench.Owner(dish, clock, case[0])


@pytest.fixture
def calm(console, clock):
    console.synchronize()
    clock.advance(2 * D)
    console.synchronize()
    assert console.is_settled
    return console


def menus_of(dish):
    """What was said that changes menus, with the menu that it was said in."""
    return [(menu, line) for menu, line in dish.heard if line in ("q", "odu", "mot", "nvs")]


def test_a_menu_within_a_menu_is_entered_step_by_step(calm, dish):
    calm.enter("mot")
    assert (dish.menu, calm.place) == ("mot", "mot")
    assert menus_of(dish) == [("root", "odu"), ("odu", "mot")]
    assert calm.run("mot", "a").lines == ("Angle[0] = 180.00", "Angle[1] = 45.00")


def test_it_is_left_step_by_step_and_never_beyond_the_root(calm, dish):
    calm.enter("mot")
    before = len(menus_of(dish))
    calm.leave()
    assert (dish.menu, calm.place, dish.alive) == ("root", "root", True)
    assert menus_of(dish)[before:] == [("mot", "q"), ("odu", "q")]
    calm.leave()
    assert menus_of(dish)[before + 2 :] == []


def test_one_menu_is_left_at_a_time(calm, dish):
    calm.enter("nvs")
    assert [calm.leave_one() for _ in range(3)] == ["odu", "root", "root"]
    assert dish.alive
    assert menus_of(dish)[-2:] == [("nvs", "q"), ("odu", "q")]


def test_the_menu_that_both_share_is_not_left(calm, dish):
    calm.enter("mot")
    before = len(menus_of(dish))
    calm.enter("nvs")
    assert (dish.menu, calm.place) == ("nvs", "nvs")
    assert menus_of(dish)[before:] == [("mot", "q"), ("odu", "nvs")]
    calm.enter("odu")
    assert (dish.menu, calm.place) == ("odu", "odu")
    assert menus_of(dish)[before + 2 :] == [("nvs", "q")]


def test_going_round_takes_no_wait(calm, dish, clock):
    for menu in ("mot", "nvs", "odu", "root"):
        calm.enter(menu)  # what is new is learnt
    began = clock.monotonic()
    for menu in ("mot", "nvs", "odu", "mot", "root", "nvs", "root"):
        calm.enter(menu)
        assert (dish.menu, calm.place) == (menu, menu)
    assert clock.monotonic() == began


@pytest.mark.parametrize("menu", ["odu", "mot", "nvs"])
def test_a_dish_that_was_left_in_a_submenu_is_found_there_and_brought_back(console, dish, menu):
    dish.menu = menu
    assert console.synchronize() != "root"
    console.enter("root")
    assert (dish.menu, console.place, dish.alive) == ("root", "root", True)
    console.enter("mot")
    assert (dish.menu, console.place) == ("mot", "mot")


def test_a_way_in_that_is_lost_is_noticed(calm, dish):
    calm.enter("odu")
    went, dish._line = dish._line, lambda line, at: went("" if line == "mot" else line, at)
    with pytest.raises(CommandRefused) as refused:
        calm.enter("mot")
    assert refused.value.reason == "wrong_menu"
    assert dish.menu == "odu"
    dish._line = went
    calm.enter("mot")
    assert (dish.menu, calm.place, dish.alive) == ("mot", "mot", True)


def test_a_reboot_in_between_ends_no_shell(calm, dish):
    calm.enter("mot")
    dish.menu = "root"
    calm.leave()
    assert dish.alive
    assert ("root", "q") not in dish.heard


def test_a_line_that_could_be_a_q_goes_out_from_every_submenu_and_not_at_the_root(calm, dish):
    with pytest.raises(CommandRefused, match="was not sent"):
        calm.exchange("freqs")
    calm.enter("odu")
    with pytest.raises(CommandRefused, match="Invalid command"):
        calm.exchange("freqs")
    assert dish.alive


def test_a_raw_line_that_enters_a_menu_is_noticed(calm, dish):
    calm.enter("odu")
    calm.type_line("mot").wait(D)
    assert calm.find_menu() != "odu"
    calm.run("nvs", "?")
    assert (dish.menu, dish.alive) == ("nvs", True)


def test_leaving_before_the_port_closes_gives_up_where_the_way_is_long(calm, dish):
    calm.enter("mot")
    dish.out_fault = lambda byte: [(0.3, bytes([byte]))]
    calm.run("mot", "a")
    before = len(menus_of(dish))
    assert not calm.leave_all(1.2)  # five round trips
    assert menus_of(dish)[before:] == []
    dish.out_fault = lambda byte: [(0.0, bytes([byte]))]
    calm.run("mot", "a")
    assert calm.leave_all(2.0)
    assert (dish.menu, dish.alive) == ("root", True)


@pytest.mark.parametrize("parents", [{"mot": "odu", "odu": "mot"}, {"mot": "nowhere"}, {"nowhere": "odu"}])
def test_every_menu_leads_to_the_root(parents):
    with pytest.raises(ValueError, match="does not lead to the root"):
        ConsoleDialect(prompts=nested.NAMED, parents=parents)


def test_a_menu_may_be_said_to_lie_in_the_root():
    assert ConsoleDialect(prompts=nested.NAMED, parents={"odu": "root", "mot": "odu"}).depth == 2
