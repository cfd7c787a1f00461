"""A machine that is no line of bytes, takes both axes at once, tells its limits when it is met, and its speeds never.

It stands for one behind a library: a call brings an answer, or an error. Its end of that is in `MACHINES`, by address.
"""

from __future__ import annotations

from dataclasses import replace

from birdcage.rotator.axis import Axis, CableRange, Role
from birdcage.rotator.facts import CableTurn, Facts, Readback, SearchSwitch, SecondMove
from birdcage.rotator.ladder import POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.values import Look, Survey, Taken

from birdcage_toys.library import LibraryRotator

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


class Learner(LibraryRotator):
    facts, machines = FACTS, MACHINES

    def __init__(self):
        super().__init__()
        self._stops = 0

    def open(self, address, baud, clock, hooks):
        super().open(address, baud, clock, hooks)
        self._stops = 0

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
                raise self._gone()
            self._stops += machine.halt()

    def settle(self, within_s):
        done, self._stops = self._stops, 0
        return self._stop_answers(within_s, [True] * done or [False])
