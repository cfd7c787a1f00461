"""How long an axis of a fast dish waits for its next command: which of both is due when, played ahead.

The wire carries one command at a time. Intervals as rate^-2/3 make the sum of squares of both saw-tooths least; where
one axis is twice as fast as the other its intervals are long and short by turns, and half of the one that comes is how
far ahead it aims, not half of the mean of both.
"""

from __future__ import annotations

from dataclasses import dataclass

FURTHEST = 8
"""So many commands are played ahead: one axis had none for so long only where it hardly moves."""


@dataclass(frozen=True, slots=True)
class AxisTurn:
    """What decides when it is an axis' turn; degrees on the sky, POSIX seconds."""

    rate_deg_s: float
    sent_s: float
    """When it acted on its last command."""
    latency_s: float
    least_deg: float
    """Its dead-band."""


@dataclass(frozen=True, slots=True)
class ReadingTimes:
    """When the position is read, which takes the wire as a command does."""

    next_s: float
    every_s: float
    take_s: float


@dataclass(frozen=True, slots=True)
class Interval:
    """From when an axis acts on a command until it acts on its next one."""

    mean_s: float
    variance_s2: float

    def middle_s(self, move_s: float) -> float:
        """Return how far ahead the mean of the interval lies, as a moment taken at random meets it: E[T²] / 2 E[T].

        While the axis is on its way it is half-way on the mean: that much later it aims.
        """
        return (self.mean_s + self.variance_s2 / self.mean_s + move_s) / 2.0


def need_of(off_deg: float, waits_s: float) -> float:
    """Return how much an axis wants the next command."""
    return off_deg**2 * max(waits_s, 1e-3)


def interval_of(
    column: int, turns: tuple[AxisTurn, ...], now_s: float, looks: ReadingTimes, variance_s2: float
) -> Interval:
    """Return how long an axis will wait if it gets its command now. `variance_s2`: of one exchange."""
    acts_s = free_s = now_s + turns[column].latency_s
    look_s, exchanges = looks.next_s, 0
    sent = [turn.sent_s for turn in turns]
    sent[column] = acts_s
    while exchanges < FURTHEST:
        if free_s >= look_s:
            free_s, look_s = free_s + looks.take_s, look_s + looks.every_s
            exchanges += 1
        best, most = column, 0.0
        for other, turn in enumerate(turns):
            waits_s = free_s + turn.latency_s - sent[other]
            off_deg = turn.rate_deg_s * waits_s
            if off_deg >= turn.least_deg and need_of(off_deg, waits_s) > most:
                best, most = other, need_of(off_deg, waits_s)
        free_s += turns[best].latency_s
        exchanges += 1
        if best == column:
            break
        sent[best] = free_s
    return Interval(free_s - acts_s, exchanges * variance_s2)
