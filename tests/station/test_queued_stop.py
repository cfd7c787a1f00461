"""STOP on a dish whose moves queue: a byte ends a silent slew, the move of one axis ends by itself, nothing follows."""

from __future__ import annotations

import random

import pytest
from birdcage.base.errors import Held, Stopped
from birdcage.protocol.carryout.protocol import CarryoutProtocol
from birdcage.protocol.hal.protocol import HAL205Protocol
from birdcage.rotator.facts import SecondMove
from birdcage.rotator.ladder import StopMeans
from birdcage.station.events import StopSent
from birdcage.station.requests import AcknowledgeFault, Goto, Jog, Release, TurnSkew
from birdcage.station.state import Activity, TvSearch
from birdcage.station.stop_pending import StopReach
from birdcage.station.stop_words import stop_line

from .conftest import Bench
from .queued_bench import QueuedBench, connected


@pytest.fixture
def bench():
    return connected()


def slewing(bench, seconds=6.0):
    future = bench.station.submit(Goto(290, 30, "you"))
    bench.step(seconds)
    assert bench.device.truth().moving
    return future


def test_the_byte_is_out_when_stop_returns(bench):
    slewing(bench)
    since = bench.clock.monotonic()
    bench.station.stop("you")
    assert bench.sent_since(since).startswith(b"\r")
    assert bench.sent_since(since).strip(b"\r") == b""
    assert bench.station.stop_reach is StopReach.SENT


def test_a_slew_ends_where_it_is_and_the_dish_is_held(bench):
    future = slewing(bench)
    before = bench.device.truth().az_deg
    bench.station.stop("you")
    bench.step(8)
    after = bench.device.truth()
    assert not after.moving
    assert before < after.az_deg < before + 25
    report = bench.state.last_stop
    assert (report.means, report.confirmed) == ("abort", True)
    assert bench.state.held.by == "you"
    assert bench.state.activity is Activity.IDLE
    assert not bench.state.position.modelled
    assert isinstance(future.exception(0), Stopped)
    bench.step(60)
    assert bench.device.truth().az_deg == pytest.approx(after.az_deg, abs=0.01)


@pytest.mark.parametrize(("firmware", "dish"), [("hal205", HAL205Protocol), ("carryout", CarryoutProtocol)])
def test_a_slew_that_was_not_sent_yet_is_dropped_and_nothing_is_sent(firmware, dish, monkeypatch):
    bench = Bench(f"{firmware}?seed=1", firmware=firmware)
    bench.connect(12.0)
    bench.step(10.0)
    slew, told = dish.begin_slew, []

    def pressed(self, *where):
        before = len(bench.written)
        bench.station.stop("you")
        assert len(bench.written) == before, "STOP has nothing to end"
        slew(self, *where)

    monkeypatch.setattr(dish, "begin_slew", pressed)
    bench.station.subscribe(lambda event: told.append(event.report) if isinstance(event, StopSent) else None)
    future, since = bench.station.submit(Goto(290, 40, "you")), bench.clock.monotonic()
    bench.step(5.0)
    assert isinstance(future.exception(0), Stopped)
    assert told[0].sentence.startswith("The move was not sent yet, and is dropped.")
    assert bench.moves_since(since) == []
    assert not bench.device.truth().moving


def test_a_byte_that_ended_no_slew_before_is_sent_and_not_relied_on(bench):
    bench.station._antenna.strategy.found_to_fail(StopMeans.ABORT)
    slewing(bench)
    assert stop_line(bench.state, bench.clock.monotonic()).startswith("STOP at end of move, ")
    since = bench.clock.monotonic()
    bench.station.stop("you")
    assert bench.sent_since(since).startswith(b"\r")
    bench.step(0.05)
    assert bench.state.last_stop.means == "end of move"
    assert "did not end a slew before" in bench.state.last_stop.sentence


def test_one_whose_shell_waits_with_moves_of_one_axis_is_stopped_in_a_slew_all_the_same():
    bench = connected(own_facts={"second_same": "block", "second_other": "block"})
    assert bench.state.dish.second_same is SecondMove.BLOCK
    slewing(bench)
    assert stop_line(bench.state, bench.clock.monotonic()).startswith("STOP takes ")
    since = bench.clock.monotonic()
    bench.station.stop("you")
    assert bench.sent_since(since).startswith(b"\r")
    bench.step(8)
    assert not bench.device.truth().moving
    assert (bench.state.last_stop.means, bench.state.last_stop.confirmed) == ("abort", True)


@pytest.mark.parametrize("options", ["abort_key=keep", "abort_prompt=at_rest", "prompts=alike", "g_axes=turn"])
def test_a_slew_ends_on_every_kind(options):
    bench = connected(options)
    slewing(bench)
    bench.station.stop("you")
    bench.step(8)
    assert not bench.device.truth().moving
    assert (bench.state.last_stop.means, bench.state.last_stop.confirmed) == ("abort", True)
    since = bench.clock.monotonic()
    bench.step(30)
    assert bench.sent_moves(since) == []


def test_a_byte_that_is_lost_is_repeated_at_most_five_times(bench):
    slewing(bench)
    bench.device.wire.to_host.silent = True
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(10)
    assert bench.state.last_stop.confirmed is False
    stops = [data for at, data in bench.sent if since <= at < since + 5 and data.strip(b"\r") == b""]
    assert 1 < len(stops) <= 6


def test_the_move_of_one_axis_ends_by_itself_and_nothing_follows(bench):
    future = bench.station.submit(Goto(184, 41, "you"))
    bench.step(1.0)
    first = bench.sent_moves()[-1]
    since = bench.clock.monotonic()
    bench.station.stop("you")
    assert bench.sent_since(since) == b""
    assert bench.station.stop_reach is StopReach.ENDS
    bench.step(0.05)
    report = bench.state.last_stop
    assert report.means == "end of move"
    assert "ends in 2." in report.sentence
    assert report.confirmed is None
    bench.step(15)
    assert bench.state.last_stop.confirmed is True
    assert isinstance(future.exception(0), Stopped)
    truth = bench.device.truth()
    assert not truth.moving
    assert (truth.az_deg, truth.el_deg) == pytest.approx((184, 45) if first.startswith("a 0") else (180, 41), abs=0.05)
    assert bench.sent_moves(since) == []


def test_a_move_that_has_hardly_begun_does_not_pass_for_one_at_rest(bench):
    bench.station.submit(Goto(184.5, 45, "you"))
    while not bench.sent_moves() or not bench.sent_moves()[-1].startswith("a 0"):
        bench.step(0.01)
    bench.station.stop("you")
    bench.step(1)
    assert bench.device.truth().moving
    assert bench.state.last_stop.confirmed is None
    assert bench.state.activity is Activity.STOPPING
    bench.step(10)
    assert bench.state.last_stop.confirmed is True


def test_equal_readings_before_the_end_of_a_move_are_no_rest(bench):
    """A dish that takes its time to begin: it stands still, and will move all the same."""
    bench.station.submit(Goto(184.5, 45, "you"))
    while not bench.sent_moves() or not bench.sent_moves()[-1].startswith("a 0"):
        bench.step(0.01)
    for axis in bench.device.dish.axes:
        axis.block(bench.device.machine.dish_s, slips=False)
    bench.station.stop("you")
    bench.step(2)
    assert bench.state.last_stop.confirmed is None
    assert bench.state.activity is Activity.STOPPING
    bench.step(6)
    assert bench.state.last_stop.confirmed is True


def test_stop_at_rest_sends_nothing_that_moves(bench):
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(3)
    assert bench.state.last_stop.means == "nothing moved"
    assert bench.state.last_stop.confirmed is True
    assert bench.sent_moves(since) == []


def test_after_a_release_a_person_moves_it_again(bench):
    slewing(bench)
    bench.station.stop("you")
    bench.step(4)
    bench.do(Release("you"))
    assert bench.do(Goto(200, 40, "you"), 60).az_deg == pytest.approx(200, abs=0.05)


def test_a_release_before_it_rests_lets_a_new_target_wait_for_the_rest(bench):
    bench.station.submit(Goto(184, 45, "you"))
    bench.step(1)
    bench.station.stop("you")
    bench.step(0.1)
    bench.station.submit(Release("you"))
    future = bench.station.submit(Goto(182, 45, "you"))
    bench.step(20)
    assert future.result(0).az_deg == pytest.approx(182, abs=0.05)


def test_a_search_is_ended_by_stop():
    bench = QueuedBench("searching=1&search_finds=0")
    bench.connect(12)
    bench.watch("position")
    bench.step(20)
    assert bench.device.truth().moving
    assert bench.state.activity is Activity.MOVING_UNASKED
    since = bench.clock.monotonic()
    bench.station.stop("you")
    assert bench.sent_since(since).startswith(b"\r")
    bench.step(20)
    assert not bench.device.truth().moving
    assert (bench.state.last_stop.means, bench.state.last_stop.confirmed) == ("search", True)
    assert bench.state.last_stop.sentence.startswith("The TV search was ended. Stands still")
    assert bench.state.search is TvSearch.OFF_UNTIL_POWER_UP
    assert bench.sent_moves(since) == []
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    assert bench.do(Goto(150, 40, "you"), 90).az_deg == pytest.approx(150, abs=0.05)


def test_a_dish_that_wanders_though_the_board_says_at_rest(bench):
    bench.device.wander(0, 60)
    bench.station.stop("you")
    bench.step(20)
    assert bench.state.last_stop.means == "search"
    assert bench.state.held is not None


@pytest.mark.parametrize("beginning", [b"a\r", b"g 290", b"a 0 ", b"a 1 ", b"a 2 "])
@pytest.mark.parametrize("target", [(290, 30), (183, 43)])
def test_no_line_that_moves_follows_stop_in_any_exchange(beginning, target):
    bench = connected()
    stops = []

    def press(data):
        if data.startswith(beginning) and not stops:
            stops.append(len(bench.sent))
            bench.station.stop("you")

    bench.on_write = press
    bench.station.submit(Goto(*target, "you"))
    bench.station.submit(TurnSkew(60, "you"))
    bench.step(30)
    if stops:
        after = b"".join(data for _at, data in bench.sent[stops[0] :]).decode().split("\r")
        assert [line for line in after if line.startswith(("g ", "a 0 ", "a 1 ", "a 2 "))] == []
        assert bench.state.held is not None
    assert not bench.device.truth().moving


@pytest.mark.parametrize("seed", range(25))
def test_no_motion_begins_after_stop_whatever_the_timing(seed):
    rng = random.Random(seed)
    bench = connected(rng.choice(["", "abort_key=keep", "g_axes=turn", "abort_prompt=at_rest", "wrap=0"]))
    for _ in range(rng.randint(1, 5)):
        who = rng.choice(["you", "you", "Gpredict"])
        bench.station.submit(
            rng.choice([
                Goto(rng.uniform(60, 300), rng.uniform(20, 85), who), Jog(rng.uniform(-4, 4), rng.uniform(-4, 4), who),
                TurnSkew(rng.uniform(20, 160), who),
            ])
        )  # fmt: skip
        bench.step(rng.choice([0.0, 0.003, 0.02, 0.3, 1.0, 4.0]))
    presses = [rng.randint(1, 4)]

    def press(_data):
        presses[0] -= 1
        if presses[0] == 0:
            stop()

    stopped = []

    def stop():
        stopped.append(len(bench.sent))
        bench.station.stop("you")

    if rng.random() < 0.5:
        bench.on_write = press
        bench.step(rng.uniform(0, 3))
    if not stopped:
        stop()
    for _ in range(20):
        late = bench.station.submit(Goto(rng.uniform(60, 300), 40, rng.choice(["you", "Gpredict"])))
        bench.step(2)
        assert isinstance(late.exception(0), Held)
    after = b"".join(data for _at, data in bench.sent[stopped[0] :]).decode().split("\r")
    assert [line for line in after if line.startswith(("g ", "a 0 ", "a 1 ", "a 2 "))] == []
    assert not bench.device.truth().moving
    assert bench.state.held is not None
    assert bench.state.activity is Activity.IDLE


def test_closing_in_mid_slew_ends_it(bench):
    slewing(bench)
    before = bench.device.truth().az_deg
    sentence = bench.session.close()
    bench.clock.advance(10)
    assert sentence.startswith("STOP was sent.")
    assert bench.device.truth().az_deg < before + 25


def test_closing_in_a_single_move_says_that_it_ends_by_itself(bench):
    bench.station.submit(Goto(184, 41, "you"))
    bench.step(1.0)
    assert "it ends by itself" in bench.session.close()


def test_a_combined_move_that_a_person_typed_is_ended_by_a_byte(bench):
    from birdcage.station.raw import Grade
    from birdcage.station.requests import Raw

    bench.station.submit(Raw("motor", confirmed=Grade.RUINS))
    bench.step(2)
    bench.station.submit(Raw("g 300 30 90", confirmed=Grade.RUINS))
    bench.step(5)
    assert bench.device.truth().moving
    since, before = bench.clock.monotonic(), bench.device.truth().az_deg
    bench.station.stop("you")
    assert bench.sent_since(since).startswith(b"\r")
    bench.step(10)
    assert not bench.device.truth().moving
    assert bench.device.truth().az_deg < before + 25
    assert bench.sent_moves(since) == []
    assert bench.state.held is not None
