"""What raw lines leave behind, and lines that print on."""

from __future__ import annotations

import pytest
from birdcage.base.errors import (
    CommandRefused,
    LinkError,
    NoReply,
    Stopped,
)
from birdcage.rotator.facts import CableTurn
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import (
    Goto,
    Home,
    Release,
    ReleaseLease,
)
from birdcage.station.state import Activity, TvSearch
from birdcage.station.state import LinkPhase as LinkNow

from .raw_console_bench import TalkBench


@pytest.fixture
def bench():
    return TalkBench()


# --- what no longer holds


def test_after_a_raw_motion_the_position_is_unknown_until_it_is_read_again(bench):
    bench.do(Home("you"))
    assert bench.state.turn is CableTurn.COUNTED
    bench.do(ReleaseLease("you"))
    bench.type("a 0 100", confirmed=Grade.RUINS)
    assert bench.state.position_lost == "raw command"
    assert bench.state.turn is CableTurn.UNKNOWN
    assert bench.state.activity is Activity.UNKNOWN
    assert bench.state.raw_motion
    bench.step(40)
    assert not bench.state.raw_motion
    assert bench.state.position_lost is None
    assert bench.state.position.az_deg == pytest.approx(100, abs=0.1)
    assert bench.state.activity is Activity.IDLE
    assert bench.state.fault is None


def test_a_raw_move_of_the_elevation_keeps_the_counted_cable(bench):
    bench.do(Home("you"))
    bench.do(Goto(20, 40, "you"))
    bench.do(ReleaseLease("you"))
    bench.type("a 1 50", confirmed=Grade.RUINS)
    bench.do(ReleaseLease(CONSOLE))
    bench.step(3)
    assert bench.state.turn is CableTurn.COUNTED
    assert bench.state.position.cable_deg == pytest.approx(20, abs=0.1)


def test_a_released_dish_is_believed_nothing_until_it_is_homed():
    bench = TalkBench("g2?seed=1&release_forgets=0")
    bench.type("r", confirmed=Grade.RUINS)
    assert bench.state.homed is None
    bench.do(ReleaseLease(CONSOLE))
    bench.step(3)
    assert bench.state.position is None
    assert bench.state.position_lost == "released"
    bench.type("h 0", confirmed=Grade.RUINS)
    bench.type("h 1", confirmed=Grade.RUINS)
    assert bench.state.homed is True
    assert bench.station.judge("a 0 100").grade is Grade.MOVES
    bench.do(ReleaseLease(CONSOLE))
    bench.step(3)
    assert bench.state.position is not None


def test_settings_that_were_written_by_hand_are_surveyed_again(bench):
    bench.type("q")
    bench.type("nvs")
    bench.type("e 20 1", confirmed=Grade.RUINS)
    assert bench.state.search is TvSearch.UNKNOWN
    bench.type("e 102 60", confirmed=Grade.RUINS)
    bench.type("s", confirmed=Grade.RUINS)
    surveys = bench.lines().count("d 102")
    assert surveys
    bench.do(ReleaseLease(CONSOLE))
    bench.step(8)
    assert bench.state.search is TvSearch.OFF
    assert bench.lines().count("d 102") == surveys + 1


def test_a_raw_reboot_is_seen_through(bench):
    bench.type("q")
    bench.type("reboot", confirmed=Grade.RUINS, seconds=200)
    assert bench.state.homed is None
    assert bench.station.judge("a").grade is Grade.SETTING  # it is at the root now
    bench.do(ReleaseLease(CONSOLE))
    bench.step(10)
    assert bench.state.homed is False  # NVS 20 is TRUE: it does not home by itself


# --- what prints on


def test_a_stream_runs_until_the_next_line(bench):
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(5)
    assert not stream.done()
    reply = bench.type("rssi 1")
    told = stream.result(0)
    assert told.ended_by_key
    assert len(told.lines) > 2
    assert told.prompt == "DVB>"
    assert any("RSSI" in line for line in reply.lines)
    assert bench.state.link.state is LinkNow.UP


def test_a_stream_ends_with_the_lease(bench):
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("snr")
    bench.step(3)
    bench.do(ReleaseLease(CONSOLE))
    bench.step(8)
    assert stream.result(0).ended_by_key
    assert bench.state.menu == "mot"


def test_a_stream_ends_after_a_minute(bench):
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(59)
    assert not stream.done()
    bench.step(2)
    assert stream.result(0).ended_by_key
    assert bench.state.holder == CONSOLE


def test_nothing_prints_on_after_the_station_has_ended(bench):
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(3)
    bench.session.close()
    assert isinstance(stream.exception(0), Stopped)
    since = len(bench.device.inbox)
    bench.clock.advance(5)
    bench.device.truth()
    assert len(bench.device.inbox) <= since + 5


def test_a_line_that_is_overwritten_again_and_again_is_a_stream_too(bench):
    bench.type("q")
    bench.type("adc")
    stream = bench.begin("m")
    bench.step(4)
    assert not stream.done()
    assert bench.type("bdid").menu == "adc"
    assert len(stream.result(0).lines) > 2


def test_a_cable_pulled_in_mid_stream_ends_the_talk_and_comes_back(bench):
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(2)
    bench.device.unplug()
    bench.step(1)
    assert isinstance(stream.exception(0), LinkError)
    assert bench.state.holder is None
    bench.device.plug()
    bench.step(10)
    assert bench.state.link.state is LinkNow.UP
    assert bench.state.menu == "mot"
    bench.do(Release("you"))
    assert bench.do(Goto(50, 40, "you"))


def test_a_dish_that_dies_in_mid_stream_is_noticed(bench):
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(2)
    bench.device.power_off()
    bench.step(8)
    assert isinstance(stream.exception(0), NoReply)
    assert bench.state.link.state is LinkNow.SILENT


def test_the_talk_begins_in_the_motor_menu_though_the_signal_was_just_being_read(bench):
    bench.watch("position", "rssi")
    for _ in range(200):
        bench.step(0.1)
        if bench.state.menu == "dvb":
            break
    assert bench.state.menu == "dvb"
    assert bench.type("a").menu == "mot"


def test_a_dead_shell_is_noticed(bench):
    bench.type("a")
    bench.device.deadlock()
    with pytest.raises(NoReply) as silence:
        bench.type("a")
    assert silence.value.reason == "silent"
    assert bench.state.link.state is LinkNow.SILENT


def test_homing_is_waited_for(bench):
    reply = bench.type("h 0", confirmed=Grade.RUINS, seconds=20)
    assert reply.took_s > 1
    assert any("Wrap" in line for line in reply.lines)


def test_a_busy_dish_takes_no_second_line(bench):
    homing = bench.begin("h 0", confirmed=Grade.RUINS)
    bench.step(0.5)
    with pytest.raises(CommandRefused, match="still at `h 0`"):
        bench.type("a")
    bench.step(15)
    assert homing.result(0)
