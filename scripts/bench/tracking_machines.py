"""How well each simulated machine follows, by the whole station: a row a machine, beside other programs' policies.

The passes are those of `tracking.py`; the machine is its twin with its own delays, met by its own driver. *Limit* is
what the machine leaves to whoever drives it, the root sum square of four errors: of axes that are too slow for the
pass (a keyhole), of steps (each is up to half a step off), of an overshoot that is anywhere up to the greatest, and of
the target's way from one command to the next: while two are answered, and, where moves wait for each other, are made. A
machine that does not tell its position has no such limit here: its goal is the target's way between two commands.

    goal    median within three times the limit where the position is told; else within one command's way

A machine whose delays are random is shown, and has no goal. The last line is one JSON object.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from multiprocessing import Pool
from statistics import fmean, median
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.geometry import separation
from birdcage.link.link import Link
from birdcage.rotator.facts import Facts, Readback, SecondMove
from birdcage.sim.port import SimPort, firmware_names, open_device
from birdcage.sky.targets.model import Satellite
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit_state import PursuitOptions
from birdcage.station.requests import AcquireLease, Goto, Home, Pursue, Request, Sync, Watch
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.state import StationState
from birdcage.station.station import Station
from birdcage.tracking.controller_input import Controller, ControllerInput
from birdcage.tracking.mount import Mount
from birdcage.tracking.plan import Plan, PlanLeg, PlanPart
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.steps import ReadPosition, Send, Wait
from tracking_passes import Case, everything, spread
from tracking_peers import PEERS

OURS = "birdcage"
POLICIES = (OURS, "move to now, 1 Hz", "Gpredict, 1°", "Gpredict, 5°")
RANDOM_DELAY = frozenset({"pathway-x2"})
EARLY_S, LEAST_S, SETTLED_S, SAMPLES_HZ = 400.0, 60.0, 5.0, 10.0
GOAL = 3.0
OTHERS = 3
"""Others fly every third pass."""
PAUSES_S: dict[type, float] = {Send: 0.0, ReadPosition: 0.02}
"""How long a step of theirs takes."""


@dataclass(frozen=True)
class Run:
    """One pass with one machine, and who follows."""

    firmware: str
    policy: str
    case: Case


@dataclass(frozen=True)
class Followed:
    """Degrees on the sky."""

    rms: float
    worst: float
    limit: float
    """Of a machine that does not tell: the target's way between two commands."""
    tells: bool


class Ground:
    """A machine at its station, at rest and found."""

    def __init__(self, firmware: str, case: Case) -> None:
        self.clock = VirtualClock(datetime.fromtimestamp(case.passing.aos.timestamp() - EARLY_S, UTC))
        self.device = open_device(f"{firmware}?seed=1", clock=self.clock)
        settings = StationSettings(
            port="sim:bench", firmware=firmware,
            open_link=lambda port, baud: Link(SimPort(self.device, port, baud=baud), self.clock),
        )  # fmt: skip
        self.session = Session(self.clock, Station(self.clock, settings))
        self.station = self.session.station
        self.station.submit(Watch("bench", frozenset({"position"}), 2.0))
        self.session.step(20.0)
        assert self.state.link.state is LinkNow.UP, (firmware, self.state.link)
        if self.state.awaits_sync:
            self.do(Sync(self.device.truth().az_deg, None, "bench", agreed=True))
        elif self.state.homed is False and self.dish.homing_s is not None:
            self.do(Home("bench"))
        elif self.state.awaits_first_move:
            self.do(Goto(180.0, 45.0, "bench"))

    @property
    def state(self) -> StationState:
        return self.station.state

    @property
    def dish(self) -> Facts:
        """What the machine is."""
        assert self.state.dish is not None
        return self.state.dish

    def do(self, request: Request) -> None:
        future = self.station.submit(request)
        for _ in range(300):
            if future.done():
                break
            self.session.step(1.0)
        future.result(0)

    def now_s(self) -> float:
        return self.clock.utc().timestamp()


def follow(run: Run) -> Followed | None:
    """Follow a pass; None where it is out of the machine's reach, or for less than a minute within."""
    ground = Ground(run.firmware, run.case)
    facts = ground.dish
    if facts.no_following:
        return None
    mount = mount_of(ground.state, Settings())

    def planned(of: Mount) -> Plan:
        satellite, observer = Satellite(run.case.satellite), run.case.observer
        return plan_pass(satellite, observer, of, ground.clock.utc(), passing=run.case.passing)

    plan = planned(mount)
    legs = [leg for leg in plan.legs if leg.part is PlanPart.FOLLOW]
    if plan.forecast is None or sum(leg.end_s - leg.start_s for leg in legs) < LEAST_S:
        return None
    at_once = replace(facts, second_same=SecondMove.RETARGET, second_other=SecondMove.RETARGET)
    free = planned(replace(mount, model=at_once))
    sent = len(ground.device.shell.received)
    walks = _ours(ground, plan, legs) if run.policy == OURS else _theirs(ground, plan, legs, PEERS[run.policy]())
    errors, times = list[float](), list[float]()
    for _ in walks:
        now_s, truth = ground.now_s(), ground.device.truth()
        if any(leg.start_s + SETTLED_S <= now_s < leg.end_s - 1.0 for leg in legs):
            times.append(now_s)
            errors.append(separation(truth.az_deg, truth.el_deg, *plan.sky.at(now_s)))
    tells = facts.readback is Readback.ALWAYS
    moves = sum(line[:1].lower() in "agmv" for _at, line in list(ground.device.shell.received)[sent:])
    limit = _limit(free, facts, np.array(times), ground.state.link.round_trip_s or 0.0) if tells else 0.0
    if not tells:
        limit = _rate(plan, np.array(times)) * (times[-1] - times[0]) / max(moves, 1)
    ground.session.close()
    return Followed(math.sqrt(fmean(each * each for each in errors)), max(errors), limit, tells)


def _ours(ground: Ground, plan: Plan, legs: list[PlanLeg]) -> Iterator[None]:
    ground.station.submit(Pursue(plan, "bench", PursuitOptions(at_end="stay")))
    while ground.now_s() < legs[-1].end_s:
        ground.session.step(1.0 / SAMPLES_HZ)
        yield


def _theirs(ground: Ground, plan: Plan, legs: list[PlanLeg], controller: Controller) -> Iterator[None]:
    """Let another program's policy send directions, clamped, as it does over the network."""
    ground.do(AcquireLease("bench"))
    start_az, start_el = plan.sky.at(legs[0].start_s)
    ground.do(Goto(start_az % 360.0, start_el, "bench", clamp=True))
    while ground.now_s() < legs[0].start_s:
        ground.session.step(1.0 / SAMPLES_HZ)
        yield
    helm = SimpleNamespace(
        model=ground.dish, now_s=ground.now_s(), until_s=legs[-1].end_s, start_az_deg=start_az,
        start_el_deg=start_el, course=lambda: plan.sky,
    )  # fmt: skip
    steps, wanted = controller(cast("ControllerInput", helm)), dict[int, float]()
    answer: Any = None
    while True:
        try:
            step = steps.send(answer)
        except StopIteration:
            return
        here = ground.state.position
        if isinstance(step, Send):
            wanted[step.axis] = step.deg
            if len(wanted) == 2:
                _wish(ground, wanted)
                wanted = {}
        until_s = step.until_s if isinstance(step, Wait) else ground.now_s() + PAUSES_S[type(step)]
        while ground.now_s() < min(until_s, legs[-1].end_s):
            ground.session.step(min(1.0 / SAMPLES_HZ, max(until_s - ground.now_s(), 1e-3)))
            yield
        az_deg, el_deg = (None, None) if here is None else (here.az_deg, here.el_deg)
        answer = SimpleNamespace(now_s=ground.now_s(), az_deg=az_deg, el_deg=el_deg)


def _wish(ground: Ground, wanted: dict[int, float]) -> None:
    facts = ground.dish
    ground.station.submit(Goto(wanted[facts.azimuth.index], wanted[facts.elevation.index], "bench", clamp=True))


def _rate(plan: Plan, times: np.ndarray) -> float:
    """Return how fast the target goes, RMS, in degrees a second on the sky."""
    az, el = plan.sky.sample(times)
    later_az, later_el = plan.sky.sample(times + 0.1)
    turn = (np.mod(later_az - az + 180.0, 360.0) - 180.0) * np.cos(np.radians(el))
    return float(np.sqrt(np.mean((turn**2 + (later_el - el) ** 2) / 0.01)))


def _between_s(facts: Facts, rate_deg_s: float, answer_s: float) -> float:
    """Return the least time from one pair of commands to the next: T = 2 answers, and two moves over rate T in turn.

    A move over d takes 2 sqrt(d / a) from rest to rest, or what was measured.
    """
    spent_s = 2.0 * answer_s
    if not facts.moves_in_turn:
        return spent_s
    for _ in range(50):
        way = rate_deg_s * spent_s / math.sqrt(2.0)
        moves = (
            axis.times.seconds(way) if axis.times is not None else 2.0 * math.sqrt(way / axis.acceleration_deg_s2)
            for axis in (facts.azimuth, facts.elevation)
        )  # fmt: skip
        spent_s = 2.0 * answer_s + sum(moves)
    return spent_s


def _limit(free: Plan, facts: Facts, times: np.ndarray, answer_s: float) -> float:
    """Return what is left to whoever drives it: see above. `free`: the plan of one that takes each command at once."""
    az, el = free.sky.sample(times)
    slow = 0.0
    if free.course is not None:
        on_az, on_el = free.course.sample(times)
        turn = (np.mod(on_az - az + 180.0, 360.0) - 180.0) * np.cos(np.radians(el))
        slow = float(np.mean(turn**2 + (on_el - el) ** 2))
    across = float(np.mean(np.cos(np.radians(el)) ** 2))
    az_axis, el_axis = facts.azimuth, facts.elevation
    steps = (az_axis.step_deg**2 * across + el_axis.step_deg**2) / 12.0
    overshoot = (az_axis.overshoot_deg**2 * across + el_axis.overshoot_deg**2) / 3.0
    rate = _rate(free, times)
    between = (rate * _between_s(facts, rate, answer_s)) ** 2 / 12.0
    return math.sqrt(slow + steps + overshoot + between)


def attempt(run: Run) -> tuple[Run, Followed | str | None]:
    """Follow, and return what came of it, or why nothing did."""
    try:
        return run, follow(run)
    except Exception as error:  # noqa: BLE001 - it is told, and the other machines fly on
        return run, str(error) or type(error).__name__


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--passes", type=int, default=6)
    parser.add_argument("--machine", action="append", choices=firmware_names(), help="one of them; repeatable")
    parser.add_argument("--ours", action="store_true", help="leave the other programs' policies out")
    given = parser.parse_args()
    cases = spread(everything(), given.passes)
    names = given.machine or list(firmware_names())
    shown = {policy: cases if policy == OURS else cases[::OTHERS] for policy in ((OURS,) if given.ours else POLICIES)}
    runs = [Run(name, policy, case) for name in names for policy, some in shown.items() for case in some]
    found: dict[tuple[str, str], list[Followed]] = {}
    wrong = dict[str, str]()
    with Pool(min(os.cpu_count() or 1, 4)) as pool:
        for done, (run, told) in enumerate(pool.imap_unordered(attempt, runs), 1):
            print(f"{done} of {len(runs)}", end="\r", file=sys.stderr, flush=True)
            if isinstance(told, str):
                wrong[f"{run.firmware}, {run.policy}"] = told
            elif told is not None:
                found.setdefault((run.firmware, run.policy), []).append(told)
    print(f"Degrees on the sky, up to {len(cases)} passes a machine, whole station.\n")
    print(f"{'':14}{'':20}{'passes':>8}{'median':>9}{'worst':>9}{'worst':>9}{'limit or':>10}{'goal':>9}")
    print(f"{'':14}{'':20}{'':>8}{'rms':>9}{'rms':>9}{'max':>9}{'step':>10}")
    report, missed = dict[str, Any](), list[str]()
    for name in names:
        for policy in shown:
            if followed := found.get((name, policy)):
                report[f"{name}, {policy}"] = _row(name, policy, followed, missed)
            else:
                print(f"{name:14}{policy:20}{0:8}  {wrong.get(f'{name}, {policy}', 'no pass in its reach')}")
    print(json.dumps({"bench": "tracking_machines", "passes": len(cases), "rows": report, "failed": wrong}))
    sys.exit(f"goal missed: {', '.join(missed)}" if missed else 0)


def _row(name: str, policy: str, told: list[Followed], missed: list[str]) -> dict[str, float]:
    rms, limit = median(each.rms for each in told), median(each.limit for each in told)
    goal = limit * (GOAL if told[0].tells else 1.0)
    word = "" if policy != OURS else "none" if name in RANDOM_DELAY else "met" if rms <= goal else "missed"
    if word == "missed":
        missed.append(name)
    worst_rms, worst = max(each.rms for each in told), max(each.worst for each in told)
    print(f"{name:14}{policy:20}{len(told):8}{rms:9.3f}{worst_rms:9.3f}{worst:9.2f}{limit:10.3f}{word:>9}")
    return {"median_rms_deg": rms, "worst_rms_deg": worst_rms, "worst_deg": worst, "limit_deg": limit}


if __name__ == "__main__":
    main()
