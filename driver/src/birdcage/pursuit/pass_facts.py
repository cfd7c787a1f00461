"""What a hook is told of its pass."""

from __future__ import annotations

import json
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Literal

from birdcage.pursuit.follower import reach_end, reach_start, told_reach_end

if TYPE_CHECKING:
    from birdcage.sky.downlinks import Downlink
    from birdcage.sky.observer import Observer
    from birdcage.tracking.plan import Plan

SAMPLES = 200
"""Directions that are looked at for the highest one within reach."""

Event = Literal["reach_start", "tca", "reach_end"]


@dataclass(frozen=True, slots=True)
class PassFacts:
    """One pass, as a command line of the user's sees it. Times are aware; what is not known is None."""

    name: str
    reach_start: datetime
    reach_end: datetime | None
    """None for what is always up in reach."""
    norad_id: int | None = None
    aos: datetime | None = None
    tca: datetime | None = None
    """When it is highest within reach."""
    los: datetime | None = None
    max_el_deg: float | None = None
    """Within reach."""
    freq_hz: float | None = None
    """Of its downlink."""
    site: str | None = None
    """The name of the place."""
    downlink: Downlink | None = None
    """What is sent at that frequency."""

    def is_same_pass(self, other: PassFacts) -> bool:
        """Whether `other` is the same pass, planned anew: what has run does not run again."""
        return (
            (self.name, self.norad_id) == (other.name, other.norad_id)
            and (other.reach_end is None or self.reach_start < other.reach_end)
            and (self.reach_end is None or other.reach_start < self.reach_end)
        )

    def values(self, event: Event) -> dict[str, str | float | int | None]:
        """Return what goes out: times in ISO 8601 with `Z`, frequency in Hz, angles in degrees, symbols a second.

        `pipeline` is SatDump's name for what is sent; `pipeline_live`, 1 or 0: whether it decodes it as it is received.
        """
        sent = self.downlink
        return {
            "event": event,
            "name": self.name,
            "norad": self.norad_id,
            "aos": _told(self.aos),
            "los": _told(self.los),
            "reach_start": _told(self.reach_start),
            "reach_end": _told(self.reach_end),
            "duration_s": self._duration_s(),
            "max_el": None if self.max_el_deg is None else round(self.max_el_deg, 2),
            "freq_hz": None if self.freq_hz is None else round(self.freq_hz),
            "site": self.site,
            "mode": None if sent is None else sent.mode or None,
            "polarization": None if sent is None else sent.polarization,
            "symbol_rate": None if sent is None or sent.symbol_rate_baud is None else round(sent.symbol_rate_baud),
            "pipeline": None if sent is None else sent.pipeline or None,
            "pipeline_live": None if sent is None or not sent.pipeline else int(sent.pipeline_live),
        }

    def _duration_s(self) -> float | None:
        return None if self.reach_end is None else round((self.reach_end - self.reach_start).total_seconds(), 1)

    def environment(self, event: Event) -> dict[str, str]:
        """Return them as `BIRDCAGE_EVENT` and so on; empty is what is not known, so that `set -u` does not stumble."""
        return {
            f"BIRDCAGE_{key.upper()}": "" if each is None else str(each) for key, each in self.values(event).items()
        }

    def json_line(self, event: Event) -> str:
        """Return them as one line of JSON, with null for what is not known."""
        return json.dumps(self.values(event)) + "\n"


def facts_of(plan: Plan, observer: Observer | None) -> PassFacts | None:
    """Return what a hook is told; None if nothing can be reached."""
    import numpy as np

    start, end = reach_start(plan), reach_end(plan)
    if start is None or end is None:
        return None
    times = np.linspace(max(start.timestamp(), plan.sky.start_s), min(end.timestamp(), plan.sky.end_s), SAMPLES)
    elevations = plan.sky.sample(times)[1]
    top = int(np.argmax(elevations))
    passing = plan.passing
    return PassFacts(
        name=plan.aim.name, reach_start=start, reach_end=told_reach_end(plan), norad_id=plan.aim.norad_id,
        aos=None if passing is None else passing.aos,
        tca=None if passing is None else datetime.fromtimestamp(float(times[top]), UTC),
        los=None if passing is None else passing.los, max_el_deg=float(elevations[top]),
        freq_hz=plan.aim.frequency_hz, downlink=plan.aim.downlink,
        site=(observer.name or None) if observer is not None else None,
    )  # fmt: skip


def _told(moment: datetime | None) -> str | None:
    if moment is None:
        return None
    return moment.astimezone(UTC).isoformat(timespec="seconds").replace("+00:00", "Z")
