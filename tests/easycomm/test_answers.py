"""Which line answers what, of a rotator whose lines come late, twice, or one for each axis."""

from __future__ import annotations

import math

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import NoReply
from birdcage.base.wake import Wake
from birdcage.easycomm.rotator import EasycommRotator
from birdcage.link.link import Link
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopBy, StopOrder

from tests.shared.line_machine import LineMachine

STOP = StopOrder(StopBy.COMMAND)


class Teller(LineMachine):
    """Answers what it is given, each piece so many seconds later."""

    def __init__(self, clock, version):
        super().__init__(clock, b"\n")
        self.version, self.told = version, [(0.02, b"AZ10.0 EL20.0\n")]
        self.stopped = [(0.02, b"AZ10.0 EL20.0\n")]
        self.acts_at, self.act = math.inf, None

    def next_event(self):
        return min(self.acts_at, super().next_event())

    def _run(self):
        super()._run()
        if self.acts_at <= self.clock.monotonic():
            self.acts_at = math.inf
            self.act()

    def _take(self, line):
        self.heard.append((self.clock.monotonic(), line))
        answers = {"VE": [(0.02, f"VE{self.version}\n".encode())], "GE": [(0.02, b"GE1\n")]}
        stops = line in ("STOP", "SA SE")
        for in_s, data in answers.get(line, self.stopped if stops else self.told):
            self.say(data, in_s)


class Abandoned(Exception):
    """What `on_wake` raises."""


def met(version):
    clock = VirtualClock()
    machine, rotator, wake = Teller(clock, version), EasycommRotator(), Wake()

    def give_up():
        wake.clear()
        raise Abandoned

    hooks = Hooks(dial=lambda *_: Link(machine, clock), wake=wake, on_wake=give_up)
    rotator.open("a port", None, clock, hooks)
    rotator.meet()
    return rotator, machine, wake


def test_an_elevation_that_came_before_its_azimuth_belongs_to_the_answer_before():
    rotator, machine, _ = met("Acme 1")
    machine.told = [(0.02, b"AZ10.0\n"), (3.0, b"EL20.0\n")]
    with pytest.raises(NoReply):
        rotator.look()
    machine.clock.advance(2.0)
    for el in (21.0, 22.0):
        machine.told = [(0.02, b"AZ10.0\n"), (0.5, f"EL{el}\n".encode())]
        assert rotator.look().angles == {"azimuth": 10.0, "elevation": el}


@pytest.mark.parametrize(("version", "stop"), [("SatNOGS-RP2040-v0.2", "STOP"), ("SatNOGS-v2.2", "SA SE")])
def test_the_answer_to_a_question_that_was_given_up_does_not_answer_stop(version, stop):
    rotator, machine, wake = met(version)
    machine.told = [(0.3, b"AZ10.0 EL20.0\n")]
    machine.stopped = []
    machine.acts_at, machine.act = machine.clock.monotonic() + 0.1, lambda: (rotator.stop_now(STOP), wake.set())
    with pytest.raises(Abandoned):
        rotator.look()
    assert machine.lines()[-1] == stop
    with pytest.raises(NoReply):
        rotator.settle(2.0)
    machine.stopped = [(0.02, b"AZ10.0 EL20.0\n")]
    rotator.stop_now(STOP)
    assert rotator.settle(2.0) == (None,)


def test_a_firmware_whose_lines_may_come_twice_is_stopped_twice_and_answers_each():
    rotator, machine, _ = met("Acme 1")
    machine.told = [(0.02, b"AZ10.0 EL20.0\n"), (0.5, b"AZ10.0 EL20.0\n")]
    machine.stopped = []
    rotator.look()
    rotator.stop_now(STOP)
    assert machine.lines()[-2:] == ["SA SE", "SA SE"]
    with pytest.raises(NoReply):
        rotator.settle(2.0)
