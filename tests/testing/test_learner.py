"""The contract, kept by a machine without a line, that tells its limits when it is met and its speeds never."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import MotionRefused
from birdcage.rotator import machines
from birdcage.rotator.facts import SecondMove
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import EVERY_MOVE, POWER_SWITCH, MoveKind, Rung, StopBy, StopMeans
from birdcage.station.requests import Goto, Home, Release
from birdcage.station.state import LimitSource
from birdcage.station.stop_words import stop_line
from birdcage.testing import Contract, MachineBench, Stage, StopScene
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shown.state_words import motion_text
from birdcage_tui.shown.view import View
from installed_toys import installed


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import learner_twin

        yield learner_twin


@pytest.fixture
def bench(twins):
    return MachineBench("learner", twins.LearnerTwin, stops=(StopScene("command", (80.0, 20.0), 1.0),), follows_deg=1.0)


def known(monkeypatch, learner, **facts):
    facts = replace(learner.FACTS, **facts)
    monkeypatch.setattr(learner.Learner, "facts", facts)
    monkeypatch.setattr(learner, "FACTS", facts)


class TestLearner(Contract):
    pass


def test_limits_are_those_that_it_has_told(bench, twins):
    """Gate, state and the faces' facts follow; another machine at the same name has its own."""
    assert machines.facts_of("learner").elevation.max_deg == 90.0
    with Stage(bench) as stage:
        stage.ready()
        state = stage.state
        assert (state.el_min_deg, state.el_max_deg) == (8.0, 72.0)
        assert state.limit_sources["el_max"] is LimitSource.DISH
        assert (state.dish.azimuth.min_deg, state.dish.azimuth.max_deg) == (20.0, 340.0)
        assert (state.cable_min_deg, state.cable_max_deg) == (20.0, 340.0)
        refusal = stage.refused(Goto(120.0, 80.0, "you"), MotionRefused)
        assert "80.00° is 8.00° above the limit of 72.00°" in str(refusal)
        assert "limit of 20.00°" in str(stage.refused(Goto(10.0, 30.0, "you"), MotionRefused))
        stage.do(Goto(25.0, 70.0, "you"))
        assert stage.stands_at(25.0, 70.0)
    with Stage(bench, lambda clock: twins.LearnerTwin(clock, el=(0.0, 45.0))) as stage:
        stage.ready()
        assert stage.state.el_max_deg == 45.0
    assert machines.facts_of("learner").elevation.max_deg == 90.0


def test_a_stop_command_that_is_ignored_leads_to_the_next_rung(bench, twins, monkeypatch):
    """Its own command does nothing, and is answered: it is stopped by a new target, and at once by that the next time.

    A rung that nothing has proven is said to do what it should, until a STOP has shown it.
    """
    from birdcage_toys import learner

    orders = []

    def stop_now(self, order):
        with self._writing:
            orders.append(order.by)
            for axis, deg in order.aim_deg.items():
                self._machine.go({learner.AXES.index(axis): deg})
            self._stops += 1

    retarget = Rung(means=StopMeans.RETARGET, ends=frozenset({MoveKind.SINGLE}), proven=False, sentence="a new target")
    known(monkeypatch, learner, stop_ladder=(learner.FACTS.stop_ladder[0], retarget, POWER_SWITCH))
    monkeypatch.setattr(learner.Learner, "stop_now", stop_now)
    with Stage(bench, lambda clock: twins.LearnerTwin(clock, speed_deg_s=4.0)) as stage:
        stage.ready()

        def stopped_in_motion(az_deg):
            stage.station.submit(Goto(az_deg, 40.0, "you"))
            stage.step(2.0)
            said = stop_line(stage.state, stage.clock.monotonic())
            stage.station.stop("you")
            stage.until(lambda: not stage.truth.moving, 30.0, "it rests")
            stage.until(lambda: stage.state.last_stop.confirmed is not None, 30.0, "STOP was followed up")
            assert abs(stage.truth.az_deg - az_deg) > 10.0, "it was stopped, and not there"
            stage.do(Release("you"))
            return said, stage.state.last_stop

        said, stop = stopped_in_motion(300.0)
        assert said == "STOP stops it; how fast is unknown"
        assert orders == [StopBy.COMMAND, StopBy.RETARGET]
        assert (stop.means, stop.confirmed) == (StopMeans.RETARGET, True)
        orders.clear()
        said, stop = stopped_in_motion(40.0)
        assert said == "STOP stops it; how fast is unknown", "it was seen to work"
        assert orders == [StopBy.RETARGET]


def test_a_script_stops_it_by_its_own_command(twins, monkeypatch):
    from birdcage_toys import learner

    orders, halt, clock = [], learner.Learner.stop_now, VirtualClock()

    def stop_now(self, order):
        orders.append(order.by)
        halt(self, order)

    monkeypatch.setattr(learner.Learner, "stop_now", stop_now)
    twin, machine = twins.LearnerTwin(clock), learner.Learner()
    machine.open(twin.address, None, clock, Hooks())
    machine.meet()
    antenna = BirdcageAntenna(machine)
    antenna.move_to(300.0, 40.0)
    machine.listen(clock.monotonic() + 1.0)
    assert twin.truth().moving
    antenna.stop()
    assert orders == [StopBy.COMMAND]
    assert not twin.truth().moving


def test_a_dish_that_waits_with_moves_still_obeys_its_stop_command(bench, monkeypatch):
    from birdcage_toys import learner

    known(monkeypatch, learner, second_same=SecondMove.BLOCK, second_other=SecondMove.BLOCK)
    with Stage(bench) as stage:
        stage.ready()
        stage.station.submit(Goto(200.0, 30.0, "you"))
        stage.step(1.0)
        stage.station.stop("you")
        assert not stage.truth.moving
        stage.step(5.0)
        assert (stage.state.last_stop.means, stage.state.last_stop.confirmed) == (StopMeans.COMMAND, True)


@pytest.mark.parametrize("proven", [True, False])
def test_stop_ends_a_homing_where_it_says_so(bench, monkeypatch, proven):
    """Its command works anywhere, and is known to end that; else nothing is sent, and no line says otherwise."""
    from birdcage_toys import learner

    rung = replace(learner.FACTS.stop_ladder[0], ends=EVERY_MOVE, proven=proven, anywhere=True)
    known(monkeypatch, learner, stop_ladder=(rung, POWER_SWITCH), homing_s=30.0)
    said = []

    def home(self, axis):
        self._machine.motors[0].go(300.0)
        self._pause(self.clock.monotonic() + 2.0)
        said.append(stop_line(stage.state, self.clock.monotonic()))
        stage.station.stop("you")
        said.append(stage.truth.moving)
        self._machine.motors[0].halt()

    monkeypatch.setattr(learner.Learner, "home", home)
    with Stage(bench) as stage:
        stage.ready()
        stage.station.submit(Home("you"))
        stage.step(6.0)
        stop = stage.state.last_stop
        if proven:
            assert said == ["STOP ends the homing", False], "its other axis is not homed"
            assert (stop.means, stop.confirmed) == (StopMeans.COMMAND, True)
        else:
            assert said == ["Homing has no STOP. In an emergency, switch off its plug.", True]
            assert stop.means is StopMeans.NONE


def test_a_target_that_is_not_answered_leads_to_the_stop_command(bench, monkeypatch):
    """Nothing tells whether it stopped: what its ladder has above that is sent, and its answer waited for."""
    from birdcage_toys import learner

    retarget = Rung(means=StopMeans.RETARGET, ends=frozenset({MoveKind.SINGLE}), proven=False, sentence="a new target")
    known(monkeypatch, learner, stop_ladder=(retarget, *learner.FACTS.stop_ladder))
    orders, halt = [], learner.Learner.stop_now

    def stop_now(self, order):
        orders.append(order.by)
        if order.by is StopBy.COMMAND:
            halt(self, order)

    monkeypatch.setattr(learner.Learner, "stop_now", stop_now)
    with Stage(bench) as stage:
        stage.ready()
        stage.station.submit(Goto(300.0, 30.0, "you"))
        stage.step(1.0)
        stage.station.stop("you")
        stage.step(10.0)
        assert orders == [StopBy.RETARGET] * 5 + [StopBy.COMMAND]
        assert not stage.truth.moving
        assert (stage.state.last_stop.means, stage.state.last_stop.confirmed) == (StopMeans.COMMAND, True)


@pytest.mark.parametrize("speed_deg_s", [1.5, 9.0, 60.0])
def test_no_time_of_arrival_is_invented(bench, twins, speed_deg_s):
    """Slow or fast, it arrives, it is not called stuck, and no time is shown."""

    with Stage(bench, lambda clock: twins.LearnerTwin(clock, speed_deg_s=speed_deg_s)) as stage:
        stage.ready()
        move = stage.station.submit(Goto(180.0, 50.0, "you"))
        stage.step(0.5)
        view = View(stage.state, stage.clock.monotonic(), stage.clock.utc(), AppOptions())
        assert re.fullmatch(r"SLEWING \d+\.\d° to go", motion_text(view))
        assert view.progress is None
        stage.until(move.done, 100.0, "it arrived")
        assert move.exception(0) is None
        assert stage.stands_at(180.0, 50.0)
        assert stage.state.fault is None


def test_one_call_takes_all_axes_that_change_and_no_others(bench):
    with Stage(bench) as stage:
        stage.ready()
        stage.do(Goto(140.0, 40.0, "you"))
        stage.do(Goto(150.0, 40.0, "you"))
        stage.do(Goto(160.0, 45.0, "you"))
        assert [set(each.motors) for each in stage.twin.taken()] == [{0, 1}, {0}, {0, 1}]
