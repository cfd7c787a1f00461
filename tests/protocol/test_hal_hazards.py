"""What raw lines do on a Trav'ler: each hazard warns with its consequence, and what is not listed says so."""

from __future__ import annotations

import pytest
from birdcage.protocol import HAL205Protocol
from birdcage.rotator.values import Position
from birdcage.rotator.verdict import Grade

from .judged import Judged

HARMLESS, SETTING, MOVES, RUINS = Grade.HARMLESS, Grade.SETTING, Grade.MOVES, Grade.RUINS


@pytest.fixture
def dish():
    return Judged(HAL205Protocol(), Position(180.0, 45.0, 90.0))


@pytest.mark.parametrize(
    ("menu", "line", "grade", "words"),
    [
        ("root", "q", RUINS, "until a power cycle"),
        ("root", "freqs", RUINS, "byte lost"),
        ("root", "stow", RUINS, "crushed"),
        ("root", "reboot", MOVES, "TV search"),
        ("root", "motor", HARMLESS, ""),
        ("root", "?", HARMLESS, ""),
        ("root", "warp 9", SETTING, "Undocumented"),
        ("motor", "a", HARMLESS, ""),
        ("motor", "q", HARMLESS, ""),
        ("motor", "a 0 190", MOVES, "Nothing can cancel it"),
        ("motor", "a 1 46.5", MOVES, "Nothing can cancel it"),
        ("motor", "a 2 100", MOVES, "feed"),
        ("motor", "a 0 -0.5", MOVES, "sign"),
        ("motor", "g 190 45 90", MOVES, "any key ends it"),
        ("motor", "g 190", MOVES, "unknown"),
        ("ngsearch", "s", SETTING, "next power-up"),
        ("nvs", "s", SETTING, "flash"),
        ("nvs", "e 127", HARMLESS, ""),
        ("nvs", "e 127 0", SETTING, "15°"),
        ("nvs", "e 40 1", SETTING, "GPS"),
        ("nvs", "d", HARMLESS, ""),
        (None, "s", SETTING, ""),
        (None, "q", RUINS, "power cycle"),
    ],
)
def test_lines(dish, menu, line, grade, words):
    verdict = dish.judge(line, menu, homed=True)
    assert verdict.grade is grade
    assert words in verdict.consequence


@pytest.mark.parametrize(
    ("line", "limit", "motion"),
    [
        ("a 0 190", "", (0, 190.0)),
        ("a 0 361", "beyond", (0, 361.0)),
        ("a 1 10", "below", (1, 10.0)),
        ("a 1 46x", "not an angle", None),
        ("g 190 10 90", "below", None),
        ("g 190 46 90", "", None),
        ("a 2 500", "", None),
    ],
)
def test_raw_motions_are_held_against_the_limits(dish, line, limit, motion):
    verdict = dish.judge(line, "motor", homed=True)
    assert limit in verdict.limit
    assert bool(verdict.limit) == bool(limit)
    assert (verdict.aim and verdict.aim.single) == motion


def test_every_documented_command_is_listed(dish):
    for command in dish.commands:
        if command.name != "e":
            assert dish.judge(command.name, command.menu, homed=True).listed, command


@pytest.mark.parametrize(
    ("line", "asks"),
    [("a", True), ("?", True), ("e 127", True), ("motor", True), ("q", False), ("s", False), ("a 0 10", False),
     ("warp", False)],
)  # fmt: skip
def test_what_only_asks_is_told_by_the_line_as_no_prompt_is_known(dish, line, asks):
    assert dish.only_asks(line, "ANY>") is asks
