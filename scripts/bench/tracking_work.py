"""One run of the benchmark: a pass, a dish, a way to follow, and the conditions; and what came of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import cache

import numpy as np
from birdcage.rotator.facts import SecondMove
from birdcage.sky.targets.model import Satellite
from birdcage.tracking.controller_input import Controller
from birdcage.tracking.curve import Curve
from birdcage.tracking.plan import Plan, PlanLeg, PlanPart
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.planning.refining import refine
from birdcage.tracking.steering.choice import lead_s
from birdcage.tracking.steering.fast import fast
from birdcage.tracking.steering.queued import queued
from birdcage.tracking.steering.velocity import velocity
from tracking_dishes import G2, IDEAL, PLAY, ROBUST, SHAKEN, TRAVLER_5, WORN, Dish
from tracking_passes import Case
from tracking_peers import PEERS
from tracking_recognised import RECOGNISED
from tracking_runner import DELAY_S, EARLY_S, Bench, Order
from tracking_smoothed import SMOOTHED

OURS: dict[str, Callable[[], Controller]] = {
    "fast": lambda: fast,
    "velocity matched": lambda: velocity,
    "queued": lambda: queued,
}
LEADS_S = {name: lead_s("velocity" if name == "velocity matched" else name, DELAY_S) for name in OURS}
"""How long before the target comes into reach each takes over."""
DISHES = {dish.name: dish for dish in (G2, TRAVLER_5)}
CONDITIONS = {"base": IDEAL, "worn": WORN, "shaken": SHAKEN, "robust": ROBUST, "lost": IDEAL, "play": PLAY}
LOST = {"shaken": 0.02, "robust": 0.02, "lost": 0.02}
"""Part of the answers."""
CLOSE_DEG = 0.58
"""1 dB at Ku band for a dish of 33 inches."""
KEYHOLE_DEG = 0.5
"""A keyhole is where even both axes at once would be off by more than this."""
AROUND_S = 10.0
"""What belongs to a keyhole before and after it."""
ASTRAY_DEG = 90.0
LONGEST_S = 2.0
"""An axis that stood for longer had nothing to follow: at its limit, or where the target does not turn."""


@dataclass(frozen=True)
class Work:
    """What is to be done."""

    case: Case
    dish: str
    policy: str
    condition: str = "base"
    late_s: float = 0.0
    """How much the computer's clock is behind."""
    offset_s: float = 0.0
    """What the time-offset knob is set to."""
    seed: int = 1
    gear_known: bool = False
    """Whether its owner has set the play of the dish, and moves before the pass have taught its overshoot."""


@dataclass(frozen=True)
class Score:
    """Degrees on the sky, over what the dish can reach."""

    work: Work
    rms: float
    worst: float
    off_keyhole_rms: float
    hole_worst: float
    hole_limit: float
    """0 where there is no keyhole."""
    close: float
    """Part of the time above the floor within 0.58 degrees."""
    close_limit: float
    """The same of a dish whose axes go at once and at their greatest speeds."""
    seconds: float
    """How long it was followed."""
    commands: int
    backlog: int
    astray: int
    """How often the dish went the other way round though no plan said so."""
    planned_rewinds: int
    bias_s: float
    """Mean of what it is ahead of the target, along the track."""
    saw_tooth: float
    """RMS of rate x interval / 2 sqrt(3), over the intervals at which each axis really acted on commands."""
    unforeseen: float
    """The same of a program that has to choose each goal as its line goes out, before anybody knows when it will act:
    rate x the standard deviation of how long ago the command in force was sent. One latency for all makes both equal.
    """


def run(work: Work) -> Score:
    dish = DISHES[work.dish]
    now = datetime.fromtimestamp(work.case.passing.aos.timestamp() - EARLY_S + 10.0, UTC)
    plan = planned(work, dish, now, work.offset_s)
    true = plan if work.offset_s == 0.0 else planned(work, dish, now, 0.0)
    start_s = work.case.passing.aos.timestamp() + work.offset_s
    address = dish.address(CONDITIONS[work.condition], work.seed)
    bench = Bench(address, dish.model, start_s, LOST.get(work.condition, 0.0), work.late_s, seed=work.seed)
    if work.gear_known:
        bench.learn(float(CONDITIONS[work.condition]["backlash"]))
    stretches, rewinds = _stretches(plan)
    bench.sample(stretches[0][0] + work.late_s, stretches[-1][1] + work.late_s)
    if plan.preposition is not None:
        bench.go(plan.preposition.waypoints)
    course = plan.course
    assert course is not None, "only what can be reached is followed"
    ours = work.policy in OURS
    for (begin_s, end_s), rewind in zip(stretches, rewinds, strict=True):
        if ours and rewind is not None:
            bench.wait(rewind.start_s)
            bench.go(rewind.waypoints or ((rewind.to_az_deg, course.at(rewind.end_s)[1]),))
        bench.at = course.at(begin_s)
        if ours:
            bench.follow(OURS[work.policy](), course, begin_s, end_s, LEADS_S[work.policy] if rewind is None else 0.0)
        elif work.policy in RECOGNISED:
            bench.follow(RECOGNISED[work.policy](work.case, course), plan.sky, begin_s, end_s)
        else:
            bench.follow((PEERS | SMOOTHED)[work.policy](), plan.sky, begin_s, end_s)
    return _score(work, dish, plan, true, bench)


def planned(work: Work, dish: Dish, now: datetime, offset_s: float) -> Plan:
    mount = dish.mount(*dish.stands)
    plan = plan_pass(
        Satellite(work.case.satellite), work.case.observer, mount, now, passing=work.case.passing,
        time_offset_s=offset_s,
    )  # fmt: skip
    return refine(plan, mount) if work.policy in OURS else plan


def _stretches(plan: Plan) -> tuple[list[tuple[float, float]], list[PlanLeg | None]]:
    """Return what is followed in one go, gaps above the ceiling included, and the rewind before each."""
    found: list[tuple[float, float]] = []
    rewinds: list[PlanLeg | None] = []
    before: PlanLeg | None = None
    for leg in plan.legs:
        if leg.part is PlanPart.REWIND:
            before = leg
        elif found and before is None:
            found[-1] = found[-1][0], leg.end_s
        else:
            found.append((leg.start_s, leg.end_s))
            rewinds.append(before)
            before = None
    return found, rewinds


def _score(work: Work, dish: Dish, plan: Plan, true: Plan, bench: Bench) -> Score:
    seen = bench.followed()
    sky_az, sky_el = true.sky.sample(seen.t_s)
    error = angle(seen.az_deg, seen.el_deg, sky_az, sky_el)
    above = sky_el >= dish.low_el
    inside = above & (sky_el <= dish.high_el)
    for leg in plan.rewinds:
        inside &= (seen.t_s < leg.start_s) | (seen.t_s > leg.end_s)
    limit = _limit(work, dish)
    least = angle(*limit.sample(seen.t_s), sky_az, sky_el) if limit is not None else error
    off, hole_worst, hole_limit = inside.copy(), 0.0, 0.0
    for hole in true.keyholes:
        if hole.limit_deg <= KEYHOLE_DEG:
            continue
        around = (seen.t_s >= hole.start_s - AROUND_S) & (seen.t_s <= hole.end_s + AROUND_S) & inside
        off &= ~around
        if around.any():
            hole_worst, hole_limit = max(hole_worst, float(error[around].max())), max(hole_limit, hole.limit_deg)
    course = plan.course
    assert course is not None
    lost = np.abs(seen.az_deg - course.sample(seen.t_s - work.late_s)[0]) > ASTRAY_DEG
    for leg in plan.rewinds:
        lost &= (seen.t_s < leg.start_s) | (seen.t_s > leg.end_s)
    return Score(
        work, _rms(error[inside]), float(error[inside].max()), _rms(error[off]), hole_worst, hole_limit,
        float((error[above] <= CLOSE_DEG).mean()), float((least[above] <= CLOSE_DEG).mean()),
        float(seen.t_s[-1] - seen.t_s[0]), seen.commands, seen.backlog,
        int(np.count_nonzero(np.diff(lost.astype(int)) > 0)), len(plan.rewinds),
        _bias_s(true.sky, seen.t_s[off], seen.az_deg[off], seen.el_deg[off]),
        *_floors(true.sky, seen.t_s[inside], bench.orders),
    )  # fmt: skip


def _floors(sky: Curve, t: np.ndarray, orders: tuple[list[Order], list[Order]]) -> tuple[float, float]:
    """Return what is left where every goal is the best one: `saw_tooth` and `unforeseen` of `Score`."""
    saw_tooth, unforeseen = 0.0, 0.0
    for given, rate in zip(orders, _rates(sky, t), strict=True):
        acted, sent = np.array([(order.acted_s, order.sent_s) for order in given]).T
        after = np.clip(np.searchsorted(acted, t), 1, len(acted) - 1)
        interval = acted[after] - acted[after - 1]
        weight = np.where(interval < LONGEST_S, rate**2, 0.0)
        if not weight.any():
            continue  # no two commands of this axis were close enough to tell
        saw_tooth += np.mean(weight * interval**2) / 12.0
        age = t - sent[after - 1]
        unforeseen += np.mean(weight * (age - np.average(age, weights=weight)) ** 2)
    return float(np.sqrt(saw_tooth)), float(np.sqrt(unforeseen))


def _rates(sky: Curve, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return how fast the target goes in azimuth and in elevation, degrees a second on the sky."""
    az, el = sky.sample(t)
    later_az, later_el = sky.sample(t + 0.1)
    turn = np.mod(later_az - az + 180.0, 360.0) - 180.0
    return turn * np.cos(np.radians(el)) / 0.1, (later_el - el) / 0.1


@cache
def _limit_of(case: Case, name: str) -> Curve | None:
    dish = DISHES[name]
    model = replace(dish.model, second_same=SecondMove.RETARGET, second_other=SecondMove.RETARGET)
    now = datetime.fromtimestamp(case.passing.aos.timestamp() - EARLY_S, UTC)
    return planned(Work(case, name, ""), replace(dish, model=model), now, 0.0).course


def _limit(work: Work, dish: Dish) -> Curve | None:
    return _limit_of(work.case, dish.name)


def angle(az1: np.ndarray, el1: np.ndarray, az2: np.ndarray, el2: np.ndarray) -> np.ndarray:
    """Return the angle on the sky between directions, in degrees."""
    d_az, e1, e2 = np.radians(az1 - az2), np.radians(el1), np.radians(el2)
    h = np.sin((e1 - e2) / 2.0) ** 2 + np.cos(e1) * np.cos(e2) * np.sin(d_az / 2.0) ** 2
    found: np.ndarray = np.degrees(2.0 * np.arcsin(np.sqrt(np.clip(h, 0.0, 1.0))))
    return found


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else 0.0


def _bias_s(sky: Curve, t: np.ndarray, az: np.ndarray, el: np.ndarray) -> float:
    sky_az, sky_el = sky.sample(t)
    lift = np.cos(np.radians(sky_el))
    rate = np.array(_rates(sky, t))
    off = np.array([(np.mod(az - sky_az + 180.0, 360.0) - 180.0) * lift, el - sky_el])
    return float((rate * off).sum() / (rate * rate).sum())
