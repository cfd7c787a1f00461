"""What the public programs of a Carryout of 2003 send, and what they look for in its answer."""

from __future__ import annotations

import re

import pytest


def rotor_reads(reply: bytes) -> tuple[float, float] | None:
    """Read an answer as the only public program does that reads one, by its description.

    Split at single blanks, the first word aside: the azimuth stands three words before the word `el`, the elevation
    two after it, of which four characters count; both are hundredths of a degree.
    """
    words = reply[:100].decode().strip().split(" ")[1:]
    if "el" not in words:
        return None
    at = words.index("el")
    if at + 2 >= len(words):
        return None
    return int(words[at - 3]) / 100, int(words[at + 2][:4]) / 100


def hear(dish, count: int, seconds: float) -> bytes:
    """As many bytes as were asked for, or those of so many seconds."""
    heard, end = b"", dish.now + seconds
    while len(heard) < count and dish.now < end:
        heard += dish.listen(0.01).encode("latin-1")
    return heard[:count]


def test_t_carryout2003(carryout):
    dish = carryout("az=170&el=40")
    dish.type("q\r\r")
    dish.listen(1.0)
    dish.type("target\r")
    dish.type("g 180.0 45.0\r")
    reply = hear(dish, 100, 1.0)
    assert b"g 180.0 45.0\r\n" in reply
    az, el = rotor_reads(reply)
    truth = dish.device.truth()
    assert 170.0 <= az <= truth.az_deg
    assert 40.0 <= el <= truth.el_deg
    dish.type("q\r")
    rest = dish.listen(5.0)
    assert re.findall(r"az = (\d+) +el = (\d+)\r\n", rest)[-1] == ("18000", "4500")
    assert dish.device.truth().menu == "root"
    for line, value in (("nvs", ""), ("e 102", "73.00"), ("e 102 90", "90.00"), ("s", ""), ("q", "")):
        assert value in dish.ask(line)
    dish.device.power_cycle()
    dish.listen(900.0)
    dish.ask("target")
    dish.ask("g 180 90")
    dish.listen(30.0)
    assert dish.device.truth().el_deg == 90.0


@pytest.mark.parametrize("second_move", ["retarget", "queue", "block", "refuse", "abort"])
def test_the_rotor_program_follows_a_target_where_the_dish_lets_it(carryout, second_move):
    dish = carryout(f"az=100&el=40&second_move={second_move}")
    read = []
    for step in range(12):
        dish.type(f"target\rg {100.0 + step} {40.0 + step / 2}\r")
        read.append(rotor_reads(hear(dish, 100, 1.0)))
        dish.type("q\r")
    places = [each for each in read if each is not None]
    assert places[-1] == pytest.approx((dish.device.truth().az_deg, dish.device.truth().el_deg), abs=1.5)
    assert len(places) > 6


@pytest.mark.parametrize("second_move", ["retarget", "queue", "block", "refuse", "abort"])
def test_the_scan_sends_q_right_behind_g_which_an_aborting_dish_would_not_survive(carryout, second_move):
    dish = carryout(f"az=90&el=22&second_move={second_move}")
    for az in range(90, 121):
        dish.type(f"target\rg {az} 22\rq\r")
        dish.listen(1 / 3)
    dish.listen(5.0)
    assert dish.device.truth().az_deg == pytest.approx(90.0 if second_move == "abort" else 120.0, abs=1.1)


def test_numbers_as_people_type_them(carryout):
    dish = carryout()
    dish.ask("target", "TARGET>")
    for line, az, el in (("g 0 22", 0.0, 22.0), ("g 359.5 35.839999999999996", 359.5, 35.84), ("g 180.0 45", 180, 45)):
        dish.ask(line, "TARGET>")
        assert (dish.device.truth().az_deg, dish.device.truth().el_deg) == (az, el)


def test_it_is_silent_until_asked_and_tells_nothing_at_rest(carryout):
    dish = carryout()
    assert dish.listen(600.0) == ""
    for menu in ("target", "motor"):
        dish.ask(menu)
        for line in ("", "a", "p", "g", "el"):
            assert not re.search(r"\d{4}", dish.ask(line))
        dish.ask("q")


def test_every_menu_is_listed_entered_and_left(carryout):
    dish = carryout("motor_help=a,g")
    assert dish.ask("?", "TRK>") == "?\r\ntarget\r\nmotor\r\ndvb\r\nos\r\nnvs\r\nq\r\nTRK>"
    for menu in ("target", "motor", "dvb", "os", "nvs"):
        prompt = f"{menu.upper()}>"
        assert dish.ask(menu, prompt) == f"{menu}\r\n{prompt}"
        assert dish.ask("?", prompt).endswith(f"\r\nq\r\n{prompt}")
        assert "Invalid command." in dish.ask("nosuch", prompt)
        assert dish.ask("q", "TRK>") == "q\r\nTRK>"
    dish.ask("motor", "MOTOR>")
    assert dish.ask("?", "MOTOR>") == "?\r\na\r\ng\r\nq\r\nMOTOR>"


def test_prompts_that_are_all_alike(carryout):
    dish = carryout("prompts=alike")
    for line in ("", "target", "q", "nvs"):
        assert dish.ask(line) == f"{line}\r\n>"
