"""Somebody talks to the firmware past the station: warned, marked, alone on the wire, and stoppable."""

from __future__ import annotations

import pytest
from birdcage.base.errors import (
    CommandRefused,
    ConfirmationNeeded,
    Held,
    LeaseDenied,
    LinkError,
    NoReply,
    Stopped,
)
from birdcage.protocol.model import Turn
from birdcage.station.events import TranscriptLine
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import (
    AcquireLease,
    Goto,
    Home,
    ListCommands,
    Raw,
    Release,
    ReleaseLease,
)
from birdcage.station.state import Activity, Search
from birdcage.station.state import Link as LinkNow

from .conftest import Bench


class TalkBench(Bench):
    def __init__(self, address="g2?seed=1", **options):
        self.remarks = []
        super().__init__(address, {"remark": self.remarks.append, **options})
        self.connect()
        self.step(6)

    def type(self, line, *, confirmed=False, seconds=30.0):
        return self.do(Raw(line, CONSOLE, confirmed), seconds)

    def begin(self, line, *, confirmed=False):
        return self.station.submit(Raw(line, CONSOLE, confirmed))

    def counted(self):
        """The turn of the cable is known, and the dish stands at 300 degrees."""
        self.do(Home("you"))
        self.do(Goto(300, 45, "you"))
        self.do(ReleaseLease("you"))
        return self

    def in_raw_motion(self, line="a 0 100", seconds=0.7):
        """A raw motion, counterclockwise, that takes seconds is under way."""
        self.type(line, confirmed=True)
        self.step(seconds)
        assert self.device.truth().moving
        return self.device.truth().az_deg

    def at_rest(self):
        return not self.device.truth().moving


@pytest.fixture
def bench():
    return TalkBench()


def lines_since(bench, time):
    return [line for at, line in bench.received() if at > time]


# --- a line and its reply


def test_a_line_brings_its_reply(bench):
    reply = bench.type("mv")
    assert reply.line == "mv"
    assert reply.lines[0].startswith("Max Vel [0]")
    assert (reply.menu, reply.prompt, reply.ended_by_key) == ("mot", "MOT>", False)
    assert 0 < reply.took_s < 0.5
    assert bench.state.holder == CONSOLE


def test_what_the_dish_refuses_is_a_reply_too(bench):
    assert bench.type("frob", confirmed=True).lines == ("Invalid command.",)


def test_submenus_work_and_the_menu_is_shown(bench):
    assert bench.type("q").menu == "root"
    assert bench.type("os").prompt == "OS>"
    assert bench.state.menu == "os"
    assert any("Antenna ID" in line for line in bench.type("id").lines)
    assert bench.type("q").menu == "root"


def test_a_bare_enter_shows_the_prompt(bench):
    assert bench.type("").prompt == "MOT>"


def test_what_cannot_be_typed_is_refused(bench):
    with pytest.raises(CommandRefused, match="printable"):
        bench.type("a\x08")


# --- warnings


def test_what_is_not_harmless_wants_a_persons_word(bench):
    since = bench.clock.monotonic()
    with pytest.raises(ConfirmationNeeded, match="fall under its own weight"):
        bench.type("r")
    with pytest.raises(ConfirmationNeeded, match="Nobody has written down"):
        bench.type("frob")
    assert not {"r", "frob"} & set(lines_since(bench, since))


def test_a_motion_beyond_a_limit_is_warned_of_and_marked_when_sent(bench):
    verdict = bench.station.judge("a 0 9999")
    assert verdict.grade is Grade.MOVES
    assert "9639.00° beyond the limit of 360.00°" in verdict.limit
    with pytest.raises(ConfirmationNeeded, match=r"9639\.00° beyond"):
        bench.type("a 0 9999")
    sent = []
    original = bench.sim.write
    bench.sim.write = lambda data: (sent.append((len(bench.remarks), data)), original(data))
    bench.type("a 0 9999", confirmed=True)
    mark = (
        "raw by console: a 0 9999 (MOVES, confirmed; "
        "Azimuth 9999.00 deg is 9639.00 deg beyond the limit of 360.00 deg.)"
    )
    assert mark in bench.remarks
    assert sent[0] == (bench.remarks.index(mark) + 1, b"a 0 9999\r")  # the remark stands before the bytes
    assert mark in [e.text for e in bench.events if isinstance(e, TranscriptLine) and e.direction == "#"]


def test_unreadable_settings_are_a_limit_of_every_raw_motion():
    bench = TalkBench(refuse_motion="The section [motion] cannot be read.")
    assert "cannot be read" in bench.station.judge("a 0 100").limit
    assert bench.station.judge("a").limit == ""


def test_while_held_questions_and_settings_go_and_motions_do_not(bench):
    bench.station.stop("you")
    bench.step(2)
    assert bench.type("mv").lines
    assert bench.type("w 0 on", confirmed=True)
    since = bench.clock.monotonic()
    for line in ("a 0 100", "h 0", "r", "sw 0 0"):
        with pytest.raises(Held):
            bench.type(line, confirmed=True)
    assert not {"a 0 100", "h 0", "r", "sw 0 0"} & set(lines_since(bench, since))
    bench.do(Release("you"))
    bench.type("a 0 100", confirmed=True)
    assert "a 0 100" in bench.lines()


# --- whose console it is


def test_nobody_types_while_another_has_control(bench):
    bench.do(AcquireLease("tracker"))
    with pytest.raises(LeaseDenied, match="tracker"):
        bench.type("a")
    bench.do(AcquireLease(CONSOLE, take_over=True))
    assert bench.type("a").lines


def test_while_somebody_talks_nothing_is_sent_that_was_not_typed(bench):
    bench.watch("position", "rssi")
    bench.step(3)
    bench.do(AcquireLease(CONSOLE))
    since = bench.clock.monotonic()
    bench.step(20)
    assert lines_since(bench, since) == []
    bench.type("mv")
    bench.step(20)
    assert lines_since(bench, since) == ["mv"]
    assert bench.state.position is not None
    assert bench.state.position_lost is None  # it only grows old
    assert bench.clock.monotonic() - bench.state.position.at > 39


def test_after_30_s_without_a_line_the_console_is_given_back_and_looked_at(bench):
    bench.type("q")
    bench.type("dvb")
    bench.step(29.5)
    assert bench.state.holder == CONSOLE
    since = bench.clock.monotonic()
    bench.step(3)
    assert bench.state.holder is None
    assert bench.state.menu == "mot"
    assert "a" in lines_since(bench, since)


def test_giving_the_lease_back_ends_it_too(bench):
    bench.watch("position")
    bench.step(6)
    bench.type("q")
    since = bench.clock.monotonic()
    bench.do(ReleaseLease(CONSOLE))
    bench.step(1)
    assert lines_since(bench, since)[:2] == ["mot", "a"]
    assert bench.do(Goto(100, 40, "you"))


def test_no_line_goes_out_while_the_station_moves_the_dish(bench):
    future = bench.station.submit(Goto(200, 45, "you"))
    bench.step(0.5)
    bench.do(AcquireLease(CONSOLE, take_over=True))
    with pytest.raises(CommandRefused, match="on its way") as refused:
        bench.type("mv")
    assert refused.value.reason == "moving"
    bench.step(20)
    assert future.result(0)
    assert bench.type("mv").lines


def test_without_a_link_nothing_is_said(bench):
    bench.device.unplug()
    bench.step(1)
    with pytest.raises(LinkError):
        bench.type("a")


# --- what no longer holds


def test_after_a_raw_motion_the_position_is_unknown_until_it_is_read_again(bench):
    bench.do(Home("you"))
    assert bench.state.turn is Turn.COUNTED
    bench.do(ReleaseLease("you"))
    bench.type("a 0 100", confirmed=True)
    assert bench.state.position_lost == "raw command"
    assert bench.state.turn is Turn.UNKNOWN
    assert bench.state.activity is Activity.UNKNOWN
    bench.step(40)
    assert bench.state.position_lost is None
    assert bench.state.position.az_deg == pytest.approx(100, abs=0.1)
    assert bench.state.activity is Activity.IDLE
    assert bench.state.fault is None


def test_a_raw_move_of_the_elevation_keeps_the_counted_cable(bench):
    bench.do(Home("you"))
    bench.do(Goto(20, 40, "you"))
    bench.do(ReleaseLease("you"))
    bench.type("a 1 50", confirmed=True)
    bench.do(ReleaseLease(CONSOLE))
    bench.step(3)
    assert bench.state.turn is Turn.COUNTED
    assert bench.state.position.cable_deg == pytest.approx(20, abs=0.1)


def test_a_released_dish_is_believed_nothing_until_it_is_homed():
    bench = TalkBench("g2?seed=1&release_forgets=0")
    bench.type("r", confirmed=True)
    assert bench.state.homed is None
    bench.do(ReleaseLease(CONSOLE))
    bench.step(3)
    assert bench.state.position is None
    assert bench.state.position_lost == "released"
    bench.type("h 0", confirmed=True)
    bench.type("h 1", confirmed=True)
    assert bench.state.homed is True
    assert bench.station.judge("a 0 100").grade is Grade.MOVES
    bench.do(ReleaseLease(CONSOLE))
    bench.step(3)
    assert bench.state.position is not None


def test_settings_that_were_written_by_hand_are_surveyed_again(bench):
    bench.type("q")
    bench.type("nvs")
    bench.type("e 20 1", confirmed=True)
    assert bench.state.search is Search.UNKNOWN
    bench.type("e 102 60", confirmed=True)
    bench.type("s", confirmed=True)
    bench.do(ReleaseLease(CONSOLE))
    bench.step(5)
    assert bench.state.search is Search.OFF
    assert "d 102" in bench.lines()


def test_a_raw_reboot_is_seen_through(bench):
    bench.type("q")
    bench.type("reboot", confirmed=True, seconds=200)
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


def test_a_dead_shell_is_noticed(bench):
    bench.type("a")
    bench.device.deadlock()
    with pytest.raises(NoReply) as silence:
        bench.type("a")
    assert silence.value.reason == "silent"
    assert bench.state.link.state is LinkNow.SILENT


def test_homing_is_waited_for(bench):
    reply = bench.type("h 0", confirmed=True, seconds=20)
    assert reply.took_s > 1
    assert any("Wrap" in line for line in reply.lines)


def test_a_busy_dish_takes_no_second_line(bench):
    homing = bench.begin("h 0", confirmed=True)
    bench.step(0.5)
    with pytest.raises(CommandRefused, match="still at `h 0`"):
        bench.type("a")
    bench.step(15)
    assert homing.result(0)


# --- the rule of the q


@pytest.fixture
def mortal():
    return TalkBench("g2?seed=1&root_q=kill")


def alive(bench):
    return bench.device.truth().shell_alive


def test_q_in_a_submenu_leaves_it_and_never_reaches_the_root(mortal):
    for menu in ("mot", "dvb", "nvs", "os"):
        if mortal.state.menu != menu:
            mortal.type(menu)
        assert mortal.type("q").menu == "root"
        with pytest.raises(ConfirmationNeeded, match="until a power cycle"):
            mortal.type("q")
        with pytest.raises(ConfirmationNeeded):
            mortal.type(" Q ")
    assert alive(mortal)


def test_two_q_in_a_row_do_not_kill_it(mortal):
    first, second = mortal.begin("q"), mortal.begin("q")
    mortal.step(5)
    assert first.result(0).menu == "root"
    assert isinstance(second.exception(0), ConfirmationNeeded)
    assert alive(mortal)


def test_a_word_that_holds_a_q_goes_out_from_a_proven_submenu_only(mortal):
    mortal.type("q")
    mortal.type("dvb")
    assert mortal.type("qls", seconds=60).menu == "dvb"
    mortal.type("q", seconds=60)
    with pytest.raises(ConfirmationNeeded):
        mortal.type("qls")
    assert alive(mortal)


def test_a_reboot_behind_our_back_does_not_make_q_deadly(mortal):
    mortal.type("q")
    mortal.type("dvb")
    mortal.device.shell.menu = "root"
    assert mortal.type("q", seconds=60).menu == "root"
    assert alive(mortal)


def test_a_confirmed_q_at_the_root_is_sent_as_typed(mortal):
    mortal.type("q")
    with pytest.raises(NoReply):
        mortal.type("q", confirmed=True)
    assert not alive(mortal)
    assert mortal.lines()[-1] == "q"


def test_streams_and_the_end_of_the_talk_leave_the_shell_alive(mortal):
    mortal.type("q")
    mortal.type("dvb")
    mortal.begin("agc")
    mortal.step(3)
    mortal.do(ReleaseLease(CONSOLE))
    mortal.step(30)
    assert alive(mortal)
    assert mortal.state.menu == "mot"
    mortal.session.close()
    assert alive(mortal)


# --- STOP


def test_stop_of_a_raw_motion_leaves_at_once_and_ahead_of_the_dish(bench):
    before = bench.counted().in_raw_motion()
    sent = []
    original = bench.sim.write
    bench.sim.write = lambda data: (sent.append(data), original(data))
    bench.station.stop("you")
    assert sent
    assert sent[0].startswith(b"a 0 ")  # from the caller's own thread
    bench.step(2)
    assert bench.at_rest()
    assert before - 40 < bench.device.truth().az_deg < before
    assert bench.state.holder is None
    assert bench.state.held is not None
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True
    bench.step(20)
    assert bench.at_rest()


def test_stop_leaves_at_once_while_the_raw_motion_waits_for_its_prompt(bench):
    bench.counted()
    future = bench.begin("a 0 100", confirmed=True)
    bench.step(0.001)
    assert not future.done()
    bench.station.stop("you")
    bench.step(2)
    assert bench.at_rest()
    assert 270 < bench.device.truth().az_deg <= 300
    assert future.result(0)
    assert bench.state.last_stop.confirmed is True
    assert bench.state.link.state is LinkNow.UP


@pytest.mark.parametrize("line", ["a 0 170", "a 0 -170"])
def test_stop_of_a_raw_motion_that_is_not_foreseen_looks_and_aims(bench, line):
    # The turn of the cable is not known: `a 0 170` from 0 goes counterclockwise, as the cable has no more room.
    bench.type(line, confirmed=True)
    bench.step(0.5)
    before = bench.device.truth().az_deg
    bench.station.stop("you")
    bench.step(2)
    assert bench.at_rest()
    assert before - 40 < bench.device.truth().az_deg < before
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True


@pytest.mark.parametrize("counted", [True, False])
def test_stop_from_another_menu_goes_to_the_motor_menu_first(counted):
    bench = TalkBench("g2?seed=1&az_speed=5&root_q=kill")
    if counted:
        bench.counted()
    before = bench.in_raw_motion()
    bench.type("q")
    bench.type("dvb")
    bench.station.stop("you")
    assert bench.state.held is None  # the station has not run yet
    bench.step(0.5)
    assert bench.state.last_stop.by == "you"
    bench.step(3)
    assert bench.state.menu == "mot"
    assert bench.at_rest()
    assert before - 30 < bench.device.truth().az_deg < before
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True
    assert alive(bench)


@pytest.mark.parametrize("menu", ["dvb", "nvs", "os", "step"])
def test_no_stop_line_is_typed_into_another_menu(menu):
    bench = TalkBench("g2?seed=1&az_speed=5").counted()
    bench.in_raw_motion()
    bench.type("q")
    bench.type(menu)
    wrong = []
    original = bench.sim.write
    bench.sim.write = lambda data: (
        wrong.append((bench.device.shell.menu, data)) if data.startswith(b"a ") else None,
        original(data),
    )
    bench.station.stop("you")
    bench.step(4)
    assert {where for where, _ in wrong} == {"mot"}
    assert bench.at_rest()


def test_stop_in_the_middle_of_a_stream_ends_it_first():
    bench = TalkBench("g2?seed=1&az_speed=2&root_q=kill")
    before = bench.in_raw_motion()
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(2)
    bench.station.stop("you")
    bench.step(12)
    assert stream.result(0).ended_by_key
    assert bench.state.menu == "mot"
    assert bench.at_rest()
    assert before - 40 < bench.device.truth().az_deg < before
    assert bench.state.last_stop.confirmed is True
    assert alive(bench)


def test_stop_with_nothing_moving_ends_the_talk(bench):
    bench.type("q")
    bench.type("dvb")
    bench.station.stop("you")
    bench.step(3)
    assert bench.state.holder is None
    assert bench.state.held is not None
    assert bench.state.last_stop.confirmed is True
    assert "Stands still" in bench.state.last_stop.sentence
    assert bench.state.activity is Activity.IDLE


def test_stop_holds_back_a_motion_that_was_typed_before_it(bench):
    bench.type("a")
    since = bench.clock.monotonic()
    future = bench.begin("a 0 200", confirmed=True)
    bench.station.stop("you")
    bench.step(5)
    assert isinstance(future.exception(0), (Held, Stopped))
    assert "a 0 200" not in lines_since(bench, since)
    assert bench.at_rest()


def test_stop_during_raw_homing_says_that_nothing_stops_it(bench):
    homing = bench.begin("h 0", confirmed=True)
    bench.step(0.5)
    bench.station.stop("you")
    bench.step(0.5)
    assert bench.state.last_stop.means == "none"
    assert "cannot be stopped" in bench.state.last_stop.sentence
    bench.step(20)
    assert homing.done()
    assert bench.at_rest()
    assert bench.state.held is not None
    assert bench.state.link.state is LinkNow.UP


def test_two_raw_axes_are_both_stopped(bench):
    bench.counted()
    bench.type("a 0 100", confirmed=True)
    bench.type("a 1 20", confirmed=True)
    bench.step(0.1)
    bench.station.stop("you")
    bench.step(3)
    assert bench.at_rest()
    assert bench.device.truth().az_deg > 250
    assert bench.device.truth().el_deg > 25
    assert bench.state.last_stop.confirmed is True


def test_a_raw_motion_that_the_dish_refused_is_not_retargeted(bench):
    bench.type("a 1 64.9", confirmed=True)
    bench.step(3)
    bench.do(ReleaseLease(CONSOLE))
    bench.step(2)
    bench.type("a 1 17", confirmed=True)
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(2)
    assert bench.moves_since(since) == []
    assert bench.state.last_stop.means == "nothing moved"


# --- commands


def test_the_commands_of_a_menu_are_known_before_the_dish_is_asked(bench):
    since = bench.clock.monotonic()
    commands = {command.name: command for command in bench.station.commands("mot")}
    assert commands["a"].usage == "a [<motor> <angle>]"
    assert not commands["a"].told_by_dish
    assert lines_since(bench, since) == []
    assert bench.station.commands("nonsense") == ()


def test_the_dish_is_asked_for_its_commands_once(bench):
    told = {command.name: command for command in bench.do(ListCommands())}
    assert told["elminmaxhome"].told_by_dish
    assert told["elminmaxhome"].help  # the reference says what the dish does not
    assert not told["motorboth"].told_by_dish
    assert bench.lines().count("?") == 1
    bench.do(ListCommands())
    assert bench.lines().count("?") == 1
    assert any(command.told_by_dish for command in bench.station.commands("mot"))


def test_the_root_menu_lists_its_submenus(bench):
    bench.type("q")
    told = {command.name: command for command in bench.do(ListCommands())}
    assert told["dvb"].told_by_dish
    assert told["dvb"].help == "DVB Tuner"
    assert bench.type("mot").menu == "mot"


def test_the_tuner_lists_its_commands_page_by_page(bench):
    bench.type("q")
    bench.type("dvb")
    assert any(command.told_by_dish for command in bench.do(ListCommands()))
    assert bench.state.link.state is LinkNow.UP
