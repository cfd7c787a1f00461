"""A task that is about to move the dish by itself says so over everything else, and how to keep it from that."""

from __future__ import annotations

from datetime import timedelta

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.station.task_state import TaskPhase, TaskState
from stage import read, run

NOW = VirtualClock().utc()


def counting(kind):
    at = NOW + timedelta(seconds=4)
    task = TaskState(1, kind, "station", TaskPhase.COUNTDOWN, 0.0, "", kind, at)
    return {"not_now": "Not now: wind 14 m/s.", "tasks": (task,)}


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48), (40, 12)], ids=str)
@pytest.mark.parametrize(
    ("kind", "name", "words"),
    [
        ("recovery", "fault", "HOMES after its restart in 4 s   Space cancels"),
        ("park", "idle", "PARKS: no program has asked for a motion lately in 4 s   Space cancels"),
        ("shelter", "idle", "PARKS in 4 s   Not now: wind 14 m/s.   Space cancels"),
        ("scan", "idle", "MOVES for the scan in 4 s   Space cancels"),
    ],
)
def test_what_is_about_to_move_by_itself_is_said_above_a_fault_too(kind, name, words, size):
    text = " ".join(run(read, name, size, state=counting(kind)).split())
    assert " ".join(words.split()) in text
