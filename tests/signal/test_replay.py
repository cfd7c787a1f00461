"""A recording is read again piece by piece: the outline, and what lies around a moment."""

from __future__ import annotations

from datetime import timedelta

import pytest
from birdcage.base.errors import StoreError
from birdcage.signal import replay as module
from birdcage.signal.replay import open_tape, read_window

from tests.signal.test_recording import NOON, recorded, row


def at(seconds):
    return NOON + timedelta(seconds=seconds)


@pytest.fixture
def path(tmp_path):
    """Two recordings in one file; the second has a gap, and one value above all others."""
    path = tmp_path / "signal.sqlite"
    recorded(path, [row(index) for index in range(5)])
    rows = [row(second, value=400.0 + second % 7, az_deg=second / 10.0) for second in range(1000)]
    rows[620] = row(620, value=900.0, az_deg=123.0)
    recorded(path, rows[:300] + rows[500:])
    return path


def test_the_outline_has_every_extreme_and_says_where_it_was(path):
    tape = open_tape(path, 2)
    assert (tape.begins, tape.ends, tape.recording.readings) == (at(0), at(999), 800)
    assert len(tape.pieces) <= module.PIECES + 1
    best = max(tape.pieces, key=lambda piece: piece.high)
    assert (best.high, best.high_at, best.high_az_deg) == (900.0, at(620), 123.0)
    assert min(piece.low for piece in tape.pieces) == 400.0
    assert [piece.begins for piece in tape.pieces] == sorted(piece.begins for piece in tape.pieces)
    assert not any(at(300) <= piece.begins < at(500) for piece in tape.pieces), "a gap is a gap"


@pytest.mark.parametrize(("begins", "ends"), [(0, 60), (290, 510), (615, 625), (990, 2000), (-50, -1), (310, 400)])
def test_a_window_has_all_between_two_moments_and_nothing_else(path, begins, ends):
    window = read_window(path, open_tape(path, 2), at(begins), at(ends))
    seconds = [second for second in (*range(300), *range(500, 1000)) if begins <= second <= ends]
    assert [each.utc for each in window.readings] == [at(second) for second in seconds]
    assert (window.begins, window.ends) == (at(begins), at(ends))


def test_a_window_is_bounded_and_says_where_it_ends(path, monkeypatch):
    monkeypatch.setattr(module, "MOST_READ", 50)
    window = read_window(path, open_tape(path, 2), at(0), at(200))
    assert (len(window.readings), window.ends) == (50, at(49))


def test_one_that_is_gone_or_empty_is_said(path, tmp_path):
    with pytest.raises(StoreError, match="Recording 7 holds no readings"):
        open_tape(path, 7)
    with pytest.raises(StoreError, match="Recording 1 holds no readings"):
        open_tape(tmp_path / "none.sqlite", 1)


def test_one_reading_alone_is_a_tape(tmp_path):
    path = tmp_path / "signal.sqlite"
    recorded(path, [row(3)])
    tape = open_tape(path, 1)
    assert (len(tape.pieces), tape.begins) == (1, tape.ends)
    assert len(read_window(path, tape, tape.begins, tape.ends).readings) == 1
