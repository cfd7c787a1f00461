"""STOP at the worst moments: in the middle of an exchange, while the link goes, right after a release."""

from __future__ import annotations

import math

import pytest
from birdcage.base.errors import BirdcageError, CommandRefused, Held, NoReply, Stopped
from birdcage.rotator.facts import CableTurn
from birdcage.sim.wire import Byte
from birdcage.station.events import HeldChanged
from birdcage.station.requests import Goto, Home, Jog, Release, ReleaseMotors
from birdcage.station.state import Activity, LinkPhase

from .conftest import Bench


def press_when_sent(bench, beginning, then):
    """Call `then` once, right after a line that begins so has been written."""
    write, done = bench.sim.write, []

    def writing(data):
        write(data)
        if data.startswith(beginning) and not done:
            done.append(data)
            then()

    bench.sim.write = writing
    return done


def slewing(bench, seconds=0.5):
    bench.do(Goto(60, 45, "you"), 120)
    future = bench.station.submit(Goto(210, 45, "you"))
    bench.step(seconds)
    assert bench.device.truth().moving
    return future


@pytest.mark.parametrize("line", [b"a\r", b"a 0 210", b"a 1 "])
def test_stop_in_any_exchange_of_a_goto_ends_it_and_raises_no_fault(bench, line):
    bench.do(Goto(60, 45, "you"))
    assert press_when_sent(bench, line, lambda: bench.station.stop("you")) == []
    future = bench.station.submit(Goto(210, 46, "you"))
    bench.step(6)
    assert isinstance(future.exception(0), Stopped)
    assert bench.state.fault is None
    assert bench.state.motion is None
    assert bench.state.held.reason == "stop"
    assert not bench.device.truth().moving


def test_a_second_stop_does_not_move_a_dish_that_the_first_kept_at_rest(bench):
    """The goto was being prepared: nothing had gone out, so there is nothing to retarget."""
    bench.do(Goto(60, 45, "you"))
    press_when_sent(bench, b"a\r", lambda: bench.station.stop("you"))
    bench.station.submit(Goto(210, 45, "you"))
    since = bench.clock.monotonic()
    bench.station._stopper._last_call = -math.inf
    bench.step(0.02)
    bench.clock.advance(0.25)
    bench.station.stop("you")
    bench.step(5)
    assert bench.moves_since(since) == []


def test_a_refused_move_leaves_stop_nothing_to_repeat(bench):
    bench.do(Goto(60, 45, "you"))
    protocol = bench.station._antenna.rotator.protocol
    send = protocol._send_move

    def refuse(motor, degrees, busy_s):
        raise CommandRefused("The dish refused it.", reason="failed")

    protocol._send_move = refuse
    with pytest.raises(CommandRefused):
        bench.do(Goto(210, 45, "you"))
    protocol._send_move = send
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(2)
    assert bench.moves_since(since) == []
    assert bench.state.last_stop.means == "nothing moved"


def test_after_a_target_that_was_not_taken_in_mid_slew_stop_aims_ahead_of_the_real_motion():
    bench = Bench("g2?seed=1&second_move=refuse&az_speed=20").connect()
    slewing(bench)
    bench.station.submit(Goto(60, 45, "you"))
    bench.step(0.2)
    before, since = len(bench.written), bench.clock.monotonic()
    bench.station.stop("you")
    assert bench.written[before:] == b"\r", "where it goes is not known: it is looked at first"
    bench.step(1.0)
    aims = [float(line.split()[2]) for line in bench.moves_since(since) if line.startswith("a 0")]
    assert aims
    assert all(75.0 < aim < 210.0 for aim in aims)


def test_unplugged_right_after_stop_the_station_goes_on(bench):
    slewing(bench)
    bench.station.stop("you")
    bench.device.unplug()
    bench.step(3)
    assert bench.state.link.state is LinkPhase.LOST
    assert bench.state.last_stop.confirmed is False
    bench.device.plug()
    bench.step(10)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.position_lost is None
    assert bench.state.activity is Activity.IDLE


def test_silent_right_after_stop_was_answered(bench):
    slewing(bench)
    bench.station.stop("you")
    bench.step(0.06)
    bench.device.wire.to_host.silent = True
    bench.step(20)
    assert bench.state.link.state is LinkPhase.SILENT
    assert bench.state.last_stop.confirmed is False
    bench.device.wire.to_host.silent = False
    bench.step(10)
    assert bench.state.link.state is LinkPhase.UP


def test_a_release_that_was_asked_before_stop_does_not_undo_it(bench):
    slewing(bench)
    bench.station.stop("you")
    bench.step(5)
    releasing, going = bench.station.submit(Release("you")), bench.station.submit(Goto(60, 45, "you"))
    bench.clock.advance(1)
    bench.station.stop("you")
    since = bench.clock.monotonic()
    bench.step(3)
    assert isinstance(releasing.exception(0), Held)
    assert isinstance(going.exception(0), Held)
    assert bench.state.held is not None
    assert bench.moves_since(since) == []


def test_a_stop_right_after_a_release_stops_and_shows_held(bench):
    bench.do(Goto(60, 45, "you"))
    bench.station.stop("you")
    bench.station.submit(Release("you"))
    bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.15)
    assert bench.state.held is None
    bench.station.stop("you")
    bench.step(3)
    assert bench.state.held is not None
    assert not bench.device.truth().moving
    assert abs(bench.device.truth().az_deg - 210) > 5


def test_stop_while_silent_aims_at_nothing_that_it_cannot_see():
    """A dish that does not answer may read what is sent when it has long arrived: it gets a bare Enter."""
    bench = Bench("g2?seed=1&az_speed=10").connect()
    slewing(bench, 1.0)
    bench.device.wire.to_host.silent = True
    bench.step(4)
    before, since = len(bench.written), bench.clock.monotonic()
    bench.station.stop("you")
    assert bench.written[before:] == b"\r"
    bench.step(1)
    assert bench.moves_since(since) == []


def test_stop_on_a_stalled_dish_does_not_send_it_to_its_target_again(bench):
    slewing(bench)
    bench.device.stall(0)
    bench.step(6)
    assert bench.state.fault.reason == "stall"
    bench.device.stall(0, blocked=False)
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(3)
    assert [line for line in bench.moves_since(since) if line.startswith("a 0 210")] == []
    assert not bench.device.truth().moving


def test_stop_after_a_homing_that_replaced_a_motion_sends_nothing(bench):
    slewing(bench)
    bench.do(Home("you"), seconds=60)
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(2)
    assert bench.moves_since(since) == []


def test_a_motion_asked_for_while_silent_does_not_close_the_port(bench):
    bench.device.wire.to_host.silent = True
    bench.watch("position")
    bench.step(5)
    assert bench.state.link.state is LinkPhase.SILENT
    ports = len(bench.opened)
    with pytest.raises(BirdcageError):
        bench.do(Goto(210, 45, "you"))
    assert bench.state.link.state is LinkPhase.SILENT
    bench.device.wire.to_host.silent = False
    bench.step(8)
    assert bench.state.link.state is LinkPhase.UP
    assert len(bench.opened) == ports


def test_a_client_that_asks_all_the_time_does_not_put_off_the_reconnection(bench):
    bench.device.unplug()
    bench.watch("position")
    bench.step(2)
    bench.device.plug()
    for _ in range(60):
        bench.station.submit(Goto(100, 40, "Gpredict"))
        bench.step(0.2)
    assert bench.state.link.state is LinkPhase.UP


def test_a_goto_that_is_not_answered_holds_like_any_lost_motion(bench):
    bench.do(Goto(60, 45, "you"))
    old = bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.3)
    press_when_sent(bench, b"a 0 100", lambda: setattr(bench.device.wire.to_host, "silent", True))
    new = bench.station.submit(Goto(100, 45, "you"))
    bench.step(5)
    assert isinstance(new.exception(0), NoReply)
    assert isinstance(old.exception(0), BirdcageError)
    assert bench.state.held.reason == "link"


def test_a_clock_step_in_mid_slew_stops_the_dish_and_reads_it_again(bench):
    future = slewing(bench)
    bench.clock.step_utc(60)
    bench.step(4)
    assert isinstance(future.exception(0), Stopped)
    assert not bench.device.truth().moving
    assert abs(bench.device.truth().az_deg - 210) > 5
    assert "clock" in bench.state.held.reason
    assert bench.state.position_lost is None
    assert bench.state.activity is Activity.IDLE


def test_a_clock_step_is_followed_by_a_reading_though_nobody_looks(bench):
    bench.clock.step_utc(60)
    bench.step(4)
    assert bench.state.position_lost is None


def test_a_clock_that_drifts_slowly_is_no_step(bench):
    for _ in range(60):
        bench.clock.step_utc(0.1)
        bench.step(1)
    assert bench.state.held is None


def test_a_reboot_in_mid_slew_does_not_leave_it_slewing_for_ever():
    bench = Bench("g2?seed=1&az_speed=5").connect()
    bench.watch("position")
    slewing(bench, 1.0)
    bench.device.reboot()
    bench.step(120)
    assert bench.state.held is not None
    assert bench.state.motion is None
    assert bench.state.activity is not Activity.SLEWING


def test_homing_an_axis_that_does_not_exist_is_refused(bench):
    with pytest.raises(BirdcageError):
        bench.do(Home("you", (7,)))
    bench.do(Goto(100, 40, "you"))


def test_motors_released_means_position_and_turn_unknown_until_homed(bench):
    bench.do(Home("you"), seconds=60)
    assert bench.state.turn is CableTurn.COUNTED
    bench.watch("position")
    bench.do(ReleaseMotors("you"))
    bench.step(3)
    assert bench.state.turn is CableTurn.UNKNOWN
    assert bench.state.position is None
    with pytest.raises(BirdcageError):
        bench.do(Goto(100, 40, "you"))
    bench.do(Home("you"), seconds=60)
    assert bench.state.position is not None
    bench.do(Goto(100, 40, "you"))


def test_motors_released_on_a_dish_that_goes_on_counting():
    bench = Bench("g2?seed=1&release_forgets=0").connect()
    bench.watch("position")
    bench.do(ReleaseMotors("you"))
    bench.step(3)
    assert bench.state.position is None
    assert bench.state.position_lost == "released"
    with pytest.raises(BirdcageError, match="released"):
        bench.do(Goto(100, 40, "you"))
    bench.do(Home("you"), seconds=60)
    assert bench.state.position is not None


def test_the_turn_of_the_cable_is_forgotten_with_the_link(bench):
    bench.do(Home("you"), seconds=60)
    bench.watch("position")
    bench.device.unplug()
    bench.step(3)
    bench.device.plug()
    bench.step(10)
    assert bench.state.turn is CableTurn.UNKNOWN
    assert bench.state.position.cable_deg is None


def test_a_step_after_the_dish_was_moved_by_hand_starts_from_where_it_is(bench):
    bench.do(Goto(60, 45, "you"))
    bench.watch("position")
    bench.step(3)
    bench.sim.write(b"a 0 200\r")
    bench.step(10)
    from birdcage.station.requests import AcknowledgeFault

    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    assert bench.do(Jog(2, 0, "you")).az_deg == pytest.approx(202, abs=0.2)


def test_a_dish_that_turns_out_unhomed_shows_no_position(bench):
    bench.do(Goto(60, 45, "you"))
    for axis in bench.device.dish.axes:
        axis.homed = False
    with pytest.raises(BirdcageError):
        bench.do(Goto(100, 40, "you"))
    assert bench.state.position is None
    assert bench.state.homed is False


def test_a_listener_that_fails_leaves_no_future_behind(bench):
    future = slewing(bench)

    def fail(event):
        if isinstance(event, HeldChanged):
            raise RuntimeError("a listener fails")

    bench.station.subscribe(fail)
    bench.station.stop("you")
    with pytest.raises(RuntimeError):
        bench.step(1)
    bench.station.shut()
    assert future.done()
    assert isinstance(bench.station.submit(Goto(1, 45, "you")).exception(0), Stopped)


def test_ending_right_after_a_motion_went_out_stops_it(bench):
    """The goto's first line is on the wire, and the state does not say so yet."""
    bench.do(Goto(60, 45, "you"))
    press_when_sent(bench, b"a 0 210", lambda: bench.session.close())
    bench.station.submit(Goto(210, 45, "you"))
    bench.step(1)
    bench.clock.advance(3)
    assert abs(bench.device.truth().az_deg - 210) > 5


def test_a_dish_that_refuses_the_position_query_is_no_crash(bench):
    bench.watch("position")
    bench.step(2)
    bench.device.shell.menu = "dvb"
    bench.step(10)
    assert bench.state.link.state in (LinkPhase.UP, LinkPhase.SILENT)


def test_a_goto_right_after_a_release_is_not_stopped_by_the_stop_before_it(bench):
    bench.do(Goto(60, 45, "you"))
    bench.station.stop("you")
    bench.station.submit(Release("you"))
    pointing = bench.do(Goto(210, 45, "you"))
    assert pointing.az_deg == pytest.approx(210, abs=0.07)
    assert bench.state.last_stop.confirmed is None
    assert bench.state.fault is None


@pytest.mark.parametrize("lost_bytes", [120, 400])
def test_a_dish_that_answers_stop_after_a_silence_has_a_link_and_a_position(bench, lost_bytes):
    slewing(bench)
    left = [lost_bytes]

    def lose(_value):
        left[0] -= 1
        return Byte(drop=left[0] >= 0)

    def stop_unheard():
        bench.device.wire.to_host.set_plan(lose)
        bench.station.stop("you")

    press_when_sent(bench, b"a\r", stop_unheard)
    seen = []
    for _ in range(150):
        bench.step(0.1)
        state = bench.state
        seen.append((state.link.state, state.position is not None and state.position_lost is None))
    assert (LinkPhase.SILENT, False) in seen
    assert (LinkPhase.SILENT, True) not in seen
    assert seen[-1] == (LinkPhase.UP, True)
