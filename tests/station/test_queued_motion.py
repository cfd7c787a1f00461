"""A dish whose moves queue: silent slews, one axis after the other, latest wins, skew."""

from __future__ import annotations

import pytest
from birdcage.base.errors import MotionRefused, Superseded
from birdcage.station.events import MoveEnded, PositionRead
from birdcage.station.requests import Goto, Home, Jog, TurnSkew
from birdcage.station.state import Activity

from .queued_bench import connected


@pytest.fixture
def bench():
    return connected()


def there(bench, az, el):
    truth = bench.device.truth()
    assert not truth.moving
    assert truth.az_deg == pytest.approx(az, abs=0.05)
    assert truth.el_deg == pytest.approx(el, abs=0.05)


def test_a_long_way_is_gone_by_one_silent_slew(bench):
    since = bench.clock.monotonic()
    pointing = bench.do(Goto(230, 30, "you"), 60)
    assert (pointing.az_deg, pointing.el_deg, pointing.modelled) == (pytest.approx(230), pytest.approx(30), False)
    assert bench.sent_moves(since) == ["g 230.00 30.00 90.00"]
    there(bench, 230, 30)
    assert bench.state.activity is Activity.IDLE
    assert bench.state.motion is None


def test_not_a_byte_leaves_while_the_slew_lasts(bench):
    bench.watch("position", "rssi")
    bench.step(2)
    bench.station.submit(Goto(290, 30, "you"))
    bench.step(1)
    began = next(at for at, data in bench.sent if data.startswith(b"g "))
    reads = []
    bench.station.subscribe(lambda event: reads.append(event) if isinstance(event, PositionRead) else None)
    while bench.device.truth().moving:
        bench.step(0.1)
        assert bench.sent_since(began + 1e-6) == b""
        assert bench.state.position.modelled or not bench.device.truth().moving
    assert bench.clock.monotonic() - began > 10
    bench.step(5)
    there(bench, 290, 30)


def test_the_modelled_position_tells_its_source_and_its_age(bench):
    bench.watch("position")
    bench.step(2)
    bench.station.submit(Goto(290, 30, "you"))
    bench.step(6)
    now, position = bench.clock.monotonic(), bench.state.position
    assert position.modelled
    assert 185 < position.az_deg < 285
    assert now - position.at < 0.2
    assert now - position.told_at > 5
    assert bench.state.motion.stop_means == "abort"
    assert bench.state.motion.rests_at is None
    bench.step(20)
    assert not bench.state.position.modelled


def test_short_ways_are_gone_one_axis_after_the_other(bench):
    since = bench.clock.monotonic()
    bench.station.submit(Goto(183, 42, "you"))
    bench.step(1.0)
    assert len(bench.sent_moves(since)) == 1
    assert bench.state.motion.stop_means == "end of move"
    assert bench.state.motion.rests_at > bench.clock.monotonic()
    assert bench.state.motion.eta > bench.state.motion.rests_at
    bench.step(20)
    there(bench, 183, 42)
    moves = bench.sent_moves(since)
    assert sorted(moves) == ["a 0 183.00", "a 1 42.00"]


def test_the_second_axis_is_sent_only_when_the_first_rests(bench):
    bench.station.submit(Goto(183, 42, "you"))
    moving = []
    bench.on_write = lambda data: moving.append(bench.device.dish.axes) if data.startswith(b"a 1 ") else None
    speeds = []

    def look(data):
        if data.startswith((b"a 0 ", b"a 1 ")):
            now = bench.device.machine.dish_s
            speeds.append([axis.moving(now) for axis in bench.device.dish.axes[:2]])

    bench.on_write = look
    bench.step(20)
    assert len(speeds) == 2
    assert speeds[1].count(True) <= 1  # the one that begins now


def test_the_axes_take_turns_in_going_first(bench):
    since = bench.clock.monotonic()
    bench.do(Goto(182, 43, "you"))
    bench.do(Goto(184, 41, "you"))
    assert [line.split()[1] for line in bench.sent_moves(since)] in (["0", "1", "1", "0"], ["1", "0", "0", "1"])


def test_there_already_sends_nothing(bench):
    bench.do(Goto(183, 42, "you"))
    since = bench.clock.monotonic()
    assert bench.do(Goto(183, 42, "you")).az_deg == pytest.approx(183, abs=0.05)
    assert bench.sent_moves(since) == []


def test_a_way_across_north_may_go_round_and_so_is_gone_by_a_slew_that_can_be_stopped():
    bench = connected("az=2")
    since = bench.clock.monotonic()
    bench.do(Goto(359, 45, "you"), 60)
    assert bench.sent_moves(since)[0].startswith("g 359.00")
    assert bench.device.truth().az_deg == pytest.approx(359, abs=0.05)


def test_a_newer_target_far_away_aborts_the_slew_and_goes_on_from_where_it_rests(bench):
    first = bench.station.submit(Goto(290, 30, "you"))
    bench.step(5)
    since = bench.clock.monotonic()
    second = bench.station.submit(Goto(120, 50, "you"))
    bench.step(0.05)
    assert bench.sent_since(since).startswith(b"\r")
    assert isinstance(first.exception(0), Superseded)
    bench.step(50)
    assert second.result(0).az_deg == pytest.approx(120, abs=0.05)
    assert bench.sent_moves(since) == ["g 120.00 50.00 90.00"]
    ends = [event.end.value for event in bench.events if isinstance(event, MoveEnded)]
    assert ends == ["superseded", "arrived"]


def test_a_newer_target_near_the_end_of_the_slew_lets_it_go_on(bench):
    bench.station.submit(Goto(290, 30, "you"))
    bench.step(5)
    since = bench.clock.monotonic()
    bench.do(Goto(292, 31, "you"), 60)
    assert sorted(bench.sent_moves(since)) == ["a 0 292.00", "a 1 31.00"]
    there(bench, 292, 31)


def test_a_newer_target_in_a_single_move_waits_for_its_end(bench):
    first = bench.station.submit(Goto(184, 45, "you"))
    bench.step(1)
    since = bench.clock.monotonic()
    assert bench.device.truth().moving
    second = bench.station.submit(Goto(180, 45, "you"))
    bench.step(1)
    assert isinstance(first.exception(0), Superseded)
    assert bench.sent_moves(since) == []
    bench.step(20)
    assert second.result(0).az_deg == pytest.approx(180, abs=0.05)
    assert bench.sent_moves(since) == ["a 0 180.00"]


def test_ten_presses_are_ten_steps_and_no_backlog(bench):
    since = bench.clock.monotonic()
    futures = [bench.station.submit(Jog(0.4, 0, "you")) for _ in range(10)]
    bench.step(30)
    there(bench, 184, 45)
    assert [isinstance(future.exception(0), Superseded) for future in futures] == [True] * 9 + [False]
    assert len(bench.sent_moves(since)) == 2


def test_what_the_gate_refuses_leaves_the_slew_alone(bench):
    first = bench.station.submit(Goto(290, 30, "you"))
    bench.step(5)
    since = bench.clock.monotonic()
    with pytest.raises(MotionRefused):
        bench.do(Goto(200, 5, "you"))
    assert bench.sent_since(since) == b""
    bench.step(30)
    assert first.result(0).az_deg == pytest.approx(290, abs=0.05)


@pytest.mark.parametrize("options", ["g_axes=turn", "abort_key=keep", "abort_prompt=at_rest", "prompts=alike"])
def test_arrives_and_supersedes_on_every_kind(options):
    bench = connected(options)
    bench.do(Goto(250, 30, "you"), 90)
    there(bench, 250, 30)
    bench.station.submit(Goto(100, 60, "you"))
    bench.step(4)
    bench.do(Goto(200, 40, "you"), 90)
    there(bench, 200, 40)
    assert bench.state.fault is None


def test_a_dish_that_stalls_in_a_slew_is_a_fault():
    bench = connected("stall_text=0")
    bench.station.submit(Goto(290, 45, "you"))
    bench.step(4)
    bench.device.stall(0)
    bench.step(30)
    assert bench.state.fault.reason == "stall"


def test_the_skew_is_a_motion_of_its_own(bench):
    future = bench.station.submit(TurnSkew(60, "you"))
    bench.step(0.3)
    assert bench.state.motion.to_skew_deg == 60
    assert bench.state.target_skew_deg == 60
    bench.step(20)
    assert future.result(0).skew_deg == pytest.approx(60, abs=0.05)
    assert bench.device.truth().skew_deg == pytest.approx(60, abs=0.05)
    assert bench.kinds().count("MoveEnded") == 1
    with pytest.raises(MotionRefused, match="beyond the limit"):
        bench.do(TurnSkew(500, "you"))


def test_the_skew_does_not_end_a_motion_under_way(bench):
    going = bench.station.submit(Goto(290, 30, "you"))
    bench.step(3)
    since = bench.clock.monotonic()
    with pytest.raises(MotionRefused, match="moves"):
        bench.do(TurnSkew(60, "you"))
    assert bench.sent_since(since) == b""
    bench.step(30)
    assert going.result(0)


def test_a_dish_without_skew_refuses_it():
    from .conftest import Bench

    bench = Bench().connect()
    with pytest.raises(MotionRefused, match="no skew"):
        bench.do(TurnSkew(60, "you"))
    assert bench.state.holder is None


def test_homing_is_refused_before_anything_changes(bench):
    since, before = bench.clock.monotonic(), bench.state
    with pytest.raises(MotionRefused, match="homes only at power-up"):
        bench.do(Home("you"))
    assert bench.state.homed is before.homed
    assert bench.state.position is not None
    assert bench.state.holder is None
    assert bench.sent_moves(since) == []


def test_a_stream_of_targets_is_followed_without_a_backlog_or_a_fault(bench):
    from birdcage.station.requests import Follow

    bench.do(Goto(200, 30, "tracker"), 60)
    since = bench.clock.monotonic()
    for second in range(60):
        bench.station.submit(Follow(200 + 0.4 * second, 30 + 0.2 * second, "tracker"))
        bench.step(1)
        lag = abs(bench.device.truth().az_deg - (200 + 0.4 * second))
        assert lag < 4
    assert bench.state.fault is None
    bench.step(10)
    there(bench, 223.6, 41.8)
    assert len(bench.sent_moves(since)) <= 2 * 60


def test_an_offset_stands_between_base_and_world():
    from birdcage.antenna.alignment import Alignment

    bench = connected(alignment=Alignment(10.0, 1.0))
    bench.do(Goto(240, 31, "you"), 60)
    there(bench, 230, 30)
    since = bench.clock.monotonic()
    bench.do(Goto(242, 30, "you"), 60)
    there(bench, 232, 29)
    assert sorted(bench.sent_moves(since)) == ["a 0 232.00", "a 1 29.00"]


def test_a_way_through_a_no_go_sector_is_refused_also_for_what_waits():
    bench = connected(sectors=((200.0, 220.0, 40.0),))
    with pytest.raises(MotionRefused):
        bench.do(Goto(250, 30, "you"))
    going = bench.station.submit(Goto(100, 45, "you"))
    bench.step(3)
    with pytest.raises(MotionRefused):
        bench.do(Goto(210, 30, "you"))
    assert not going.done()
    waits = bench.station.submit(Goto(250, 30, "you"))
    bench.step(30)
    assert isinstance(waits.exception(0), MotionRefused)
    assert bench.state.motion is None
    assert not bench.device.truth().moving


def test_status_tells_what_is_modelled(bench):
    from birdcage.station.report import status_report

    bench.station.submit(Goto(290, 30, "you"))
    bench.step(6)
    told = status_report(bench.state, bench.clock.monotonic())
    assert told["modelled"] is True
    assert told["age_s"] > 5
    assert told["skew_deg"] == 90.0
    assert told["stop_means"] == "abort"
