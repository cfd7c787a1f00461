"""Targets that are always up: no durations, no countdowns; what a person who points at a slot wants to see."""

from __future__ import annotations

import re

import pytest
from track_stage import SIZES, read, run

DURATION = re.compile(r"\b1h00\b|\b60 min\b|\bin reach \d|In reach for|\bend in\b|No passes soon")


@pytest.mark.parametrize("size", SIZES[:3], ids=str)
@pytest.mark.parametrize(
    ("scene", "words"),
    [
        ("craft-geo", "always up"), ("craft-geo-chosen", "Always up: f follows it now."),
        ("craft-geo-held", "Always up: Enter releases"),
        ("craft-geo-low", "lways up, out of reach: below the 18° floor"),
    ],
)  # fmt: skip
def test_what_is_always_up_has_no_duration_on_track(scene, words, size):
    text = run(read, scene, size=size)
    assert words in text
    assert DURATION.findall(text) == []
