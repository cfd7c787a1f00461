"""Two known levels on F3: asked for, kept, told beside the counts, marked beyond, and taken back."""

from __future__ import annotations

import re

import pytest
import stage
import stand_in
from birdcage.signal.level_scale import KnownLevel, checked_scale, keep_scale, load_scales
from birdcage.signal.source import Scale, SignalFacts
from birdcage.signal.tuner import TUNER_FACTS
from test_signal_strip import hear

SDR = SignalFacts("sdr", "sdr", "dB", Scale.LOG, 1.0, 2.0, None, None, 1, 10.0, None, of_dish=False, demo=False)


KEPT = (KnownLevel(401.0, 0.0), KnownLevel(451.0, 12.5))
FEED = "Ku LNB"
"""Of the stand-in."""


def played(tmp_path, *keys, kept=None, counts=431.0, size=(120, 36), before=None):
    """Return all text after these keys, and what is in the file then."""
    path = tmp_path / "levels.toml"
    if kept is not None:
        keep_scale(path, checked_scale("tuner", FEED, *kept))

    async def look(app, pilot):
        app.signals.book.choose(before or TUNER_FACTS)
        hear(app, [counts] * 4)
        for key in keys:
            await pilot.press(key)
        await pilot.pause()
        hear(app, [counts] * 4)
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    return stage.run(look, "idle", size, key="f3", levels_file=path), load_scales(path).entries


def test_they_are_typed_and_told_beside_the_counts(tmp_path):
    typed = ("D", *"401", "tab", "0", "tab", *"451", "tab", *"12", "enter")
    text, found = played(tmp_path, *typed)
    assert [(each.low, each.high) for each in found] == [(KnownLevel(401.0, 0.0), KnownLevel(451.0, 12.0))]
    assert "A straight line between them is assumed." in text
    assert len(re.findall(r"7\.2 dB(?!\?)", text)) >= 2, "beside the level, and in the strip"


@pytest.mark.parametrize(
    ("counts", "said"), [(431.0, r"7\.5 dB(?!\?)"), (455.0, r"13\.5 dB\?"), (391.0, r"-2\.5 dB\?")]
)
def test_what_was_kept_is_used_from_the_start_and_marked_beyond(tmp_path, counts, said):
    text, _found = played(tmp_path, kept=KEPT, counts=counts)
    assert len(re.findall(said, text)) == 2
    assert not re.search(said, played(tmp_path / "none", counts=counts)[0])


def test_a_marker_is_compared_in_decibels(tmp_path):
    async def look(app, pilot):
        app.signals.book.choose(TUNER_FACTS)
        hear(app, [431.0] * 8)
        await pilot.press("enter")
        app.session.clock.advance(2.0)
        hear(app, [435.0] * 8)
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    keep_scale(tmp_path / "levels.toml", checked_scale("tuner", FEED, *KEPT))
    text = stage.run(look, "idle", (120, 36), key="f3", levels_file=tmp_path / "levels.toml")
    assert re.search(r"1 \d\d:\d\d:\d\dZ +431 \+1\.0 dB ", text)


def test_wrong_ones_stay_in_the_dialog_and_all_empty_removes_them(tmp_path):
    text, found = played(tmp_path, "D", *"401", "tab", "0", "tab", *"401", "tab", "3", "enter")
    assert "Both levels are 401." in text
    assert found == ()
    emptied = ("ctrl+u", "tab", "ctrl+u", "tab", "ctrl+u", "tab", "ctrl+u")
    text, found = played(tmp_path, "D", "end", *emptied, "enter", kept=KEPT)
    assert "Known levels removed." in text
    assert found == ()


def test_who_tells_decibels_is_not_asked(tmp_path):
    text, _found = played(tmp_path, "D", before=SDR)
    assert "The sdr tells decibels already." in text
