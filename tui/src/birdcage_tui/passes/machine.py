"""The time machine: which moment the page shows. It is a view alone; no clock and no dish knows of it."""

from __future__ import annotations

SPEEDS = (1, 10, 60, 300, 900)
"""How many seconds of view pass in one, at choice."""


class TimeMachine:
    """Shows now, or another moment that stands still or runs. All times are POSIX seconds of the app's clock."""

    def __init__(self) -> None:
        self._anchor: tuple[float, float] | None = None
        """A moment of now, and which one was shown then; None: now is shown."""
        self.speed = 1
        self.paused = False
        self.bounds: tuple[float, float] | None = None
        """From when until when there is something to show."""

    @property
    def is_now(self) -> bool:
        """Whether the page shows now."""
        return self._anchor is None

    @property
    def runs(self) -> bool:
        """Whether what is shown moves on by itself, other than now does."""
        return self._anchor is not None and not self.paused

    def time(self, now_s: float) -> float:
        """Return the moment that is shown."""
        if self._anchor is None:
            return now_s
        since_s, shown_s = self._anchor
        return self._within(shown_s + (0.0 if self.paused else (now_s - since_s) * self.speed))

    def _within(self, t_s: float) -> float:
        return t_s if self.bounds is None else min(max(t_s, self.bounds[0]), self.bounds[1])

    def to(self, now_s: float, t_s: float) -> None:
        """Show another moment; it goes on as before, and a first one at the pace of the clock."""
        self._anchor = (now_s, self._within(t_s))

    def shift(self, now_s: float, by_s: float) -> None:
        """Show a moment earlier or later."""
        self.to(now_s, self.time(now_s) + by_s)

    def pause(self, now_s: float) -> None:
        """Let time stand still, or go on."""
        shown_s = self.time(now_s)
        self.paused = not self.paused
        self._anchor = (now_s, shown_s)

    def faster(self, now_s: float, by: int) -> None:
        """Take the next speed, up or down."""
        shown_s = self.time(now_s)
        index = SPEEDS.index(self.speed) + by
        self.speed = SPEEDS[min(max(index, 0), len(SPEEDS) - 1)]
        self.paused = False
        self._anchor = (now_s, shown_s)

    def back_to_now(self) -> None:
        """Show now again, at its own pace."""
        self._anchor, self.speed, self.paused = None, 1, False
