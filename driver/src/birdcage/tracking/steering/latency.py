"""How long a command is on its way, and how often an axis gets one: measured at the prompt, and smoothed."""

from __future__ import annotations

from birdcage.rotator.facts import Facts
from birdcage.tracking.steps import StepResult

SHARE = 0.15
"""What a new measurement counts: six commands, a second or so, until a change shows."""
LASTING = 0.05
"""The same of a latency: what varies from command to command is not mistaken for a change."""
WILDEST = 4.0
"""A measurement counts as at most so many times what is known: one lost answer does not move the aim."""
REPLY_BYTES = 30
"""Of a move: what comes back after the dish has taken it, echo left out (`docs/reference/consoles.md`, *Variants*)."""
READING_BYTES = 45
"""Of a position: two lines and the prompt."""
BITS_A_BYTE = 10


class Smoothed:
    """A mean that follows its measurements slowly: seconds, unless it is made of something else."""

    def __init__(self, first_s: float, share: float = SHARE) -> None:
        self.seconds = first_s
        self._share = share
        self._taken = 0

    def take(self, measured_s: float) -> None:
        """Take in a measurement. The first ones count for more: a guess is soon forgotten."""
        self._taken += 1
        share = max(self._share, 1.0 / (self._taken + 1))
        self.seconds += share * (min(max(measured_s, 0.0), WILDEST * self.seconds) - self.seconds)


class Latency:
    """From the first byte of a command until the dish acts, for each axis.

    The shell has one thread (`docs/reference/consoles.md`, *Shell*). It is taken to answer when it has carried the
    command out, so a dish acts at the end of the round trip, less what the answer takes on the wire. Where the answer
    comes only when the move is over (of some that is unknown) the move is taken off as well.
    """

    def __init__(self, model: Facts, first_s: float) -> None:
        self._reading_s = model.bits_s(READING_BYTES * BITS_A_BYTE)
        self._reply_s = model.bits_s(REPLY_BYTES * BITS_A_BYTE)
        self._both = model.azimuth.index, model.elevation.index
        self._axes = {axis.index: Smoothed(first_s, LASTING) for axis in model.axes}
        self._trip = Smoothed(first_s, LASTING)
        self._square = Smoothed(first_s * first_s, LASTING)
        self._waits = {True: Smoothed(first_s), False: Smoothed(first_s)}
        self._misfit = {True: Smoothed(first_s), False: Smoothed(first_s)}

    @property
    def blocks(self) -> bool:
        """Whether the answers fit a dish better that answers only at rest."""
        return self._misfit[True].seconds < 0.5 * self._misfit[False].seconds

    def of(self, axis: int) -> float:
        """Return how long the next command of an axis will take to act."""
        return self._axes[axis].seconds

    @property
    def variance_s2(self) -> float:
        """How much one exchange differs from the next: the mean square, in square seconds."""
        return max(self._square.seconds - self._trip.seconds**2, 0.0)

    @property
    def mean_s(self) -> float:
        """That of azimuth and elevation."""
        return sum(self._axes[index].seconds for index in self._both) / 2.0

    def seen_s(self, answer: StepResult) -> float:
        """Return when the dish was where a reading says: as it answers, not as it is asked."""
        return answer.now_s - self._reading_s

    def measure(self, axis: int, answer: StepResult, move_s: float) -> float:
        """Take in what came of a command whose move takes `move_s`; return when the dish acted on it, POSIX seconds."""
        if answer.sent_s is None:
            return answer.now_s
        trip_s = max(answer.now_s - answer.sent_s - self._reply_s, 0.0)
        for blocking, wait_s in ((True, trip_s - move_s), (False, trip_s)):
            # Whichever of both readings explains the answers with less scatter is the true one.
            self._misfit[blocking].take(abs(wait_s - self._waits[blocking].seconds))
            self._waits[blocking].take(wait_s)
        if self.blocks:
            trip_s = max(trip_s - move_s, 0.0)
        self._axes[axis].take(trip_s)
        self._trip.take(trip_s)
        self._square.take(trip_s * trip_s)
        return answer.sent_s + trip_s
