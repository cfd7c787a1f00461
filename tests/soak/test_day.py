"""A simulated day of the station (`-m soak`), and two hours of it at all times.

People and programs move the dish every few minutes, change their minds, jog, press STOP, talk to the console and listen
to the tuner; the adapter is pulled out, the dish restarts, the program restarts, and noise alters what the dish says.

- A position or a signal that is published was printed by the dish within the seconds before: to the last digit, unless
  a byte was altered just then. A number that was altered passes only for a place where the dish could have got to
  meanwhile, and is corrected by the next reading: at rest, what is shown is where the shafts stand.
- No step is lost: at each arrival the shafts stand where they were sent, within the overshoot of a G2, and
  count and shaft agree always. A plain motion on a sound wire always arrives.
- STOP holds; everybody gets an answer; after minutes of peace the link is up and the dish at rest, and is told so.
- From the second hour on neither memory nor threads nor open files grow, and the transcript keeps to its limits.
"""

from __future__ import annotations

import faulthandler
import sys
import tracemalloc

import pytest

from .day import TOTAL_LIMIT, Day
from .growth import Holdings

FIRMWARE = ("g2", "hal205")
SEED = 2
LONGEST_S = 600.0
GROWTH_BYTES = 80_000
"""What caches may still take in 22 hours: eight bytes for each position that is read are more."""


@pytest.fixture
def patience():
    """A day takes longer than a test may that hangs; on one busy core, twice as long again."""
    faulthandler.dump_traceback_later(LONGEST_S, exit=True, file=sys.__stderr__)
    yield
    faulthandler.cancel_dump_traceback_later()


@pytest.fixture
def traced():
    tracemalloc.start()
    yield
    tracemalloc.stop()


@pytest.mark.parametrize("firmware", FIRMWARE)
def test_two_hours(firmware, tmp_path):
    day = Day(firmware, SEED, tmp_path)
    day.until(2.0)
    day.end()
    assert not day.recorder.wrong, "\n".join([f"{firmware}, seed {SEED}", *day.recorder.wrong])
    assert day.tally["arrived"] > 10


@pytest.mark.soak
@pytest.mark.night
@pytest.mark.usefixtures("patience", "traced")
@pytest.mark.parametrize("firmware", FIRMWARE)
def test_a_day(firmware, tmp_path):
    day = Day(firmware, SEED, tmp_path)
    day.until(2.0)
    before = Holdings.now()
    day.until(24.0)
    after = Holdings.now()
    assert not day.recorder.wrong, "\n".join([f"{firmware}, seed {SEED}", *day.recorder.wrong])
    assert after.threads == before.threads
    assert after.files == before.files
    assert after.bytes - before.bytes < GROWTH_BYTES, (before.blocks, after.blocks)
    files = sorted(tmp_path.glob("wire-*.txt"))
    assert len(files) > 1
    assert sum(path.stat().st_size for path in files) <= TOTAL_LIMIT
    deeds = ("change_mind", "jog", "stop", "talk", "listen", "unplug", "noise", "restart_dish", "restart_program")
    assert min(day.tally[deed] for deed in deeds) > 0
    assert day.tally["arrived"] > 200
    day.end()
