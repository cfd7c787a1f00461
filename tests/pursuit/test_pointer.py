"""Where what is typed stands, with what belongs to it."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.pursuit.finder import Finder
from birdcage.pursuit.pointer import Pointer
from birdcage.sky.observer import Observer

NOW = datetime(2026, 11, 21, 12, tzinfo=UTC)
KASSEL = Observer(51.3, 9.5)


@pytest.fixture
def pointer(tmp_path):
    return Pointer(Finder(tmp_path / "catalogue.sqlite"))


@pytest.mark.parametrize(
    ("typed", "skew"),
    [
        ("28.2E", "Skew -14.5° geometry +7.0° slot = -7.5°"),
        ("13E", "Skew -2.8° geometry, slot's own unknown"),
        ("61.5W", ""),
        ("sun", ""),
        ("az 180 el 45", ""),
    ],
)
def test_a_linear_slot_comes_with_its_skew(pointer, typed, skew):
    pointer.ask(typed)
    assert pointer.look(KASSEL, NOW, "radio").skew == skew


def test_refraction_is_added_to_what_is_in_the_sky_and_not_to_a_direction(pointer):
    for typed, lifted in (("28.2E", True), ("az 180 el 10", False)):
        pointer.ask(typed)
        with_it, without = (pointer.look(KASSEL, NOW, kind).el_deg for kind in ("radio", "none"))
        assert (with_it > without) is lifted
