"""What turns an axis round that went the other way: told where the facts of the machine name it, and else nothing."""

from __future__ import annotations

import pytest
from birdcage.easycomm.facts import STOCK_FACTS
from birdcage.easycomm.kinds import OTHER

ROTATOR = "easycomm?kind=rp2040&seed=1"


def answered(house, axis):
    """Answer that an axis went the other way; return what is told then."""
    house.setup.clear()
    for choice in ("start", "no") if axis == "az" else ("start", "yes", "no"):
        house.choose("direction", choice)
    view = house.view("direction")
    assert view.mark.value == "failed"
    return view.evidence


@pytest.mark.parametrize(
    ("axis", "flag", "other"), [("az", "kAzInvert", "kElInvert"), ("el", "kElInvert", "kAzInvert")]
)
def test_a_rotator_that_names_it_has_it_told_with_the_danger_of_half_of_it(build, axis, flag, other):
    house = build(ROTATOR)
    house.until(lambda: house.state.surveyed)
    house.choose("home", "sync", az_deg="10", el_deg="")
    told = answered(house, axis)
    assert "Do not point with it until that is fixed. In its firmware's config.h" in told
    assert flag in told
    assert other not in told
    assert "If only one of the two is reversed, the axis runs away" in told


def test_a_machine_that_names_none_shows_none(house):
    assert answered(house, "az").endswith("Do not point with it until that is fixed.")
    assert not STOCK_FACTS.handling.reversed_remedies
    assert not OTHER.facts.handling.reversed_remedies
