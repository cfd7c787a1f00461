"""A dish that takes no command of a move while a motor runs, on either axis, and answers late (docs/decisions/0023)."""

from __future__ import annotations

import pytest
from birdcage.base.errors import NoReply, Stopped
from birdcage.base.geometry import shortest_turn
from birdcage.rotator.facts import SecondMove
from birdcage.station.events import ActivityChanged, MoveEnded, StopSent
from birdcage.station.requests import Goto, Jog, Release
from birdcage.station.state import Activity, LinkPhase

from .conftest import Bench

WAITS = "g2?seed=1&second_move=block&second_other=block&az=-180"


def begun(address=WAITS, *, press_s=None, **options):
    """From 180/45 to 0/30; the azimuth turns for 2.9 s, and 0.05 s after its command that of the elevation goes out.

    `press_s`: when STOP is pressed; what it writes at once is in `bench.pressed`.
    """
    bench = Bench(address, options).connect()
    bench.watch("position")
    bench.step(8.0)
    assert bench.state.surveyed
    bench.pressed = None

    def press():
        before = len(bench.written)
        bench.station.stop("you")
        bench.pressed = bytes(bench.written[before:])
        bench.pressed_at = bench.clock.monotonic()

    if press_s is not None:
        bench.later(press_s, press)
    return bench, bench.station.submit(Goto(0, 30, "you"))


def settled(address=WAITS):
    """The same, at rest at 0/30."""
    bench, _ = begun(address)
    bench.step(6.0)
    return bench


def sent_since(bench, time):
    """The moves that the dish has received from a time on: the first goes out at the very moment it is asked for."""
    return [line for line in bench.moves_since(time - 0.001) if line.startswith("a ")]


def busy_told(bench):
    return [e for e in bench.events if isinstance(e, ActivityChanged) and e.text == "busy with the last move"]


def stands_at(bench, az_deg, el_deg):
    truth = bench.device.truth()
    off = max(abs(shortest_turn(az_deg, truth.az_deg)), abs(truth.el_deg - el_deg))
    return not truth.moving and off < 0.1


def test_a_goto_arrives_and_nothing_is_called_silent():
    bench, future = begun()
    bench.step(8.0)
    assert stands_at(bench, 0, 30)
    assert future.result(0) is not None
    assert bench.state.held is None
    assert bench.state.fault is None
    assert not [e for e in bench.events if type(e).__name__ == "LinkChanged" and e.link.state is LinkPhase.SILENT]


def test_while_it_waits_it_is_shown_on_its_way_and_busy_with_the_last_move():
    bench, _ = begun()
    seen = []
    bench.later(1.5, lambda: seen.append(bench.state))
    bench.step(4.0)
    assert seen[0].activity is Activity.SLEWING
    assert seen[0].activity_text == "busy with the last move"
    assert (seen[0].motion.to_az_deg, seen[0].motion.to_el_deg) == (pytest.approx(0.0), pytest.approx(30.0))
    assert seen[0].motion.stop_means == "none", "nothing that is sent now is read before the motor stands"
    assert bench.state.activity_text == ""


def test_it_is_learnt_at_the_first_late_answer():
    bench = settled()
    assert bench.state.dish.second_same is bench.state.dish.second_other is SecondMove.BLOCK
    assert [rung.means for rung in bench.state.dish.stop_ladder] == ["end of move", "release", "key", "power"]


def test_from_then_on_one_axis_is_sent_when_the_other_stands_so_that_it_answers_at_once():
    bench = settled()
    told, since = len(busy_told(bench)), bench.clock.monotonic()
    future = bench.station.submit(Goto(180, 45, "you"))
    bench.step(0.3)
    assert len(sent_since(bench, since)) == 1
    assert bench.state.motion.stop_means == "end of move"
    bench.step(6.0)
    assert future.done()
    assert stands_at(bench, 180, 45)
    assert len(busy_told(bench)) == told


def test_a_prompt_dish_is_not_learnt_as_one():
    bench = settled("g2?seed=1&az=-180")
    assert stands_at(bench, 0, 30)
    assert bench.state.dish.second_other is SecondMove.UNKNOWN
    assert busy_told(bench) == []


@pytest.mark.parametrize("latency", ["&delay=0.4", "&latency_min=1.4&latency_max=1.5"])
def test_a_slow_wire_is_no_dish_that_waits(latency):
    bench, _ = begun("g2?seed=1&az=-180" + latency)
    bench.step(15.0)
    assert stands_at(bench, 0, 30)
    assert bench.state.dish.second_other is SecondMove.UNKNOWN


@pytest.mark.parametrize("after_s", [0.5, 1.5, 2.8])
def test_stop_behind_an_unanswered_line_sends_enter_and_no_target(after_s):
    bench, future = begun(press_s=after_s)
    bench.step(15.0)
    assert bench.pressed == b"\r"
    assert isinstance(future.exception(0), Stopped)
    assert sent_since(bench, bench.pressed_at) == []
    assert stands_at(bench, 0, 30), "the elevation was on the wire before STOP"
    assert bench.state.held is not None
    assert bench.state.last_stop.means == "end of move"
    assert bench.state.last_stop.confirmed is True


def test_while_that_lasts_it_says_that_nothing_but_its_power_stops_the_dish():
    bench, _ = begun(press_s=1.0)
    told = []
    bench.station.subscribe(lambda event: told.append(event.report) if isinstance(event, StopSent) else None)
    bench.step(3.2)
    assert "power" in bench.state.last_stop.sentence
    assert bench.state.last_stop.confirmed is None
    bench.step(8.0)
    assert [report.means for report in told] == ["look"]


def test_stop_on_a_dish_that_is_known_to_wait_sends_nothing_and_the_next_leg_stays_out():
    bench = settled()
    bench.station.submit(Goto(180, 45, "you"))
    bench.step(0.2)
    before, since = len(bench.written), bench.clock.monotonic()
    bench.station.stop("you")
    assert len(bench.written) == before
    bench.step(0.05)
    assert "cut its power" in bench.state.last_stop.sentence
    bench.step(8.0)
    assert sent_since(bench, since) == []
    assert bench.state.last_stop.confirmed is True
    assert not bench.device.truth().moving
    assert not stands_at(bench, 180, 45)


def test_a_young_line_does_not_keep_stop_from_aiming_ahead():
    bench, _ = begun("g2?seed=1&az=-180", press_s=1.0)
    bench.step(8.0)
    assert bench.pressed.startswith(b"a 0 ")
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True


def test_a_dish_whose_answer_is_missing_is_stopped_on_sight():
    """It retargets, and one of its answers is lost: nothing is aimed blind, and it is stopped when it is seen."""
    bench, _ = begun("g2?seed=1&az=-180&az_speed=10", press_s=2.0)
    bench.later(1.0, lambda: setattr(bench.device.wire.to_host, "silent", True))
    bench.later(2.05, lambda: setattr(bench.device.wire.to_host, "silent", False))
    bench.step(12.0)
    assert bench.pressed == b"\r"
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True
    assert 0 < bench.device.truth().az_deg % 360 < 175


def test_jogs_build_no_backlog():
    bench = settled()
    since = bench.clock.monotonic()
    for _ in range(10):
        bench.station.submit(Jog(-10.0, 0.0, "you"))
        bench.step(0.1)
    bench.step(6.0)
    assert stands_at(bench, 260, 30)
    assert len(sent_since(bench, since)) <= 4


def test_a_shell_that_never_answers_again_is_busy_with_the_last_move_for_two_seconds_longer_than_that_lasts():
    bench, future = begun()
    begins = bench.clock.monotonic()
    bench.later(0.5, bench.device.deadlock)
    bench.step(1.0)
    assert 4.7 < bench.clock.monotonic() - begins < 5.4
    error = future.exception(0)
    assert isinstance(error, NoReply)
    assert error.reason == "busy"
    assert "busy with the last move" in str(error)
    assert "deadlock" not in str(error)
    bench.step(10.0)
    assert "busy with the last move" in bench.state.link.detail
    bench.step(60.0)
    assert "silent" in bench.state.link.detail
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(5.0)
    assert sent_since(bench, since) == []


def test_another_program_left_it_moving():
    """Its motion is not known here: the first commands wait as long as any motion may take."""
    bench = Bench(WAITS + "&az_speed=40").connect()
    bench.device.dish.axes[0].retarget(bench.device.machine.dish_s, -20.0)
    bench.do(Goto(200, 40, "you"), 30)
    assert stands_at(bench, 200, 40)
    assert bench.state.held is None


def test_after_a_release_it_goes_where_it_is_sent():
    bench, _ = begun(press_s=1.0)
    bench.step(10.0)
    bench.do(Release("you"))
    bench.do(Goto(90, 40, "you"))
    assert stands_at(bench, 90, 40)
    ends = [event.end.value for event in bench.events if isinstance(event, MoveEnded)]
    assert ends == ["stopped", "arrived"]
