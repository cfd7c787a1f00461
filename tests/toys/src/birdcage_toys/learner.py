"""A machine that is no line of bytes, takes both axes at once, tells its limits when it is met, and its speeds never.

It stands for one behind a library: a call brings an answer, or an error. Its end of that is in `MACHINES`, by address.
"""

from __future__ import annotations

import threading
from dataclasses import replace

from birdcage.base.clock import WaitOutcome
from birdcage.base.errors import LinkError, NoReply
from birdcage.base.reason import Reason
from birdcage.rotator.axis import Axis, CableRange, Role
from birdcage.rotator.facts import CableTurn, Facts, Readback, SearchSwitch, SecondMove
from birdcage.rotator.ladder import POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.plain import PlainLine, PlainRotator
from birdcage.rotator.values import Look, Survey, Taken

MACHINES = {}
AXES = "azimuth", "elevation"
FACTS = Facts(
    name="Learner",
    firmware="learner",
    baud=0,
    axes=(
        Axis("azimuth", Role.AZ, 0.0, 360.0, 2.0, 10.0, 0.1, speed_known=False),
        Axis("elevation", Role.EL, 0.0, 90.0, 2.0, 10.0, 0.1, speed_known=False),
    ),
    cable=CableRange(0.0, 360.0),
    turn=CableTurn.REPORTED,
    second_same=SecondMove.RETARGET,
    second_other=SecondMove.RETARGET,
    stop_ladder=(
        Rung(means=StopMeans.COMMAND, ends=frozenset({MoveKind.SINGLE}), proven=True, sentence="it halts where it is"),
        POWER_SWITCH,
    ),
    slew=None,
    sends_together=True,
    search_switch=SearchSwitch.NEVER_SEARCHES,
    homing_s=None,
    never_homes=True,
    boot_s=1.0,
    readback=Readback.ALWAYS,
    power_switch="plug",
)


class Learner(PlainRotator):
    facts = FACTS

    def __init__(self):
        self.line, self._machine, self._clock = PlainLine(), None, None
        self._writing, self._stops = threading.RLock(), 0

    @property
    def is_open(self):
        return self._machine is not None

    @property
    def clock(self):
        if self._clock is None:
            raise LinkError("Learner is not open.", reason=Reason.LOST)
        return self._clock

    def open(self, address, baud, clock, hooks):
        machine = MACHINES.get(address)
        if machine is None or not machine.plugged:
            raise LinkError(f"There is no Learner at {address}.", reason=Reason.MISSING)
        self._machine, self._clock, self._hooks, self._stops = machine, clock, hooks, 0
        self.line, self.is_simulated = PlainLine(hooks.delay_s), True

    def close(self, within_s):
        self._machine = self._clock = None

    def _pause(self, until):
        while self.clock.wait(None, until, self._hooks.wake) is WaitOutcome.INTERRUPTED and self._hooks.on_wake:
            self._hooks.on_wake()

    def _call(self, function, *given, permit=None):
        clock = self.clock
        asked = clock.monotonic()
        try:
            with self._writing:
                if permit is not None:
                    permit()
                result = function(*given)
        except ConnectionError as gone:
            raise LinkError("Learner is gone.", reason=Reason.LOST) from gone
        except TimeoutError as silence:
            self._pause(asked + self.line.delay_s)
            self.line.note_silence()
            raise NoReply("Learner is silent.", reason=Reason.SILENT) from silence
        self._pause(asked + 0.02)
        self.line.note(asked, clock.monotonic())
        return result

    def meet(self):
        (az_low, az_high), (el_low, el_high) = self._call(self._machine.limits)
        self._hooks.on_facts(
            replace(FACTS, cable=CableRange(az_low, az_high)).with_axes(
                replace(FACTS.azimuth, min_deg=az_low, max_deg=az_high),
                replace(FACTS.elevation, min_deg=el_low, max_deg=el_high),
            )
        )

    def survey(self):
        low, high = self._call(self._machine.limits)[1]
        return Survey(el_min_deg=low, el_max_deg=high)

    def look(self, *, hurry=False, busy_s=0.0):
        return Look(dict(zip(AXES, self._call(self._machine.angles), strict=True)))

    def send(self, to, *, hurry=False, busy_s=0.0):
        sent = {AXES.index(axis): deg for axis, deg in to.items()}
        self._call(self._machine.go, sent, permit=self._hooks.permit)
        return Taken(True, "", self.line.took_s)

    def stop_now(self, order):
        with self._writing:
            machine = self._machine
            if machine is None or not machine.plugged:
                raise LinkError("Learner is gone.", reason=Reason.LOST)
            self._stops += machine.halt()

    def settle(self, within_s):
        done, self._stops = self._stops, 0
        self._pause(self.clock.monotonic() + (0.02 if done else within_s))
        if not done:
            raise NoReply("Learner did not answer STOP.", reason=Reason.SILENT)
        return (None,) * done

    def listen(self, until):
        if self.clock.wait(None, until, self._hooks.wake) is WaitOutcome.INTERRUPTED and self._hooks.on_wake:
            self._hooks.on_wake()
        if not self._machine.plugged:
            raise LinkError("Learner is gone.", reason=Reason.LOST)
