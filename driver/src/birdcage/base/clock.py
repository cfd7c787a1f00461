"""The one place where time is read and waited for.

Three makes: `RealClock`, `ScaledClock` (UTC and mechanics run n times faster, wire deadlines stay real seconds) and
`VirtualClock` (no threads, no waiting: `wait` jumps to the next thing that happens).
"""

from __future__ import annotations

import math
import select
import time
from datetime import UTC, datetime, timedelta
from enum import Enum
from typing import Protocol

from birdcage.base.wake import Wake

POLL_SLICE_S = 0.005
"""How often an endpoint is looked at that has neither a descriptor nor a timetable (`socket://` on Windows, say)."""


class WaitOutcome(Enum):
    """Why a wait ended."""

    READY = "ready"
    TIMEOUT = "timeout"
    INTERRUPTED = "interrupted"


class Endpoint(Protocol):
    """Something that bytes may arrive at."""

    def fileno(self) -> int | None:
        """A descriptor that `select` takes, or None."""

    def pending(self) -> bool:
        """Whether bytes can be read at this moment."""

    def next_event(self) -> float | None:
        """When it may become readable by itself, in monotonic seconds; `inf` for never, None when it can't know."""


class Clock(Protocol):
    """Reads the time and waits for it."""

    rate: float
    """How many seconds of UTC and mechanics pass in one second of `monotonic`."""

    def monotonic(self) -> float:
        """Seconds on a scale that never steps back; deadlines on the wire are counted on it."""

    def utc(self) -> datetime:
        """The time of day, aware, in UTC."""

    def wait(self, endpoint: Endpoint | None, until: float, wake: Wake | None = None) -> WaitOutcome:
        """Wait until `endpoint` has bytes, `wake` is set, or `monotonic()` reaches `until`, in that order of rank."""


class RealClock:
    """The clock on the wall."""

    rate = 1.0

    def monotonic(self) -> float:
        """Return seconds of the system's monotonic clock (it stands still while the machine is suspended)."""
        return time.monotonic()

    def utc(self) -> datetime:
        """Return the system's time of day."""
        return datetime.now(UTC)

    def wait(self, endpoint: Endpoint | None, until: float, wake: Wake | None = None) -> WaitOutcome:
        """Wait in `select` where there is a descriptor, by timetable for a simulator, in slices of 5 ms elsewhere."""
        while True:
            if wake is not None and wake.is_set():
                return WaitOutcome.INTERRUPTED
            if endpoint is not None and endpoint.pending():
                return WaitOutcome.READY
            now = self.monotonic()
            if now >= until:
                return WaitOutcome.TIMEOUT
            self._sleep(endpoint, until - now, wake)

    def _sleep(self, endpoint: Endpoint | None, longest_s: float, wake: Wake | None) -> None:
        descriptors = [wake.fileno()] if wake is not None else []
        if endpoint is not None:
            descriptor = endpoint.fileno()
            if descriptor is not None:
                descriptors.append(descriptor)
            else:
                event = endpoint.next_event()
                slice_s = POLL_SLICE_S if event is None else event - self.monotonic()
                longest_s = min(longest_s, max(slice_s, 0.0))
        timeout_s = min(longest_s, 3600.0)
        if descriptors:
            select.select(descriptors, [], [], timeout_s)
        else:
            time.sleep(timeout_s)


class ScaledClock(RealClock):
    """A real clock whose UTC and mechanics run `rate` times faster, for the demo and the simulator only."""

    def __init__(self, rate: float) -> None:
        if not (math.isfinite(rate) and rate > 0):
            raise ValueError(f"the speed must be a positive number, not {rate}")
        self.rate = rate
        self._start = time.monotonic()
        self._start_utc = datetime.now(UTC)

    def utc(self) -> datetime:
        """Return the scaled time of day, equal to the wall's at construction."""
        return self._start_utc + timedelta(seconds=(self.monotonic() - self._start) * self.rate)


class VirtualClock:
    """A clock that moves only when somebody waits. For tests: station, link and simulator run in one thread."""

    rate = 1.0

    def __init__(self, utc: datetime = datetime(2026, 3, 20, 12, 0, 0, tzinfo=UTC)) -> None:
        self._now = 1000.0
        self._utc_at_zero = utc - timedelta(seconds=self._now)

    def monotonic(self) -> float:
        """Return virtual seconds."""
        return self._now

    def utc(self) -> datetime:
        """Return virtual UTC."""
        return self._utc_at_zero + timedelta(seconds=self._now)

    def step_utc(self, seconds: float) -> None:
        """Step the time of day alone, as NTP or a resumed laptop does."""
        self._utc_at_zero += timedelta(seconds=seconds)

    def advance(self, seconds: float) -> None:
        """Let time pass without watching the wire."""
        self._now += seconds

    def wait(self, endpoint: Endpoint | None, until: float, wake: Wake | None = None) -> WaitOutcome:
        """Jump to the endpoint's next event, or to `until`; never block."""
        while True:
            if wake is not None and wake.is_set():
                return WaitOutcome.INTERRUPTED
            if endpoint is not None and endpoint.pending():
                return WaitOutcome.READY
            if self._now >= until:
                return WaitOutcome.TIMEOUT
            event = endpoint.next_event() if endpoint is not None else math.inf
            goal = min(until, math.inf if event is None else event)
            if math.isinf(goal):
                raise RuntimeError("a virtual clock was asked to wait for something that never happens")
            self._now = max(math.nextafter(self._now, math.inf), goal)
