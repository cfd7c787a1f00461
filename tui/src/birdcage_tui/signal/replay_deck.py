"""A recording that is played: where it stands, how fast it goes, and what was read of it so far."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime, timedelta

from birdcage.signal.recording import RecordedReading
from birdcage.signal.replay import Tape, TapePiece, TapeWindow

SPEEDS = (0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0)
SPAN_S = 60.0
"""What the strip shows."""
AHEAD_S = 4.0
"""So long before what was read comes to its end, in seconds of a person, more is read."""


@dataclass
class ReplayDeck:
    """For the app's thread. Whoever has it reads `wanted`, and hands over what was read."""

    tape: Tape
    window: TapeWindow | None = None
    speed: float = 1.0
    paused: bool = False
    _at: datetime = field(init=False)
    _since: float | None = None
    """The monotonic time at which it stood there."""

    def __post_init__(self) -> None:
        self._at = self.tape.begins

    @property
    def at(self) -> datetime:
        """The moment that is shown."""
        return self._at

    @property
    def is_over(self) -> bool:
        """Whether it stands at its end."""
        return self._at >= self.tape.ends

    def play(self, now: float) -> None:
        """Go on to a monotonic time; wait at the end of what was read, and at that of the recording."""
        before, self._since = self._since, now
        if before is None or self.paused or not self._reaches(self._at):
            return
        at = self._at + timedelta(seconds=max(now - before, 0.0) * self.speed)
        assert self.window is not None, "it reaches there"
        self._at = min(at, self.tape.ends, max(self.window.ends, self._at))

    def pause(self) -> None:
        """Stand still, or go on; at the end, from the beginning."""
        if self.is_over and not self.paused:
            self.jump(self.tape.begins)
            return
        self.paused = not self.paused

    def change_speed(self, steps: int) -> None:
        """Go faster by so many steps, slower by negative ones."""
        index = min(max(SPEEDS.index(self.speed) + steps, 0), len(SPEEDS) - 1)
        self.speed = SPEEDS[index]

    def jump(self, to: datetime) -> None:
        """Stand at a moment, or at the end that is nearer."""
        self._at = min(max(to, self.tape.begins), self.tape.ends)

    @property
    def wanted(self) -> tuple[datetime, datetime] | None:
        """What is to be read next: from when to when; None while there is enough."""
        ahead = timedelta(seconds=AHEAD_S * self.speed)
        if self._reaches(self._at) and self._reaches(min(self._at + ahead, self.tape.ends)):
            return None
        span = timedelta(seconds=SPAN_S)
        return self._at - span, min(self._at + 4.0 * ahead + span, self.tape.ends)

    def take(self, window: TapeWindow) -> None:
        """Take what was read; of no use where it was jumped meanwhile."""
        self.window = window

    def _reaches(self, moment: datetime) -> bool:
        span = timedelta(seconds=SPAN_S)
        window = self.window
        return window is not None and window.begins <= self._at - span and moment <= window.ends

    @property
    def heard(self) -> Sequence[RecordedReading]:
        """What was heard in the last `SPAN_S` before the moment, the newest last."""
        if self.window is None or not self._reaches(self._at):
            return ()
        since = self._at - timedelta(seconds=SPAN_S)
        return [each for each in self.window.readings if since <= each.utc <= self._at]

    @property
    def is_reading(self) -> bool:
        """Whether what is shown is still to be read from the disk."""
        return not self._reaches(self._at)

    @property
    def best(self) -> TapePiece | None:
        """The part with the strongest signal from the beginning to this moment; None before it was read."""
        known = [piece for piece in self.tape.pieces if piece.high_at <= self._at]
        return max(known, key=lambda piece: piece.high, default=None)

    @property
    def part(self) -> float:
        """Which part of it lies behind, 0 to 1."""
        span_s = (self.tape.ends - self.tape.begins).total_seconds()
        return 1.0 if span_s <= 0.0 else (self._at - self.tape.begins).total_seconds() / span_s


def digits_of(values: Sequence[float]) -> int:
    """Return how many digits behind the point values have that are worth showing: none for whole counts."""
    return 1 if any(value % 1.0 for value in values) else 0
