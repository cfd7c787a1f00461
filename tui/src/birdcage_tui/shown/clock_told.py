"""What the pages say of this machine's clock: values and words, made off the app's thread (`clock_watch`)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.gps.verdict import ClockVerdict

BY = {"gps": "GPS", "watch": "your watch", "network": "NTP"}


@dataclass(frozen=True, slots=True)
class ClockTold:
    """How good the clock is."""

    words: str
    """`NTP ±0.02 s`, `not known`, `doubtful`."""
    glyph: str
    ink: str
    doubt: str = ""
    """Why it is doubtful, and what to do; empty when it is not."""
    cost: str = ""
    """What an error costs; empty when the clock is good."""


def clock_told(verdict: ClockVerdict) -> ClockTold:
    """Return what to say of a verdict."""
    from birdcage.gps.verdict import OVERHEAD_DEG_S, cost_sentence

    if not verdict.doubtful:
        return ClockTold(_good(verdict), "●", "good")
    cost = cost_sentence(verdict, OVERHEAD_DEG_S)
    if verdict.kind == "unknown":
        return ClockTold("unknown", "·", "dim", verdict.doubt, cost)
    return ClockTold(
        "doubtful" if verdict.worst_s is None else f"doubtful: {_wrong(verdict, verdict.worst_s)}",
        "▲",
        "warn",
        verdict.doubt,
        cost,
    )


def _wrong(verdict: ClockVerdict, worst_s: float) -> str:
    """Return how wrong it is or may be, and what that is on a low satellite overhead."""
    from birdcage.gps.verdict import LOST_DEG, OVERHEAD_DEG_S, cost_deg

    offset_s = verdict.offset_s
    if offset_s is not None and verdict.kind != "remembered":
        off = f"{_span(abs(offset_s))} {'fast' if offset_s > 0 else 'slow'}"
    else:
        off = f"±{_span(worst_s)}"
    worst_deg = cost_deg(worst_s, OVERHEAD_DEG_S)
    return f"{off}, targets can't be found" if worst_deg > LOST_DEG else f"{off}, ±{worst_deg:.1f}° overhead"


def _span(seconds: float) -> str:
    for unit, length in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * length:
            return f"{seconds / length:.0f} {unit}"
    return f"{seconds:.1f} s"


def clock_scaled(rate: float) -> ClockTold:
    """Return what to say of a clock that this program makes itself."""
    return ClockTold(f"simulated, {rate:g} times as fast", "·", "dim")


def _good(verdict: ClockVerdict) -> str:
    by = BY.get(verdict.kind, f"by {verdict.source}")
    worst_s = verdict.worst_s
    if worst_s is None:
        return by
    return f"{by} ±{max(worst_s, 0.01):.2f} s" if worst_s < 1.0 else f"{by} ±{worst_s:.1f} s"
