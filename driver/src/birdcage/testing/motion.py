"""Cases: going somewhere, steps by hand, and what is refused."""

from __future__ import annotations

import math

from birdcage.base.errors import MotionRefused, Superseded
from birdcage.base.geometry import separation, shortest_turn
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION
from birdcage.station.requests import Goto, Jog
from birdcage.station.state import Activity
from birdcage.testing.stage import STEP_S, Stage, require
from birdcage.testing.twin import MachineBench

QUARTERS_DEG = (45.0, 135.0, 225.0, 315.0)


class MotionContract:
    """Arrival is what the mechanics do, never what was sent."""

    def test_a_go_to_arrives_where_the_truth_is(self, bench: MachineBench) -> None:
        """A go-to is over when the mechanics rest at the target, not sooner, and what is shown agrees."""
        with Stage(bench) as stage:
            target = stage.ready().go(40.0, 12.0)
            require(stage.stands_at(*target), f"it said to have arrived at {target}, and is at {stage.truth}")
            require(stage.shows_truth(), f"shown: {stage.state.position}, true: {stage.truth}")
            require(stage.state.activity is Activity.IDLE, f"it still shows {stage.state.activity}")
            require(stage.state.motion is None, "a motion is still shown")

    def test_it_goes_all_round_its_circle(self, bench: MachineBench) -> None:
        """Each quarter that axis and cable allow is reached and shown, however the machine itself counts."""
        with Stage(bench) as stage:
            facts = stage.found().facts
            if facts.mapping is not None:
                return
            for az_deg in QUARTERS_DEG:
                turns = [az_deg + 360.0 * turn for turn in (-2, -1, 0, 1, 2)]
                on_axis = facts.azimuth.min_deg <= az_deg <= facts.azimuth.max_deg
                cable = facts.cable
                if on_axis and (cable is None or any(cable.min_deg <= each <= cable.max_deg for each in turns)):
                    target = az_deg, stage.target(0.0, 2.0)[1]
                    stage.do(Goto(*target, "contract"))
                    require(stage.stands_at(*target), f"sent to {target}, and is at {stage.truth}")
                    require(stage.shows_truth(), f"shown: {stage.state.position}, true: {stage.truth}")

    def test_a_newer_target_wins(self, bench: MachineBench) -> None:
        """Of two go-tos the second one counts, and whoever asked for the first is told."""
        with Stage(bench) as stage:
            stage.ready()
            first = stage.station.submit(Goto(*stage.target(50.0, 10.0), "contract"))
            stage.step(0.5)
            target = stage.target(25.0, 6.0)
            stage.do(Goto(*target, "contract"))
            require(isinstance(first.exception(0), Superseded), f"the first one ended otherwise: {first.exception(0)}")
            require(stage.stands_at(*target), f"sent to {target}, and is at {stage.truth}")

    def test_a_step_moves_one_axis_and_names_only_that(self, bench: MachineBench) -> None:
        """An arrow key turns one axis; the other one is not even sent where it stands, as that may stir it.

        Unless the machine cannot be sent one axis alone.
        """
        with Stage(bench) as stage:
            stage.found().go(30.0, 8.0)
            if stage.facts.mapping is not None:
                self._step_along(stage)
                return
            for motor, step in ((MOTOR_AZIMUTH, (2.0, 0.0)), (MOTOR_ELEVATION, (0.0, -1.0))):
                before, since = stage.truth, stage.clock.monotonic()
                stage.step(STEP_S)
                stage.do(Jog(*step, "contract"))
                now, near = stage.truth, bench.near_deg
                az_deg, el_deg = shortest_turn(before.az_deg, now.az_deg), now.el_deg - before.el_deg
                require(
                    abs(az_deg - step[0]) <= 2 * near and abs(el_deg - step[1]) <= 2 * near,
                    f"a step of {step} turned azimuth by {az_deg:+.2f}° and elevation by {el_deg:+.2f}°",
                )
                named = frozenset[int]().union(*(each.motors for each in stage.taken_since(since)))
                require(motor in named, f"the command of the step names {sorted(named)}")
                alone = stage.facts.moves_one_axis
                require(named == {motor} or not alone, f"a step of axis {motor} names {sorted(named)}")

    @staticmethod
    def _step_along(stage: Stage) -> None:
        """A step goes to the nearest point that the machine reaches, and what it misses is told."""
        for step in ((0.7, 0.0), (0.0, -0.7)):
            asked = stage.truth.az_deg + step[0], stage.truth.el_deg + step[1]
            nearest = stage.target(*step)
            stage.do(Jog(*step, "contract"))
            require(stage.stands_at(*nearest), f"{nearest} is the nearest to {asked}, and it is at {stage.truth}")
            off_deg, told_deg = separation(*asked, stage.truth.az_deg, stage.truth.el_deg), stage.state.target_miss_deg
            require(abs(off_deg - told_deg) <= stage.bench.near_deg, f"{off_deg:.2f}° off, and {told_deg:.2f}° is told")

    def test_what_it_cannot_reach_is_refused_with_the_nearest(self, bench: MachineBench) -> None:
        """Of a machine whose axes are not azimuth and elevation: how far it would miss, and where it could go."""
        with Stage(bench) as stage:
            mapping = stage.found().facts.mapping
            if mapping is None:
                require(not stage.facts.no_direction, f"it has no azimuth and elevation: {stage.facts.no_direction}")
                return
            since, (low, high) = stage.clock.monotonic(), stage.elevations
            az_deg, el_deg = max(
                ((az, el) for az in (90.0, 180.0, 270.0) for el in (low, high)), key=lambda to: mapping.to_axes(*to)[1]
            )
            angles, miss_deg = mapping.to_axes(az_deg, el_deg)
            near_az, near_el = mapping.to_sky(angles)
            refusal = str(stage.refused(Goto(az_deg, el_deg, "contract"), MotionRefused))
            for said in (f"{miss_deg:.2f}°", f"azimuth {near_az:.2f}°, elevation {near_el:.2f}°", "Nothing was sent"):
                require(said in refusal, f"{said!r} is not told: {refusal}")
            require(not stage.taken_since(since), f"commands of moves went out: {stage.taken_since(since)}")

    def test_on_its_way_it_is_shown_where_its_axes_point(self, bench: MachineBench) -> None:
        """Of such a machine: along its arc, and not on a straight line through the sky."""
        with Stage(bench) as stage:
            mapping = stage.found().facts.mapping
            if mapping is None:
                return
            future = stage.station.submit(Goto(*stage.target(60.0, 0.0), "contract"))
            while not future.done():
                stage.step(0.5)
                here = stage.state.position
                require(here is not None, "its position is lost on its way")
                assert here is not None
                off_deg = mapping.to_axes(here.dish_az_deg, here.dish_el_deg)[1]
                require(off_deg <= bench.near_deg, f"shown {off_deg:.2f}° off all that it reaches: {here}")

    def test_steps_add_up(self, bench: MachineBench) -> None:
        """Three presses in a row are three steps, however late the machine is."""
        with Stage(bench) as stage:
            az_deg, el_deg = stage.found().go(30.0, 8.0)
            presses = [stage.station.submit(Jog(1.0, 0.0, "contract")) for _ in range(3)]
            stage.until(presses[-1].done, 60.0, "three steps were gone")
            target = az_deg + 3.0, el_deg
            if stage.facts.mapping is not None:
                target = stage.target(3.0, 0.0, start=(az_deg, el_deg))
            require(stage.stands_at(*target), f"three steps from {az_deg}° and it is at {stage.truth}")

    def test_beyond_a_limit_nothing_is_sent(self, bench: MachineBench) -> None:
        """Whatever asks, and be it no number: a refusal says so in a sentence, and the wire stays quiet."""
        with Stage(bench) as stage:
            stage.found()
            (low, high), (az_deg, el_deg) = stage.elevations, stage.target(10.0, 0.0)
            before, since = stage.truth, stage.clock.monotonic()
            for request in (
                Goto(az_deg, high + 5.0, "contract"), Goto(az_deg, low - 5.0, "contract"),
                Goto(math.nan, el_deg, "contract"), Goto(az_deg, math.inf, "contract"),
                Jog(0.0, high - low + 5.0, "contract"), Jog(0.0, low - high - 5.0, "contract"),
            ):  # fmt: skip
                refusal = stage.refused(request, MotionRefused)
                require("Nothing was sent" in str(refusal), f"{request}: {refusal}")
            require(stage.rests_for(2.0), "it moved")
            require(stage.truth == before, f"it stood at {before} and is at {stage.truth}")
            require(not stage.taken_since(since), f"commands of moves went out: {stage.taken_since(since)}")
            require(stage.state.holder is None, "a refused motion has taken control")
