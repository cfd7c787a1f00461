"""The table of the benchmark: a row for every simulated machine, and a limit that has only what no driver can avoid."""

from __future__ import annotations

import math
import sys
from importlib.metadata import entry_points
from pathlib import Path

import numpy as np
import pytest
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER

BENCH = Path(__file__).parents[2] / "scripts" / "bench"


@pytest.fixture(autouse=True)
def _beside(monkeypatch):
    monkeypatch.setattr(sys, "path", [str(BENCH), *sys.path])


def test_every_twin_has_a_row_beside_gpredict():
    from tracking_rows import OURS, POLICIES, rows

    assert {point.name for point in entry_points(group="birdcage.twins")} <= {row.partition("?")[0] for row in rows()}
    assert OURS in POLICIES
    assert {"Gpredict, 1°", "Gpredict, 5°"} <= set(POLICIES)


def test_wire_that_axes_share_leaves_the_saw_tooth_of_its_answers():
    from tracking_limits import stair_deg2

    still = stair_deg2(CARRYOUT_G2, np.array([0.0, 0.0]), 0.1)
    even = stair_deg2(CARRYOUT_G2, np.array([0.5, 0.5]), 0.1)
    assert still == 0.0
    # Both get every second answer: 0.1° of way for each, 0.2 s apart, less what the short move takes of that.
    assert 0.5 < math.sqrt(even / (2.0 * 0.1**2 / 12.0)) < 1.0
    # A slower second axis gets fewer of them.
    assert stair_deg2(CARRYOUT_G2, np.array([0.5, 0.01]), 0.1) < 0.5 * even


def test_axes_that_move_in_turn_are_left_more_than_those_that_take_a_command_at_once():
    from tracking_limits import stair_deg2

    rates = np.array([0.3, 0.2])
    assert stair_deg2(TRAVLER, rates, 0.01) > 10.0 * stair_deg2(CARRYOUT_G2, rates, 0.01)


def test_a_line_that_asks_or_is_blank_is_no_move():
    from tracking_machines import is_move

    assert [line for line in ("", "\r", "a", "q", "a 0 123.45", "g 12.0 30.0", "?") if is_move(line)] == [
        "a 0 123.45", "g 12.0 30.0",
    ]  # fmt: skip
