"""The app's end of another program's station: the words of F5, settings, what its end says, and whom it attaches to."""

from __future__ import annotations

import json
import time
from dataclasses import replace

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.errors import BadMessage, CommandRefused, LeaseDenied
from birdcage.base.no_go import NoGoSector
from birdcage.base.paths import Paths
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.ladder import StopMeans
from birdcage.station.attach_messages import wire_from_json
from birdcage.station.attached_session import AttachedSession, attach_session, judge_by_state, what_goes_on
from birdcage.station.control_client import owner_file, owners_folder
from birdcage.station.events import LeaseChanged
from birdcage.station.pursuit_state import Phase, Pursuit, PursuitOptions
from birdcage.station.raw import CONSOLE, OTHER_CONSOLE, Grade, MenuCommand, RawReply
from birdcage.station.requests import (
    AcquireLease,
    ApplySettings,
    Connect,
    Goto,
    Home,
    ListCommands,
    Raw,
    ReleaseLease,
    ReloadSettings,
    Unwatch,
    Watch,
)
from birdcage.station.state import Activity, LinkPhase, Motion, Pointing, StationState
from birdcage.station.wire_stream import AT_ONCE, KEPT, WireStream

from .attached_bench import served, until
from .conftest import Bench
from .pursuit_bench import plan_of


@pytest.fixture
def owner(tmp_path):
    with served(tmp_path) as owner:
        owner.board.change(dish=CARRYOUT_G2, menu="mot", homed=True)
        yield owner


@pytest.fixture
def app(owner):
    session = attach_session(Paths.default(), owner.state.port, "birdcage-tui")
    assert isinstance(session, AttachedSession)
    yield session
    session.station.close()


def test_without_a_program_the_app_keeps_to_itself(tmp_path):
    assert attach_session(Paths.default(), str(tmp_path / "port"), "birdcage-tui") is None


def test_what_a_dead_program_has_left_is_no_program(owner):
    path = owner_file(owners_folder(Paths.default()), owner.state.port)
    told = json.loads(path.read_text())
    owner.server.close()
    path.write_text(json.dumps(told))
    assert attach_session(Paths.default(), owner.state.port, "birdcage-tui") is None
    assert not path.exists()


def test_it_says_through_whom_it_drives(app, owner):
    assert app.via == f"birdcage (process {owner.found.pid})"


def test_a_raw_line_is_judged_here_by_the_language_of_the_dish(app):
    station = app.station
    assert station.judge("a 0 100").grade is Grade.MOVES
    assert station.judge("a").grade is Grade.HARMLESS
    assert station.has_prompt
    assert station.is_prompt("MOT>")
    assert "a" in [command.name for command in station.commands("mot")]


LINES = (
    "a", "a 0", "a 0 100", "a 0 350", "a 0 -100", "a 0 400", "a 1 30", "a 1 80", "a 1 10", "a 1 24", "a 1 70",
    "g 120 40", "h 0", "ms", "mot", "nvs", "reboot", "s 1 2 3", "w 0", "xyz", "",
)  # fmt: skip


@pytest.mark.parametrize("menu", ["mot", "nvs", None])
@pytest.mark.parametrize("where", [None, (250.0, 45.0), (10.0, 60.5)])
def test_what_a_line_would_do_is_judged_as_the_station_itself_does(menu, where):
    bench = Bench(options={
        "sectors": (NoGoSector(80.0, 140.0, 35.0),), "max_elevation_deg": 63.0, "cable_min_deg": -200.0,
        "alignment": Alignment(az_offset_deg=3.0, el_offset_deg=-2.0),
    })  # fmt: skip
    bench.connect(6.0)
    if where is not None:
        bench.do(Home("you"), 120.0)
        bench.do(Goto(*where, "you"))
    station = bench.station
    station._store.change(menu=menu)
    raw = station._antenna.raw
    for line in LINES:
        assert judge_by_state(raw, line, station.state) == station.judge(line), line
    station._store.change(motion_refused_because="Settings are unreadable.")
    assert judge_by_state(raw, "a 0 100", station.state) == station.judge("a 0 100")
    limits = [station.judge(line).limit for line in LINES]
    assert menu != "mot" or len([each for each in limits if each]) > 3


def test_a_language_that_is_not_installed_here_leaves_each_line_a_motion(app, owner):
    owner.board.change(dish=replace(CARRYOUT_G2, firmware="elsewhere"))
    until(lambda: app.station.state.dish.firmware == "elsewhere")
    assert app.station.judge("a").grade is Grade.MOVES
    assert app.station.commands("mot") == ()
    assert not app.station.has_prompt


def test_what_the_dish_lists_is_known_afterwards(app, owner):
    told = (MenuCommand("mot", "zz", "zz <n>", "unheard of", told_by_dish=True),)
    owner.answers = {ListCommands: told}
    assert app.station.submit(ListCommands()).result(5) == told
    until(lambda: "zz" in [command.name for command in app.station.commands("mot")])


def test_settings_are_read_again_by_the_program_that_has_the_port(app, owner):
    app.station.submit(ApplySettings(None, "you")).result(5)
    assert [each for each in owner.asked if isinstance(each, ReloadSettings)] == [
        ReloadSettings(str(Paths.default().config_file))
    ]


def test_another_port_is_not_for_this_app_to_choose(app, owner):
    with pytest.raises(CommandRefused, match="end that program"):
        app.station.submit(Connect("/dev/elsewhere")).result(5)
    app.station.submit(Connect(owner.state.port)).result(5)
    assert [type(each) for each in owner.asked if isinstance(each, Connect)] == [Connect]


def test_the_next_program_is_asked_for_what_this_app_looks_at(app, owner):
    app.station.submit(Watch("app", frozenset({"position"}))).result(5)
    app.station.submit(Watch("gone", frozenset({"health"}))).result(5)
    app.station.submit(Unwatch("gone")).result(5)
    owner.server.close()
    until(lambda: not app.station.is_attached)
    before = len(owner.asked)
    owner.serve_again()
    until(lambda: app.station.is_attached and len(owner.asked) > before)
    again = owner.asked[before:]
    assert [(type(each), each.features) for each in again] == [(Watch, frozenset({"position"}))]


def test_the_console_of_another_program_is_not_this_ones(app, owner):
    def lease(holder, previous=None):
        owner.board.change(holder=holder)
        owner.board.tell(LeaseChanged(*owner.board.stamp(), holder, previous))

    lease(CONSOLE)
    until(lambda: app.station.state.holder == OTHER_CONSOLE)
    app.station.submit(AcquireLease(CONSOLE, take_over=True)).result(5)
    until(lambda: app.station.state.holder == CONSOLE)
    lease(None, CONSOLE)
    until(lambda: app.station.state.holder is None)
    lease(CONSOLE)
    until(lambda: app.station.state.holder == OTHER_CONSOLE)
    owner.answers = {Raw: RawReply("a", (), "mot", "MOT>", 0.1)}
    app.station.submit(Raw("a", CONSOLE)).result(5)
    until(lambda: app.station.state.holder == CONSOLE)
    app.station.submit(ReleaseLease(CONSOLE)).result(5)
    lease(None, CONSOLE)
    lease(CONSOLE)
    until(lambda: app.station.state.holder == OTHER_CONSOLE)
    owner.answers = {Raw: LeaseDenied("Somebody has control.")}
    with pytest.raises(LeaseDenied):
        app.station.submit(Raw("a", CONSOLE)).result(5)
    assert app.station.state.holder == OTHER_CONSOLE


def test_the_wire_is_told_while_somebody_wants_it(app, owner):
    heard = []
    owner.pass_on_wire(">", b"before\r")
    end = app.on_wire(lambda entry: heard.append((entry.direction, entry.data, app.station.is_steering())))
    until(lambda: owner.transcript._listeners)
    owner.pass_on_wire(">", b"a 0 180\r")
    owner.steering = True
    owner.pass_on_wire(">", b"a 0 181\r")
    owner.pass_on_wire("<", b"\x1b[2J caf\xe9 \r\n")
    until(lambda: len(heard) == 3)
    assert heard == [
        (">", b"a 0 180\r", False), (">", b"a 0 181\r", True), ("<", b"\x1b[2J caf\xe9 \r\n", False),
    ]  # fmt: skip
    end()
    until(lambda: not owner.transcript._listeners)


def test_the_wire_of_the_next_program_is_heard_too(app, owner):
    heard = []
    app.on_wire(heard.append)
    until(lambda: owner.transcript._listeners)
    owner.server.close()
    until(lambda: not app.station.is_attached)
    assert not owner.transcript._listeners
    owner.serve_again()
    until(lambda: owner.transcript._listeners)
    owner.pass_on_wire("<", b"MOT> ")
    until(lambda: [entry.data for entry in heard] == [b"MOT> "])


def test_pieces_that_are_not_read_fast_enough_are_counted(owner):
    woken = []
    stream = WireStream(owner, owner.transcript.listen, lambda: woken.append(1))
    stream.hear(on=True)
    for number in range(KEPT + 7):
        owner.pass_on_wire("<", b"%d\r\n" % number)
    pieces, missed = wire_from_json(json.loads(stream.next_line()))
    assert missed == 7
    assert len(pieces) == AT_ONCE
    assert pieces[0].entry.data == b"7\r\n"
    assert len(woken) == KEPT + 7
    assert wire_from_json(json.loads(stream.next_line()))[1] == 0
    stream.close()
    assert stream.next_line() == b""
    assert not owner.transcript._listeners


def test_a_program_that_passes_no_wire_on_says_so(owner):
    with pytest.raises(CommandRefused):
        WireStream(owner, None, lambda: None).hear(on=True)


@pytest.mark.parametrize(
    "wrong", [{"pieces": [["no line", False]]}, {"pieces": [[1, 2]]}, {"pieces": "x"}, {"missed": "many"}, {}]
)
def test_a_wire_that_is_garbage_is_refused(wrong):
    told = {"v": 1, "type": "WirePassed", "missed": 0, "pieces": []}
    assert wire_from_json(told) == ([], 0)
    with pytest.raises(BadMessage):
        wire_from_json({**told, **(wrong or {"v": 99})})


def test_a_program_that_does_not_answer_a_stop_is_told_of(app, owner):
    owner.thawed.clear()
    called = time.monotonic()
    app.station.stop("you")
    assert time.monotonic() - called < 0.1
    until(lambda: app.station.state.last_stop is not None)
    report = app.station.state.last_stop
    assert (report.confirmed, report.means) == (False, StopMeans.NO_LINK)
    assert report.sentence.startswith(f"birdcage (process {owner.found.pid}) does not answer.")
    assert "Then end that process." in report.sentence
    owner.thawed.set()
    until(lambda: len(owner.stops) == 1)
    until(lambda: app.station.state.last_stop.confirmed is True)


def test_its_end_stops_nothing_and_says_what_goes_on(app, owner):
    pointing = Pointing(101.0, 45.0, 101.0, 45.0, owner.clock.monotonic(), owner.clock.utc())
    motion = Motion(100.0, 45.0, 160.7, 40.21, 0.0, 9.0, 0.3, StopMeans.RETARGET)
    owner.board.change(motion=motion, activity=Activity.SLEWING, position=pointing)
    until(lambda: app.station.state.motion is not None)
    app.leave("you")
    said = app.close()
    assert said.startswith(f"{app.via} goes on: the dish moves to AZ 160.70 EL 40.21°. The dish was last seen at AZ")
    assert owner.stops == []


def test_its_end_without_a_program_says_that_nothing_is_known(app, owner):
    owner.server.close()
    until(lambda: app.station.state.link.state is LinkPhase.LOST)
    assert "It is unknown whether the dish moves." in app.close()


def test_a_pursuit_that_was_told_as_an_outline_is_not_drawn_and_is_told_of_all_the_same(app, owner, monkeypatch):
    monkeypatch.setattr(app.station.services, "with_plan", lambda state: state)
    now = owner.clock.monotonic()
    pursuit = Pursuit(1, "tracker", plan_of(owner.clock.utc().timestamp()), PursuitOptions(), Phase.FOLLOWING, now, "")
    owner.board.change(pursuit=pursuit, activity=Activity.FOLLOWING)
    until(lambda: app.station.state.activity is Activity.FOLLOWING)
    assert app.station.state.pursuit is None
    assert app.station.followed == "follows NOAA 19"
    assert "goes on: the dish follows NOAA 19." in app.close()


def test_what_goes_on_is_told_in_words():
    assert what_goes_on(StationState()) == ""
    assert what_goes_on(StationState(raw_activity=True)) == "a raw line may have set the dish in motion"
    assert what_goes_on(StationState(activity=Activity.HOMING)) == "the dish homes"
    assert what_goes_on(StationState(activity=Activity.MOVING_UNASKED)) == "the dish moves"
