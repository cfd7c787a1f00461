"""The beam of dish and feed in a plan: decibels by both widths, and the keyhole of a narrow one by its name."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from birdcage.base.beam import Beam, beam_of
from birdcage.base.config import STOCK_FEED, Settings
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.sky.age import expected_error
from birdcage.sky.element_error import ElementError
from birdcage.station.reach_limits import reach_limits
from birdcage.tracking.plan_values import plan_values
from birdcage.tracking.plan_words import plan_lines
from birdcage.tracking.planning.forecast import Offsets, made, offsets_deg, separations_deg
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.pointing_error import pointing_error

from .orbits import NOW, PLACE, mount, overhead, plan_of

SOUTHBOUND = {"northbound": False}


def travler_mount():
    """As `birdcage track --plan --firmware hal205` makes it, homed and waiting in the south."""
    limits = reach_limits(Settings(), TRAVLER)
    return replace(mount(TRAVLER, at=(200.0, 30.0)), limits=limits, beam=beam_of(STOCK_FEED, TRAVLER.reflector))


@pytest.fixture(scope="module")
def near_the_zenith():
    return plan_of(0.07, travler_mount(), orbit=SOUTHBOUND)


def test_a_pass_near_the_zenith_names_its_keyhole_with_what_it_costs(near_the_zenith):
    assert "keyhole" in near_the_zenith.reach.reasons
    (hole,) = near_the_zenith.keyholes
    assert hole.max_loss_db == pytest.approx(12.0 * (hole.max_error_deg / 2.01) ** 2, rel=0.01)
    assert hole.max_loss_db > 3.0, "beyond half a beam"
    lines = plan_lines(near_the_zenith)
    (told,) = (line for line in lines if line.startswith("Keyhole"))
    assert f"{hole.max_error_deg:.2f}° off, {hole.max_loss_db:.1f} dB (at best" in told
    assert max(map(len, lines)) <= 80
    (value,) = json.loads(json.dumps(plan_values(near_the_zenith)))["keyholes"]
    assert value["max_loss_db"] == pytest.approx(hole.max_loss_db, abs=1e-3)


def test_with_a_wide_beam_the_same_pass_has_none():
    target, passing = overhead(0.07, **SOUTHBOUND)
    wide = replace(travler_mount(), limits=replace(reach_limits(Settings(), TRAVLER), tolerance_deg=3.15))
    assert "keyhole" not in plan_pass(target, PLACE, wide, NOW, passing=passing).reach.reasons


def test_the_decibels_of_a_travler_are_those_of_its_own_beam():
    narrow, round_one = (
        plan_of(-4.0, replace(travler_mount(), beam=beam), orbit=SOUTHBOUND).forecast
        for beam in (beam_of(STOCK_FEED, TRAVLER.reflector), Beam(6.3, 6.3))
    )
    assert narrow.error_deg == pytest.approx(round_one.error_deg)
    ratio = float(narrow.loss_db.mean() / round_one.loss_db.mean())
    assert (6.3 / 2.885) ** 2 < ratio < (6.3 / 2.011) ** 2
    assert ratio == pytest.approx(7.0, abs=1.5), "seven times what one feed for all dishes said"


def test_an_error_counts_by_its_direction():
    beam = Beam(2.0, 3.0)
    off = Offsets(np.array([0.3, 0.0, 0.3]), np.array([0.0, 0.3, 0.4]))
    assert off.loss_db(beam) == pytest.approx([0.27, 0.12, 0.27 + 12 * (0.4 / 3.0) ** 2])
    assert off.size_deg == pytest.approx([0.3, 0.3, 0.5])


def test_offsets_are_on_the_sky_and_not_in_azimuth():
    across, up = offsets_deg(*(np.array([value]) for value in (100.0, 60.0, 101.0, 60.0)))
    assert across == pytest.approx(0.5, abs=0.001)
    assert up == pytest.approx(0.0, abs=0.01)
    ends = [np.array(each) for each in ([0.0, 350.0], [10.0, 85.0], [40.0, 170.0], [70.0, 88.0])]
    assert offsets_deg(*ends).size_deg == pytest.approx(separations_deg(*ends))


def test_the_beam_of_the_g2_is_theory_and_not_the_bound_in_counts():
    limits = reach_limits(Settings(), CARRYOUT_G2)
    assert limits.tolerance_deg == pytest.approx(5.53 / 2, abs=0.01)
    assert reach_limits(Settings(), TRAVLER).tolerance_deg == pytest.approx(2.01 / 2, abs=0.01)


def test_the_error_of_the_elements_costs_by_the_narrower_width():
    t_s = np.array([0.0, 1.0])
    beam = Beam(2.0, 3.0)
    dish = made(t_s, Offsets(np.array([0.0, 0.0]), np.array([0.3, 0.3])), beam)
    elements = overhead(2.0)[0].elements
    shifted = ElementError(
        elements, expected_error(elements, NOW, 1000.0), t_s, np.array([0.4, 0.4]), np.array([0.8, 0.8])
    )
    found = pointing_error(dish, shifted, beam)
    assert found.median.error_deg == pytest.approx([0.5, 0.5])
    assert found.median.loss_db == pytest.approx(2 * [12 * (0.3 / 3.0) ** 2 + 12 * (0.4 / 2.0) ** 2])
    assert pointing_error(made(t_s, Offsets(t_s, t_s), None), shifted, None).p90.loss_db is None
