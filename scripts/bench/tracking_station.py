"""Follows a pass with the whole station: of a dish that tells no position at rest, only that knows how to drive it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from multiprocessing.pool import Pool
from statistics import fmean, median

import numpy as np
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.geometry import separation
from birdcage.link.link import Link
from birdcage.sim.port import SimPort, open_device
from birdcage.sky.targets.model import Satellite
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit_state import PursuitOptions
from birdcage.station.requests import Goto, Pursue
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.station import Station
from birdcage.tracking.plan import PlanPart
from birdcage.tracking.planning.planner import plan_pass
from tracking_passes import Case

FIRMWARE = "carryout"
EARLY_S = 300.0
LEAST_S = 60.0
SETTLED_S = 5.0
SAMPLES_HZ = 20.0
GUESSES = {
    "as guessed": "",
    "no records": "record=moving",
    "prompt at once": "prompt_when=at_once",
    "axes in turn": "g_axes=turn",
    "a second move waits": "second_move=queue",
    "as slow as taken": "speed=5&accel=5",
    "slow and no records": "speed=5&accel=5&record=moving",
    "records each second": "record_s=1&record_last=0",
    "cable of 455°": "wrap=455",
}
"""What is not known of this dish: each is as likely as any other."""


@dataclass(frozen=True)
class Attempt:
    """A pass, and what is guessed of the dish."""

    case: Case
    options: str
    seed: int = 1


@dataclass(frozen=True)
class Told:
    """Degrees on the sky, and what was foreseen of them."""

    rms: float
    worst: float
    foreseen_rms: float
    foreseen_worst: float
    beyond: float
    """The greatest excess over the error foreseen for its own half minute, root mean square."""

    @property
    def ratio(self) -> float:
        """How much of the error that was foreseen it has."""
        return self.rms / self.foreseen_rms


def attempt(work: Attempt) -> Told | None:
    """Follow a pass; None where it is out of the dish's reach, or for less than a minute within."""
    clock = VirtualClock(datetime.fromtimestamp(work.case.passing.aos.timestamp() - EARLY_S, UTC))
    options = "&".join(filter(None, (work.options, "latency_min=0.02", "latency_max=0.1", f"seed={work.seed}")))
    device = open_device(f"{FIRMWARE}?{options}", clock=clock)
    settings = StationSettings(
        port="sim:bench", firmware=FIRMWARE,
        open_link=lambda port, baud: Link(SimPort(device, port, baud=baud), clock),
    )  # fmt: skip
    session = Session(clock, station := Station(clock, settings))
    session.step(10.0)
    assert station.state.link.state is LinkNow.UP, station.state.link
    place = station.submit(Goto(180.0, 45.0, "bench"))
    while not place.done():
        session.step(1.0)
    place.result(0)
    plan = plan_pass(
        Satellite(work.case.satellite), work.case.observer, mount_of(station.state, Settings()), clock.utc(),
        passing=work.case.passing,
    )  # fmt: skip
    legs = [leg for leg in plan.legs if leg.part is PlanPart.FOLLOW]
    if plan.forecast is None or sum(leg.end_s - leg.start_s for leg in legs) < LEAST_S:
        return None
    forecast = plan.forecast
    station.submit(Pursue(plan, "bench", PursuitOptions(at_end="stay")))
    times, errors = list[float](), list[float]()
    for leg in legs:
        session.step(max(0.0, leg.start_s + SETTLED_S - clock.utc().timestamp()))
        while (now_s := clock.utc().timestamp()) < leg.end_s - 1.0:
            truth = device.truth()
            times.append(now_s)
            errors.append(separation(truth.az_deg, truth.el_deg, *plan.sky.at(now_s)))
            session.step(1.0 / SAMPLES_HZ)
    return Told(
        _rms(errors), max(errors), forecast.rms_deg, forecast.max_deg,
        _beyond(np.array(times), np.array(errors), forecast.t_s, forecast.error_deg),
    )  # fmt: skip


def by_time(cases: Sequence[Case], pool: Pool) -> dict[str, float]:
    """Follow passes for each guess, print a row for each, and return what they come to."""
    head = f"{'rms':>8}{'foreseen':>10}{'worst ratio':>13}{'of the max':>12}{'of a part':>11}"
    print(f"\nCarryout of 2003, whole station   {head}")
    found: dict[str, list[Told]] = {}
    for guess, options in GUESSES.items():
        works = [Attempt(case, options) for case in cases]
        told = found[guess] = [each for each in pool.imap(attempt, works, chunksize=1) if each is not None]
        print(
            f"{guess:34}{median(each.rms for each in told):8.3f}{median(each.foreseen_rms for each in told):10.3f}"
            f"{max(each.ratio for each in told):13.2f}{max(each.worst / each.foreseen_worst for each in told):12.2f}"
            f"{max(each.beyond for each in told):+11.3f}"
        )
    everything = [each for told in found.values() for each in told]
    return {
        "untold_median_rms_deg": median(each.rms for each in found["as guessed"]),
        "untold_no_records_median_rms_deg": median(each.rms for each in found["no records"]),
        "untold_ratio_to_forecast": max(each.ratio for each in everything),
        "untold_max_ratio_to_forecast": max(each.worst / each.foreseen_worst for each in everything),
    }


def _rms(errors: list[float]) -> float:
    return math.sqrt(fmean(error * error for error in errors))


def _beyond(t: np.ndarray, errors: np.ndarray, foreseen_t: np.ndarray, foreseen: np.ndarray) -> float:
    worst = -math.inf
    expected = np.interp(t, foreseen_t, foreseen)
    for start in np.arange(t[0], t[-1] - 15.0, 15.0):
        inside = (t >= start) & (t < start + 30.0)
        if not inside.any():
            continue
        worst = max(worst, math.sqrt(np.mean(errors[inside] ** 2)) - math.sqrt(np.mean(expected[inside] ** 2)))
    return worst
