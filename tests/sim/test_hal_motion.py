"""Queued moves, motors in turn, limits and the cable of a Trav'ler."""

from __future__ import annotations

import re

import pytest


def at(dish):
    return [float(text) for text in re.findall(r"(?:AZ|EL|SK) = *(-?[\d.]+)", dish.ask("a", "MOT>"))]


@pytest.fixture
def motor(hal):
    def start(options=""):
        dish = hal(options)
        dish.ask("motor", "MOT>")
        return dish

    return start


def test_the_prompt_comes_at_once_and_the_queue_keeps_all(motor):
    dish = motor()
    start = dish.now
    for line in ("a 0 200", "a 1 60", "a 0 190", "a 1 50"):
        dish.ask(line, "MOT>")
    assert dish.now - start < 0.2
    places, seen = [], []
    for _ in range(400):
        dish.clock.advance(0.1)
        truth = dish.device.truth()
        places.append((truth.az_deg, truth.el_deg))
        for goal in ((200.0, 45.0), (200.0, 60.0), (190.0, 60.0), (190.0, 50.0)):
            if places[-1] == pytest.approx(goal, abs=0.01) and goal not in seen:
                seen.append(goal)
    assert seen == [(200.0, 45.0), (200.0, 60.0), (190.0, 60.0), (190.0, 50.0)]
    assert at(dish) == [190.0, 50.0, 90.0]


def test_azimuth_and_elevation_never_turn_together_and_skew_does(motor):
    dish = motor()
    for line in ("a 0 150", "a 1 60", "a 2 20"):
        dish.ask(line, "MOT>")
    with_skew = 0
    for _ in range(300):
        dish.clock.advance(0.1)
        az, el, skew = (axis.moving(dish.device.machine.dish_s) for axis in dish.device.dish.axes)
        dish.device.truth()
        assert not (az and el)
        with_skew += skew and (az or el)
    assert with_skew > 50
    assert at(dish) == [150.0, 60.0, 20.0]


def test_each_move_of_the_queue_takes_its_own_time(motor):
    dish = motor("latency_min=0&latency_max=0")
    dish.ask("a 0 190", "MOT>")  # 6.4 s
    dish.ask("a 1 50", "MOT>")  # 4.2 s
    dish.clock.advance(6.2)
    assert dish.device.truth().el_deg == 45.0
    dish.clock.advance(4.2)
    assert dish.device.truth().moving
    dish.clock.advance(0.3)
    assert not dish.device.truth().moving


@pytest.mark.parametrize("line", ["a 3 10", "a 0 x", "a 0", "a 0 1 2", "a 0 nan"])
def test_bad_parameters(motor, line):
    assert "Invalid parameter." in motor().ask(line, "MOT>")


@pytest.mark.parametrize(("policy", "low", "high"), [("clamp", 15.0, 15.0), ("unreliable", 5.0, 15.0)])
def test_below_the_floor(motor, policy, low, high):
    dish = motor(f"below_floor={policy}")
    dish.ask("a 1 5", "MOT>")
    dish.listen(30.0)
    assert low <= at(dish)[1] <= high


def test_below_the_floor_refused(motor):
    dish = motor("below_floor=refuse")
    assert "out of range" in dish.ask("a 1 14.9", "MOT>")
    assert not dish.device.truth().moving


def test_above_the_ceiling_and_beside_the_skew(motor):
    dish = motor()
    assert "out of range" in dish.ask("a 1 90.1", "MOT>")
    assert "out of range" in dish.ask("a 2 181", "MOT>")
    clamping = motor("out_of_range=clamp")
    clamping.ask("a 1 95", "MOT>")
    clamping.ask("a 2 181", "MOT>")
    clamping.listen(60.0)
    assert at(clamping)[1:] == [90.0, 180.0]


def test_the_cable_crosses_north_and_comes_back_the_other_way_round_at_its_end(motor):
    dish = motor("az=350")
    dish.ask("a 0 10", "MOT>")
    dish.listen(20.0)
    assert dish.device.truth().cable_deg == pytest.approx(370.0)
    assert at(dish)[0] == 10.0
    dish.ask("a 0 90", "MOT>")
    dish.ask("a 0 100", "MOT>")  # 460 does not fit
    dish.listen(13.0)
    assert dish.device.truth().cable_deg == pytest.approx(450.0, abs=1.0)
    dish.listen(30.0)
    assert dish.device.truth().cable_deg == pytest.approx(100.0)


def test_a_cable_of_one_turn_never_crosses_north(motor):
    dish = motor("wrap=360&az=350")
    assert "WRAP = 360.00" in dish.ask("a", "MOT>")
    dish.ask("a 0 10", "MOT>")
    dish.listen(30.0)
    assert dish.device.truth().cable_deg == pytest.approx(10.0)


def test_a_wrap_position_that_is_reset_costs_a_whole_turn_after_the_meridian(motor):
    dish = motor("wrap=0&az=355")
    assert "WRAP = 455.00" in dish.ask("a", "MOT>")
    dish.ask("a 0 2", "MOT>")
    dish.listen(20.0)
    assert dish.device.truth().cable_deg == pytest.approx(362.0)
    assert "WRAP =   0.00" in dish.ask("a", "MOT>")
    dish.ask("a 0 4", "MOT>")
    dish.listen(30.0)
    assert dish.device.truth().cable_deg == pytest.approx(4.0)
    dish.device.power_cycle()
    dish.listen(200.0)
    dish.ask("motor", "MOT>")
    assert "WRAP = 455.00" in dish.ask("a", "MOT>")


def test_azimuth_as_the_cable_has_it(motor):
    assert at(motor("az=400&az_print=cable"))[0] == 400.0
    assert at(motor("az=400"))[0] == 40.0
    assert "out of range" in motor("az_outside=0").ask("a 0 -0.5", "MOT>")


def test_stow_folds_it_flat(hal):
    dish = hal()
    assert dish.ask("stow", "TRK>") == "stow\r\nTRK>"
    dish.listen(60.0)
    truth = dish.device.truth()
    assert (truth.cable_deg, truth.el_deg, truth.skew_deg) == pytest.approx((0.0, 0.0, 90.0))
    blocking = hal("stow_blocks=1")
    start = blocking.now
    blocking.ask("stow", "TRK>", within=60.0)
    assert blocking.now - start > 20.0
    assert not blocking.device.truth().moving
