"""How far a feed is turned for a slot: the geometry, the slot's own tilt, and both."""

from __future__ import annotations

import pytest
from birdcage.sky.observer import Observer
from birdcage.sky.skew import Skew, skew_of
from birdcage.sky.slots import slots

PRESET = {
    "Germany": (51.0, 10.5, {19.2: 0, 28.2: -7}),
    "Great Britain": (53.0, -2.0, {19.2: -8, 28.2: -13}),
    "Portugal": (39.5, -8.5, {19.2: -22, 28.2: -28}),
    "Poland": (52.0, 19.5, {19.2: 7, 28.2: 0}),
}
"""Kathrein, leaflet of the UAS 572, presettings of the polarisation by country, in degrees."""


@pytest.mark.parametrize("country", PRESET)
def test_with_the_slots_own_tilt_it_is_the_published_presetting(country):
    lat, lon, table = PRESET[country]
    for slot in slots():
        if slot.longitude_deg in table:
            skew = skew_of(slot, Observer(lat, lon))
            assert skew.feed_deg == pytest.approx(table[slot.longitude_deg], abs=1.5)
            assert abs(skew.geometry_deg - table[slot.longitude_deg]) > 6.0, "without it the table is missed"


def test_a_tilt_that_no_source_tells_leaves_the_sum_unknown():
    skew = Skew(-12.0, None)
    assert skew.values() == {"skew_deg": -12.0, "slot_tilt_deg": None, "feed_skew_deg": None}
    assert skew.words() == (
        "12.0° counterclockwise by geometry (from behind the dish, linear)", "the slot's own is not known"
    )  # fmt: skip


def test_the_sum_stays_within_a_quarter_of_a_turn():
    assert Skew(86.0, 7.0).feed_deg == pytest.approx(-87.0)
