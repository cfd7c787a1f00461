"""Calibrate finds a peak itself: the app, a real station with its tasks, and a dish that leans, on a virtual clock."""

from __future__ import annotations

import math

import pytest
from birdcage.calibration.peaks_file import load_peaks, peaks_file
from birdcage.station.state import Activity
from birdcage_tui.calibrate.aim import AimPane
from birdcage_tui.widgets.dialogs import QuestionScreen
from calibrate_tab import SIZES, pane_text, press, run
from test_calibrate_end_to_end import played


async def _on_it(house):
    """Go to the next best object, near enough to hear it."""
    await house.press("n", "enter")
    await house.rest()


async def _found(house):
    await house.press("f")
    await house.press("y")
    await house.rest(240.0)


def _kept(house):
    return load_peaks(peaks_file(house.paths)).entries


@played
async def test_a_peak_is_found_and_saved_and_nothing_is_nudged(house):
    await _on_it(house)
    assert "f finds the peak by the signal, and saves it." in _flat(house)
    target = house.guide.target
    await _found(house)
    (peak,) = _kept(house)
    assert (peak.target, peak.found, peak.number) == (target, "rssi", 1)
    assert 0.05 <= peak.sigma_deg < 0.3
    assert f"Peak 1 found and saved, ±{peak.sigma_deg:.2f}°." in _flat(house)
    assert math.hypot(*house.off()) < 0.3, "the dish ends in the middle of it"
    assert target not in [each.candidate.name for each in house.guide.proposals], "another one is proposed"


@played
async def test_the_question_says_what_will_move_and_a_no_changes_nothing(house):
    await _on_it(house)
    before = house.station.state.position
    await house.press("f")
    assert isinstance(house.app.screen, QuestionScreen)
    asked = str(house.app.screen.query_one("VerticalScroll Static").render())
    for words in ("25 directions", "to each side", "Keep its swing clear", "nothing is saved", "Space stops it"):
        assert words in asked
    await house.press("escape")
    await house.step(5.0)
    after = house.station.state.position
    assert (before.dish_az_deg, before.dish_el_deg) == (after.dish_az_deg, after.dish_el_deg)
    assert _kept(house) == ()
    assert house.station.state.tasks == ()


@played
async def test_stop_ends_it_and_nothing_is_saved(house):
    await _on_it(house)
    await house.press("f")
    await house.press("y")
    await house.step(12.0)
    assert "finding the peak: " in house.guide.busy
    await house.press("space")
    await house.step(8.0)
    assert house.station.state.held is not None
    assert house.guide.busy == ""
    assert "The peak was not found." in house.now.wrong
    assert _kept(house) == ()
    assert not house.app.motions.under_way


@played
async def test_a_step_by_hand_takes_over_and_nothing_is_saved(house):
    await _on_it(house)
    await house.press("f")
    await house.press("y")
    await house.step(12.0)
    await house.press("right")
    await house.rest()
    assert house.station.state.tasks == ()
    assert house.station.state.activity is Activity.IDLE
    assert _kept(house) == ()


@played
async def test_where_nothing_stands_out_nothing_is_saved_and_it_says_so(house):
    await _on_it(house)
    while house.app.motions.step_deg < 10.0:
        await house.press("plus")
    for _ in range(2):
        await house.press("up")
        await house.rest()
    await _found(house)
    assert "No source stands out of the floor" in house.now.wrong
    assert _kept(house) == ()


def _flat(house):
    """Return the words on the screen, without frames and line breaks."""
    return " ".join(house.text().replace("│", " ").split())


async def _ask(app, pilot, source):
    """Return the words of the aim, whether its button is there, what `f` said, and what was asked for after `y`."""
    pane = app.page.query_one(AimPane)
    words, offered = pane_text(pane), any(command == "calibrate-find" for _, command in pane.hot)
    await press(app, pilot, "f")
    note, asked = app.view().note, isinstance(app.screen, QuestionScreen)
    if asked:
        await press(app, pilot, "y")
    return words, offered, note, [one[:2] for one in source.asked]


@pytest.mark.parametrize("size", SIZES)
def test_a_peak_is_offered_on_an_object_and_asked_for_by_the_source_that_is_heard(size):
    words, offered, _, asked = run(_ask, "odd", size)
    assert "f finds the peak by the signal, and saves it." in words
    assert offered
    assert asked == [("find", "tuner")]


def test_without_a_tuner_it_asks_for_the_nudge_and_says_why():
    words, offered, note, asked = run(_ask, "odd", (120, 36), "travler")
    assert "has no tuner to read. Nudge to the highest signal, then press Enter." in words
    assert not offered
    assert note.endswith("Nudge to the highest signal by your own meter, or choose another source on F3.")
    assert asked == []


def test_without_an_object_there_is_no_peak_to_find():
    _, offered, note, asked = run(_ask, "first", (120, 36))
    assert (offered, note, asked) == (False, "No object yet. n: select the next best one.", [])
