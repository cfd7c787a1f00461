"""`w` on F3: an axis is swept, drawn as it comes, fitted, and laid over the sweeps before it."""

from __future__ import annotations

import asyncio
import math

import pytest
from birdcage.signal.beam_fit import BeamFit
from birdcage.station.task_state import TaskPhase, TaskState
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.shown.sweep_book import KEPT, SweepBook
from birdcage_tui.signal.ask_sweep import wrong_sweep
from birdcage_tui.signal.receiver import ReceiverPane
from birdcage_tui.signal.sweep import SweepPane
from test_demo import stage_of_the_pictures

FIT = BeamFit(0.5, 40.0, 0.04, 120.0, 400.0, 5.0, 9)


def task(number, azimuths, *, phase=TaskPhase.RUNNING, kind="sweep", why="", **found):
    line = tuple((az, 40.0, 400.0 + index, 2.0, 4) for index, az in enumerate(azimuths))
    told = {"axis": "az", "line": line, **found}
    return TaskState(number, kind, "you", phase, 0.0, why, done=len(line), of=9, found=told)


def book_of(*tasks):
    book = SweepBook()
    for each in tasks:
        book.take(each)
    return book.shown


def test_a_sweep_through_north_goes_on_beyond_it():
    (sweep,) = book_of(task(1, (358.0, 359.0, 0.0, 1.0), **FIT.values()))
    assert [each.deg for each in sweep.points] == [358.0, 359.0, 360.0, 361.0]
    assert sweep.fit.deg == pytest.approx(360.5)
    assert sweep.points[0].sigma == 1.0


def test_the_curve_is_the_beam_on_the_axis_and_not_on_the_sky():
    (sweep,) = book_of(task(1, (358.0, 0.0), **FIT.values()))
    half = 2.5 / math.cos(math.radians(40.0))
    assert sweep.fit.level(360.5) == 520.0
    assert sweep.fit.level(360.5 + half) == pytest.approx(460.0)


def test_decibels_rise_as_powers_do():
    (sweep,) = book_of(task(1, (358.0, 0.0), **{**FIT.values(), "rise": 10.0, "floor": -60.0, "unit": "dB"}))
    assert sweep.fit.level(360.5) == pytest.approx(-50.0)
    half = 2.5 / math.cos(math.radians(40.0))
    assert sweep.fit.level(360.5 + half) == pytest.approx(-60.0 + 10 * math.log10(1 + 9 / 2))


def test_the_newest_few_are_kept_each_once_and_nothing_but_sweeps():
    shown = book_of(*(task(number, (1.0,)) for number in (1, 2, 2, 3, 4, 5)), task(6, (1.0,), kind="peak"))
    assert [each.number for each in shown] == [2, 3, 4, 5]
    assert len(shown) == KEPT


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (("az", "20", "1"), ""),
        ((" EL ", "10°", "0.5"), ""),
        (("skew", "20", "1"), "Type az or el."),
        (("az", "much", "1"), "Type 20 and 1."),
        (("az", "nan", "1"), "out of range"),
        (("az", "400", "1"), "Type 0.1 to 360."),
        (("az", "20", "11"), "Type 0.05 to 10."),
        (("az", "360", "0.1"), "more than 1000 directions"),
    ],
)
def test_what_can_be_swept(values, words):
    said = wrong_sweep(values)
    assert words in said
    assert bool(said) == bool(words)


def swept(size, theme="dusk"):
    async def body():
        async with stage_of_the_pictures().demo(size, theme) as on:
            await on.wait(5)
            await on.press("f3", "g")
            await on.type("61.5W")
            await on.press("enter")
            await on.wait(15)
            await on.press("w")
            await on.wait(1)
            asked = on.text()
            await on.press("enter")
            await on.wait(4)
            running = on.text()
            await on.wait(40)
            page = on.app.query_one("#page-signal")
            regions = [page.query_one(kind).region for kind in (SweepPane, SignalPane, ReceiverPane)]
            over, screen = on.text(), on.app.screen.region
            await on.press("v")
            await on.wait(1)
            return asked, running, over, regions, screen, on.text()

    return asyncio.run(body())


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_an_axis_is_swept_as_it_comes_and_the_beam_is_drawn(size):
    asked, running, over, (sweep, strip, _receiver), screen, back = swept(size)
    assert "Keep its swing clear." in asked
    assert " of 21 directions, " in running
    assert "azimuth 132." in over
    for words in ("width", "rise", "floor", "122.8°", "142.8°", "132.8°"):
        assert words in over, words
    assert screen.contains_region(sweep)
    assert sweep.height >= (9 if size == (80, 24) else 10)
    assert strip.area == 0
    assert "last 60 s" in back
