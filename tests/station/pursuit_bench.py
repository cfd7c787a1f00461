"""A station with a simulated dish, and plans of made-up passes to follow with it."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import PassReach
from birdcage.station.pursuit_state import Phase, PursuitOptions
from birdcage.station.requests import Pursue
from birdcage.tracking.curve import Curve
from birdcage.tracking.plan import Plan, PlanLeg, PlanPart, PlanTarget, Preposition

from .conftest import Bench
from .queued_bench import connected

PARK = {"park_az_deg": 180.0, "park_el_deg": 45.0}


def at(bench):
    return bench.clock.utc().timestamp()


def plan_of(
    start_s, *, lasts_s=120.0, from_az=100.0, az_rate=0.5, low=30.0, high=50.0, leave_s=None, name="NOAA 19",
    gap=None, rewind_s=None, turn=None, late_s=0.0,
):  # fmt: skip
    """A pass that turns evenly in azimuth and rises and sinks in elevation; `gap` is (from, to) after its start."""
    t = np.arange(0.0, lasts_s + 0.5, 1.0)
    az = from_az + az_rate * (t - late_s)
    el = low + (high - low) * np.sin(np.pi * np.clip(t - late_s, 0, lasts_s) / lasts_s)
    curve = Curve(start_s + t, az, el)
    end_s = start_s + lasts_s
    pieces = [(PlanPart.FOLLOW, start_s, end_s)]
    if gap is not None:
        pieces = [(PlanPart.FOLLOW, start_s, start_s + gap[0]), (PlanPart.FOLLOW, start_s + gap[1], end_s)]
    elif rewind_s is not None:
        half = start_s + lasts_s / 2
        pieces = [
            (PlanPart.FOLLOW, start_s, half), (PlanPart.REWIND, half, half + rewind_s), (PlanPart.FOLLOW,
            half + rewind_s, end_s),
        ]  # fmt: skip
    legs = tuple(PlanLeg(part, a, b, curve.at(a)[0], curve.at(b)[0], turn) for part, a, b in pieces)
    first = curve.at(start_s)
    wait = Preposition(
        *first, first[0] % 360.0, first[1], (first,), start_s - 15.0 if leave_s is None else leave_s, 4.0
    )
    utc = [datetime.fromtimestamp(when, UTC) for when in (start_s, start_s + lasts_s / 2, end_s)]
    passing = Pass(name, 33591, *utc, from_az, from_az, from_az, high)
    return Plan(
        PlanTarget(name, "satellite", 33591, time_offset_s=late_s), utc[0], passing, PassReach((), (), high),
        Curve(curve.t_s, curve.az_deg % 360.0 if curve.az_deg.max() < 360 else curve.az_deg, curve.el_deg), curve, legs,
        wait, (), None, (),
    )  # fmt: skip


class PursuitBench(Bench):
    """With the phases that were told, in order."""

    def __post_init__(self):
        super().__post_init__()
        self.phases = []
        self.samples = []
        self.station.subscribe(self._hear)

    def _hear(self, event):
        name = type(event).__name__
        if name == "PursuitChanged" and (not self.phases or self.phases[-1] is not event.pursuit.phase):
            self.phases.append(event.pursuit.phase)
        elif name == "Followed":
            self.samples.append(event.sample)

    @property
    def pursuit(self):
        return self.state.pursuit

    def pursue(self, plan, *, holder="you", asked=True, **options):
        return self.do(Pursue(plan, holder, PursuitOptions(**options), asked))

    def until(self, phase, seconds=400.0):
        """Step until the pursuit is in a phase."""
        end = self.clock.monotonic() + seconds
        while self.clock.monotonic() < end:
            if self.pursuit is not None and self.pursuit.phase is phase:
                return self
            self.step(0.05)
        raise AssertionError(f"it never came to {phase}: {self.phases}, {self.pursuit.why}")


def g2(**options):
    return PursuitBench("g2?seed=1", options=options).connect()


class QueuedPursuit(PursuitBench):
    """The same with a Trav'ler."""

    def __init__(self):
        PursuitBench.__init__(self, "hal205?seed=1", {}, "hal205")


def travler():
    bench = QueuedPursuit()
    bench.connect(12.0)
    bench.step(10.0)
    return bench


__all__ = ["PARK", "Phase", "at", "connected", "g2", "plan_of", "travler"]
