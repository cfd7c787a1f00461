"""`g` of a Trav'ler: at once, all axes, until a byte arrives."""

from __future__ import annotations

import pytest


@pytest.fixture
def motor(hal):
    def start(options=""):
        dish = hal(options)
        dish.ask("motor", "MOT>")
        return dish

    return start


def where(dish):
    truth = dish.device.truth()
    return truth.az_deg, truth.el_deg, truth.skew_deg


def test_it_keeps_the_shell_until_it_is_there(motor):
    dish = motor("latency_min=0&latency_max=0")
    start = dish.now
    assert dish.ask("g 270 60 100", "MOT>", within=30.0) == "g 270 60 100\r\nMOT>"
    assert dish.now - start == pytest.approx(13.5, abs=0.2)
    assert where(dish) == pytest.approx((270.0, 60.0, 100.0))


def test_numbers_in_the_other_order(motor):
    dish = motor("g_order=az_sk_el")
    dish.ask("g 200 100 60", "MOT>", within=30.0)
    assert where(dish) == pytest.approx((200.0, 60.0, 100.0))


def test_together_or_in_turn(motor):
    for policy, both in (("together", True), ("turn", False)):
        dish = motor(f"g_axes={policy}")
        dish.type("g 230 60 90\r")
        together = False
        for _ in range(300):
            dish.clock.advance(0.1)
            dish.device.truth()
            now = dish.device.machine.dish_s
            together |= all(axis.moving(now) for axis in dish.device.dish.axes[:2])
        assert together is both
        assert where(dish) == pytest.approx((230.0, 60.0, 90.0))
        assert dish.listen(1.0).endswith("MOT>")


@pytest.mark.parametrize("byte", ["\r", "q", "x", " ", "\x00"])
@pytest.mark.parametrize("axes", ["together", "turn"])
def test_any_byte_stops_it_where_it_can(motor, byte, axes):
    dish = motor(f"g_axes={axes}&abort_prompt=at_rest")
    dish.type("g 300 60 90\r")
    dish.listen(5.0)
    before = where(dish)
    dish.type(byte)
    assert dish.listen(2.0) == "MOT>"
    after = where(dish)
    assert not dish.device.truth().moving
    assert before[0] < after[0] < before[0] + 3.0
    dish.listen(30.0)
    assert where(dish) == after


def test_the_byte_is_swallowed_or_kept(motor):
    kept = motor("abort_key=keep")
    kept.type("g 300 60 90\r")
    kept.listen(3.0)
    assert kept.ask("a").startswith("MOT>a\r\nAZ = ")
    gone = motor()
    gone.type("g 300 60 90\r")
    gone.listen(3.0)
    assert gone.ask("a") == "MOT>\r\nMOT>"


@pytest.mark.parametrize(("option", "stops"), [("ignore", False), ("line", True)])
def test_the_line_feed_of_a_crlf(motor, option, stops):
    dish = motor(f"lf_after_cr={option}")
    dish.type("g 300 60 90\r\n")
    dish.listen(30.0)
    assert (dish.device.truth().az_deg < 182.0) is stops


def test_it_drops_the_queue_or_waits_for_it(motor):
    for policy, el in (("drop", 45.0), ("wait", 60.0)):
        dish = motor(f"g_queue={policy}&out_of_range=clamp")
        dish.ask("a 0 220", "MOT>")
        dish.ask("a 1 60", "MOT>")
        dish.listen(1.0)
        assert dish.ask("g 170 45 90", "MOT>", within=60.0)
        highest = dish.device.truth().el_deg
        assert highest == pytest.approx(45.0)
        assert dish.device.truth().az_deg == pytest.approx(170.0)
        travelled = dish.device.dish.axes[1].wear(dish.device.machine.dish_s)[0]
        assert travelled == pytest.approx(2 * (el - 45.0), abs=0.1)


@pytest.mark.parametrize("line", ["g", "g 1 2", "g 1 2 3 4", "g 1 x 3"])
def test_bad_parameters(motor, line):
    assert "Invalid parameter." in motor().ask(line, "MOT>")


def test_out_of_range(motor):
    assert "out of range" in motor().ask("g 180 95 90", "MOT>")


def test_a_search_goes_on_after_it(hal):
    dish = hal("searching=1&search_finds=0")
    dish.ask("motor", "MOT>")
    dish.ask("g 100 40 90", "MOT>", within=40.0)
    assert where(dish)[:2] == pytest.approx((100.0, 40.0), abs=1.0)
    dish.listen(20.0)
    assert dish.device.truth().moving
    assert where(dish)[0] != pytest.approx(100.0, abs=1.0)
