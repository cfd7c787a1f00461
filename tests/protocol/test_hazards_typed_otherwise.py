"""Lines that could slip past a table: run together, shortened, in the wrong menu, with something behind them."""

from __future__ import annotations

import pytest
from birdcage.protocol.g2 import CarryoutG2Protocol
from birdcage.rotator.values import Position
from birdcage.rotator.verdict import Grade

from .judged import Judged

MOVES, RUINS = Grade.MOVES, Grade.RUINS


@pytest.fixture
def dish():
    return Judged(CarryoutG2Protocol(), Position(100.0, 40.0))


@pytest.mark.parametrize(
    ("menu", "line", "grade", "word"),
    [
        ("root", "help;stow", RUINS, "several commands"),
        ("root", "stow;", RUINS, "fold"),
        ("root", "id ; reboot", MOVES, "several commands"),
        ("mot", "a;a 0 200", MOVES, "Moves an axis"),
        ("mot", "p & vms 0 20 500", MOVES, "ignoring the limits"),
        ("mot", "q;q", RUINS, "root menu"),
        ("mot", "a 0 10;sp 0 100", RUINS, "every angle"),
        ("root", "sto", RUINS, "abbreviation"),
        ("root", "reb", MOVES, "abbreviation"),
        ("mot", "motorb", MOVES, "abbreviation"),
        ("mot", "freqs", Grade.SETTING, "Undocumented"),
        ("mot", "stow", RUINS, "Elsewhere"),
        ("dvb", "a 0 200", MOVES, "Elsewhere"),
        ("mot", "w 0 off now", RUINS, "cable"),
        ("root", "stow now please", RUINS, "crushed"),
        ("mot", "h 0 1 2 3", MOVES, "Only cutting the power stops"),
    ],
)
def test_a_danger_typed_otherwise_still_warns(dish, menu, line, grade, word):
    verdict = dish.judge(line, menu, homed=True)
    assert verdict.grade >= grade
    assert word.lower() in verdict.consequence.lower()
    assert "position" in verdict.forgets or grade is RUINS


@pytest.mark.parametrize("line", ["frobnicate", "x" * 5000, ";;;;", "&", "| |", ";a" * 2000])
def test_nonsense_is_judged_at_once_and_never_harmless(dish, line):
    assert dish.judge(line, "mot", homed=True).grade >= Grade.SETTING


def test_reads_that_keep_stop_out_for_long_say_so(dish):
    assert dish.judge("rssi 99", "dvb", homed=True).grade is Grade.HARMLESS
    many = dish.judge("rssi 9999", "dvb", homed=True)
    assert many.grade is Grade.SETTING
    assert "no STOP" in many.consequence
    assert many.takes_s > 900


def test_what_nobody_listed_may_have_changed_anything_that_is_read_from_the_dish(dish):
    assert {"position", "turn", "limits", "settings"} <= dish.judge("frobnicate", "mot", homed=True).forgets
