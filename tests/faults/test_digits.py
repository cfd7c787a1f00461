"""One digit of an answer is changed while the dish moves: whichever it is, no angle that it makes is ever shown."""

from __future__ import annotations

import pytest
from birdcage.antenna.reading_filter import JITTER_S
from birdcage.station.requests import Follow, Goto
from birdcage.station.state import LinkPhase

from . import recorder
from .stage import Stage

EVERY = (3, 4)
"""One reading of so many is spoilt."""
SPAN_DEG = 0.11
"""The overshoot's width: what a dish that stands may be off by, as its axes print hundredths and go in steps."""
RATE_DEG_S = {"g2": 10.0, "hal205": 0.0}
"""How fast the dish of the stage is at most while it is read."""


class Spoiler:
    """Changes one digit, counted from the decimal point, of one number of some answers to `a`."""

    def __init__(self, stage: Stage, number: int, place: int, every: int) -> None:
        self.number, self.place, self.every = number, place, every
        self.answers = self.spoilt = 0
        shell = stage.device.shell
        self._say = shell.say
        shell.say = self.say

    def say(self, text: str) -> None:
        parts = text.split("=")
        if len(parts) > 2:
            self.answers += 1
            if self.answers % self.every == 0:
                parts[self.number + 1] = self._spoil(parts[self.number + 1])
                text = "=".join(parts)
        self._say(text)

    def _spoil(self, part: str) -> str:
        at = part.index(".") - self.place
        if not part[at : at + 1].isdigit():
            return part
        self.spoilt += 1
        digit = (int(part[at]) + 1 + self.spoilt % 9) % 10
        return f"{part[:at]}{digit}{part[at + 1 :]}"


def follow(stage: Stage) -> None:
    for n in range(60):
        stage.station.submit(Follow(100.0 + 0.2 * n, 40.0 + 0.04 * n, "you"))
        stage.step(0.2)


def slews(stage: Stage) -> None:
    for az_deg, el_deg in ((120.0, 30.0), (130.0, 40.0), (129.0, 41.0)):
        stage.do(Goto(az_deg, el_deg, "you"))


@pytest.mark.parametrize("every", EVERY)
@pytest.mark.parametrize("place", [-2, -1, 1, 2, 3], ids=["hundredths", "tenths", "ones", "tens", "hundreds"])
@pytest.mark.parametrize("number", [0, 1])
@pytest.mark.parametrize("dialect", ["g2", "hal205"])
@pytest.mark.parametrize("moves", [follow, slews])
def test_a_changed_digit_is_not_shown(monkeypatch, dialect, number, place, moves, every):
    slewing = JITTER_S * RATE_DEG_S[dialect] if moves is slews else 0.0
    monkeypatch.setattr(recorder, "NEAR_DEG", SPAN_DEG + slewing)
    stage = Stage(dialect)
    stage.connect()
    stage.do(Goto(100.0, 40.0, "you"))
    stage.step(1.0)
    spoiler = Spoiler(stage, number, place, every)
    moves(stage)
    stage.step(2.0)
    assert spoiler.spoilt >= 5 or (number, place) == (1, 3)
    assert stage.recorder.false == []


def test_an_angle_that_no_dish_has_is_not_shown_however_often_it_is_read():
    stage = Stage("g2")
    stage.connect()
    stage.do(Goto(210.0, 40.0, "you"))
    stage.step(1.0)
    shell = stage.device.shell
    say = shell.say
    shell.say = lambda text: say(text.replace("= 210.", "= 2100."))
    stage.step(5.0)
    assert stage.recorder.false == []
    assert (stage.state.link.state, stage.state.position_lost) == (LinkPhase.UP, "unreadable")
