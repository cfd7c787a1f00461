"""Passes and autotrack on the Craft tab, and the words above the curves: whole sentences, and what is really done."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import stand_in
from birdcage.pursuit.now import Scheduled, Unfinished
from birdcage.sky.reach_model import LossReason, Lost, PassReach, Stretch
from birdcage.tracking.curve import Curve
from birdcage.tracking.day import Day
from birdcage_tui.shown.track_words import reach_words
from track_plans import NOON, moon, utc
from track_stage import SIZES, read, run


def test_what_to_do_about_a_held_dish_is_not_cut_by_the_curves():
    rows = [row.rpartition("││")[2].strip("│ ") for row in run(read, "craft-held").splitlines()]
    assert "In reach for 02:35: Enter releases the dish, then f and Enter follow it." in " ".join(rows)


@pytest.mark.parametrize("size", [(100, 30), (120, 36)], ids=str)
def test_why_a_pass_is_not_whole_is_told_whole_or_not_at_all(size):
    rows = run(read, "craft-over", size=size).splitlines()
    [heads] = [at for at, row in enumerate(rows) if "AOS      from" in row]
    ends = [row.partition("││")[0].strip("│ ").split()[-1] for row in rows[heads + 1 : heads + 5]]
    assert {each for each in ends if each.isalpha()} <= {"ceiling", "now"}


def rows_with(*whys):
    at = enumerate((NOON + 600.0 * number for number in range(len(whys))), 1)
    return tuple(
        Scheduled(
            f"DEMO LEO {number} station",
            900 + number,
            utc(start_s),
            utc(start_s + 240.0),
            240.0,
            62.0,
            62.0,
            0,
            False,
            why,
        )
        for (number, start_s), why in zip(at, whys, strict=True)
    )


async def with_schedule(app, pilot, desk, rows=None, **changes):
    desk.show(replace(desk.now, **({} if rows is None else {"schedule": rows}), **changes))
    await pilot.pause()
    app.paint()
    await pilot.pause()
    return stand_in.text_of(app)


@pytest.mark.parametrize("size", [(100, 30), *SIZES[1:3]], ids=str)
def test_autotrack_tells_whole_why_it_leaves_a_pass_out(size):
    rows = rows_with("overlaps DEMO LEO 1 polar (priority 0)", "joined after DEMO LEO 5 weather (priority 0)")

    async def shown(app, pilot, desk):
        return await with_schedule(app, pilot, desk, rows)

    text = run(shown, size=size, keys=("f2", "c", "v", "v"))
    assert "overlaps LEO 1 polar" in text
    assert "after LEO 5 weather" in text
    assert "priority 0" not in text


@pytest.mark.parametrize("size", SIZES[1:3], ids=str)
def test_autotrack_keeps_no_pass_while_a_person_follows_something_else(size):
    async def shown(app, pilot, desk):
        return await with_schedule(app, pilot, desk, autotrack=True)

    text = run(shown, "craft-moon", size=size)
    assert "● autotrack on" in text
    assert "goes on at 13:00" in text
    assert "○ 11:58:00" in text
    assert "following Moon" in text
    assert "● 11:58:00" in run(shown, "craft-following", size=size)


def test_hours_that_are_left_of_what_can_be_resumed_are_no_count_of_minutes():
    async def left(app, pilot, desk):
        return await with_schedule(
            app, pilot, desk, unfinished=Unfinished("Moon", "moon", utc(NOON), utc(NOON + 34669))
        )

    text = run(left, "craft-over", size=(120, 36))
    assert "U resume Moon (9h37 left)" in text.splitlines()[1]


@pytest.mark.parametrize("size", SIZES[1:3], ids=str)
def test_autotrack_tells_reach_and_maximum_of_a_pass_as_the_page_of_passes_does(size):
    (row,) = rows_with("")

    async def shown(app, pilot, desk):
        return await with_schedule(app, pilot, desk, (replace(row, reach_s=180.0, max_elevation_deg=80.0),))

    assert "12:00:00  3m00  LEO 1 station max 80°" in run(shown, size=size)


def moon_day():
    """In reach at noon, and again from three hours before the end of the day on."""
    times = np.linspace(NOON, NOON + 86400.0, 145)
    sky = Curve(times, times * 0.0 + 180.0, 10.0 + 40.0 * np.cos((times - NOON) / 86400.0 * 2.0 * np.pi))
    spans = (Stretch(utc(NOON), utc(NOON + 11000.0), 0), Stretch(utc(NOON + 75600.0), utc(NOON + 86400.0), 0))
    return replace(
        moon(),
        day=Day(sky, PassReach(spans, (Lost(utc(NOON + 11000.0), utc(NOON + 75600.0), LossReason.FLOOR),), 50.0)),
    )


@pytest.mark.parametrize("size", SIZES[1:3], ids=str)
def test_reach_of_a_body_is_told_once_and_in_order_of_time(size):
    async def shown(app, pilot, desk):
        return await with_schedule(app, pilot, desk, plan=moon_day())

    text = run(shown, "craft-slot", size=size)
    assert text.count("in reach until 15:03, again tomorrow 09:00") == 1
    assert "Moon needs no pass to be followed" in text
    assert reach_words(moon_day(), 80, NOON + 12000.0) == "in reach tomorrow from 09:00"
