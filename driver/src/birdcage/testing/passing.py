"""Cases: following a made-up pass from waiting to its end."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from birdcage.base.config import Settings
from birdcage.base.errors import MotionRefused
from birdcage.base.geometry import separation, shortest_turn
from birdcage.sky.observer import Observer
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit_state import Phase, PursuitOptions
from birdcage.station.requests import EndPursuit, Pursue
from birdcage.testing.stage import Stage, require
from birdcage.testing.twin import MachineBench

if TYPE_CHECKING:
    from birdcage.rotator.facts import Facts
    from birdcage.tracking.plan import Plan

PLACE = Observer(40.0, -105.0, 1650.0)
HOURS = 2.0
LEAST_S = 60.0
"""How long a pass is in reach at least to be worth a case."""
LONGEST_S = 60.0
"""How much of it is followed: each second costs the case real time."""
AHEAD_S = 30.0
SETTLED_S = 5.0
"""How long after the start of a leg the error counts: until then the machine may still close in."""


def made_up_pass(stage: Stage) -> Plan:
    """Return the plan of the first made-up pass of the next hours that this machine can follow in one piece."""
    from birdcage.sky.demo_orbits import demo_orbits
    from birdcage.sky.passes.search import search
    from birdcage.sky.propagate import Fleet
    from birdcage.sky.targets.model import Satellite
    from birdcage.tracking.planning.planner import plan_pass

    now = stage.clock.utc()
    by_id = {each.norad_id: each for each in demo_orbits(now, PLACE)}
    low = [each for each in by_id.values() if each.mean_motion_rev_day > 10.0]
    mount = mount_of(stage.state, Settings())
    for passing in sorted(search(Fleet(low), PLACE, now, HOURS), key=lambda each: each.aos):
        plan = plan_pass(Satellite(by_id[passing.norad_id]), PLACE, mount, now, passing=passing)
        if len(plan.legs) != 1 or plan.forecast is None:
            continue
        (leg,) = plan.legs
        if leg.end_s - leg.start_s >= LEAST_S and leg.start_s - now.timestamp() >= AHEAD_S:
            return plan
    raise AssertionError(f"no made-up pass within {HOURS:g} h is in this machine's reach for {LEAST_S:g} s")


def unseen_deg(facts: Facts, plan: Plan, start_s: float, end_s: float) -> float:
    """Return how far from its model one that does not tell its position may be: as far as the target goes in a step.

    Both are somewhere between the same two targets. A step of d takes 2 sqrt(d / a) by the facts, and the axes go in
    turn: at rates v, a turn of both lasts T = 2 sqrt(v_az T / a_az) + 2 sqrt(v_el T / a_el).
    """
    most_deg, at_s = 0.0, start_s
    while at_s < end_s:
        (az_deg, el_deg), (next_az, next_el) = plan.sky.at(at_s), plan.sky.at(at_s + 1.0)
        ways = zip((shortest_turn(az_deg, next_az), next_el - el_deg), (facts.azimuth, facts.elevation), strict=True)
        turn_s = 4.0 * sum(math.sqrt(abs(way) / axis.acceleration_deg_s2) for way, axis in ways) ** 2
        most_deg = max(most_deg, separation(az_deg, el_deg, next_az, next_el) * turn_s)
        at_s += 1.0
    return most_deg


def refuses_passes(stage: Stage) -> bool:
    """Return whether this machine follows no pass; then its plan says why, and it does not set out."""
    if not stage.facts.no_following:
        return False
    from birdcage.sky.demo_orbits import demo_orbits
    from birdcage.sky.targets.model import Satellite
    from birdcage.tracking.planning.planner import plan_pass

    now = stage.clock.utc()
    plan = plan_pass(Satellite(demo_orbits(now, PLACE)[0]), PLACE, mount_of(stage.state, Settings()), now)
    require(stage.facts.no_following in plan.notes, f"its plan does not say why it follows nothing: {plan.notes}")
    refusal = stage.refused(Pursue(plan, "contract", PursuitOptions(at_end="stay")), MotionRefused)
    require(stage.facts.no_following in str(refusal), f"it is not said why: {refusal}")
    require(stage.rests_for(3.0), "it moves")
    return True


class PassContract:
    """A pass is followed as its plan foresees, judged by the mechanics."""

    def test_a_pass_is_followed_as_foreseen(self, bench: MachineBench) -> None:
        """Waiting, there in time, then never further off than the plan says, and at rest when it is ended.

        A machine that does not tell its position may be a step away from its model besides, unless it is always sent
        all its axes: then the plan has counted that in. One that follows nothing says so in its plan.
        """
        with Stage(bench) as stage:
            if refuses_passes(stage.found()):
                return
            plan = made_up_pass(stage)
            forecast, leg = plan.forecast, plan.legs[0]
            assert forecast is not None
            stage.do(Pursue(plan, "contract", PursuitOptions(at_end="stay")))
            start_s, end_s = leg.start_s + SETTLED_S, min(leg.end_s - 1.0, leg.start_s + LONGEST_S)
            errors = self._errors(stage, plan, start_s, end_s)
            rms_deg = math.sqrt(sum(error * error for error in errors) / len(errors))
            modelled = not stage.tells and stage.facts.moves_one_axis
            more_deg = bench.follows_deg + (unseen_deg(stage.facts, plan, start_s, end_s) if modelled else 0.0)
            worst_deg = max(errors)
            require(worst_deg <= forecast.max_deg + more_deg, f"{worst_deg:.2f}° off, {forecast.max_deg:.2f}° foreseen")
            require(rms_deg <= forecast.rms_deg + more_deg, f"{rms_deg:.2f}° RMS, {forecast.rms_deg:.2f}° foreseen")
            stage.do(EndPursuit("contract"))
            self._over(stage)
            stage.until(lambda: not stage.truth.moving, 60.0, "it came to rest")
            stage.step(3.0)
            require(stage.rests_for(5.0), "it moves after the pursuit has ended")
            require(stage.state.holder is None, f"{stage.state.holder} still has control")

    def test_stop_ends_a_pass(self, bench: MachineBench) -> None:
        """STOP in the middle of a pass: it comes to rest and stays there, however long the pass would last."""
        with Stage(bench) as stage:
            if stage.found().facts.no_following:
                return
            plan = made_up_pass(stage)
            stage.do(Pursue(plan, "contract", PursuitOptions(at_end="stay")))
            self._wait(stage, plan.legs[0].start_s + 20.0)
            stage.station.stop("contract")
            stage.until(lambda: not stage.truth.moving, 60.0, "it came to rest")
            stage.step(3.0)
            since = stage.clock.monotonic()
            require(stage.rests_for(20.0), "it moves on after STOP")
            require(not stage.taken_since(since), f"commands of moves went out: {stage.taken_since(since)}")
            require(stage.state.held is not None, "STOP does not hold it")

    @staticmethod
    def _wait(stage: Stage, until_s: float) -> None:
        stage.step(max(0.0, until_s - stage.clock.utc().timestamp()))

    def _errors(self, stage: Stage, plan: Plan, start_s: float, end_s: float) -> list[float]:
        self._wait(stage, start_s)
        pursuit, errors = stage.state.pursuit, []
        require(pursuit is not None and pursuit.phase is Phase.FOLLOWING, f"it does not follow: {pursuit}")
        while (now_s := stage.clock.utc().timestamp()) < end_s:
            truth = stage.truth
            errors.append(separation(truth.az_deg, truth.el_deg, *plan.sky.at(now_s)))
            stage.step(1.0)
        return errors

    @staticmethod
    def _over(stage: Stage) -> None:
        def is_over() -> bool:
            pursuit = stage.state.pursuit
            return pursuit is not None and pursuit.phase is Phase.OVER

        stage.until(is_over, 120.0, "the pursuit was over")
