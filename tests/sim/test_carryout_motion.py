"""Moves of a Carryout of 2003: records, limits, and what a second command meets."""

from __future__ import annotations

import re

import pytest


@pytest.fixture
def target(carryout):
    def start(options=""):
        dish = carryout(options)
        dish.ask("target")
        return dish

    return start


def truth(dish):
    return dish.device.truth()


def records(text):
    return [(int(az), int(el)) for az, el in re.findall(r"az = (\d+) +el = (\d+)", text)]


def test_records_come_while_it_moves_and_end_with_where_it_rests(target):
    dish = target()
    told = records(dish.ask("g 150 50", "TARGET>"))
    assert len(told) > 5
    assert [az for az, _ in told] == sorted((az for az, _ in told), reverse=True)
    assert told[-1] == (15000, 5000)
    assert not truth(dish).moving
    assert dish.listen(60.0) == ""


def test_without_a_last_record_only_motion_is_told(target):
    told = records(target("record_last=0").ask("g 150 50", "TARGET>"))
    assert len(told) > 4
    assert told[-1] != (15000, 5000)


def test_how_often_and_how_a_record_is_printed(target):
    dish = target("record_s=0.5&record=AZ {az} v 0 el : {el}!&record_end=cr&speed=10")
    dish.type("g 160 45\r")
    heard = dish.listen(5.0)
    told = re.findall(r"AZ (\d+) v 0 el : 4500!\r(?!\n)", heard)
    assert 4 <= len(told) <= 6
    assert told[-1] == "16000"


@pytest.mark.parametrize("line", ["g", "g 1", "g 1 2 3", "g x 30", "g 180 nan"])
def test_bad_parameters(target, line):
    dish = target()
    assert "Invalid parameter." in dish.ask(line, "TARGET>")
    assert not truth(dish).moving


@pytest.mark.parametrize("line", ["g 180 21.99", "g 180 73.01", "g -0.5 45", "g 360.5 45"])
@pytest.mark.parametrize("text", ["Target out of range.", "NO", ""])
def test_a_target_beyond_the_limits_is_refused_in_words_of_its_own(target, line, text):
    dish = target(f"refusal_text={text}")
    assert dish.ask(line, "TARGET>") == f"{line}\r\n{text}{text and chr(13) + chr(10)}TARGET>"
    assert not truth(dish).moving


def test_or_it_goes_to_the_limit(target):
    dish = target("out_of_range=clamp")
    for line, el in (("g 180 10", 22.0), ("g 180 90", 73.0)):
        dish.ask(line, "TARGET>")
        assert truth(dish).el_deg == el


def test_azimuths_beyond_the_circle_may_be_turned_into_it(target):
    dish = target("az_outside=turn")
    dish.ask("g -10 45", "TARGET>", within=60.0)
    assert truth(dish).az_deg == 350.0


@pytest.mark.parametrize(("wrap", "cable"), [("360", 10.0), ("455", 370.0)])
def test_which_way_it_goes_across_north(target, wrap, cable):
    dish = target(f"wrap={wrap}&az=350")
    told = records(dish.ask("g 10 45", "TARGET>", within=60.0))
    assert truth(dish).cable_deg == cable
    assert told[-1] == (1000, 4500)


def test_together_or_azimuth_first(target):
    for policy, both in (("together", True), ("turn", False)):
        dish = target(f"g_axes={policy}&record_s=0.1")
        dish.type("g 220 60\r")
        together = False
        for _ in range(60):
            dish.listen(0.1)
            together |= all(axis.moving(dish.device.machine.dish_s) for axis in dish.device.dish.axes)
        assert together is both
        assert (truth(dish).az_deg, truth(dish).el_deg) == (220.0, 60.0)


@pytest.mark.parametrize(("second_move", "highest", "end", "said"), [
    ("retarget", 150.0, 100.0, ""),
    ("queue", 220.0, 100.0, ""),
    ("block", 220.0, 100.0, ""),
    ("refuse", 220.0, 220.0, "Motors busy."),
    ("abort", 150.0, 100.0, ""),
])  # fmt: skip
@pytest.mark.parametrize("prompt_when", ["at_rest", "at_once"])
def test_a_second_g_meets_what_is_chosen(target, second_move, highest, end, said, prompt_when):
    dish = target(f"az=120&second_move={second_move}&prompt_when={prompt_when}")
    dish.type("g 220 45\r")
    heard = dish.listen(1.0)
    dish.type("\rg 100 45\r")  # the first byte is lost to a move that any byte ends
    reached = 0.0
    for _ in range(120):
        heard += dish.listen(0.1)
        reached = max(reached, truth(dish).az_deg)
    assert (reached > 219.0) is (highest > 200.0)
    assert truth(dish).az_deg == end
    assert said in heard
    assert records(heard)[-1] == (round(end * 100), 4500)


@pytest.mark.parametrize("byte", ["\r", "q", "x", " ", "\x00"])
def test_any_byte_ends_a_move_where_it_does(target, byte):
    dish = target("second_move=abort&az=120")
    dish.type("g 300 45\r")
    dish.listen(2.0)
    before = truth(dish).az_deg
    dish.type(byte)
    dish.listen(10.0)
    assert before < truth(dish).az_deg < before + 10.0
    assert dish.ask("", "TARGET>") == "\r\nTARGET>"


def test_where_nothing_is_read_the_line_waits_for_the_move(target):
    dish = target("second_move=block&az=120")
    dish.type("g 300 45\r")
    dish.listen(1.0)
    dish.type("q\r")
    assert not re.search(r"[A-Z]+>", dish.listen(5.0))
    dish.listen(10.0)
    assert (truth(dish).menu, truth(dish).az_deg) == ("root", 300.0)


@pytest.mark.parametrize(("policy", "goes_on"), [("rest", True), ("key", False)])
def test_a_byte_may_end_the_records_and_not_the_move(target, policy, goes_on):
    dish = target(f"records={policy}&az=120")
    dish.type("g 300 45\r")
    dish.listen(1.0)
    dish.type("q\r")
    assert bool(records(dish.listen(5.0))) is goes_on
    dish.listen(10.0)
    assert (truth(dish).menu, truth(dish).az_deg) == ("root", 300.0)


def test_the_ceiling_is_row_102_from_the_next_start_on(carryout):
    for policy, at_once, after_save in (("restart", False, False), ("save", False, True), ("write", True, True)):
        dish = carryout(f"nvs_applies={policy}&search=0")

        def high(dish=dish):
            dish.ask("target")
            took = "out of range" not in dish.ask("g 180 80")
            dish.listen(20.0)
            dish.ask("q")
            return took

        dish.ask("nvs")
        assert "102) Maximum EL" in dish.ask("d")
        assert dish.ask("e 102 90").splitlines()[1].endswith("90.00")
        dish.ask("q")
        assert high() is at_once
        dish.ask("nvs")
        assert "Saved." in dish.ask("s")
        dish.ask("q")
        assert high() is after_save
        dish.device.power_cycle()
        dish.listen(200.0)
        assert high()


def test_bad_rows_of_the_settings_memory(carryout):
    dish = carryout()
    dish.ask("nvs")
    for line in ("e", "e 101", "e 102 x", "e 102 1 2", "d 1", "e x"):
        assert "Invalid parameter." in dish.ask(line)
    assert dish.ask("d 102").splitlines()[1].endswith("73.00")
