"""Cases: the line is pulled out, or the machine falls silent."""

from __future__ import annotations

from concurrent.futures import Future

from birdcage.antenna.motion import longest_s
from birdcage.base.errors import BirdcageError
from birdcage.station.pursuit_state import PursuitOptions
from birdcage.station.requests import Goto, Pursue, Release
from birdcage.station.state import MOVING, LinkPhase
from birdcage.testing.passing import made_up_pass
from birdcage.testing.stage import LONGEST_MOVE_S, Stage, require
from birdcage.testing.twin import MachineBench

NOTICED_S = 30.0
BACK_S = 60.0


class WireContract:
    """What is not known is not claimed, and nothing moves by itself afterwards."""

    def test_pulled_out_in_motion_and_put_back(self, bench: MachineBench) -> None:
        """The motion is ended in words, its position no longer claimed, and the machine comes back without moving."""
        with Stage(bench) as stage:
            motion = self._moving(stage)
            stage.twin.unplug()
            stage.until(lambda: stage.state.link.state is LinkPhase.LOST, NOTICED_S, "the lost line was noticed")
            self._claims_nothing(stage, motion)
            stage.until(lambda: not stage.truth.moving, LONGEST_MOVE_S, "the mechanics rest by themselves")
            stage.twin.plug()
            self._comes_back(stage)

    def test_pulled_out_at_rest_and_put_back(self, bench: MachineBench) -> None:
        """It can be used again at once."""
        with Stage(bench) as stage:
            stage.found()
            stage.twin.unplug()
            stage.until(lambda: stage.state.link.state is LinkPhase.LOST, NOTICED_S, "the lost line was noticed")
            require(stage.state.position_lost is not None, "the position is still claimed")
            stage.twin.plug()
            self._comes_back(stage)
            self._goes(stage)

    def test_each_fault_at_each_moment(self, bench: MachineBench) -> None:
        """The line pulled out, or the machine silent: at rest, in motion, in a pass, and while it is HELD."""
        for fault, shows in (("unplug", LinkPhase.LOST), ("mute", LinkPhase.SILENT)):
            for moment in (self._at_rest, self._moving, self._passing, self._held):
                with Stage(bench) as stage:
                    if moment == self._passing and stage.facts.no_following:
                        continue
                    moment(stage)
                    held = stage.state.held is not None
                    (stage.twin.unplug if fault == "unplug" else stage.twin.mute)()
                    self._until(stage, shows)
                    self._claims_nothing(stage)
                    stage.until(lambda: not stage.truth.moving, LONGEST_MOVE_S, "the mechanics rest by themselves")
                    (stage.twin.plug if fault == "unplug" else stage.twin.unmute)()
                    self._comes_back(stage)
                    require(stage.state.held is not None or not held, f"{fault}: STOP no longer holds it")

    def test_silent_in_motion(self, bench: MachineBench) -> None:
        """A machine that no longer answers is said to be silent, and its STOP is not called confirmed."""
        with Stage(bench) as stage:
            motion = self._moving(stage)
            stage.twin.mute()
            stage.station.stop("contract")
            self._until(stage, LinkPhase.SILENT)
            self._claims_nothing(stage, motion)
            stop = stage.state.last_stop
            require(stop is not None and stop.confirmed is not True, f"STOP reached nothing and is confirmed: {stop}")
            stage.until(lambda: not stage.truth.moving, LONGEST_MOVE_S, "the mechanics rest by themselves")
            stage.twin.unmute()
            self._comes_back(stage)
            require(stage.state.held is not None, "STOP no longer holds it")

    @staticmethod
    def _until(stage: Stage, shows: LinkPhase) -> None:
        # One that does not tell its position is asked nothing before its motion is over, be it the longest that it has.
        within_s = NOTICED_S + (0.0 if stage.tells else longest_s(stage.facts))
        stage.until(lambda: stage.state.link.state is shows, within_s, f"the link was shown as {shows.value}")

    @staticmethod
    def _at_rest(stage: Stage) -> None:
        stage.found()

    @staticmethod
    def _passing(stage: Stage) -> None:
        plan = made_up_pass(stage.found())
        stage.do(Pursue(plan, "contract", PursuitOptions(at_end="stay")))
        stage.step(plan.legs[0].start_s + 10.0 - stage.clock.utc().timestamp())

    @staticmethod
    def _held(stage: Stage) -> None:
        stage.found()
        stage.station.stop("contract")
        stage.step(5.0)

    @staticmethod
    def _moving(stage: Stage) -> Future[object]:
        scene = stage.bench.stops[0]
        stage.found()
        if scene.begin is not None:
            stage.do(Goto(*scene.begin, "contract"))
        future = stage.station.submit(Goto(*stage.target(*scene.way_deg), "contract"))
        stage.step(scene.after_s)
        require(stage.truth.moving, "nothing moves")
        return future

    @staticmethod
    def _claims_nothing(stage: Stage, motion: Future[object] | None = None) -> None:
        state = stage.state
        require(state.position_lost is not None, f"the position is still claimed: {state.position}")
        require(state.motion is None, f"a motion is still shown: {state.motion}")
        require(state.activity not in MOVING, f"it still shows {state.activity}")
        if motion is None:
            return
        done, error = motion.done(), motion.exception(0) if motion.done() else None
        require(done and isinstance(error, BirdcageError), f"who asked for the motion was told {error!r}")

    @staticmethod
    def _comes_back(stage: Stage) -> None:
        since, before = stage.clock.monotonic(), stage.truth
        stage.until(
            lambda: (
                stage.state.link.state is LinkPhase.UP
                and (stage.is_found or stage.knows_nothing() or stage.must_be_synced)
            ),
            BACK_S,
            "it came back",
        )
        stage.sync()
        require(stage.rests_for(3.0), "it moves by itself after it came back")
        require(stage.truth == before, f"it stood at {before} and is at {stage.truth}")
        require(not stage.taken_since(since), f"commands of moves went out: {stage.taken_since(since)}")
        right = stage.shows_truth() if stage.tells else stage.knows_nothing()
        require(right, f"shown: {stage.state.position}, true: {stage.truth}")

    @staticmethod
    def _goes(stage: Stage) -> None:
        if stage.state.held is not None:
            stage.do(Release("contract"))
        target = stage.go(20.0, 5.0)
        require(stage.stands_at(*target), f"sent to {target}, and is at {stage.truth}")
