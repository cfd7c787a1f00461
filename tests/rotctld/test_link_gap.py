"""The link is lost and comes back under clients: what each is told, and where the dish goes afterwards."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.rotator.facts import CableTurn
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.rprt import Rprt
from birdcage.rotctld.seen_dish import SeenDish
from birdcage.station.requests import AcquireLease, Home, Release, ReleaseLease
from birdcage.station.state import LinkPhase

from .shared_bench import SharedBench, code_of


def three(**options):
    bench = SharedBench(more="az=-160&el=40", **options)
    clients = bench.join("one", "two", "three")
    clients[0].set_position(210.0, 40.0)
    bench.settle()
    return bench, clients


def unplug(bench, seconds):
    bench.device.unplug()
    bench.run(seconds)
    assert bench.state.link.state is not LinkPhase.UP


def plug(bench, seconds=10.0):
    bench.device.plug()
    bench.run(seconds)
    assert bench.state.link.state is LinkPhase.UP


def test_the_last_position_is_repeated_and_the_newest_wish_sent_afterwards():
    bench, (one, two, three_) = three()
    last = one.position()
    assert bench.view("one").told == last
    unplug(bench, 3.0)
    sent = bench.sent_moves()
    for az in (215.0, 220.0, 225.0):
        one.set_position(az, 41.0)
        two.set_position(10.0, 50.0)
        assert {one.position(), two.position(), three_.position()} == {last}
        bench.run(2.0)
    assert all(view.stale for view in bench.shared.views())
    assert bench.view("one").waits
    plug(bench)
    bench.settle()
    assert sorted(bench.sent_moves()[len(sent) :]) == ["a 0 225.00", "a 1 41.00"], "the newest, and none of the others"
    assert one.position() == two.position() == pytest.approx((225.0, 41.0), abs=0.1)
    assert (bench.state.holder, bench.state.held) == ("one", None)
    assert not any(view.stale or view.waits for view in bench.shared.views())
    one.set_position(230.0, 41.0)
    bench.settle()
    assert one.position()[0] == pytest.approx(230.0, abs=0.1)


def test_a_motion_that_the_gap_has_cut_short_is_taken_up_again():
    bench, (one, _, _) = three()
    one.set_position(300.0, 40.0)
    bench.run(0.3)
    unplug(bench, 4.0)
    assert bench.state.held.reason is HeldReason.LINK
    plug(bench)
    bench.settle()
    assert one.position()[0] == pytest.approx(300.0, abs=0.1)
    assert bench.state.held is None


def test_a_dish_whose_moves_queue_is_taken_up_again_too():
    bench = SharedBench("hal205")
    client = bench.join("client")
    client.set_position(200.0, 40.0)
    bench.settle(200.0)
    client.set_position(260.0, 40.0)
    bench.run(1.0)
    unplug(bench, 4.0)
    client.set_position(265.0, 41.0)
    plug(bench, 40.0)
    bench.settle(200.0)
    assert client.position() == pytest.approx((265.0, 41.0), abs=0.1)
    assert bench.state.held is None


def test_a_dish_whose_slew_was_cut_short_and_that_was_then_turned_away_is_not_moved():
    bench = SharedBench("hal205")
    client = bench.join("client")
    client.set_position(200.0, 40.0)
    bench.settle(200.0)
    client.set_position(260.0, 40.0)
    bench.run(1.0)
    unplug(bench, 4.0)
    bench.device.wander(0, 60.0)
    bench.run(10.0)
    client.set_position(265.0, 41.0)
    sent = bench.sent_moves()
    plug(bench, 60.0)
    assert bench.sent_moves() == sent
    assert bench.state.held is not None


@pytest.mark.parametrize("options", [{}, {"gap_s": 5.0}])
def test_after_its_time_there_are_errors_and_a_person_releases(options):
    bench, (one, two, _) = three(**options)
    unplug(bench, options.get("gap_s", 20.0) + 1.0)
    assert code_of(one.position) is Rprt.EIO
    assert bench.view("one").told is None
    assert code_of(two.position) is Rprt.EIO
    assert code_of(one.set_position, 220.0, 40.0) is Rprt.EIO
    sent = bench.sent_moves()
    plug(bench)
    one.set_position(220.0, 40.0)
    bench.run(2.0)
    one.set_position(221.0, 40.0)
    bench.run(2.0)
    assert bench.sent_moves() == sent
    assert bench.state.held.reason is HeldReason.LINK
    assert one.position() == pytest.approx((210.0, 40.0), abs=0.1), "what is read is told"
    bench.do(Release("you"))
    one.set_position(222.0, 40.0)
    bench.settle()
    assert one.position()[0] == pytest.approx(222.0, abs=0.1)


def test_with_gap_error_there_are_errors_at_once_and_nothing_is_resumed():
    bench, (one, _, _) = three(gap="error")
    unplug(bench, 1.0)
    assert code_of(one.position) is Rprt.EIO
    assert code_of(one.set_position, 220.0, 40.0) is Rprt.EIO
    sent = bench.sent_moves()
    plug(bench)
    one.set_position(220.0, 40.0)
    bench.run(3.0)
    assert bench.sent_moves() == sent
    assert "HELD" in bench.view("one").why


def test_a_dish_that_falls_silent_times_out():
    bench, (one, _, _) = three(gap="error")
    bench.device.power_off()
    bench.run(6.0)
    assert bench.state.link.state is LinkPhase.SILENT
    assert code_of(one.position) is Rprt.ETIMEOUT


def test_the_wish_of_one_who_left_meanwhile_is_dropped():
    bench, (one, two, _) = three()
    unplug(bench, 2.0)
    one.set_position(220.0, 40.0)
    one.leave()
    sent = bench.sent_moves()
    plug(bench)
    assert bench.sent_moves() == sent
    two.set_position(230.0, 40.0)
    bench.run(3.0)
    assert bench.sent_moves() == sent, "it was another one's control that the link took"


def test_s_takes_the_waiting_wish_back():
    bench, (one, _, _) = three()
    unplug(bench, 2.0)
    one.set_position(220.0, 40.0)
    assert code_of(one.stop) is Rprt.EIO
    sent = bench.sent_moves()
    plug(bench)
    assert bench.sent_moves() == sent


def test_a_stop_of_a_person_in_the_gap_stays_latched():
    bench, (one, _, _) = three()
    unplug(bench, 2.0)
    one.set_position(220.0, 40.0)
    bench.station.stop("you")
    bench.run(1.0)
    sent = bench.sent_moves()
    plug(bench)
    one.set_position(225.0, 40.0)
    bench.run(3.0)
    assert bench.sent_moves() == sent
    assert bench.state.held is not None


def test_what_the_link_took_from_a_person_no_client_takes_up():
    bench, (one, _, _) = three()
    bench.do(AcquireLease("you", take_over=True))
    unplug(bench, 2.0)
    one.set_position(220.0, 40.0)
    sent = bench.sent_moves()
    plug(bench)
    assert bench.sent_moves() == sent
    assert bench.state.held.reason is HeldReason.LINK


def test_nothing_is_sent_before_the_dish_was_seen_at_rest():
    bench, (one, _, _) = three()
    one.set_position(300.0, 40.0)
    bench.run(0.3)
    unplug(bench, 2.0)
    held = bench.state.held
    one.set_position(220.0, 40.0)
    bench.device.plug()
    while bench.state.link.state is not LinkPhase.UP:
        bench.run(0.1)
        one.set_position(220.0, 40.0)
        assert bench.view("one").waits or bench.state.held != held
    bench.settle()
    assert one.position()[0] == pytest.approx(220.0, abs=0.1)
    assert bench.view("one").ignored == 0


def test_a_clock_that_stepped_in_the_gap_keeps_it_held():
    bench, (one, _, _) = three()
    unplug(bench, 2.0)
    one.set_position(220.0, 40.0)
    bench.clock.step_utc(600.0)
    bench.run(1.0)
    sent = bench.sent_moves()
    plug(bench)
    one.set_position(225.0, 40.0)
    bench.run(3.0)
    assert bench.sent_moves() == sent
    assert bench.state.held is not None


def test_the_turn_of_the_cable_is_known_after_the_gap_as_before():
    bench = SharedBench()
    bench.connect()
    bench.do(Home("you"), 60.0)
    bench.do(ReleaseLease("you"))
    one = bench.join("one")
    one.set_position(300.0, 40.0)
    bench.settle()
    assert bench.state.turn is CableTurn.COUNTED
    cable_deg = bench.state.position.cable_deg
    unplug(bench, 3.0)
    one.set_position(310.0, 40.0)
    plug(bench)
    bench.settle()
    assert bench.state.position.cable_deg == pytest.approx(cable_deg + 10.0, abs=0.1)


def test_a_dish_that_answers_and_does_not_know_where_it_points_has_no_position():
    bench, (one, _, _) = three()
    known, now = bench.state, bench.clock.monotonic()
    seen = SeenDish(RotctldOptions())
    assert seen.position(known, now).az_deg == one.position()[0]
    lost = replace(known, link=replace(known.link, state=LinkPhase.LOST, since=now), position_lost=Reason.LINK)
    assert seen.position(lost, now + 1.0) == known.position
    unhomed = replace(known, position=None, position_lost=Reason.UNHOMED)
    assert code_of(seen.position, unhomed, now + 2.0) is Rprt.EIO
    assert code_of(seen.position, lost, now + 3.0) is Rprt.EIO, "what it was told before counts no more"
    doubtful = replace(known, position_lost=Reason.RAW_COMMAND)
    assert code_of(seen.position, doubtful, now + 4.0) is Rprt.EIO


def test_a_dish_that_restarted_meanwhile_is_not_moved():
    bench, (one, _, _) = three()
    unplug(bench, 1.0)
    bench.device.power_cycle()
    one.set_position(220.0, 40.0)
    sent = len(bench.sent_moves())
    bench.device.plug()
    bench.run(60.0)
    assert not [line for line in bench.sent_moves()[sent:] if line.startswith("a ")]


def test_a_dish_that_was_turned_by_hand_meanwhile_is_not_moved():
    bench, (one, _, _) = three()
    unplug(bench, 2.0)
    one.set_position(220.0, 40.0)
    bench.device.wander(0, 30.0)
    sent = bench.sent_moves()
    plug(bench)
    bench.run(5.0)
    assert bench.sent_moves() == sent
