"""The wire between the program and the dish, and what can go wrong on it: faults as data."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from birdcage.sim.chance import seeded
from birdcage.sim.settings import SimSettings


@dataclass(frozen=True, slots=True)
class Byte:
    """What happens to one byte of a plan: the empty action lets it pass."""

    drop: bool = False
    double: bool = False
    delay_s: float = 0.0
    """Added to its time of arrival; later bytes wait behind it."""
    noise: bytes = b""
    """Bytes that arrive before it."""


PASS, DROP, DOUBLE = Byte(), Byte(drop=True), Byte(double=True)
Plan = Iterable[Byte] | Callable[[int], Byte]
"""Actions byte by byte (when it runs out, bytes pass), or a function of the byte's value."""


@dataclass(slots=True)
class WireDirection:
    """One direction. Fields may be changed at any time; probabilities are for each byte."""

    rng: random.Random
    silent: bool = False
    """Nothing gets through."""
    drop: float = 0.0
    double: float = 0.0
    garble: float = 0.0
    delay_min_s: float = 0.0
    delay_max_s: float = 0.0
    pace_baud: int = 0
    plan: Iterator[Byte] | Callable[[int], Byte] | None = None
    busy_until: float = 0.0
    """When the last byte so far arrives."""

    def set_plan(self, plan: Plan | None) -> None:
        """Decide byte by byte what happens from now on."""
        self.plan = plan if plan is None or callable(plan) else iter(plan)

    def clean(self) -> bool:
        """Whether bytes simply pass."""
        return not (self.drop or self.double or self.garble or self.delay_max_s or self.pace_baud or self.plan)

    def carry(self, now: float, data: bytes) -> list[tuple[float, bytes]]:
        """Return what arrives of `data`, sent at `now`, and when: in order, never before what was sent earlier."""
        if self.silent:
            return []
        if self.clean():
            self.busy_until = max(now, self.busy_until)
            return [(self.busy_until, data)]
        arrivals: list[tuple[float, bytes]] = []
        for value in data:
            action = self._action(value)
            for arriving in self._bytes(value, action):
                self.busy_until = max(now + self._delay() + action.delay_s, self.busy_until)
                if self.pace_baud:
                    self.busy_until += 10.0 / self.pace_baud
                arrivals.append((self.busy_until, bytes((arriving,))))
        return arrivals

    def _action(self, value: int) -> Byte:
        if self.plan is None:
            return PASS
        return self.plan(value) if callable(self.plan) else next(self.plan, PASS)

    def _bytes(self, value: int, action: Byte) -> bytes:
        out = bytes((value,))
        if action.drop or self._happens(self.drop):
            out = b""
        if out and self._happens(self.garble):
            out = bytes((self.rng.randrange(256),))
        if action.double or self._happens(self.double):
            out *= 2
        return action.noise + out

    def _happens(self, probability: float) -> bool:
        return probability > 0.0 and self.rng.random() < probability

    def _delay(self) -> float:
        return self.rng.uniform(self.delay_min_s, self.delay_max_s) if self.delay_max_s else 0.0


class SimWire:
    """Both directions. Only data: the device reads it whenever a byte is sent.

    A `dish_baud` of 0 is that of a USB port, which takes any rate.
    """

    def __init__(self, settings: SimSettings, dish_baud: int) -> None:
        self._dish_baud = dish_baud
        self.to_dish = WireDirection(seeded("to dish", settings.seed))
        self.to_host = WireDirection(seeded("to host", settings.seed))
        for lane in self.lanes:
            lane.drop, lane.double, lane.garble = settings.drop, settings.double, settings.garble
            lane.delay_max_s, lane.pace_baud = settings.delay, settings.pace_baud
        self.plugged = True
        """Whether the adapter is there. `Device.unplug` and `Device.plug` change it."""
        self.echo_loss = False
        """Half-duplex adapter: what the dish echoes is lost, as the program is still sending."""
        self.baud: int | None = None
        """The rate at which the program speaks; None if there is no such thing, as on TCP."""
        self._wrong_baud = settings.wrong_baud
        self._noise = seeded("wrong baud", settings.seed)

    def carry(self, lane: WireDirection, now: float, data: bytes) -> list[tuple[float, bytes]]:
        """Return what arrives of `data`, sent at `now`, and when; nothing sensible at a wrong rate."""
        if self._dish_baud and self.baud not in (None, self._dish_baud):
            if self._wrong_baud == "silent":
                return []
            data = bytes(self._noise.randrange(256) for _ in data)
        return lane.carry(now, data)

    @property
    def lanes(self) -> tuple[WireDirection, WireDirection]:
        """Both directions: to the dish, to the host."""
        return self.to_dish, self.to_host
