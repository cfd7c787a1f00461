"""How long the answers of a stream of commands are waited for: by how long they took so far."""

from __future__ import annotations

LEAST_S = 0.15
"""An answer is waited for so long at least, in real seconds."""
GUESS = 3.0
"""Before any answer of a stream has come: so many times the last round trip."""
_MEAN, _SPREAD, _WIDE = 1 / 8, 1 / 4, 4.0
"""What a new one counts, and how many mean deviations are waited for: as TCP does it (RFC 6298)."""


class Pace:
    """Smooths round trips. From the second on, an answer in a row that did not come in time doubles the patience."""

    def __init__(self) -> None:
        self._mean_s: float | None = None
        self._spread_s = 0.0
        self._missed = 0

    def take(self, round_trip_s: float) -> None:
        """Take in how long an answer took."""
        self._missed = 0
        if self._mean_s is None:
            self._mean_s, self._spread_s = round_trip_s, round_trip_s / 2
            return
        off_s = round_trip_s - self._mean_s
        self._spread_s += _SPREAD * (abs(off_s) - self._spread_s)
        self._mean_s += _MEAN * off_s

    def miss(self) -> None:
        """Take in that an answer did not come in time."""
        self._missed += 1

    def patience_s(self, guess_s: float, most_s: float) -> float:
        """Return how long to wait for the next one; `guess_s` is the last round trip of any other line."""
        due_s = GUESS * guess_s if self._mean_s is None else self._mean_s + _WIDE * self._spread_s
        return min(max(LEAST_S, due_s) * 2.0 ** max(self._missed - 1, 0), most_s)
