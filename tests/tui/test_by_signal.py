"""`f` on F3: what the dish does by the signal alone, chosen from a list, told while it goes on, and its result."""

from __future__ import annotations

import math
import re

import pytest
from birdcage.signal.drift_task import DriftTask
from birdcage.station.requests import BeginTask
from birdcage.station.task_state import TaskPhase, TaskState
from birdcage_tui.shown.event_words import finding_words
from birdcage_tui.shown.sweep_book import SweepBook
from birdcage_tui.signal.find import wrong_on_off, wrong_step_track
from birdcage_tui.signal.sweep import SweepPane
from birdcage_tui.widgets.choice_screen import ChoiceScreen
from test_signal_source import on_f3

WAYS = ("Find the peak", "Step-track …", "On-off …", "Drift scan …", "Acquire a satellite …")


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_every_way_is_offered_with_what_it_does(size):
    async def look(on):
        await on.press("f")
        await on.wait(1)
        assert isinstance(on.app.screen, ChoiceScreen)
        assert on.app.screen.region.contains_region(on.app.screen.query_one("Vertical").region)
        return on.text()

    text = on_f3(look, size)
    for words in (*WAYS, "25 directions, up to ", "The dish moves by itself. Keep its swing clear."):
        assert words in text, words


def test_on_off_compares_what_is_here_with_the_sky_and_tells_the_difference():
    async def look(on):
        asked, ask = [], on.app.ask
        on.app.ask = lambda request: (asked.append(request), ask(request))[1]
        await on.press("f", "down", "down", "enter")
        await on.wait(1)
        question = on.text()
        await on.press("tab", "tab", *["backspace"] * 3, "2", "enter")
        await on.wait(2)
        assert not isinstance(on.app.screen, ChoiceScreen)
        during = on.text()
        await on.wait(40)
        return question, during, on.text(), [each for each in asked if isinstance(each, BeginTask)]

    question, during, after, (request,) = on_f3(look, (120, 36))
    assert "Keep its swing clear." in question
    assert (request.kind, request.values["axis"], request.values["cycles"]) == ("on-off", "el", 2)
    assert "On-off: " in during
    assert " of 8 heard" in during
    assert "counts on the source against the sky 17.0° beside it" in after


def test_step_track_goes_on_and_says_how_many_peaks_there_were():
    async def look(on):
        await on.press("f", "down", "enter")
        await on.wait(1)
        await on.press("T", "enter")
        await on.wait(60)
        during = on.text()
        await on.press("space")
        await on.wait(2)
        return during, on.text()

    during, stopped = on_f3(look, (120, 36))
    assert re.search(r"Step-track: \d peaks? so far", during), during
    assert "HELD" in stopped


def test_the_satellite_to_acquire_is_found_in_the_setup():
    async def look(on):
        await on.press("f", "up", "enter")
        await on.wait(3)
        return on.text()

    assert "First satellite" in on_f3(look, (120, 36))


@pytest.mark.parametrize(("values", "words"), [
    (("17", "el", "3"), ""), (("17", "up", "3"), "Type az or el."), (("0", "az", "3"), "Type 0.1 to 90 degrees."),
    (("17", "az", "1"), "Cycles is '1'. Type 2 to 200."), (("", "az", "3"), "Beside it is 'empty'."),
    (("nan", "az", "3"), "Type 0.1 to 90 degrees."),
])  # fmt: skip
def test_what_can_be_compared(values, words):
    said = wrong_on_off(values)
    assert words in said
    assert bool(said) == bool(words)


@pytest.mark.parametrize(("values", "words"), [
    (("", "15", "24"), ""), (("x", "0", "24"), "Type 0.5 to 1440 minutes."),
    (("x", "15", "0"), "Type 0.01 to 240 hours."),
])  # fmt: skip
def test_what_can_be_tracked(values, words):
    said = wrong_step_track(values)
    assert words in said
    assert bool(said) == bool(words)


def drifted(**found):
    line = tuple((index / 10.0 - 3.0, 0.0, 400.0 + 50.0 * math.exp(-((index - 30) ** 2) / 50.0), 1.0, 4.0)
                 for index in range(60))  # fmt: skip
    told = {"axis": "path", "line": line, **found}
    return TaskState(1, DriftTask.kind, "you", TaskPhase.OVER, 0.0, "Heard best.", done=60, of=60, found=told)


def test_a_drift_scan_is_drawn_along_the_path():
    book = SweepBook()
    book.take(drifted(along_deg=0.12, sigma_deg=0.03, rise=50.0, floor=400.0, width_deg=1.6, unit="counts"))
    (sweep,) = book.shown
    assert [round(each.deg, 6) for each in sweep.points[:2]] == [-3.0, -2.9]
    assert (sweep.fit.deg, sweep.fit.stretch) == (0.12, 1.0)

    async def look(on):
        on.app.signals.sweeps.take(drifted(along_deg=0.12, sigma_deg=0.03, rise=50.0, floor=400.0, width_deg=1.6,
                                           unit="counts"))  # fmt: skip
        await on.press("v")
        await on.wait(1)
        assert on.app.screen.query_one(SweepPane).display
        return on.text()

    text = on_f3(look, (120, 36))
    assert "along the path +0.12° ±0.03°" in text
    assert "-3.0°" in text


def test_each_says_how_far_it_is():
    def words(kind, **more):
        return finding_words(TaskState(1, kind, "you", TaskPhase.RUNNING, 0.0, "", **more))

    assert words("peak", done=3, of=25) == "Finding the peak: 3 of 25 heard"
    assert words("step-track") == "Step-track: 0 peaks so far"
    assert words("drift", done=3, of=120) == "Drift scan: 3 of 120 heard"
