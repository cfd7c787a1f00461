"""Whether a target is above the horizon, and when it will be."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

from birdcage.sky.observer import Observer
from birdcage.sky.targets.model import Fixed, Satellite, SlotTarget, Target

AHEAD = timedelta(hours=24)
"""How far a rise is looked for."""
STEP = timedelta(minutes=10)
"""Of what goes round with the sky: Sun, Moon, planets, stars."""
CLOSE = timedelta(seconds=20)


def below_words(target: Target, observer: Observer, when: datetime) -> str:
    """Return the sentence for a target below the horizon, with its next rise; empty for one above it.

    BirdcageError where it has no position.
    """
    el_deg = target.look(observer, when).el_deg
    if el_deg > 0.0 or isinstance(target, Fixed):
        return ""
    below = f"{target.name} is {-el_deg:.1f}° below the horizon"
    if isinstance(target, SlotTarget):
        return f"{below} and never rises here."
    rise = next_rise(target, observer, when)
    if rise is None:
        return f"{below} and does not rise here within {AHEAD.total_seconds() / 3600.0:.0f} hours."
    return f"{below}. It rises at {rise:%H:%M} UTC."


def next_rise(target: Target, observer: Observer, when: datetime) -> datetime | None:
    """Return when a target that is below the horizon comes over it; None if that takes longer than a day."""
    when = when.astimezone(UTC)
    if isinstance(target, Satellite):
        return _next_aos(target, observer, when)
    if isinstance(target, SlotTarget | Fixed):
        return None
    before = when
    while before < when + AHEAD:
        after = before + STEP
        if target.look(observer, after).el_deg > 0.0:
            return _between(target, observer, before, after)
        before = after
    return None


def _next_aos(target: Satellite, observer: Observer, when: datetime) -> datetime | None:
    from birdcage.sky.passes.search import search
    from birdcage.sky.propagate import Fleet

    hours = AHEAD.total_seconds() / 3600.0
    found = search(Fleet((target.elements,)), observer, when, hours, 0.0, {0: target.time_offset_s})
    return found[0].aos if len(found) else None


def _between(target: Target, observer: Observer, low: datetime, high: datetime) -> datetime:
    """Halve until it is close enough: below the horizon at `low`, above it at `high`."""
    while high - low > CLOSE:
        middle = low + (high - low) / 2
        low, high = (low, middle) if target.look(observer, middle).el_deg > 0.0 else (middle, high)
    return high
