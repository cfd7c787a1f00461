"""A satellite that a client follows is recognised, and followed by a plan until its wishes say otherwise."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta

import pytest
from birdcage.base.config import Settings
from birdcage.base.config.sections import MotionSettings
from birdcage.base.config.tracking_sections import TrackingSettings
from birdcage.base.errors import Stopped
from birdcage.rotctld import recogniser
from birdcage.rotctld.client_view import ClientRole
from birdcage.rotctld.recogniser import NO_CATALOGUE, NO_PLACE
from birdcage.rotctld.rotor import MoveDirection
from birdcage.rotctld.rprt import Rprt
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import AcquireLease, Goto, Pursue, Release, ReleaseLease

from .followed_bench import PLACE, FollowedBench
from .shared_bench import code_of

FOLLOWED_DEG = 0.2
"""So near a dish is that follows by a plan, and so far none that goes by steps of a degree and more."""


@pytest.fixture
def bench(tmp_path):
    return FollowedBench(tmp_path, park=(120.0, 40.0))


@pytest.fixture
def followed(bench):
    """The same in mid-pass, with Gpredict's satellite recognised."""
    bench.to_pass(bench.orbits[0], 20.0)
    recognised_in(bench, lambda: bench.gpredict(bench.orbits[0], 5.0))
    bench.gpredict(bench.orbits[0], 5.0)
    return bench


def recognised_in(bench, follow, seconds=150.0):
    """Let a program follow until the satellite is recognised."""
    end = bench.clock.monotonic() + seconds
    while bench.view.following is None:
        assert bench.clock.monotonic() < end, bench.view
        follow()


def phase(bench):
    return None if bench.state.pursuit is None else bench.state.pursuit.phase


@pytest.mark.parametrize("threshold_deg", [5.0, 2.5, 1.0])
def test_what_gpredict_follows_in_steps_the_dish_follows_closely(bench, threshold_deg):
    satellite = bench.orbits[0]
    bench.to_pass(satellite, 20.0)
    recognised_in(bench, lambda: bench.gpredict(satellite, 5.0, threshold_deg))
    bench.gpredict(satellite, 5.0, threshold_deg)
    following = bench.view.following
    assert following.name == satellite.name
    assert following.steps_deg > 0.3 * threshold_deg
    assert phase(bench) is Phase.FOLLOWING
    worst = 0.0
    for _ in range(8):
        assert bench.gpredict(satellite, 10.0, threshold_deg) == 0, "it is content"
        worst = max(worst, bench.off(satellite))
    assert worst < FOLLOWED_DEG
    assert bench.view.following.error_deg < FOLLOWED_DEG
    assert bench.view.role is ClientRole.CONTROL


@pytest.mark.parametrize("threshold_deg", [5.0, 1.0])
def test_gpredict_is_recognised_at_the_horizon_and_the_whole_pass_goes_by_the_plan(tmp_path, threshold_deg):
    bench = FollowedBench(tmp_path, soon=timedelta(seconds=390.0))
    satellite = bench.orbits[0]
    bench.to_pass(satellite, 1.0)
    recognised_in(bench, lambda: bench.gpredict(satellite, 2.0, threshold_deg))
    assert bench.look(satellite)[1] < 6.0, "far below what the dish reaches"
    assert bench.view.following.error_deg is None
    while bench.look(satellite)[1] < 19.0:
        bench.gpredict(satellite, 5.0, threshold_deg)
    bench.gpredict(satellite, 10.0, threshold_deg)
    assert phase(bench) is Phase.FOLLOWING
    assert bench.off(satellite) < FOLLOWED_DEG


@pytest.mark.parametrize(("threshold_deg", "every_s"), [(0.0, 1.0), (4.0, 3.0)], ids=["SatDump", "SatNOGS"])
def test_and_so_it_follows_what_others_wish_for_where_it_is_now(bench, threshold_deg, every_s):
    satellite = bench.orbits[0]
    bench.to_pass(satellite, 20.0)
    recognised_in(bench, lambda: bench.now(satellite, 6.0, threshold_deg, every_s))
    bench.now(satellite, 6.0, threshold_deg, every_s)
    assert bench.view.following.name == satellite.name
    moved = len(bench.events)
    bench.now(satellite, 30.0, threshold_deg, every_s)
    assert bench.off(satellite) < FOLLOWED_DEG
    assert len(bench.events) > moved
    assert bench.state.pursuit.number == 1, "nothing came between"
    assert bench.view.ignored == 0


def test_a_long_way_to_where_the_plan_begins_is_counted_down_and_a_wish_of_the_client_is_not(bench, monkeypatch):
    satellite = bench.orbits[0]
    monkeypatch.setattr(recogniser, "FAR_DEG", 0.0)
    bench.to_pass(satellite, 20.0)
    assert bench.gpredict(satellite, 1.0) > 0
    bench.run(1.0)
    assert bench.state.motion is not None or bench.off(satellite) < 6.0, "it moves at once"
    recognised_in(bench, lambda: bench.gpredict(satellite, 1.0))
    assert phase(bench) is Phase.COUNTDOWN
    before = bench.device.truth().az_deg
    bench.client.set_position(*bench.look(satellite, 5.0))
    bench.run(2.0)
    assert (phase(bench), bench.device.truth().az_deg) == (Phase.COUNTDOWN, pytest.approx(before, abs=0.01))
    bench.gpredict(satellite, 12.0)
    assert phase(bench) is Phase.FOLLOWING
    assert bench.off(satellite) < FOLLOWED_DEG


def test_while_it_counts_down_a_wish_for_something_else_ends_it(bench, monkeypatch):
    monkeypatch.setattr(recogniser, "FAR_DEG", 0.0)
    bench.to_pass(bench.orbits[0], 20.0)
    recognised_in(bench, lambda: bench.gpredict(bench.orbits[0], 1.0))
    bench.client.set_position(90.0, 60.0)
    bench.run(40.0)
    assert phase(bench) is Phase.OVER
    assert round(bench.device.truth().az_deg % 360.0) == 90


def test_a_pass_that_is_waited_for_is_left_by_a_wish_for_something_else_too(tmp_path):
    bench = FollowedBench(tmp_path, settings=Settings(place=PLACE, motion=MotionSettings(min_elevation_deg=35.0)),
                          station={"min_elevation_deg": 35.0})  # fmt: skip
    satellite = bench.orbits[0]
    bench.to_pass(satellite, 16.0)
    recognised_in(bench, lambda: bench.now(satellite, 5.0))
    assert phase(bench) in (Phase.WAITING, Phase.READY, Phase.PREPOSITIONING)
    bench.client.set_position(10.0, 60.0)
    bench.run(150.0)
    assert phase(bench) is Phase.OVER
    assert round(bench.device.truth().az_deg % 360.0) == 10


def test_the_first_wish_for_something_else_moves_the_dish_there_at_once_and_control_stays(followed):
    followed.client.set_position(100.0, 60.0)
    followed.run(1.0)
    assert phase(followed) is Phase.OVER
    assert followed.state.holder == "rotctld 1"
    assert followed.view.following is None
    followed.run(40.0)
    assert (round(followed.device.truth().az_deg % 360.0), round(followed.device.truth().el_deg)) == (100, 60)


def test_a_wish_further_along_its_path_than_the_threshold_is_another_one(followed):
    there = followed.look(followed.orbits[0], 60.0)
    followed.client.set_position(*there)
    followed.run(20.0)
    assert phase(followed) is Phase.OVER
    truth = followed.device.truth()
    assert (truth.az_deg % 360.0, truth.el_deg) == pytest.approx(there, abs=0.1)


def test_a_wish_for_it_while_it_is_followed_is_carried_out_by_the_plan(followed):
    satellite = followed.orbits[0]
    followed.client.set_position(*followed.look(satellite, 10.0))  # what Gpredict sends where it was late
    followed.run(5.0)
    assert phase(followed) is Phase.FOLLOWING
    assert followed.off(satellite) < FOLLOWED_DEG


def test_stop_of_the_client_ends_it_and_its_next_wishes_are_carried_out_as_they_are(followed):
    followed.client.stop()
    followed.run(1.0)
    assert phase(followed) is Phase.OVER
    assert followed.state.holder is None
    followed.client.set_position(300.0, 50.0)
    followed.run(30.0)
    assert round(followed.device.truth().az_deg % 360.0) == 300


def test_a_park_that_is_refused_changes_nothing(tmp_path):
    bench = FollowedBench(tmp_path)
    bench.to_pass(bench.orbits[0], 20.0)
    recognised_in(bench, lambda: bench.now(bench.orbits[0], 2.0))
    assert code_of(bench.client.park) is Rprt.ENAVAIL
    bench.now(bench.orbits[0], 10.0)
    assert bench.view.following is not None
    assert bench.off(bench.orbits[0]) < FOLLOWED_DEG


def test_park_ends_it_too(followed):
    followed.client.park()
    followed.run(40.0)
    assert phase(followed) is Phase.OVER
    assert round(followed.device.truth().az_deg % 360.0) == 120


def test_a_drive_ends_it(followed):
    followed.client.move(MoveDirection.UP, 50)
    followed.run(1.0)
    assert phase(followed) is Phase.OVER
    before = followed.device.truth().el_deg
    followed.run(6.0)
    assert followed.device.truth().el_deg > before - 0.5


def test_a_client_that_hangs_up_ends_it_and_gives_control_back(followed):
    followed.client.leave()
    followed.run(3.0)
    assert phase(followed) is Phase.OVER
    assert followed.state.holder is None


def test_a_client_that_falls_silent_is_not_followed_for_long(followed):
    followed.run(25.0)
    assert phase(followed) is Phase.FOLLOWING
    followed.run(8.0)
    assert phase(followed) is Phase.OVER


def test_who_takes_control_has_the_dish_and_it_is_not_followed_again_by_itself(followed):
    followed.station.submit(AcquireLease("you", take_over=True))
    followed.run(2.0)
    assert phase(followed) is Phase.OVER
    followed.station.submit(ReleaseLease("you"))
    followed.run(10.0)
    assert phase(followed) is Phase.OVER
    assert followed.state.motion is None


def test_stop_latches_and_no_wish_of_it_moves_the_dish_until_a_person_releases_it(followed):
    followed.station.stop("you")
    followed.run(1.0)
    assert phase(followed) is Phase.OVER
    followed.run(2.0)
    before = followed.device.truth().az_deg
    followed.gpredict(followed.orbits[0], 40.0)
    assert followed.device.truth().az_deg == pytest.approx(before, abs=0.01)
    assert followed.view.role is ClientRole.IGNORED
    followed.station.submit(Release("you"))
    followed.run(1.0)
    recognised_in(followed, lambda: followed.gpredict(followed.orbits[0], 5.0))


def test_switched_off_in_mid_pass_the_last_wish_counts_again(followed):
    wish = followed.view.wish
    followed.recogniser.on = False
    followed.run(20.0)
    assert phase(followed) is Phase.OVER
    truth = followed.device.truth()
    assert (truth.az_deg % 360.0, truth.el_deg) == pytest.approx((wish.az_deg, wish.el_deg), abs=0.1)
    assert followed.state.holder == "rotctld 1"
    followed.gpredict(followed.orbits[0], 30.0)
    assert followed.view.following is None


def test_once_the_pass_is_out_of_reach_the_clients_own_wishes_count_and_nothing_parks(tmp_path):
    park = TrackingSettings(park_az_deg=120.0, park_el_deg=40.0)
    bench = FollowedBench(tmp_path, settings=Settings(place=PLACE, tracking=park), soon=timedelta(0))
    satellite = bench.orbits[0]
    recognised_in(bench, lambda: bench.gpredict(satellite, 5.0))
    while bench.look(satellite)[1] > 16.0:
        bench.gpredict(satellite, 10.0)
    bench.gpredict(satellite, 60.0)
    assert bench.view.following is None
    assert bench.view.role is ClientRole.CONTROL
    assert bench.state.position.el_deg == pytest.approx(18.0, abs=0.2)
    assert phase(bench) is Phase.OVER, "neither what is left of the pass, nor the next one"


def test_what_the_dish_refuses_to_follow_is_asked_for_once(tmp_path, caplog):
    caplog.set_level("INFO", "birdcage.rotctld")
    bench = FollowedBench(
        tmp_path, settings=Settings(place=PLACE, tracking=TrackingSettings(controller="velocity")), soon=timedelta(0)
    )
    bench.now(bench.orbits[0], 60.0)
    assert bench.view.following is None
    assert bench.view.role is ClientRole.CONTROL
    assert bench.off(bench.orbits[0]) < 3.0, "it goes by the client's own wishes"
    assert sum("is not followed" in line for line in caplog.messages) == 1


def test_a_satellite_that_is_in_no_catalogue_is_followed_by_the_clients_own_wishes(tmp_path):
    others = FollowedBench(tmp_path / "all").orbits
    bench = FollowedBench(tmp_path / "some", catalogue=others[1:])
    bench.to_pass(others[0], 20.0)
    bench.gpredict(others[0], 120.0)
    assert bench.view.following is None
    assert bench.recogniser.lacks == ""
    assert bench.off(others[0]) < 8.0


def almost(bench):
    """Have Gpredict follow until a satellite was recognised that is not yet followed."""
    answers = bench.client._wishes.pursuit._answers
    bench.to_pass(bench.orbits[0], 20.0)
    for _ in range(300):
        bench.gpredict(bench.orbits[0], 0.9)
        bench.client.set_position(*bench.look(bench.orbits[0], 3.0))
        bench.recogniser.step()
        if any(found is not None for _, found in answers):
            return
    raise AssertionError("nothing was recognised")


def test_a_satellite_that_is_told_after_the_client_went_over_to_something_else_is_not_followed(bench):
    almost(bench)
    bench.client.set_position(200.0, 60.0)
    bench.run(40.0)
    assert phase(bench) is None
    assert round(bench.device.truth().az_deg % 360.0) == 200


def test_nor_is_one_that_is_told_after_its_stop(bench):
    almost(bench)
    bench.client.stop()
    bench.run(1.0)
    bench.client.set_position(*bench.look(bench.orbits[0]))
    bench.run(5.0)
    assert phase(bench) is None


def test_nor_is_one_while_another_has_control(bench):
    almost(bench)
    bench.station.submit(AcquireLease("you", take_over=True))
    bench.run(5.0)
    assert phase(bench) is None


@pytest.mark.parametrize(
    ("more", "lacks"), [({"settings": Settings()}, NO_PLACE), ({"catalogue": ()}, NO_CATALOGUE)], ids=["place", "sets"]
)
def test_it_says_what_it_lacks(tmp_path, more, lacks):
    bench = FollowedBench(tmp_path, **more)
    assert bench.recogniser.lacks == lacks
    bench.to_pass(bench.orbits[0], 20.0)
    bench.gpredict(bench.orbits[0], 60.0)
    assert bench.view.following is None
    assert bench.view.role is ClientRole.CONTROL


def test_a_fixed_direction_and_a_slow_one_are_never_taken_for_a_satellite(bench):
    for turn in range(60):
        bench.client.set_position(180.0 + 0.004 * turn, 40.0)
        bench.run(1.0)
    assert bench.view.following is None
    assert phase(bench) is None


def test_a_pursuit_that_waits_for_its_own_pass_is_left_alone(followed):
    first = followed.state.pursuit
    followed.client.stop()
    followed.run(1.0)
    later = replace(first.plan, preposition=replace(
        first.plan.preposition or _place(first.plan), leave_s=followed.clock.utc().timestamp() + 3600.0,
    ))  # fmt: skip
    future = followed.station.submit(Pursue(later, "tracker", first.options, asked=False))
    followed.run(1.0)
    assert future.done()
    assert future.exception() is None
    followed.gpredict(followed.orbits[0], 60.0)
    assert followed.state.pursuit.holder == "tracker"
    assert followed.view.following is None


def _place(plan):
    pytest.skip("this plan has no place to be at before")


def test_a_person_has_a_client_ignored_and_its_motion_ends(followed):
    followed.client.shut_out(on=True)
    followed.run(2.0)
    assert phase(followed) is Phase.OVER
    before = followed.device.truth().az_deg
    assert followed.gpredict(followed.orbits[0], 40.0) > 0
    assert followed.device.truth().az_deg == pytest.approx(before, abs=0.01)
    assert (followed.view.role, followed.view.shut_out) == (ClientRole.IGNORED, True)
    followed.client.shut_out(on=False)
    followed.gpredict(followed.orbits[0], 40.0)
    assert followed.view.role is ClientRole.CONTROL


def test_who_is_ignored_keeps_nobody_else_from_the_dish(followed):
    followed.client.shut_out(on=True)
    followed.run(1.0)
    future = followed.station.submit(Goto(200.0, 45.0, "you"))
    followed.run(40.0)
    assert future.result() is not None
    assert not isinstance(future.exception(), Stopped)
