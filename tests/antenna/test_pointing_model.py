"""What a tilted base and a beam that looks aside do to a direction, and back."""

from __future__ import annotations

import math

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.antenna.pointing_model import PointingModel, tilt_of_base
from birdcage.base.geometry import separation, shortest_turn
from hypothesis import assume, given
from hypothesis import strategies as st

AZ = st.floats(0.0, 359.999)
SMALL = st.floats(-5.0, 5.0)


def test_signs_are_those_of_tpoint() -> None:
    # dE = -AN cos A, dE = +AW sin A, dA = -CA sec E, dA = -AN sin A tan E, dA = -AW cos A tan E (true - mount)
    small = 0.01
    for az, el in ((0.0, 40.0), (90.0, 40.0), (210.0, 60.0), (333.0, 5.0)):
        a, e = math.radians(az), math.radians(el)
        for model, d_az, d_el in (
            (PointingModel(an_deg=small), -small * math.sin(a) * math.tan(e), -small * math.cos(a)),
            (PointingModel(aw_deg=small), -small * math.cos(a) * math.tan(e), small * math.sin(a)),
            (PointingModel(ca_deg=small), -small / math.cos(e), 0.0),
        ):
            true_az, true_el = model.to_true(az, el)
            assert shortest_turn(az, true_az) == pytest.approx(d_az, abs=2e-5)
            assert true_el - el == pytest.approx(d_el, abs=2e-5)


@given(AZ, st.floats(-20.0, 90.0), SMALL, SMALL, SMALL, st.floats(-180, 180), SMALL)
def test_there_and_back_is_the_same_direction(
    az: float, el: float, ca: float, an: float, aw: float, az_offset: float, el_offset: float
) -> None:
    alignment = Alignment(az_offset, el_offset, ca, an, aw)
    dish = alignment.to_dish(az, el)
    assume(dish[1] + el_offset < 90.0 - 1e-9)  # the mount's own zenith: a beam that looks aside does not reach it
    assert separation(az, el, *alignment.to_true(*dish)) < 1e-6


@given(AZ, st.floats(-20.0, 89.9), SMALL, SMALL, SMALL)
def test_dish_angles_come_back_themselves(az: float, el: float, ca: float, an: float, aw: float) -> None:
    alignment = Alignment(12.5, 0.0, ca, an, aw)
    assume(alignment.model is not None)
    back = alignment.to_dish(*alignment.to_true(az, el))
    assert abs(shortest_turn(az, back[0])) < 1e-6
    assert back[1] == pytest.approx(el, abs=1e-6)


def test_the_zenith_is_a_direction_like_any_other() -> None:
    leaning = Alignment(an_deg=1.0)
    az, el = leaning.to_dish(0.0, 90.0)
    # The axis leans north, so the zenith lies a degree south of the mount's own.
    assert el == pytest.approx(89.0)
    assert az == pytest.approx(180.0)
    assert leaning.to_true(0.0, 90.0) == pytest.approx((0.0, 89.0))
    aside = Alignment(ca_deg=0.5)
    assert aside.to_dish(0.0, 90.0)[1] == 90.0
    assert aside.to_true(*aside.to_dish(0.0, 90.0))[1] == pytest.approx(89.5)


def test_offsets_alone_stay_what_they_were() -> None:
    offsets = Alignment(10.0, -0.5)
    assert offsets.model is None
    assert offsets.to_true(355.0, 30.0) == (5.0, 29.5)
    assert offsets.to_dish(5.0, 29.5) == (355.0, 30.0)
    assert Alignment().to_dish(412.3, 30.0) == (412.3, 30.0)
    sector = offsets.sector_to_dish(20.0, 40.0, 30.0, "mast")
    assert (sector.az_from_deg, sector.az_to_deg, sector.el_below_deg, sector.reason) == (10.0, 30.0, 30.5, "mast")


@given(AZ, st.floats(1.0, 300.0), st.floats(-10.0, 80.0), SMALL, SMALL, SMALL, AZ, st.floats(0.0, 1.0))
def test_a_sector_loses_nothing_to_the_tilt(
    start: float, width: float, below: float, ca: float, an: float, aw: float, az: float, part: float
) -> None:
    alignment = Alignment(30.0, 2.0, ca, an, aw)
    sector = alignment.sector_to_dish(start, start + width, below)
    inside = (start + width * part, min(below, -10.0 + (below + 10.0) * (az / 360.0)))
    assume(abs(inside[1]) <= abs(below))
    dish_az, dish_el = alignment.to_dish(*inside)
    assert dish_el <= sector.el_below_deg + 1e-9
    assert sector.overlaps(dish_az - 1e-7, 2e-7)


def test_a_sector_up_to_the_zenith_goes_all_round() -> None:
    sector = Alignment(ca_deg=1.0).sector_to_dish(100.0, 120.0, 90.0)
    assert all(sector.overlaps(float(az), 0.0) for az in range(0, 360, 5))


def test_a_base_that_leans_back_leans_the_axis_away_from_its_front() -> None:
    assert tilt_of_base(2.0, 0.0, 0.0) == pytest.approx((-2.0, 0.0))  # front north and up: the axis leans south
    assert tilt_of_base(2.0, 0.0, 90.0) == pytest.approx((0.0, 2.0))  # front east and up: it leans west
    assert tilt_of_base(0.0, 1.0, 0.0) == pytest.approx((0.0, -1.0))  # right side, the east, down: it leans east


def test_what_is_not_zero_is_said() -> None:
    assert Alignment().words() == ""
    assert Alignment(1.2, -0.3).words() == "az +1.20°, el -0.30°"
    assert Alignment(1.2, -0.3, 0.1, 0.3, -0.4).words() == "az +1.20°, el -0.30°, tilt 0.50° to 53°, beam 0.10° left"
