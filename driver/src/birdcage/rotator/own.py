"""What is known of one machine itself: its own facts, which lie over those of all that are like it.

What its owner says goes before what a program has learnt of it, and that before what its language has.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from types import MappingProxyType

from birdcage.rotator.facts import Facts, SecondMove
from birdcage.rotator.ladder import END_OF_MOVE, StopMeans
from birdcage.rotator.origin import Origin

SECOND_MOVES = ("second_same", "second_other")
_TIMED_BY = ("speed_deg_s", "acceleration_deg_s2")
_CARE = (SecondMove.RETARGET, SecondMove.UNKNOWN, SecondMove.QUEUE, SecondMove.BLOCK)
"""By how little they take for granted of what a second command does."""


@dataclass(frozen=True, slots=True)
class OwnFact:
    """One fact, and how it came to be known."""

    value: float | str
    """Of a second move: its word."""
    origin: Origin
    utc: datetime
    readings: int = 0
    """How many it was learnt from; 0 for one that was set."""


@dataclass(frozen=True, slots=True)
class OwnFacts:
    """Facts of one machine by their flat names; what is not among them is not known."""

    facts: Mapping[str, OwnFact] = field(default_factory=lambda: MappingProxyType({}))

    def with_fact(self, name: str, fact: OwnFact | None) -> OwnFacts:
        """Return them with one replaced; None forgets it."""
        facts = {key: each for key, each in self.facts.items() if key != name}
        return OwnFacts(MappingProxyType(facts if fact is None else {**facts, name: fact}))

    def that_waits(self, utc: datetime) -> OwnFacts:
        """Return them for a machine that was seen to answer no command of a move while a motor runs."""
        seen = OwnFact(SecondMove.BLOCK.value, Origin.LEARNT, utc, 1)
        return self.with_fact("second_same", seen).with_fact("second_other", seen)

    def on(self, facts: Facts) -> Facts:
        """Return the machine with them."""
        for name, fact in self.facts.items():
            facts = laid(facts, name, fact.value, fact.origin)
        return facts


def laid(facts: Facts, name: str, value: float | str, origin: Origin) -> Facts:
    """Return facts with one replaced, and who stands for it. One that the owner has set stays.

    A speed goes before times that were measured at another machine. One that waits with a second move is stopped at the
    end of its move. AttributeError where the machine has no such part.
    """
    if facts.origin_of(name) is Origin.USER:
        return facts
    origins = {**facts.origin, name: origin}
    part, _, key = name.rpartition(".")
    if not part:
        said: object = SecondMove(value) if name in SECOND_MOVES else value
        return _stopped_as_it_moves(replace(facts, **{name: said}, origin=origins))  # type: ignore[arg-type]
    own: dict[str, object] = {key: value}
    if key in _TIMED_BY:
        own["times"] = None
    if part == "cable":
        return replace(facts, cable=replace(facts.cable, **own), origin=origins)  # type: ignore[type-var]
    return replace(facts.with_axes(replace(getattr(facts, part), **own)), origin=origins)


def with_speeds(facts: Facts, speeds: Mapping[int, float]) -> Facts:
    """Return facts with the greatest speeds (by motor number) that are in force at the machine.

    Where its owner has told how fast an axis goes, the lesser of both counts.
    """
    if facts.mapping is not None:
        return facts
    axes = []
    for axis in (facts.azimuth, facts.elevation):
        speed = speeds.get(axis.index, axis.speed_deg_s)
        if facts.origin_of(f"{axis.role.value}.speed_deg_s") is Origin.USER:
            speed = min(speed, axis.speed_deg_s)
        if speed != axis.speed_deg_s:
            axes.append(replace(axis, speed_deg_s=speed))
    return facts.with_axes(*axes) if axes else facts


def _stopped_as_it_moves(facts: Facts) -> Facts:
    if not facts.moves_in_turn or all(rung.means is not StopMeans.RETARGET for rung in facts.stop_ladder):
        return facts
    kept = (rung for rung in facts.stop_ladder if rung.means is not StopMeans.WAIT)
    ladder = tuple(END_OF_MOVE if rung.means is StopMeans.RETARGET else rung for rung in kept)
    return replace(facts, stop_ladder=ladder)


def laid_by_owner(facts: Facts, values: Mapping[str, float | str]) -> tuple[Facts, tuple[str, ...]]:
    """Return a machine with what its owner says of it, and a sentence for each fact that can't count.

    A range can be narrowed; it can be widened only where it is no more than an assumption. What a second command does
    can be told otherwise than documented only towards more care, as STOP rests on it.
    """
    said, wrong = facts, list[str]()
    for name, value in values.items():
        if objection := _objection(facts, name, value):
            wrong.append(f"dish.facts.{name} {objection} It does not count.")
        else:
            said = laid(said, name, value, Origin.USER)
    for part in ("azimuth", "elevation", "skew", "cable"):
        span = getattr(said, part)
        if span is not None and span.min_deg >= span.max_deg:
            said = replace(said, cable=facts.cable) if part == "cable" else said.with_axes(getattr(facts, part))
            wrong.append(
                f"dish.facts.{part} leaves no range: {span.min_deg:g} to {span.max_deg:g} deg. It does not count."
            )
    return said, tuple(wrong)


def _objection(facts: Facts, name: str, value: float | str) -> str:
    part, _, key = name.rpartition(".")
    span = getattr(facts, part) if part else None
    if part and (span is None or (part != "cable" and span not in facts.axes)):
        what = "cable limit" if part == "cable" else f"{part} axis"
        return f"is set, but no {what} of the {facts.name} is known."
    if name == "homing_s" and facts.homing_s is None:
        return f"is set, but the {facts.name} homes only by itself."
    if key in ("min_deg", "max_deg") and facts.origin_of(name) is not Origin.INFERRED:
        limit, asked = getattr(span, key), float(value)
        beyond = limit - asked if key == "min_deg" else asked - limit
        if beyond > 0:
            return (
                f"is {asked:g}, {beyond:g} deg beyond the {facts.name}'s own limit of {limit:g} deg, and can only "
                "narrow it."
            )
    if name in SECOND_MOVES:
        known, asked_move = getattr(facts, name), SecondMove(value)
        sure = facts.origin_of(name) is not Origin.INFERRED
        has_rung = any(rung.means is StopMeans.RETARGET for rung in facts.stop_ladder)
        if _CARE.index(asked_move) < _CARE.index(known) and (sure or not has_rung):
            return f"is {value!r}, but the {facts.name} is known to {known.value}, and STOP rests on that."
    return ""
