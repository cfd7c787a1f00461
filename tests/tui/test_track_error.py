"""The Craft tab promises one error, of dish and elements together, at 80x24 and at 120x36."""

from __future__ import annotations

import re

import pytest
from track_stage import SIZES, read, run

NARROW, WIDE = SIZES[:2]


@pytest.mark.parametrize("size", [NARROW, WIDE], ids=str)
def test_with_elements_of_3228_days_the_headline_and_the_head_say_unknown_and_no_decibels_are_told(size):
    text = run(read, "craft-old", size=size)
    assert "FOLLOWING METEOR-M2 4  error unknown" in text
    assert "✗ 3228 d old, error unknown" in text or "✗ useless elements, 3228 d old, figures end at 7 d" in text
    assert "--.-- dB  pass unknown" in text
    assert not re.search(r"\d ?dB", text)
    assert re.search(r"FOLLOW (err )?\?", text.splitlines()[0])


@pytest.mark.parametrize("size", [NARROW, WIDE], ids=str)
def test_with_elements_of_two_days_the_number_is_that_of_the_elements(size):
    text = run(read, "craft-days", size=size)
    live, over = (
        float(re.search(pattern, text)[1])
        for pattern in (r"FOLLOWING ISS \(ZARYA\)  error ±([\d.]+)°", r"pass ±([\d.]+)° \(90 %")
    )
    assert live > 0.05
    assert over > 0.1
    assert "○" in text
    assert "2 d old" in text
    assert "dish alone RMS 0.0" in text or size == NARROW


def test_the_remedy_is_named_where_the_elements_are_what_matters():
    for name in ("craft-old", "craft-old-chosen", "craft-days"):
        assert "`birdcage elements update` gets newer ones" in run(read, name, size=WIDE)
    assert "birdcage elements" in " ".join(run(read, "craft-old-chosen", size=NARROW).split())
    assert "elements update" not in run(read, "craft-following", size=WIDE)


@pytest.mark.parametrize("size", [NARROW, WIDE], ids=str)
def test_what_follows_no_elements_says_nothing_of_them(size):
    text = run(read, "craft-moon", size=size)
    assert re.search(r"FOLLOWING Moon  error 0\.\d\d°", text)
    assert "elements" not in text
    assert "expected error ±0.02°" in text
