"""Holds what a station publishes against what the simulated dish printed and did."""

from __future__ import annotations

import re
from collections import Counter, deque

from birdcage.base.geometry import shortest_turn
from birdcage.station.events import PositionRead, ReadingRead
from birdcage.station.state import LinkPhase

KEPT_S = 12.0
"""How long what was printed is remembered: an answer is given up before."""
ANGLES = {
    "g2": re.compile(r"Angle\[0\] = (\S+)\s+Angle\[1\] = (\S+)\s"),
    "hal205": re.compile(r"AZ =\s*(\S+)\s+EL =\s*(\S+)\s"),
}
SIGNAL = re.compile(r"Reads:\d+\s+RSSI\[avg:\s*(\d+)\s")
PASSABLE_DEG = 10.0
"""A number altered on the wire passes only for a place where the dish could have got meanwhile."""
STEP_DEG = 0.02


class Recorder:
    """`wrong` gets a sentence for everything that was published and was not so; `tally` counts what was looked at."""

    def __init__(self, firmware: str, device, clock) -> None:
        self.wrong: list[str] = []
        self.tally: Counter[str] = Counter()
        self._angles, self._device, self._clock = ANGLES[firmware], device, clock
        self._printed: deque[tuple[float, str]] = deque()
        self.noise_at = -1e9
        """When the wire last altered a byte."""
        carry = device.wire.carry

        def carrying(lane, now, data):
            if lane is device.wire.to_host:
                self._printed.append((now, data.decode("latin-1")))
            return carry(lane, now, data)

        device.wire.carry = carrying

    def note(self, sentence: str) -> None:
        """Something is wrong."""
        self.wrong.append(f"{self._clock.monotonic() - 1000.0:.1f} s: {sentence}")
        assert len(self.wrong) < 10, "\n".join(self.wrong)

    def hear(self, event) -> None:
        """Judge one event."""
        match event:
            case PositionRead(position=position) if not position.modelled:
                self._judge_position(position)
            case ReadingRead(feature="rssi", value=value):
                self.tally["signal"] += 1
                if float(value) not in {float(text) for text in SIGNAL.findall(self._recent())} and not self._noisy:
                    self.note(f"signal {value} was not printed")

    @property
    def _noisy(self) -> bool:
        return self._clock.monotonic() - self.noise_at < KEPT_S

    def _recent(self) -> str:
        now = self._clock.monotonic()
        while self._printed and self._printed[0][0] < now - KEPT_S:
            self._printed.popleft()
        return "".join(text for _, text in self._printed)

    def _judge_position(self, position) -> None:
        self.tally["position"] += 1
        told = (position.dish_az_deg, position.dish_el_deg)
        places = [(float(az), float(el)) for az, el in self._angles.findall(self._recent())]
        if told in places:
            return
        off = min((_apart(told, place) for place in places), default=360.0)
        self.tally["position altered on the wire"] += 1
        if not self._noisy or off > PASSABLE_DEG:
            self.note(f"position {told} was not printed, {off:.2f} deg off")

    def at_rest(self, state, *, commanded=None, within_deg: float) -> None:
        """The dish rests: what is shown is so, where it was sent it is, and no motor has lost a step."""
        self.tally["at rest"] += 1
        truth, now_s = self._device.truth(), self._device.machine.dish_s
        if truth.moving:
            self.note("told to rest, and it moves")
            return
        here = truth.az_deg, truth.el_deg
        shown = state.position
        if shown is not None and state.position_lost is None and state.link.state is LinkPhase.UP:
            self.tally["shown"] += 1
            if _apart((shown.dish_az_deg, shown.dish_el_deg), here) > STEP_DEG:
                self.note(f"shown at {shown.dish_az_deg}/{shown.dish_el_deg}, is at {here}")
        if commanded is not None and _apart(commanded, here) > within_deg:
            self.note(f"told to have arrived at {commanded}, is at {here}")
        for axis in self._device.dish.axes:
            if axis.homed and abs(axis.shaft(now_s) - axis.count(now_s)[0]) > axis.step_deg:
                self.note(f"{axis.data.name} counts {axis.count(now_s)[0]}, stands at {axis.shaft(now_s)}")


def _apart(one, other) -> float:
    return max(abs(shortest_turn(one[0], other[0])), abs(one[1] - other[1]))
