"""Start, search and stalls of a dish that homes and searches by itself."""

from __future__ import annotations

import pytest
from birdcage.base.errors import BirdcageError, CommandRefused
from birdcage.station.requests import AcknowledgeFault, Goto, Release, SetSearch
from birdcage.station.state import Activity, LinkPhase, TvSearch

from .queued_bench import QueuedBench, connected


@pytest.fixture
def bench():
    return connected()


def test_the_search_of_a_dish_that_has_been_up_is_not_known(bench):
    assert bench.state.search is TvSearch.UNKNOWN


def test_a_search_is_ended_now_and_without_a_backup():
    bench = QueuedBench("searching=1&search_finds=0")
    bench.connect(12)
    bench.step(10)
    assert bench.device.truth().moving
    assert bench.do(SetSearch("you", disabled=True)) is None
    assert bench.state.search is TvSearch.OFF_UNTIL_POWER_UP
    bench.step(5)
    assert not bench.device.truth().moving
    assert bench.state.activity is Activity.IDLE
    assert bench.do(Goto(150, 40, "you"), 90).az_deg == pytest.approx(150, abs=0.05)
    assert bench.state.search is TvSearch.OFF_UNTIL_POWER_UP


def test_it_cannot_be_given_back_and_nothing_is_sent(bench):
    since = bench.clock.monotonic()
    with pytest.raises(CommandRefused, match="by itself"):
        bench.do(SetSearch("you", disabled=False))
    assert bench.sent_since(since) == b""
    assert bench.state.holder is None


def test_the_search_is_not_ended_in_a_motion_of_ours(bench):
    bench.station.submit(Goto(290, 30, "you"))
    bench.step(4)
    since = bench.clock.monotonic()
    with pytest.raises(BirdcageError, match="while the dish moves"):
        bench.do(SetSearch("you", disabled=True))
    assert bench.sent_since(since) == b""


def test_a_lost_link_forgets_that_the_search_was_ended(bench):
    bench.do(SetSearch("you", disabled=True))
    bench.device.unplug()
    bench.step(3)
    assert bench.state.search is TvSearch.UNKNOWN


def test_a_dish_that_boots_is_waited_for():
    bench = QueuedBench("boot=1&search_finds=0")
    bench.watch("position")
    bench.step(60)
    assert bench.state.link.state is not LinkPhase.UP
    assert bench.state.activity is Activity.INITIALIZING
    assert bench.state.activity_text
    assert bench.sent_moves() == []
    bench.step(120)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.search is TvSearch.RUNNING
    assert bench.state.activity is not Activity.INITIALIZING
    assert bench.state.fault is None or bench.state.fault.reason == "moved"


def test_a_restart_forgets_everything_and_is_a_fault(bench):
    bench.do(SetSearch("you", disabled=True))
    bench.watch("position")
    bench.step(3)
    bench.device.reboot()
    bench.step(60)
    assert bench.state.search is not TvSearch.OFF_UNTIL_POWER_UP
    assert bench.state.activity is Activity.INITIALIZING
    bench.step(120)
    assert bench.state.fault.reason == "reboot"
    assert bench.state.search is TvSearch.RUNNING
    since = bench.clock.monotonic()
    bench.step(60)
    assert bench.sent_moves(since) == []


def test_a_restart_in_mid_slew_moves_nothing_afterwards(bench):
    future = bench.station.submit(Goto(290, 30, "you"))
    bench.step(4)
    bench.device.reboot()
    since = bench.clock.monotonic()
    bench.step(240)
    assert isinstance(future.exception(0), BirdcageError)
    assert bench.sent_moves(since) == []
    assert bench.state.held is not None
    assert bench.state.link.state is LinkPhase.UP


@pytest.mark.parametrize("target", [(290, 30), (184.5, 45)])
def test_a_stall_that_the_dish_tells_of_names_the_axis(bench, target):
    future = bench.station.submit(Goto(*target, "you"))
    bench.step(2)
    since = bench.clock.monotonic()
    bench.device.stall(0)
    bench.step(30)
    assert bench.state.fault.reason == "stall"
    assert "azimuth" in bench.state.fault.what
    assert "stall" in str(future.exception(0))
    assert not bench.device.truth().moving
    assert bench.sent_moves(since) == []
    bench.device.stall(0, blocked=False)
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    assert bench.do(Goto(200, 40, "you"), 60).az_deg == pytest.approx(200, abs=0.05)


def test_unplugged_in_mid_slew_nothing_moves_after_the_return(bench):
    future = bench.station.submit(Goto(290, 30, "you"))
    bench.step(4)
    bench.device.unplug()
    bench.step(4)
    assert isinstance(future.exception(0), BirdcageError)
    assert bench.state.position_lost == "link"
    since = bench.clock.monotonic()
    bench.device.plug()
    bench.step(40)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.activity is Activity.IDLE
    assert not bench.state.position.modelled
    assert bench.sent_moves(since) == []
