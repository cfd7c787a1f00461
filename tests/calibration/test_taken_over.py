"""In the app the guide takes control from a pursuit with its motion, and only where that is allowed."""

from __future__ import annotations

import pytest
from birdcage.calibration.guide import Guide
from birdcage.sky.targets.model import Fixed
from birdcage.station.pursuit_state import Phase, PursuitOptions
from birdcage.station.requests import Pursue

from tests.station.pursuit_bench import plan_of


@pytest.fixture
def followed(garden):
    """The garden's dish, on a target that the tracker follows; the guide is yours, as in the app."""
    garden.guide = Guide(
        garden.session, garden.guide.settings, garden.paths, environ={}, holder="you", over_pursuit=True
    )
    start_s = garden.clock.utc().timestamp() + 10.0
    garden.session.station.submit(Pursue(plan_of(start_s, lasts_s=300.0), "tracker", PursuitOptions()))
    garden.run(30.0)
    assert garden.session.station.state.pursuit.phase is Phase.FOLLOWING
    return garden


@pytest.mark.parametrize(
    "ask", [lambda guide: guide.nudge(0.0, 60.0), lambda guide: guide.go(Fixed("zenith", 180.0, 85.0))]
)
def test_a_nudge_or_an_object_beyond_a_limit_ends_no_pass(followed, ask):
    ask(followed.guide)
    followed.run(3.0)
    state = followed.session.station.state
    assert "above the limit of" in followed.guide.view().failure
    assert (state.pursuit.phase, state.holder) == (Phase.FOLLOWING, "tracker")


def test_a_nudge_that_is_allowed_takes_control(followed):
    followed.guide.nudge(1.0, 0.0)
    followed.run(3.0)
    state = followed.session.station.state
    assert followed.guide.view().failure == ""
    assert (state.pursuit.phase, state.holder) == (Phase.YIELDED, "you")
