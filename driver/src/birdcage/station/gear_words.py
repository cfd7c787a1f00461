"""What is known of a dish's play and overshoot, as a sentence and as values for JSON."""

from __future__ import annotations

from birdcage.antenna.gear import AXES, KINDS, NAMES
from birdcage.rotator.origin import Origin
from birdcage.rotator.own import OwnFact, OwnFacts

_ORIGIN_WORDS = {Origin.USER: "set by the user", Origin.LEARNT: "learnt from readings at rest"}


def gear_words(own: OwnFacts) -> str:
    """Return what is known of the gear in a sentence; empty if nothing is."""
    found = {
        axis: [f"{words} {_fact_words(fact)}" for kind, words in KINDS.items() if (fact := _of(own, axis, kind))]
        for axis in AXES
    }
    return "; ".join(f"{axis}: {', '.join(words)}" for axis, words in found.items() if words)


def gear_values(own: OwnFacts) -> dict[str, str | float | bool | None] | None:
    """Return it for JSON, flat: each figure in degrees, with its origin, its time and its count of readings.

    None if nothing is known.
    """
    found: dict[str, str | float | bool | None] = {"sentence": gear_words(own)}
    for name, fact in own.facts.items():
        if name in NAMES:
            axis, _, kind = name.partition(".")
            key = f"{axis}_{KINDS[kind].replace(' ', '_')}"
            found |= {
                f"{key}_deg": round(float(fact.value), 4), f"{key}_origin": _ORIGIN_WORDS[fact.origin],
                f"{key}_since": fact.utc.isoformat(timespec="seconds"), f"{key}_readings": fact.readings,
            }  # fmt: skip
    return found if len(found) > 1 else None


def _of(own: OwnFacts, axis: str, kind: str) -> OwnFact | None:
    return own.facts.get(f"{axis}.{kind}")


def _fact_words(fact: OwnFact) -> str:
    of = f"learnt from {fact.readings} readings at rest" if fact.readings else _ORIGIN_WORDS[fact.origin]
    return f"{fact.value:.3f}° ({of}, {fact.utc:%Y-%m-%d})"
