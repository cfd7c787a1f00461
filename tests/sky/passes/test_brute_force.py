"""The search finds what SGP4 every ten seconds finds: no pass missed, none invented."""

from __future__ import annotations

import pytest
from birdcage.sky.observer import Observer
from night import by_night

PLACES = [
    Observer(0.5, 32.0, 1200.0),
    Observer(47.0, 8.0, 500.0),
    Observer(78.2, 15.6, 20.0),
    Observer(-33.9, 18.4, 40.0),
    Observer(64.1, -21.9, 0.0),
]
MASKS = [0.0, 5.0, 18.0, 30.0]


@pytest.mark.parametrize("seed", range(5))
def test_agrees_with_brute_force(agree, orbits, start, seed: int) -> None:
    assert agree(orbits(24, seed), PLACES[seed], start, 24.0, MASKS[seed % 4]) > 20


@pytest.mark.parametrize("mask_deg", [-25.0, -3.0, 60.0, 75.0])
def test_a_high_or_a_low_mask_agrees(agree, orbits, start, mask_deg: float) -> None:
    assert agree(orbits(40, 11), PLACES[1], start, 24.0, mask_deg) > 8


@pytest.mark.parametrize("hours", [0.05, 1.0, 100.0])
def test_any_span_agrees(agree, orbits, start, hours: float) -> None:
    assert agree(orbits(8, 12), PLACES[1], start, hours, 0.0) > 0


def test_satellites_that_come_later_or_earlier_agree(agree, orbits, start) -> None:
    agree(orbits(12, 13), PLACES[3], start, 24.0, 5.0, {0: 12.5, 3: -40.0, 7: 0.0, 8: 12.5})


@pytest.mark.soak
@pytest.mark.parametrize("seed", by_night(range(20, 30), 1))
@pytest.mark.parametrize("place", PLACES, ids=str)
def test_many_agree_with_brute_force(agree, orbits, start, seed: int, place: Observer) -> None:
    assert agree(orbits(60, seed), place, start, 24.0, MASKS[seed % 4], grid_s=5.0) > 50
