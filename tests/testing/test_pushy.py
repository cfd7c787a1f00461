"""The contract, kept by a machine that pushes its position and leaves the turn of its cable to the host."""

from __future__ import annotations

import pytest
from birdcage.base.errors import BirdcageError, CommandRefused
from birdcage.rotator import machines
from birdcage.rotator.facts import CableTurn
from birdcage.station.requests import Goto, Read, Set, SetSearch
from birdcage.station.state import Activity, TvSearch
from birdcage.testing import Contract, MachineBench, Stage, StopScene
from installed_toys import installed


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import pushy_twin

        yield pushy_twin
    assert "pushy" not in machines.names(), "it stays installed after the test"


@pytest.fixture
def bench(twins):
    return MachineBench("pushy", twins.PushyTwin, stops=(StopScene("retarget", (100.0, 20.0), 1.0),))


class TestPushy(Contract):
    pass


@pytest.mark.parametrize(("turn_deg", "az_deg", "sent_deg"), [(250.0, 300.0, -60.0), (-200.0, 170.0, -190.0),
                                                             (100.0, 250.0, 250.0), (260.0, 250.0, 250.0)])  # fmt: skip
def test_the_host_chooses_the_turn(bench, twins, turn_deg, az_deg, sent_deg):
    with Stage(bench, lambda clock: twins.PushyTwin(clock, turn_deg)) as stage:
        stage.ready()
        assert stage.state.turn is CableTurn.REPORTED
        assert stage.state.position.cable_deg == pytest.approx(turn_deg)
        stage.do(Goto(az_deg, 40.0, "you"))
        assert stage.twin.motors[0].deg == pytest.approx(sent_deg)
        assert stage.state.position.cable_deg == pytest.approx(sent_deg)
        assert stage.state.position.az_deg == pytest.approx(az_deg)


def test_it_has_no_tv_search_to_end(bench):
    with Stage(bench) as stage:
        stage.ready()
        assert stage.state.search is TvSearch.NONE
        for disabled in (True, False):
            error = stage.refused(SetSearch("you", disabled), CommandRefused)
            assert str(error) == "The Pushy has no TV search. Nothing was sent."


def test_a_lamp_is_read_and_set_at_rest_only(bench):
    """Its supply may be read in motion; its lamp is said to be left alone then."""
    with Stage(bench) as stage:
        stage.ready()
        stage.station.submit(Goto(300.0, 40.0, "you"))
        stage.step(1.0)
        assert stage.truth.moving
        for request in (Read(("lamp",)), Set("lamp", 40.0, "you")):
            assert stage.refused(request, BirdcageError, within_s=1.0).reason == "moving"
        assert stage.twin.lamp == 0
        assert stage.do(Read(("supply",)), 1.0)["supply"].value == pytest.approx(12.1)


def test_what_it_tells_unasked_is_seen_by_all(bench):
    """Not asked for: no one watches, and the dish is pushed by hand."""
    with Stage(bench) as stage:
        stage.step(5.0)
        assert stage.state.activity is Activity.IDLE
        stage.twin.motors[0].go(112.0)
        stage.step(2.0)
        assert stage.state.fault.reason == "moved"
        assert stage.shows_truth()


def test_stop_aims_on_the_cable(bench, twins):
    """In a turn across north, the aim is on the far side of 0, and not a circle away."""
    with Stage(bench, lambda clock: twins.PushyTwin(clock, 40.0)) as stage:
        stage.ready()
        stage.station.submit(Goto(300.0, 30.0, "you"))
        stage.step(5.0)
        assert stage.twin.motors[0].deg < -10.0
        stage.station.stop("you")
        stage.step(5.0)
        assert -30.0 < stage.twin.motors[0].deg < -10.0
        assert stage.state.last_stop.confirmed is True


def test_stop_after_a_step_of_the_clock_does_not_lead_back(bench, twins):
    """The position is in doubt then: the aim is still ahead of where it goes, and not where it began."""
    with Stage(bench, lambda clock: twins.PushyTwin(clock, 250.0)) as stage:
        stage.ready()
        stage.station.submit(Goto(40.0, 30.0, "you"))
        stage.step(5.0)
        before = stage.twin.motors[0].deg
        stage.clock.step_utc(30.0)
        stage.step(0.3)
        assert stage.state.held is not None
        stage.step(5.0)
        assert before - 30.0 < stage.twin.motors[0].deg < before
