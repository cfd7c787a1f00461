"""A made-up pass is as it was asked for, at any place."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.base.errors import OutOfRange
from birdcage.sky.made_up_pass import PassWish, durations_s, made_up_pass
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet

NOW = datetime(2026, 11, 28, 2, 0, tzinfo=UTC)


@pytest.mark.parametrize("latitude_deg", [0.0, 0.3, -2.0, 7.0, 40.0, -33.9, 78.2, -89.9])
@pytest.mark.parametrize(("max_el_deg", "minutes"), [(60, 10), (10, 8), (85, 9), (90, 12), (5, 7), (60, 22)])
def test_it_is_as_it_was_asked_for(latitude_deg, max_el_deg, minutes):
    place = Observer(latitude_deg, 151.2, 100.0)
    elements = made_up_pass(PassWish(max_el_deg, minutes * 60.0, 90.0), NOW, place)
    found = min(search(Fleet([elements]), place, NOW, 1.5), key=lambda each: each.aos)
    assert (found.aos - NOW).total_seconds() == pytest.approx(90.0, abs=0.1)
    assert found.duration_s == pytest.approx(minutes * 60.0, abs=0.1)
    assert found.max_elevation_deg == pytest.approx(max_el_deg, abs=0.02)
    assert elements.name.startswith("DEMO "), "it is no satellite that exists"


@pytest.mark.parametrize("max_el_deg", [5.0, 45.0, 90.0])
def test_shorter_and_longer_than_any_orbit_is_refused_with_what_can_be_asked_for(max_el_deg):
    shortest, longest = durations_s(max_el_deg)
    for duration_s in (shortest - 6.0, longest + 6.0):
        with pytest.raises(OutOfRange, match=r"Give \d+\.\d to \d+\.\d min\."):
            made_up_pass(PassWish(max_el_deg, duration_s), NOW, Observer(40.0, 0.0, 0.0))
    for duration_s in (shortest + 6.0, longest - 6.0):
        made_up_pass(PassWish(max_el_deg, duration_s), NOW, Observer(40.0, 0.0, 0.0))


@pytest.mark.parametrize("max_el_deg", [4.0, 91.0, float("nan")])
def test_no_pass_culminates_there(max_el_deg):
    with pytest.raises(OutOfRange, match="Give 5 to 90"):
        made_up_pass(PassWish(max_el_deg), NOW, Observer(40.0, 0.0, 0.0))
