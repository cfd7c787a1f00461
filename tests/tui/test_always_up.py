"""Targets that are always up: no durations, no countdowns; what a person who points at a slot wants to see."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
import sky_stand_in
from birdcage_tui.shown.pass_words import reach_text
from test_passes_page import on_page, pressed
from track_plans import NOON
from track_stage import SIZES, read, run

DURATION = re.compile(r"\b1h00\b|\b60 min\b|\bin reach \d|In reach for|\bend in\b|No passes soon")


@pytest.mark.parametrize("size", SIZES[:3], ids=str)
@pytest.mark.parametrize(
    ("scene", "words"),
    [
        ("craft-geo", "always up"), ("craft-geo-chosen", "Always up: f and Enter follow it now."),
        ("craft-geo-held", "Always up: Enter releases"),
        ("craft-geo-low", "lways up, out of reach: below the 18° floor"),
    ],
)  # fmt: skip
def test_what_is_always_up_has_no_duration_on_track(scene, words, size):
    text = run(read, scene, size=size)
    assert words in text
    assert DURATION.findall(text) == []


def test_signal_and_error_of_the_last_minutes_stand_where_az_and_el_would_be_flat():
    text = run(read, "craft-geo", size=(120, 36))
    assert "Signal and error" in text
    assert "Azimuth, elevation, error" not in text
    assert re.search(r"sig\s.*\s\d{3} cts", text)
    assert re.search(r"err\s.*0\.\d\d°", text)
    assert "-20 min" in text
    assert "stands still in the sky" in text


def test_what_was_heard_elsewhere_is_not_told_as_the_target_s():
    text = run(read, "craft-geo-chosen", size=(120, 36))
    assert "f and Enter follow it and read the tuner." in text
    assert " cts" not in text


def test_drift_within_a_day_is_drawn_where_there_is_any():
    text = run(read, "craft-geo-chosen", size=(120, 36))
    assert "drifts 0.80° az, 4.00° el a day" in text
    assert re.search(r"EL\s.*4\.00°", text)
    assert "+24 h" in text
    assert "drift over 24 h" in text


def test_no_error_is_drawn_of_the_time_before_the_dish_followed():
    text = run(read, "craft-geo-chosen", size=(120, 36))
    (row,) = [row.partition("err ")[2] for row in text.splitlines() if "err  " in row]
    assert "expected ±0.0" in row
    assert re.findall(r"[\u2801-\u28ff]", row) == []


def geo_row(**changes):
    path = sky_stand_in.path_of(NOON, 86400.0, 190, 190, 40)
    times = path.t_s
    path = replace(
        path, az_deg=tuple(190.0 for _ in times), el_deg=tuple(40.0 + 0.03 * (n % 2) for n in range(len(times)))
    )
    times_s = (NOON, NOON + 3600.0, NOON + 86400.0)
    reach = sky_stand_in.in_reach((NOON, times_s[2]), best=40.0)
    row = sky_stand_in.shown_pass(
        "GEO 95W", 9, times_s, (190.0, 190.0, 190.0), 40.0, reach=reach, path=path, already_up=True, still_up=True
    )
    return sky_stand_in.changed(row, favourite=True, **changes)


@pytest.mark.parametrize("size", SIZES[:3], ids=str)
def test_f7_lists_and_draws_it_without_a_duration(size):
    async def find(app, pilot):
        return await pressed(app, pilot, "slash", *"geo", "enter")

    text = on_page(find, size=size, sky=sky_stand_in.make(rows=(*sky_stand_in.rows(), geo_row())))
    (row,) = [line for line in text.splitlines() if "▶" in line and "GEO 95W" in line]
    assert "always up" in row
    assert re.search(r"\balways\b.*40°", row.partition("GEO")[2])
    for wrong in ("24h00", "1d", "stays up", "up to later"):
        assert wrong not in text
    assert "always in reach" in text


def test_a_pass_that_lasts_beyond_the_search_is_longer_than_what_was_searched():
    row = geo_row(already_up=False)
    assert reach_text(row) == ">24h"
    assert reach_text(geo_row(reach=sky_stand_in.in_reach(lost=((NOON, NOON + 86400.0, "floor"),)))) == "none"
