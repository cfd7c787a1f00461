"""Readings of the position that a wire has changed: never believed, and asked again."""

from __future__ import annotations

import pytest
from birdcage.antenna.reading_filter import CLEAN_READS, AngleSpan, Expected, ReadingFilter
from birdcage.base.errors import NoReply
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.values import Position


class Wire:
    """Answers with what it is given, 20 ms apart."""

    def __init__(self, *angles):
        self.angles = list(angles)
        self.now = 0.0
        self.asked = 0
        self.rate = 1.0

    def once(self):
        self.now += 0.02
        self.asked += 1
        return Position(*self.angles.pop(0))

    def monotonic(self):
        return self.now


@pytest.fixture
def rested():
    wire, belief = Wire((127.51, 36.29), (127.51, 36.29)), ReadingFilter(CARRYOUT_G2)
    belief.read(wire.once, wire)
    return wire, belief


def test_the_first_reading_needs_a_second(rested):
    wire, _belief = rested
    assert wire.asked == 2


def test_a_dish_at_rest_is_asked_once(rested):
    wire, belief = rested
    wire.angles = [(127.52, 36.28)]
    assert belief.read(wire.once, wire) == Position(127.52, 36.28)


@pytest.mark.parametrize("wrong", [(27.51, 36.29), (127.51, 3.29), (127.51, 86.29), (121.51, 36.29)])
def test_one_wrong_digit_is_asked_again(rested, wrong):
    wire, belief = rested
    wire.angles = [wrong, (127.51, 36.29), (127.51, 36.29)]
    assert belief.read(wire.once, wire) == Position(127.51, 36.29)


def test_a_dish_that_really_jumped_is_believed_at_the_second_reading(rested):
    wire, belief = rested
    wire.angles = [(140.0, 36.29), (140.01, 36.29)]
    assert belief.read(wire.once, wire) == Position(140.01, 36.29)


@pytest.mark.parametrize("wrong", [
    (27.51, 36.29), (127.51, 6.29), (127.51, 3.29), (127.51, 36.9), (127.51, 86.29), (127.51, 66.29), (127.51, 336.29),
])  # fmt: skip
def test_the_same_digit_damaged_twice_is_not_believed(rested, wrong):
    wire, belief = rested
    wire.angles = [wrong, wrong, (127.51, 36.29), (127.51, 36.29)]
    assert belief.read(wire.once, wire) == Position(127.51, 36.29)


def test_a_dish_that_went_where_a_damaged_digit_would_have_it_is_believed_at_the_third_reading(rested):
    wire, belief = rested
    wire.angles = [(127.51, 6.29)] * 3
    assert belief.read(wire.once, wire) == Position(127.51, 6.29)
    assert wire.asked == 5


def test_two_readings_that_differ_are_no_proof_of_motion(rested):
    wire, belief = rested
    wire.angles = [(128.51, 36.29), (127.51, 36.29), (128.51, 36.29), (128.51, 36.29), (128.51, 36.29)]
    assert belief.read(wire.once, wire) == Position(128.51, 36.29)


def test_three_readings_of_an_even_motion_are(rested):
    wire, belief = rested
    wire.angles = [(140.0, 36.29), (140.2, 36.29), (140.4, 36.29)]
    assert belief.read(wire.once, wire) == Position(140.4, 36.29)


def test_under_way_at_an_even_speed_it_is_asked_once(rested):
    wire, belief = rested
    wire.angles = [(127.71, 36.29), (127.91, 36.29), (128.11, 36.29), (128.31, 36.29), (128.51, 36.29)]
    belief.read(wire.once, wire)
    wire.asked = 0
    belief.read(wire.once, wire)
    belief.read(wire.once, wire)
    assert wire.asked == 2


def test_angles_that_never_fit_together_are_garbage(rested):
    wire, belief = rested
    wire.angles = [(100.0 * (n % 3), 36.29) for n in range(9)]
    with pytest.raises(NoReply) as error:
        belief.read(wire.once, wire)
    assert error.value.reason == "garbage"


def test_across_north_is_no_jump():
    wire, belief = Wire((359.99, 40.0), (0.01, 40.0), (359.98, 40.0)), ReadingFilter(CARRYOUT_G2)
    belief.read(wire.once, wire)
    assert belief.read(wire.once, wire) == Position(359.98, 40.0)
    assert wire.asked == 3


def test_a_dish_whose_time_is_scaled_turns_further_between_two_readings():
    wire, belief = Wire((10.0, 30.0), (20.0, 30.0), (30.0, 30.0)), ReadingFilter(CARRYOUT_G2)
    wire.rate = 20.0
    assert belief.read(wire.once, wire) == Position(30.0, 30.0)


def foreseen(*azimuths):
    """Return what a motion says of which only the azimuth moves."""
    spans = tuple(AngleSpan(azimuth, azimuth, 0.0) for azimuth in azimuths)
    still = (AngleSpan(36.29, 36.29, 0.0),)
    return lambda _last, _at, _now: Expected("it", (spans, still))


def test_a_reading_that_the_motion_explains_needs_no_second(rested):
    wire, belief = rested
    belief.foresee = foreseen(133.04)
    wire.angles = [(133.05, 36.29)]
    assert belief.read(wire.once, wire) == Position(133.05, 36.29)


def test_a_reading_where_the_dish_stood_needs_one_when_it_should_have_moved(rested):
    wire, belief = rested
    belief.foresee = foreseen(127.71)
    wire.angles = [(127.51, 36.29), (127.71, 36.29), (127.71, 36.29)]
    assert belief.read(wire.once, wire) == Position(127.71, 36.29)


def test_one_digit_does_not_make_an_arrival_of_a_dish_that_stands_still(rested):
    wire, belief = rested
    belief.foresee = foreseen(137.51)
    wire.angles = [(137.51, 36.29), (127.51, 36.29), (127.51, 36.29)]
    assert belief.read(wire.once, wire) == Position(127.51, 36.29)


def test_a_motion_that_the_dish_does_not_follow_is_not_gone_by_again(rested):
    wire, belief = rested
    belief.foresee = foreseen(133.04)
    wire.angles = [(127.51, 36.29)] * 3
    belief.read(wire.once, wire)
    wire.asked = 0
    belief.read(wire.once, wire)
    assert wire.asked == 1


@pytest.mark.parametrize(("clean", "asked"), [(50, 3), (CLEAN_READS, 1)])
def test_on_a_line_that_was_clean_for_long_a_step_by_whole_degrees_is_believed_at_once(rested, clean, asked):
    wire, belief = rested
    for _ in range(clean):
        wire.angles = [(127.51, 36.29)]
        belief.read(wire.once, wire)
    belief.foresee = foreseen(129.51)
    wire.angles, wire.asked = [(129.51, 36.29)] * 3, 0
    assert belief.read(wire.once, wire) == Position(129.51, 36.29)
    assert wire.asked == asked


def test_one_contradiction_makes_a_clean_line_doubtful_again(rested):
    wire, belief = rested
    for _ in range(CLEAN_READS):
        wire.angles = [(127.51, 36.29)]
        belief.read(wire.once, wire)
    wire.angles = [(27.51, 36.29), (127.51, 36.29), (127.51, 36.29)]
    belief.read(wire.once, wire)
    belief.foresee = foreseen(129.51)
    wire.angles = [(129.51, 36.29), (127.51, 36.29), (127.51, 36.29)]
    assert belief.read(wire.once, wire) == Position(127.51, 36.29)
