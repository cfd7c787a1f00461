"""Fifty thousand keys over every page and layer, and five thousand more through a real terminal.

No exit, no exception, no lost STOP, nothing moves unasked: see `tests/tui/key_storm.py`.
"""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path

import pytest

from tests.shared.night import by_night

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tui"))

import jumping_loop
from key_storm import WAYS, blow

SIZES = ((80, 24), (120, 36), (160, 48), (60, 20), (40, 12))
EACH = 2000


@pytest.mark.soak
@pytest.mark.parametrize("seed", by_night(range(100, 125), 1))
def test_two_thousand_keys_in_one_app(seed, monkeypatch):
    before = asyncio.get_event_loop_policy()
    jumping_loop.let_time_jump(monkeypatch.setattr)
    storm = asyncio.run(blow(seed, EACH, SIZES[seed % len(SIZES)]))
    asyncio.set_event_loop_policy(before)
    assert not storm.wrong, "\n".join(storm.wrong)
    assert len(storm.met) > 5
    assert storm.pressed >= EACH > len(WAYS)


@pytest.mark.soak
@pytest.mark.skipif(sys.platform == "win32", reason="needs a pty")
@pytest.mark.parametrize("seed", by_night(range(10, 20), 1))
def test_five_hundred_keys_in_one_terminal(seed, tmp_path):
    from terminal_storm import storm

    assert storm(seed, 500, tmp_path) == 0
