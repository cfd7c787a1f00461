"""A motor that swings a dish along the geostationary arc, and never tells where it is.

It stands for a DiSEqC H-H motor behind a USB library: no line of bytes, one axis that turns about the Earth's, and a
call for STOP that returns only when the motor stands. Its end of that is in `MACHINES`, by address.
"""

from __future__ import annotations

import queue
import threading
import time
from dataclasses import replace
from math import asin, atan2, cos, degrees, radians, sin

from birdcage.base.errors import PositionUnknown
from birdcage.base.reason import Reason
from birdcage.rotator.axis import Axis, Role
from birdcage.rotator.facts import CableTurn, Facts, Readback, SearchSwitch, SecondMove
from birdcage.rotator.ladder import EVERY_MOVE, POWER_SWITCH, Rung, StopMeans
from birdcage.rotator.mapping import Arc
from birdcage.rotator.values import Taken

from birdcage_toys.library import LibraryRotator

MACHINES = {}
LEAVE_S = 1.0
EARTH_M, ORBIT_M = 6_378_137.0, 42_164_000.0
HOUR = Axis("hour", Role.ARC, -65.0, 65.0, 2.0, 8.0, 0.1)
FACTS = Facts(
    name="Swing",
    firmware="swing",
    baud=0,
    axes=(HOUR,),
    mapping_lacks="Its arc depends on where it stands: set your location (`birdcage place add`), then connect again.",
    cable=None,
    turn=CableTurn.UNKNOWN,
    second_same=SecondMove.UNKNOWN,
    second_other=SecondMove.UNKNOWN,
    stop_ladder=(
        Rung(means=StopMeans.COMMAND, ends=EVERY_MOVE, proven=True, sentence="its library halts it"),
        POWER_SWITCH,
    ),
    slew=None,
    search_switch=SearchSwitch.NEVER_SEARCHES,
    homing_s=None,
    never_homes=True,
    boot_s=1.0,
    readback=Readback.NEVER,
    moves_one_axis=False,
    power_switch="plug",
)


def polar_arc(site):
    """The hour angle counts westward from the meridian; the dish is declined to the arc as it stands there."""
    lat = radians(site.latitude_deg)
    declination = -atan2(EARTH_M * sin(lat), ORBIT_M - EARTH_M * cos(lat))

    def point(hour_deg):
        hour = radians(hour_deg)
        el = asin(sin(lat) * sin(declination) + cos(lat) * cos(declination) * cos(hour))
        east = -cos(declination) * sin(hour)
        north = cos(lat) * sin(declination) - sin(lat) * cos(declination) * cos(hour)
        return degrees(atan2(east, north)) % 360.0, degrees(el)

    return Arc(HOUR.name, HOUR.min_deg, HOUR.max_deg, point)


class Halter:
    """Carries STOP to the library on a thread of its own: that call blocks, and `stop_now` must not."""

    def __init__(self, halt):
        self._halt, self._asked, self._answers = halt, queue.SimpleQueue(), queue.SimpleQueue()
        self._counting, self._due = threading.Lock(), 0
        self._thread = threading.Thread(target=self._run, name="swing-halter", daemon=True)
        self._thread.start()

    def ask(self):
        with self._counting:
            self._due += 1
        self._asked.put(True)

    def _run(self):
        for _ in iter(self._asked.get, None):
            try:
                self._halt()
            except (ConnectionError, TimeoutError):
                self._answers.put(False)
            else:
                self._answers.put(True)

    def answers(self, within_s):
        """Wait for what is due, in real seconds, as the thread lives by those: False for each that takes too long."""
        with self._counting:
            due, self._due = self._due, 0
        answers, deadline = [], time.monotonic() + within_s
        while len(answers) < due:
            try:
                answers.append(self._answers.get(timeout=max(0.0, deadline - time.monotonic())))
            except queue.Empty:
                answers += [False] * (due - len(answers))
        return answers

    def end(self):
        self._asked.put(None)
        self._thread.join(LEAVE_S)


class Swing(LibraryRotator):
    facts, machines = FACTS, MACHINES

    def __init__(self):
        super().__init__()
        self._halter = None

    def open(self, address, baud, clock, hooks):
        super().open(address, baud, clock, hooks)
        self._halter = Halter(self._stop_motor)

    def close(self, within_s):
        halter, self._halter = self._halter, None
        if halter is not None:
            halter.end()
        super().close(within_s)

    def _stop_motor(self):
        machine = self._machine
        if machine is None:
            raise ConnectionError
        with self._writing:  # after a move that is just being sent
            machine.halt()

    def meet(self):
        self._call(self._machine.ping)
        site = self._hooks.site
        if site is not None and self.facts.mapping is None:
            self._hooks.on_facts(replace(self.facts, mapping=polar_arc(site)))

    def look(self, *, hurry=False, busy_s=0.0):
        raise PositionUnknown("Swing does not tell where it points.", reason=Reason.UNTOLD)

    def send(self, to, *, hurry=False, busy_s=0.0):
        self._call(self._machine.turn, to[HOUR.name], permit=self._hooks.permit)
        return Taken(True, "", self.line.took_s)

    def stop_now(self, order):
        halter, machine = self._halter, self._machine
        if halter is None or not machine.plugged:
            raise self._gone()
        halter.ask()

    def settle(self, within_s):
        return self._stop_answers(within_s, self._halter.answers(within_s) if self._halter is not None else [])
