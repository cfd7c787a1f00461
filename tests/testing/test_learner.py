"""The contract, kept by a machine without a line, that tells its limits when it is met and its speeds never."""

from __future__ import annotations

import re

import pytest
from birdcage.base.errors import MotionRefused
from birdcage.rotator import machines
from birdcage.station.requests import Goto
from birdcage.station.state import LimitSource
from birdcage.testing import Bench, Contract, Stage, StopScene
from birdcage_tui.settings import AppSettings
from birdcage_tui.view import View
from birdcage_tui.words import motion_text

from .installed import installed


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import learner_twin

        yield learner_twin


@pytest.fixture
def bench(twins):
    return Bench("learner", twins.LearnerTwin, stops=(StopScene("command", (80.0, 20.0), 1.0),), follows_deg=1.0)


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


@pytest.mark.parametrize("speed_deg_s", [1.5, 9.0, 60.0])
def test_no_time_of_arrival_is_invented(bench, twins, speed_deg_s):
    """Slow or fast, it arrives, it is not called stuck, and no time is shown."""

    with Stage(bench, lambda clock: twins.LearnerTwin(clock, speed_deg_s=speed_deg_s)) as stage:
        stage.ready()
        move = stage.station.submit(Goto(180.0, 50.0, "you"))
        stage.step(0.5)
        view = View(stage.state, stage.clock.monotonic(), stage.clock.utc(), AppSettings())
        assert re.fullmatch(r"SLEWING \d+\.\d° to go", motion_text(view))
        assert view.progress is None
        stage.until(move.done, 100.0, "it arrived")
        assert move.exception(0) is None
        assert stage.stands_at(180.0, 50.0)
        assert stage.state.fault is None
