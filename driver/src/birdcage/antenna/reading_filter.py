"""Whether a reading can be true: a digit that was lost or changed on its way makes a number as good as any other."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from birdcage.base.clock import Clock
from birdcage.base.errors import NoReply
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import Position

NEAR_DEG = 0.05
"""How far apart two readings of a dish at rest may lie."""
ROUND_DEG = 0.02
"""How far a reading may lie outside what is expected of it: angles are printed in hundredths, and axes go in steps."""
JITTER_S = 0.03
"""How much sooner or later than the one before a dish may take its reading."""
MOST_READS = 6
STRICT_READS = 3
"""How many readings must fit together as the motion is expected, or evenly; then that the axes can do it is enough."""
DIGIT_DEG = 1.0
"""Where a changed digit of a dish that stands still would be taken for an arrival: from whole degrees on."""

LEAST_DAMAGE_DEG = 0.5
"""A pair that is off by less than this is taken: so near a dish goes by itself, a step of its target at a time."""


CLEAN_READS = 100
"""After so many readings in a row that no other one contradicted, one that is as expected is believed at once, even if
a changed digit would make it of the one before: a move by whole degrees does that, too."""


@dataclass(frozen=True, slots=True)
class AngleSpan:
    """Where an axis may be when it is read, in degrees that may go on beyond 0..360."""

    low_deg: float
    high_deg: float
    rate_deg_s: float
    """How fast it then is, by the clock."""


@dataclass(frozen=True, slots=True)
class Expected:
    """What the motion that was sent lets a reading be. Each axis has a few spans, and is in one of them."""

    motion: object
    """Equal for one and the same motion."""
    axes: tuple[tuple[AngleSpan, ...], ...]
    """Azimuth, elevation and, where it was read before, skew. None of an axis: not known well enough."""


Foresight = Callable[[Position, float, float], Expected | None]
"""From a reading, when it was made and when the next one is: what that must be. None: no motion is known."""


@dataclass(frozen=True, slots=True)
class _Seen:
    position: Position
    at: float
    rates: tuple[float, ...] = ()
    """Degrees a second of each axis."""


class ReadingFilter:
    """Takes a reading that goes on where the last ones ended; asks again for any other, until two agree.

    A dish at rest, or under way as expected, is so asked once; one that does anything else, twice. Two readings that
    one damaged digit would make of the last that was believed may both be damaged: then a third must agree.
    """

    def __init__(self, model: Facts) -> None:
        self._model = model
        self._last: _Seen | None = None
        self._taken: _Seen | None = None
        """The last reading that was believed, also when readings did not fit together since."""
        self._clean = 0
        """How many readings in a row were contradicted by none."""
        self._astray: object = None
        """The motion that the dish was seen not to follow."""
        self.foresee: Foresight = lambda _position, _at, _now: None

    def read(self, once: Callable[[], Position], clock: Clock) -> Position:
        """Return what `once` reads, or reads again. NoReply (`garbage`) when no two readings in a row agree."""
        now = clock.monotonic
        seen = _Seen(once(), now())
        self._clean += 1
        expected = self._expected(self._last, seen.at)
        if expected is not None:
            rates = self._fits(seen, expected)
            if rates is not None:
                return self._take(seen, rates)
        elif self._goes_on(seen):
            return self._take(seen)
        earlier: _Seen | None = None
        doubted, strict = False, STRICT_READS
        for count in range(2, MOST_READS + 1):
            before, seen = seen, _Seen(once(), now())
            even = count > strict or (earlier is not None and _evenly(earlier, before, seen))
            if self._agree(before, seen):
                if doubted or self._taken is None or not _may_be_damaged(self._taken, seen):
                    return self._take_agreed(before, seen)
                doubted, strict = True, MOST_READS - 1
            elif even and self._can_do(before, seen, clock.rate):
                return self._take_agreed(before, seen)
            else:
                doubted, self._clean = False, 0
            earlier = before
        self._last = None
        raise NoReply(
            "The dish reports angles that do not fit together: bytes change on the wire.", reason=Reason.GARBAGE
        )

    def _expected(self, last: _Seen | None, now: float) -> Expected | None:
        expected = None if last is None else self.foresee(last.position, last.at, now)
        return None if expected is None or expected.motion == self._astray else expected

    def _fits(self, seen: _Seen, expected: Expected) -> tuple[float, ...] | None:
        """Return the rate of each axis if the reading is as expected, and not one that a changed digit would make."""
        angles = _angles(seen.position)
        if len(angles) != len(expected.axes):
            return None
        spans = [
            next((span for span in spans if _is_in(angle, span)), None)
            for angle, spans in zip(angles, expected.axes, strict=True)
        ]
        rates = tuple(span.rate_deg_s for span in spans if span is not None)
        last = self._last
        if len(rates) < len(angles):
            return None
        doubted = last is not None and self._clean <= CLEAN_READS and _differs_by_a_digit(last.position, seen.position)
        return None if doubted else rates

    def _goes_on(self, seen: _Seen) -> bool:
        return self._last is not None and _keeps(self._last, self._last.rates, seen)

    def _agree(self, one: _Seen, other: _Seen) -> bool:
        if _keeps(one, (0.0,) * len(_angles(one.position)), other):
            return True
        expected = self._expected(one, other.at)
        return expected is not None and self._fits(other, expected) is not None

    def _can_do(self, one: _Seen, other: _Seen, rate: float) -> bool:
        ways, past_s = _ways(one.position, other.position), other.at - one.at
        axes = self._model.azimuth, self._model.elevation, self._model.skew
        speeds = [axis.speed_deg_s * rate if axis.speed_known else math.inf for axis in axes if axis]
        return _same_axes(one, other) and all(
            abs(way) <= NEAR_DEG + speed * (past_s + JITTER_S) for way, speed in zip(ways, speeds, strict=False)
        )

    def _take_agreed(self, before: _Seen, seen: _Seen) -> Position:
        """Take the second of two readings that agree; what they contradict is not gone by again."""
        whole, onward = self._expected(self._last, seen.at), self._expected(before, seen.at)
        rates = None if onward is None else self._fits(seen, onward)
        if whole is not None and all(whole.axes) and self._fits(seen, whole) is None:
            self._astray, rates = whole.motion, None
        return self._take(seen, rates)

    def _take(self, seen: _Seen, rates: tuple[float, ...] | None = None) -> Position:
        last = self._last
        if rates is None:
            ways = () if last is None or seen.at <= last.at else _ways(last.position, seen.position)
            angles = _angles(seen.position)
            rates = (0.0,) * len(angles)
            if last is not None and len(ways) == len(angles):
                rates = tuple(way / (seen.at - last.at) for way in ways)
        self._last = self._taken = _Seen(seen.position, seen.at, rates)
        return seen.position


def _angles(position: Position) -> tuple[float, ...]:
    both = position.azimuth, position.elevation
    return both if position.skew is None else (*both, position.skew)


def _ways(one: Position, other: Position) -> tuple[float, ...]:
    """Return how far each axis went from one to the other; the skew where both have it."""
    ways = shortest_turn(one.azimuth, other.azimuth), other.elevation - one.elevation
    return ways if one.skew is None or other.skew is None else (*ways, other.skew - one.skew)


def _same_axes(one: _Seen, other: _Seen) -> bool:
    return (one.position.skew is None) is (other.position.skew is None)


def _keeps(one: _Seen, rates: tuple[float, ...], other: _Seen) -> bool:
    """Return whether each axis went on from one reading to the other at its rate."""
    ways, past_s = _ways(one.position, other.position), other.at - one.at
    return (
        _same_axes(one, other)
        and len(ways) == len(rates)
        and all(
            abs(way - rate * past_s) <= NEAR_DEG + abs(rate) * JITTER_S for way, rate in zip(ways, rates, strict=True)
        )
    )


def _evenly(one: _Seen, two: _Seen, three: _Seen) -> bool:
    """Return whether three readings are those of axes at an even speed."""
    past_s = two.at - one.at
    return past_s > 0 and _keeps(two, tuple(way / past_s for way in _ways(one.position, two.position)), three)


def _is_in(angle_deg: float, span: AngleSpan) -> bool:
    middle, half = (span.low_deg + span.high_deg) / 2, (span.high_deg - span.low_deg) / 2
    return abs(shortest_turn(middle, angle_deg)) <= half + ROUND_DEG


def _differs_by_a_digit(one: Position, other: Position) -> bool:
    """Return whether one digit, of whole degrees or more, makes one reading of the other."""
    for first, second in zip(_angles(one), _angles(other), strict=False):
        texts = f"{abs(first):06.2f}", f"{abs(second):06.2f}"
        changed = [a != b for a, b in zip(*texts, strict=False)]
        if abs(first - second) >= DIGIT_DEG and changed.count(True) == 1:
            return True
    return False


def _may_be_damaged(last: _Seen, seen: _Seen) -> bool:
    """Return whether one digit lost, doubled or changed makes this reading of where the axes may be since the last."""
    past_s = seen.at - last.at
    rates = last.rates or (0.0,) * len(_angles(last.position))
    for here, there, rate in zip(_angles(last.position), _angles(seen.position), rates, strict=False):
        loose_deg = NEAR_DEG + abs(rate) * past_s
        if abs(there - here) < LEAST_DAMAGE_DEG + loose_deg:
            continue
        if any(abs(there - damaged) <= loose_deg for damaged in _damaged(here)):
            return True
    return False


def _damaged(angle_deg: float) -> set[float]:
    """Return what one digit lost, doubled or changed makes of a printed angle."""
    text = f"{angle_deg:.2f}"
    made = set()
    for at, sign in enumerate(text):
        if sign.isdigit():
            others = ("", sign * 2, *"0123456789")
            made |= {f"{text[:at]}{other}{text[at + 1 :]}" for other in others}
        elif sign == "-":
            made.add(text[:at] + text[at + 1 :])
    return {float(each) for each in made if any(sign.isdigit() for sign in each)}
