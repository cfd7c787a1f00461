"""Compares what the station tells with what the simulated dish really does, at the moment when it is told."""

from __future__ import annotations

import re
from collections import deque
from typing import TYPE_CHECKING

from birdcage.base.geometry import shortest_turn
from birdcage.sim.dish import DishTruth
from birdcage.station.events import Event, PositionRead, ReadingRead, StopConfirmed
from birdcage.station.state import Activity, LinkPhase

if TYPE_CHECKING:
    from .stage import Stage

NEAR_DEG = 0.1
LOOP_DEG = 0.35
"""One with a control loop tells tenths of a degree, as they were at its last round: a hundredth of a second ago."""
RSSI = re.compile(r"RSSI\[avg:\s*(\d+)")
KEPT_S = 6.0
"""How long the truth is remembered: an answer is given up long before."""


class Recorder:
    """`false` holds a sentence for everything that was told and was not so."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage
        self.false: list[str] = []
        self.misled: list[str] = []
        """What was modelled, and marked so, and is not so: of a dish that does not tell."""
        self._seen: deque[tuple[float, DishTruth]] = deque()
        self._asked_at = 0.0
        self.said: set[float] = set()
        """The strengths of signal that left the dish, whatever became of them on the wire."""
        self._overhear()
        self.places: list[tuple[float, float]] = []
        """Where the dish was, look by look."""

    def _overhear(self) -> None:
        """Note what the dish says before the wire has it."""
        shell = self.stage.device.shell
        say = shell.say

        def saying(text: str) -> None:
            self.said.update(float(number) for number in RSSI.findall(text))
            say(text)

        shell.say = saying  # type: ignore[method-assign]

    def asked(self, data: bytes) -> None:
        """A line goes out: what is told from now on may be as old as this, and no older."""
        self.look()
        if data.strip() in ((b"a", b"EL", b"AZ EL") if self.stage.tells else (b"",)):
            self._asked_at = self.stage.now

    def look(self) -> None:
        """Note the truth."""
        truth, now = self.stage.device.truth(), self.stage.now
        self._seen.append((now, truth))
        while self._seen[0][0] < now - KEPT_S:
            self._seen.popleft()
        self.places.append((truth.az_deg, truth.el_deg))
        state = self.stage.state
        asked = state.position is not None and not state.position.modelled
        told = asked and state.homed and state.position_lost is None and state.link.state is LinkPhase.UP
        if state.activity is Activity.INITIALIZING and not self.stage.has_restarted:
            self._note("told to be starting, and is not")
        if told and not any(seen.homed for _, seen in self._seen):
            self._note("told to be homed, and is not")

    def glance(self) -> None:
        """Look at the state between two pieces of the station's work."""
        self.look()
        state = self.stage.state
        if (
            state.link.state in (LinkPhase.SILENT, LinkPhase.LOST)
            and state.position is not None
            and state.position_lost is None
        ):
            self._note("a position shown without a link")

    def hear(self, event: Event) -> None:
        """Judge one event."""
        self.look()
        match event:
            case PositionRead(position=position):
                self._compare(position)
            case ReadingRead(feature="rssi", value=value) if value not in self.said:
                self._note(f"a signal of {value} told, and the dish never said so")
            case StopConfirmed(report=report) if report.confirmed and self.stage.device.truth().moving:
                self._note("STOP confirmed, and the dish moves")

    def _compare(self, position) -> None:
        if not self.stage.tells:
            if not position.modelled:
                self._note("a modelled position told as read")
            if self.stage.state.motion is not None:
                return  # how fast it is, and when it begins, is not known
        span = [truth for at, truth in self._seen if at >= self._asked_at - 1e-6]
        here = span[-1]
        turns = [shortest_turn(here.az_deg, truth.az_deg) for truth in span]
        off = {
            "azimuth": _outside(shortest_turn(here.az_deg, position.dish_az_deg), turns),
            "elevation": _outside(position.dish_el_deg, [truth.el_deg for truth in span]),
        }
        if position.skew_deg is not None and here.skew_deg is not None:
            off["skew"] = _outside(position.skew_deg, [truth.skew_deg for truth in span])
        note = self._note if self.stage.tells else self.misled.append
        if not any(truth.homed for truth in span):
            note("a position told, and the dish does not know it")
        for axis, by_deg in off.items():
            if by_deg > (NEAR_DEG if self.stage.has_menus else LOOP_DEG):
                kind = "modelled" if position.modelled else "read"
                note(f"{axis} {kind} {by_deg:.2f}° off")

    def _note(self, what: str) -> None:
        self.false.append(f"{self.stage.now:.2f} {what}")


def _outside(value: float, span: list[float]) -> float:
    """Return how far a value lies outside what the truth was meanwhile."""
    return max(min(span) - value, value - max(span), 0.0)
