"""How well each simulated machine follows, by the whole station: a row a machine, beside other programs' policies.

The passes are those of `tracking.py`, which prints this table, too; the machine is its twin with its own delays,
overshoot and play, met by its own driver. *Limit* is what it leaves to whoever drives it (`tracking_limits.py`). A
machine that does not tell its position has another goal: the target's way from one command of birdcage's to the next.

    goal    median within three times the limit where the position is told; else within one command's way

A machine whose delays are random is shown, and has no goal. The last line is one JSON object.
"""

from __future__ import annotations

import argparse
import json
import math
import multiprocessing
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from multiprocessing.pool import Pool
from statistics import fmean, median
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.geometry import separation
from birdcage.link.link import Link
from birdcage.rotator.facts import Facts, Readback, SecondMove
from birdcage.sim.axis import OVERSHOOT_FORWARD_DEG
from birdcage.sim.port import SimPort, open_device
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
from tracking_limits import limit_deg, rates_deg_s
from tracking_passes import Case, everything, spread
from tracking_peers import PEERS
from tracking_rows import GLIDES, GLIDING, OURS, POLICIES, RANDOM_DELAY, rows

EARLY_S, LEAST_S, SETTLED_S, SAMPLES_HZ = 400.0, 60.0, 5.0, 10.0
GOAL = 3.0
OTHERS = 3
"""Others fly every third pass."""
OPTIONS = {
    OURS: PursuitOptions(at_end="stay"),
    GLIDING: PursuitOptions(controller="velocity", velocity_allowed=True, at_end="stay"),
}
PAUSES_S: dict[type, float] = {Send: 0.0, ReadPosition: 0.02}
"""How long a step of theirs takes."""


@dataclass(frozen=True)
class Run:
    """One pass with one machine, and who follows."""

    firmware: str
    """And, after a question mark, settings of its twin."""
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

    def __init__(self, firmware: str, case: Case, gear: Mapping[str, float]) -> None:
        self.clock = VirtualClock(datetime.fromtimestamp(case.passing.aos.timestamp() - EARLY_S, UTC))
        name, _, options = firmware.partition("?")
        self.device = open_device(f"{name}?{'&'.join(filter(None, (options, 'seed=1')))}", clock=self.clock)
        settings = StationSettings(
            port="sim:bench", firmware=name, own_facts=gear,
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
    if run.policy == GLIDING and run.firmware not in GLIDES:
        return None
    ground = Ground(run.firmware, run.case, GLIDES[run.firmware] if run.policy == GLIDING else {})
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
    options = OPTIONS.get(run.policy)
    walks = _ours(ground, plan, legs, options) if options else _theirs(ground, plan, legs, PEERS[run.policy]())
    errors, times = list[float](), list[float]()
    for _ in walks:
        now_s, truth = ground.now_s(), ground.device.truth()
        if any(leg.start_s + SETTLED_S <= now_s < leg.end_s - 1.0 for leg in legs):
            times.append(now_s)
            errors.append(separation(truth.az_deg, truth.el_deg, *plan.sky.at(now_s)))
    tells, at = facts.readback is Readback.ALWAYS, np.array(times)
    if tells:
        limit = limit_deg(free, facts, at, answer_s(ground), scatter_deg(ground))
    else:
        moves = sum(is_move(line) for _at, line in list(ground.device.shell.received)[sent:])
        rates = rates_deg_s(plan, at) * np.column_stack((np.cos(np.radians(plan.sky.sample(at)[1])), np.ones(len(at))))
        limit = math.sqrt(np.mean(np.sum(rates**2, axis=1))) * (times[-1] - times[0]) / max(moves, 1)
    ground.session.close()
    return Followed(math.sqrt(fmean(each * each for each in errors)), max(errors), limit, tells)


def answer_s(ground: Ground) -> float:
    """Return how long the machine itself takes for a command on the mean: its delay, or the pace that it asks for."""
    settings = ground.device.settings
    return max((settings.latency_min + settings.latency_max) / 2.0, getattr(settings, "motor_gap_s", 0.0))


def scatter_deg(ground: Ground) -> float:
    """Return how far an axis comes to rest from its mean, RMS, where it has to rest: it takes no speed to glide at."""
    near_deg, far_deg = OVERSHOOT_FORWARD_DEG
    return 0.0 if ground.dish.has_speeds else ground.device.settings.overshoot * (far_deg - near_deg) / math.sqrt(12.0)


def is_move(line: str) -> bool:
    """Return whether a line sends an axis somewhere: it has angles behind its word."""
    words = line.split()
    return len(words) > 1 and words[0].lower() in ("a", "g", "m")


def _ours(ground: Ground, plan: Plan, legs: list[PlanLeg], options: PursuitOptions) -> Iterator[None]:
    ground.station.submit(Pursue(plan, "bench", options))
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


def attempt(run: Run) -> tuple[Run, Followed | str | None]:
    """Follow, and return what came of it, or why nothing did."""
    try:
        return run, follow(run)
    except Exception as error:  # noqa: BLE001 - it is told, and the other machines fly on
        return run, str(error) or type(error).__name__


def machine_rows(
    cases: Sequence[Case], pool: Pool, names: Sequence[str] = (), policies: Sequence[str] = POLICIES
) -> tuple[dict[str, Any], list[str]]:
    """Follow passes with each machine, print its rows, and return what they come to and which missed the goal."""
    shown = {policy: cases if policy in OPTIONS else cases[::OTHERS] for policy in policies}
    names = names or rows()
    runs = [Run(name, policy, case) for name in names for policy, some in shown.items() for case in some]
    found: dict[tuple[str, str], list[Followed]] = {}
    wrong = dict[str, str]()
    for done, (run, told) in enumerate(pool.imap_unordered(attempt, runs), 1):
        print(f"{done} of {len(runs)}", end="\r", file=sys.stderr, flush=True)
        if isinstance(told, str):
            wrong[f"{run.firmware}, {run.policy}"] = told
        elif told is not None:
            found.setdefault((run.firmware, run.policy), []).append(told)
    print(f"\nEach machine, up to {len(cases)} passes, whole station")
    print(f"{'':20}{'':20}{'passes':>8}{'median':>9}{'worst':>9}{'worst':>9}{'limit or':>10}{'ratio':>8}{'goal':>8}")
    print(f"{'':20}{'':20}{'':>8}{'rms':>9}{'rms':>9}{'max':>9}{'way':>10}{'to it':>8}")
    report, missed = dict[str, Any](), [name for name in names if (name, OURS) not in found]
    for name in names:
        for policy in shown:
            if followed := found.get((name, policy)):
                report[f"{name}, {policy}"] = _row(name, policy, followed, missed)
            elif policy != GLIDING or name in GLIDES:
                print(f"{name:20}{policy:20}{0:8}  {wrong.get(f'{name}, {policy}', 'no pass in its reach')}")
    return {"rows": report, "failed": wrong}, missed


def _row(name: str, policy: str, told: list[Followed], missed: list[str]) -> dict[str, float]:
    rms, limit = median(each.rms for each in told), median(each.limit for each in told)
    goal = GOAL if told[0].tells else 1.0
    is_met = "met" if rms <= goal * limit else "missed"
    word = "" if policy not in OPTIONS else "none" if name in RANDOM_DELAY else is_met
    if word == "missed":
        missed.append(name if policy == OURS else f"{name}, {policy}")
    worst_rms, worst = max(each.rms for each in told), max(each.worst for each in told)
    print(
        f"{name:20}{policy:20}{len(told):8}{rms:9.3f}{worst_rms:9.3f}{worst:9.2f}{limit:10.3f}{rms / limit:8.1f}"
        f"{word:>8}"
    )
    return {"median_rms_deg": rms, "worst_rms_deg": worst_rms, "worst_deg": worst, "limit_deg": limit}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--passes", type=int, default=6)
    parser.add_argument("--machine", action="append", choices=rows(), help="one of them; repeatable")
    parser.add_argument("--ours", action="store_true", help="leave the other programs' policies out")
    parser.add_argument("--processes", type=int, default=min(os.cpu_count() or 1, 4))
    given = parser.parse_args()
    with multiprocessing.Pool(given.processes) as pool:
        report, missed = machine_rows(
            spread(everything(), given.passes), pool, given.machine or (), tuple(OPTIONS) if given.ours else POLICIES
        )
    print(json.dumps({"bench": "tracking_machines", "passes": given.passes, **report}))
    sys.exit(f"goal missed: {', '.join(missed)}" if missed else 0)


if __name__ == "__main__":
    main()
