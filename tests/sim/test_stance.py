"""A base that leans, and a beam that looks aside."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.geometry import separation
from birdcage.sim.port import open_device
from birdcage.sim.settings import SimSettings
from birdcage.sim.stance import Stance


def test_a_level_base_is_only_turned() -> None:
    assert Stance(SimSettings(heading=30.0)).beam(350.0, 40.0) == (20.0, 40.0)


def test_leaning_north_lowers_what_is_north_and_lifts_what_is_south() -> None:
    stance = Stance(SimSettings(tilt_north=2.0))
    assert stance.beam(0.0, 40.0) == pytest.approx((0.0, 38.0))
    assert stance.beam(180.0, 40.0) == pytest.approx((180.0, 42.0))
    # To the east the beam swings towards the north: dA = -AN sin A tan E.
    az, el = stance.beam(90.0, 40.0)
    assert az == pytest.approx(90.0 - 1.68, abs=0.01)
    assert el == pytest.approx(40.0, abs=0.05)


def test_leaning_east_lowers_what_is_east() -> None:
    assert Stance(SimSettings(tilt_east=1.0)).beam(90.0, 30.0) == pytest.approx((90.0, 29.0))
    assert Stance(SimSettings(tilt_east=1.0)).beam(270.0, 30.0) == pytest.approx((270.0, 31.0))


def test_the_heading_turns_the_dish_and_not_the_lean() -> None:
    assert Stance(SimSettings(tilt_north=2.0, heading=90.0)).beam(270.0, 40.0) == pytest.approx((0.0, 38.0))


def test_collimation_is_the_same_angle_at_every_elevation() -> None:
    stance = Stance(SimSettings(collimation=0.5))
    for el in (10.0, 45.0, 85.0):
        assert separation(100.0, el, *stance.beam(100.0, el)) == pytest.approx(0.5)
    assert stance.beam(100.0, 10.0)[0] < 100.0


@pytest.mark.parametrize("firmware", ["g2", "hal205"])
def test_the_truth_tells_where_the_beam_is(firmware: str) -> None:
    device = open_device(f"{firmware}?heading=90&tilt_north=2&az=0&el=40", clock=VirtualClock())
    truth = device.truth()
    assert truth.az_deg == 0.0
    assert (truth.beam_az_deg, truth.beam_el_deg) == Stance(device.settings).beam(truth.az_deg, truth.el_deg)
    assert truth.beam_az_deg == pytest.approx(88.32, abs=0.01)
