"""Cases: opening the line and meeting the machine."""

from __future__ import annotations

from birdcage.base.errors import MotionRefused
from birdcage.rotator import machines
from birdcage.rotator.axis import Role
from birdcage.station.requests import Goto, Jog, ReleaseLease
from birdcage.station.state import LinkPhase
from birdcage.testing.stage import FIRST_DEG, STEP_S, Stage, require
from birdcage.testing.twin import MachineBench


class MeetingContract:
    """What holds before anything is asked for."""

    def test_it_is_found_by_its_name_and_tells_its_facts(self, bench: MachineBench) -> None:
        """Every face reads the facts before a port is open: they need no machine."""
        facts = machines.facts_of(bench.machine)
        require(facts.name, "the machine has no name")
        require(facts.firmware == bench.machine, f"facts say {facts.firmware!r}, it is found as {bench.machine!r}")
        require(facts.stop_ladder, "the ladder of STOP has no rung: what stops it, be it a person at a switch?")
        for axis in facts.axes:
            require(axis.min_deg < axis.max_deg, f"{axis.name}: {axis.min_deg} to {axis.max_deg} is no range")
            require(axis.step_deg > 0.0, f"{axis.name} has no step")
            require(
                axis.role is not Role.AZ or (axis.min_deg >= 0.0 and axis.max_deg <= 360.0),
                f"{axis.name}: {axis.min_deg:g} to {axis.max_deg:g}; an azimuth counts on the circle, 0 to 360. What "
                "the machine takes beyond is its `cable`, with turn=Turn.REPORTED and turn_by=TurnBy.HOST of the axis",
            )

    def test_it_is_met_without_moving(self, bench: MachineBench) -> None:
        """Plugging in must never set a machine in motion."""
        with Stage(bench) as stage:
            before = stage.truth
            stage.ready()
            require(stage.state.link.state is LinkPhase.UP, "the link is not up")
            require(stage.truth == before, f"it stood at {before} and stands at {stage.truth}")
            require(not stage.twin.taken(), f"commands of moves went out: {stage.twin.taken()}")

    def test_what_is_shown_is_what_the_mechanics_do(self, bench: MachineBench) -> None:
        """The position on the screen is where it points, within its limits, and control is free.

        A machine that does not tell it refuses a step, and shows nothing before the end of its first go-to, unless it
        tells that while it moves.
        """
        with Stage(bench) as stage:
            stage.ready()
            if not stage.tells:
                self._not_told(stage)
            require(stage.shows_truth(), f"shown: {stage.state.position}, true: {stage.truth}")
            low, high = stage.elevations
            require(low <= stage.truth.el_deg <= high, f"it stands at {stage.truth.el_deg}°, outside {low} to {high}")
            require(stage.state.holder is None, f"{stage.state.holder} has control, unasked")
            require(stage.state.fault is None, f"a fault stands: {stage.state.fault}")

    @staticmethod
    def _not_told(stage: Stage) -> None:
        stage.refused(Jog(1.0, 0.0, "contract"), MotionRefused)
        require(stage.rests_for(2.0) and not stage.twin.taken(), "a step from nowhere known has moved it")
        target = stage.target(*FIRST_DEG)
        future = stage.station.submit(Goto(*target, "contract"))
        while not future.done():
            require(
                not stage.is_found or not stage.truth.moving or stage.tells_truth_on_its_way(),
                f"shown on a way from nowhere known: {stage.state.position}",
            )
            stage.step(STEP_S)
        future.result(0)
        require(stage.stands_at(*target), f"it said to have arrived at {target}, and is at {stage.truth}")
        stage.do(ReleaseLease("contract"))

    def test_closing_leaves_it_at_rest(self, bench: MachineBench) -> None:
        """A program that ends while the machine rests sends nothing that moves it."""
        with Stage(bench) as stage:
            stage.ready()
        before = stage.truth
        stage.clock.advance(5.0)
        require(stage.truth == before, f"it stood at {before} and stands at {stage.truth}")
        require(not stage.twin.taken(), f"commands of moves went out: {stage.twin.taken()}")
