"""What can be said of this machine's clock, and what an error of it costs."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Literal

from birdcage.gps.fix import LATE_S, GpsFix

DOUBTFUL_S = 1.0
"""An error above this is worth a word: on a low satellite overhead it is a degree."""
WATCH_S = 1.0
"""How well a person presses Enter at the second that was typed."""
OVERHEAD_DEG_S = 1.0
"""How fast the space station crosses the zenith: the fastest pass that is common (7.2 km/s over 415 km)."""
LOST_DEG = 60.0
"""Beyond this an error in degrees means nothing: it is another part of the sky."""
ROLLOVER = timedelta(weeks=1024)
"""Old receivers count weeks in ten bits, and begin again after this."""

Kind = Literal["gps", "watch", "network", "remembered", "unknown"]


@dataclass(frozen=True, slots=True)
class ClockVerdict:
    """How good the clock is, by whom, and when that was found."""

    kind: Kind
    source: str
    """For a person: `gpsd at localhost:2947`, `your watch`, `network time (chrony)`."""
    checked_at: datetime
    """By this machine's own clock."""
    offset_s: float | None = None
    """How far this machine is ahead of the source; None if it was not measured."""
    precision_s: float | None = None
    """How far from that the truth may be; None if unknown."""
    doubt: str = ""
    """Why the clock is doubtful, as a sentence; empty when it is good."""

    @property
    def doubtful(self) -> bool:
        """Whether it should be set, or compared, before anything fast is followed."""
        return bool(self.doubt)

    @property
    def worst_s(self) -> float | None:
        """How far off the clock may be at most; None if unknown."""
        return None if self.precision_s is None else abs(self.offset_s or 0.0) + self.precision_s

    @property
    def sentence(self) -> str:
        """All of it in one line."""
        if self.doubt:
            return self.doubt
        by = f"The clock is good by {self.source}"
        if self.offset_s is not None:
            return f"{by}: {self.offset_s:+.1f} s, to within {self.precision_s or 0.0:.1g} s."
        return f"{by}." if self.precision_s is None else f"{by}, to within {self.precision_s:.2g} s."


def by_gps(fix: GpsFix) -> ClockVerdict | None:
    """Judge by a fix; None when the receiver told no time."""
    offset_s = fix.clock_offset_s
    if offset_s is None:
        return None
    # A report names a moment that is past when it comes: half of that is taken off, and stays as doubt.
    offset_s -= LATE_S / 2
    turns = round(timedelta(seconds=offset_s) / ROLLOVER)
    if turns and abs(timedelta(seconds=offset_s) - turns * ROLLOVER) < timedelta(days=2):
        weeks = f"{abs(turns) * 1024} weeks {'back' if turns > 0 else 'ahead'}"
        doubt = f"The receiver's date is {weeks}, as old receivers' are: its time of day can't be trusted either."
        return ClockVerdict("gps", fix.source, fix.received_utc, None, None, doubt)
    return _measured("gps", fix.source, fix.received_utc, offset_s, LATE_S / 2)


def by_watch(told: datetime, now: datetime) -> ClockVerdict:
    """Judge by what a person's watch showed when this machine said `now`."""
    return _measured("watch", "your watch", now, (now - told) / timedelta(seconds=1), WATCH_S)


def cost_deg(error_s: float, rate_deg_s: float) -> float:
    """Return how far from the dish's aim a target is that moves so fast, when the clock is so wrong."""
    return abs(error_s * rate_deg_s)


def cost_sentence(verdict: ClockVerdict, rate_deg_s: float, what: str = "the space station overhead") -> str:
    """Say what a second costs, and what this clock may cost, on a target of that greatest speed."""
    second = f"One second costs {_degrees(cost_deg(1.0, rate_deg_s))} on {what} ({rate_deg_s:g}°/s)"
    if verdict.worst_s is None:
        return f"{second}; the error of this clock is unknown."
    worst_deg = cost_deg(verdict.worst_s, rate_deg_s)
    if worst_deg > LOST_DEG:
        return f"{second}; with this clock the dish points elsewhere."
    return f"{second}; this clock at most {_degrees(worst_deg)}."


def _degrees(angle: float) -> str:
    return f"{angle:.0f}°" if angle >= 10.0 else f"{angle:.2g}°"


def _measured(kind: Kind, source: str, now: datetime, offset_s: float, precision_s: float) -> ClockVerdict:
    doubt = ""
    if abs(offset_s) > DOUBTFUL_S + precision_s:
        way = "fast" if offset_s > 0 else "slow"
        doubt = f"The clock is {_span(abs(offset_s))} {way} by {source}: set it."
    return ClockVerdict(kind, source, now.astimezone(UTC), offset_s, precision_s, doubt)


def _span(seconds: float) -> str:
    for unit, length in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * length:
            return f"{seconds / length:.0f} {unit}"
    return f"{seconds:.1f} s"
