"""Cases: STOP on each rung of the machine's ladder, and HELD after it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import Held, Stopped
from birdcage.base.geometry import separation
from birdcage.rotator import machines
from birdcage.rotator.axis import Role
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import MoveKind, StopMeans
from birdcage.station.requests import Goto, Jog, Release
from birdcage.station.state import Activity
from birdcage.testing.stage import LONGEST_MOVE_S, STEP_S, Stage, require
from birdcage.testing.twin import MachineBench, StopScene

BY_HAND = "power"
"""The rung that a person climbs."""
SHORT_DEG = 2.0
"""A motion that was stopped ends this far from its target at least: else it was not stopped, it was over."""


class StoppingContract:
    """STOP is judged by the mechanics alone."""

    def test_every_rung_has_a_scene(self, bench: MachineBench) -> None:
        """A rung that no case has seen at work is a promise.

        One that ends nothing but a sweep of the machine's own is for its own tests. Whether one works cannot be seen of
        a machine that does not tell its position: STOP names none but a proven one. Whether it tells may show only when
        it is met.
        """
        with Stage(bench) as stage:
            facts = stage.ready().facts
        rungs = [rung for rung in facts.stop_ladder if rung.ends != {MoveKind.SWEEP}]
        ladder = [rung.means for rung in rungs if rung.means != BY_HAND]
        if not facts.tells_at_rest:
            ladder = [rung.means for rung in facts.stop_ladder if rung.proven and rung.means.is_sent]
            ladder = ladder or [StopMeans.NONE]
        seen = [scene.rung for scene in bench.stops]
        require(set(ladder) <= set(seen), f"the ladder has {ladder}, and the bench shows {seen}")

    def test_stop_in_motion_by_each_rung(self, bench: MachineBench) -> None:
        """What was said to stop it has stopped it, and it is called confirmed only of a machine that tells where it is.

        A rung that needs consent is not climbed without it.
        """
        for scene in bench.stops:
            with Stage(bench, scene.twin, scene.settings) as stage:
                self._stop(stage, scene)
            consent = [rung for rung in machines.facts_of(bench.machine).stop_ladder if rung.means == scene.rung]
            if consent and consent[0].needs_consent:
                with Stage(bench, scene.twin) as stage:
                    self._move(stage, scene)
                    stage.station.stop("contract")
                    self._rest(stage)
                    stop = stage.state.last_stop
                    require(stop is not None and stop.means != scene.rung, f"{scene.rung} needs consent, and had none")

    @staticmethod
    def _move(stage: Stage, scene: StopScene) -> tuple[float, float]:
        stage.found()
        if scene.begin is not None:
            stage.do(Goto(*scene.begin, "contract"))
        target = stage.target(*scene.way_deg)
        stage.station.submit(Goto(*target, "contract"))
        if scene.again_deg is not None:
            stage.step(scene.after_s)
            target = stage.target(*scene.again_deg, start=target)
            stage.station.submit(Goto(*target, "contract"))
        stage.step(scene.after_s)
        require(stage.truth.moving, f"{scene.after_s} s after the request nothing moves: choose a longer way")
        return target

    @staticmethod
    def _rest(stage: Stage) -> None:
        stage.step(STEP_S)
        stage.until(lambda: not stage.truth.moving, LONGEST_MOVE_S, "the mechanics rest")
        stage.until(lambda: stage.state.activity is not Activity.STOPPING, 60.0, "STOP was followed up")

    def _stop(self, stage: Stage, scene: StopScene) -> None:
        target = self._move(stage, scene)
        shown = stage.state.motion
        require(shown is not None, "the motion under way is not shown, nor what would stop it")
        stage.station.stop("contract")
        self._rest(stage)
        stop, truth = stage.state.last_stop, stage.truth
        assert stop is not None
        require(stop.means == scene.rung, f"STOP says {stop.means!r}, and the rung is {scene.rung!r}: {stop.sentence}")
        left_deg = separation(truth.az_deg, truth.el_deg, *target)
        if scene.reaches_target:
            require(left_deg <= stage.bench.near_deg, f"{scene.rung}: it ended {left_deg:.2f}° from its target")
        else:
            require(left_deg >= SHORT_DEG, f"{scene.rung}: it was stopped {left_deg:.2f}° from its target, at {truth}")
        facts = stage.state.dish
        wanted = scene.confirmed if facts is not None and facts.tells_at_rest else None
        require(
            stop.confirmed is wanted if wanted else stop.confirmed is not True,
            f"{scene.rung}: STOP says {stop.confirmed!r} where {wanted!r} is due: {stop.sentence}",
        )
        require(stage.state.held is not None, "STOP does not hold it")
        since = stage.clock.monotonic()
        require(stage.rests_for(5.0), f"{scene.rung}: it moves again: {stage.truth}")
        if not stage.tells:
            stage.step(LONGEST_MOVE_S)
            require(not stage.taken_since(since), f"commands of moves went out: {stage.taken_since(since)}")
            require(stage.knows_nothing(), f"where STOP left it nothing tells, and {stage.state.position} is shown")

    def test_what_stop_has_latched_does_not_go_out(self, bench: MachineBench) -> None:
        """STOP may come after everything was judged: the machine asks once more, just before the first byte."""

        def latched() -> None:
            raise Stopped("STOP is latched.")

        clock = VirtualClock()
        twin, rotator = bench.twin(clock), machines.make(bench.machine)
        rotator.open(twin.address, None, clock, Hooks(dial=twin.dial, permit=latched))
        rotator.meet()
        rotator.make_ready()
        facts = rotator.facts
        if facts.tells_at_rest:
            rotator.look()
        middle = {axis.name: (axis.min_deg + axis.max_deg) / 2.0 for axis in facts.axes if axis.role is not Role.SKEW}
        moves: list[Callable[[], object]] = [partial(rotator.begin_slew, middle)]
        if facts.moves_one_axis or facts.slew is None:
            moves = [partial(rotator.send, {name: deg}) for name, deg in middle.items()]
        for move in moves:
            try:
                move()
            except Stopped:
                pass
            else:
                raise AssertionError(f"{move} goes out though `Hooks.permit` refuses it")
        require(not twin.taken(), f"commands of moves went out: {twin.taken()}")
        rotator.close(0.0)

    def test_stop_at_rest_moves_nothing(self, bench: MachineBench) -> None:
        """STOP may be pressed at any time."""
        with Stage(bench) as stage:
            stage.found()
            before = stage.truth
            stage.station.stop("contract")
            require(stage.rests_for(5.0), "STOP at rest set it in motion")
            require(stage.truth == before, f"it stood at {before} and is at {stage.truth}")
            require(stage.state.held is not None, "STOP does not hold it")

    def test_held_until_a_person_releases_it(self, bench: MachineBench) -> None:
        """HELD refuses every motion with nothing sent, its release moves nothing by itself, and then it goes."""
        scene = bench.stops[0]
        with Stage(bench, scene.twin, scene.settings) as stage:
            target = self._move(stage, scene)
            stage.station.stop("contract")
            self._rest(stage)
            since, before = stage.clock.monotonic(), stage.truth
            for request in (Goto(*target, "contract"), Jog(1.0, 0.0, "contract"), Jog(0.0, 1.0, "somebody else")):
                stage.refused(request, Held)
            require(stage.rests_for(5.0), "it moves while it is HELD")
            stage.do(Release("contract"))
            require(stage.state.held is None, "its release did not let go of it")
            require(stage.rests_for(5.0), "its release set it in motion")
            require(stage.truth == before, f"it stood at {before} and is at {stage.truth}")
            require(not stage.taken_since(since), f"commands of moves went out: {stage.taken_since(since)}")
            # One that does not tell is sent nowhere before the move that was stopped must be over.
            stage.until(lambda: stage.state.activity is Activity.IDLE, LONGEST_MOVE_S, "it counted as resting")
            stage.do(Goto(*target, "contract"))
            require(stage.stands_at(*target), f"sent to {target} after its release, and is at {stage.truth}")
