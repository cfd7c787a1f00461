"""What is known of one dish's own gear: the play of each axis, and how far past its target it comes to rest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from enum import Enum
from types import MappingProxyType

from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import Facts


class GearOrigin(Enum):
    """Where a fact comes from."""

    USER = "set by the user"
    READINGS = "learnt from readings at rest"


class GearKind(Enum):
    """What a fact is about."""

    PLAY = "play"
    OVERSHOOT_UP = "overshoot up"
    """On the mean, of moves to greater angles."""
    OVERSHOOT_DOWN = "overshoot down"


FIELDS = {
    GearKind.PLAY: "play_deg",
    GearKind.OVERSHOOT_UP: "mean_overshoot_up_deg",
    GearKind.OVERSHOOT_DOWN: "mean_overshoot_down_deg",
}
"""Of `Axis`."""
AXES = ("azimuth", "elevation")
MOST_DEG = {GearKind.PLAY: 0.15, GearKind.OVERSHOOT_UP: 0.1, GearKind.OVERSHOOT_DOWN: 0.1}
"""No more is believed, whoever says it. A play of more would lead a command out of the margin of a no-go sector."""


@dataclass(frozen=True, slots=True)
class GearFact:
    """One figure, and where it comes from."""

    deg: float
    origin: GearOrigin
    utc: datetime
    readings: int = 0
    """How many it was learnt from; 0 for one that was set."""

    def words(self) -> str:
        """Return it for a person."""
        of = f"learnt from {self.readings} readings at rest" if self.readings else self.origin.value
        return f"{self.deg:.3f}° ({of}, {self.utc:%Y-%m-%d})"


@dataclass(frozen=True, slots=True)
class Gear:
    """The facts of one dish; what is not among them is not known."""

    facts: Mapping[tuple[str, GearKind], GearFact] = field(default_factory=lambda: MappingProxyType({}))
    """By name of the axis and kind."""

    def with_fact(self, axis: str, kind: GearKind, fact: GearFact | None) -> Gear:
        """Return it with one fact replaced; None forgets it."""
        facts = {key: each for key, each in self.facts.items() if key != (axis, kind)}
        return Gear(MappingProxyType(facts if fact is None else {**facts, (axis, kind): fact}))

    def on(self, model: Facts) -> Facts:
        """Return the model of this dish."""
        return replace(model, azimuth=self._on(model.azimuth), elevation=self._on(model.elevation))

    def _on(self, axis: Axis) -> Axis:
        known = {FIELDS[kind]: fact.deg for (name, kind), fact in self.facts.items() if name == axis.name}
        return replace(axis, **known)  # type: ignore[arg-type]

    def words(self) -> str:
        """Return all of it in a sentence; empty if nothing is known."""
        return "; ".join(
            f"{axis}: " + ", ".join(f"{kind.value} {self.facts[axis, kind].words()}" for kind in kinds)
            for axis in AXES
            if (kinds := [kind for kind in GearKind if (axis, kind) in self.facts])
        )

    def values(self) -> dict[str, str | float | bool | None]:
        """Return it for JSON, flat: each figure in degrees, with its origin, its time and its count of readings."""
        found: dict[str, str | float | bool | None] = {"sentence": self.words()}
        for (axis, kind), fact in self.facts.items():
            name = f"{axis}_{kind.value.replace(' ', '_')}"
            found |= {
                f"{name}_deg": round(fact.deg, 4), f"{name}_origin": fact.origin.value,
                f"{name}_since": fact.utc.isoformat(timespec="seconds"), f"{name}_readings": fact.readings,
            }  # fmt: skip
        return found
