"""F3 while the dish follows: against the best since then, no way to a peak, and back to both afterwards."""

from __future__ import annotations

from dataclasses import replace

import pytest
import stand_in
import track_stage
from birdcage.signal.source import SignalReading
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.pursuit_state import Phase

RISES = [401.0, 402.0, 401.0, 402.0, 421.0, 422.0, 441.0, 442.0, 421.0, 422.0]
"""A second and a half each."""


def passed(app, values=RISES, number=None):
    """Have the app hear these of the pursuit under way, after a far stronger signal of before."""
    book, clock = app.signals.book, app.session.clock
    book.choose(TUNER_FACTS)
    state = app.station.state
    before = replace(state, pursuit=None)
    for value in (900.0, 100.0):
        _hear(app, value, before)
    if number is not None:
        state = app.station.state = replace(state, pursuit=replace(state.pursuit, number=number))
    for value in values:
        _hear(app, value, state)
        clock.advance(1.5)
    _hear(app, values[-1], state)


def _hear(app, value, state):
    clock = app.session.clock
    for _ in range(3):
        clock.advance(0.01)
        told = SignalReading(value, "counts", clock.monotonic(), clock.utc(), "tuner")
        app.signals.book.hear(told, TUNER_FACTS, state)


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_the_percentage_is_of_the_best_since_it_follows(size):
    async def look(app, pilot, _desk):
        passed(app)
        app.paint()
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app), app.view()

    text, view = track_stage.run(look, size=size, keys=("f3",))
    assert view.state.pursuit.phase is Phase.FOLLOWING
    assert view.level.share == pytest.approx(0.5, abs=0.05), "half-way between 401 and 442"
    for words in ("% of the best so far", "lowest 40", "While following", "best so far", "pointing error",
                  f"Following {view.state.pursuit.plan.aim.name}"):  # fmt: skip
        assert words in text, words
    assert "To the peak" not in text
    assert "azimuth" not in text.split("While following")[1].split("Signal")[0]


def test_another_pursuit_begins_anew_and_afterwards_all_counts_again():
    async def look(app, pilot, _desk):
        passed(app)
        state = app.station.state
        best = app.view().level.peak.value
        app.station.state = replace(state, pursuit=replace(state.pursuit, number=state.pursuit.number + 1))
        other = app.view().level
        app.station.state = replace(state, pursuit=None)
        return best, other, app.view().level.peak.value

    best, other, after = track_stage.run(look, size=(120, 36), keys=("f3",))
    assert best == pytest.approx(441.7, abs=0.5)
    assert other is None
    assert after > best, "all that was heard counts again"


def test_x_begins_anew_with_it():
    async def look(app, pilot, _desk):
        passed(app)
        await pilot.press("x")
        return app.view().level

    assert track_stage.run(look, size=(120, 36), keys=("f3",)) is None
