"""Judges whether a machine that was silent had power all the time, by where it then counts its axes to stand.

`docs/decisions/0082-told-zero.md`. One that was without power counts from 0 and stands there.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from birdcage.base.geometry import shortest_turn

SAME_DEG = 0.25
"""Such machines tell tenths of a degree, and the last one may waver."""
BESIDE_DEG = 1.0
"""How far a control loop passes its target, at the most."""
Span = tuple[float, float]


@dataclass(frozen=True, slots=True)
class SilentZero:
    """How it was left as it fell silent, and for how long no byte came."""

    zero_deg: Mapping[str, float]
    """What a person has told."""
    may_be_deg: Mapping[str, Span]
    """Where it may count each axis to stand if it had power: from where it was last seen to where it was sent."""
    turns: bool
    """Whether it counts the turns of its cable; else its azimuths lie on the circle."""
    silent_s: float
    boot_s: float
    """How long a start takes at the longest: too short to switch it off, turn it by hand and switch it on."""

    def holds_at(self, counted: Mapping[str, float]) -> bool:
        """Return whether it had power, for all that is known, if it counts so now."""
        if any(not self._may_be(name, counted.get(name, math.inf)) for name in self.may_be_deg):
            return False
        if any(abs(counted[name]) > SAME_DEG for name in self.zero_deg):
            return True  # one that has started counts 0, and nothing has sent it elsewhere
        stood = all(max(map(abs, self.may_be_deg[name])) <= SAME_DEG for name in self.zero_deg)
        return stood and self.silent_s <= self.boot_s

    def _may_be(self, name: str, deg: float) -> bool:
        low, high = self.may_be_deg[name]
        beside = SAME_DEG if high - low <= SAME_DEG else BESIDE_DEG
        if not self.turns and math.isfinite(deg):
            deg = (low + high) / 2 + shortest_turn((low + high) / 2, deg)
        return low - beside <= deg <= high + beside


class WayWatch:
    """Where a machine may count its axes to stand, from one reading to the next."""

    def __init__(self) -> None:
        self.seen_at = -math.inf
        """When it was last read, in monotonic seconds."""
        self._seen: dict[str, float] = {}
        self._sent: dict[str, Span] = {}

    def forget(self) -> None:
        """Nothing is known of it."""
        self.seen_at = -math.inf
        self._seen, self._sent = {}, {}

    def see(self, counted: Mapping[str, float], at: float, *, rests: bool) -> None:
        """Take in where it counts its axes to stand. At rest that is where it stays."""
        self.seen_at, self._seen = at, dict(counted)
        if rests:
            self._sent = {}

    def send(self, goals: Mapping[str, float], *, taken: bool) -> None:
        """Take in where it was sent. Unless that is known to be `taken`, an earlier command may still hold instead."""
        for name, goal in goals.items():
            low, high = (goal, goal) if taken else self._sent.get(name, (goal, goal))
            self._sent[name] = min(low, goal), max(high, goal)

    @property
    def seen(self) -> Mapping[str, float]:
        """Where it counted its axes to stand as it was last read; empty while nothing is known of it."""
        return self._seen

    @property
    def may_be_deg(self) -> Mapping[str, Span]:
        """Where it may be now, if it has power; empty while nothing is known of it."""
        spans = {}
        for name, deg in self._seen.items():
            low, high = self._sent.get(name, (deg, deg))
            spans[name] = min(low, deg), max(high, deg)
        return spans
