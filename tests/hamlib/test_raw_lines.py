"""What a raw line does to a server that reads one word after the other, and what passes a latched STOP."""

from __future__ import annotations

import pytest
from birdcage.base.errors import Held
from birdcage.hamlib.hazards import HAZARDS
from birdcage.rotator.verdict import Grade
from birdcage.station.requests import Raw
from birdcage.testing import MachineBench, Stage
from rotctl_twin import server

SECOND = (
    "P10 20", "+P 10 20", "_ P 10 20", "s K", "1 K", "zz P 1 2", "v AZ P 10 20", "v SPEED K", "v K", "V SPEED 50 K",
    "C min_az 0 K", "C min_az K", r"\pause 1 K", r"\get_conf min_az K", r"\get_conf K", r"v \park",
)  # fmt: skip


@pytest.mark.parametrize("line", SECOND)
def test_a_second_command_on_a_line_is_a_motion(line):
    verdict, _ = HAZARDS.judge(line, None, homed=True)
    assert verdict.grade == Grade.MOVES


@pytest.mark.parametrize(
    ("line", "grade"),
    [
        ("p", Grade.HARMLESS), (r"\dump_state", Grade.HARMLESS), ("v SPEED", Grade.HARMLESS), ("v ?", Grade.HARMLESS),
        (r"\get_conf min_az", Grade.HARMLESS), ("V SPEED 50", Grade.SETTING), (r"\set_level SPEED 50.5", Grade.SETTING),
        ("C min_az -180", Grade.SETTING), ("C rot_pathname /dev/ttyUSB1", Grade.SETTING),
        (r"\pause 1.5", Grade.SETTING),
    ],
)  # fmt: skip
def test_one_command_counts_as_what_it_does(line, grade):
    verdict, _ = HAZARDS.judge(line, None, homed=True)
    assert (verdict.grade, verdict.listed) == (grade, True)


def test_no_second_command_on_a_line_gets_past_a_latched_stop():
    with Stage(MachineBench("rotctl", server("seed=1&az=100&el=30"), stops=())) as stage:
        stage.ready()
        stage.station.stop("you")
        stage.step(5.0)
        before = len(stage.twin.lines())
        for line in SECOND:
            assert line in str(stage.refused(Raw(line, "you", Grade.RUINS), Held))
        assert not [said for said in stage.twin.said()[before:] if said != "p"]
        stage.do(Raw("V SPEED 50", "you", Grade.SETTING), 60.0)
        assert "V SPEED 50" in stage.twin.said(), "what only sets a speed moves nothing by itself"
