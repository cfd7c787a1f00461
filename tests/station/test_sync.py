"""A machine whose zero is where it was switched on is synced, and only then sent anywhere."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from birdcage.base.errors import (
    BirdcageError,
    CommandRefused,
    ConfirmationNeeded,
    LeaseDenied,
    OutOfRange,
    PositionUnknown,
)
from birdcage.station.events import TaskChanged
from birdcage.station.json_form import request_from_json, to_json
from birdcage.station.requests import (
    AcquireLease,
    BeginTask,
    Goto,
    Jog,
    Release,
    Sync,
)
from birdcage.station.task import ItemTask
from birdcage.testing import MachineBench, Stage
from birdcage.tracking.steps import ReadPosition
from installed_toys import installed

from .conftest import Bench


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import starter_twin

        yield starter_twin


@pytest.fixture
def stage(twins):
    with met(twins) as stage:
        yield stage


def met(twins, settings=None, machine="starter", **stands):
    """A program that has just met one that stands there."""
    make = lambda clock: twins.StarterTwin(clock, **stands)  # noqa: E731
    stage = Stage(MachineBench(machine, make, stops=()), settings=settings)
    stage.until(lambda: stage.state.surveyed, 10.0, "it was met")
    stage.step(1.0)
    return stage


def test_before_it_is_told_nothing_is_known_and_nothing_sent(stage):
    state = stage.state
    assert (state.position, state.homed, state.position_lost) == (None, False, "unsynced")
    for request in (Goto(90.0, 30.0, "you"), Jog(1.0, 0.0, "you")):
        refused = stage.refused(request, BirdcageError)
        assert isinstance(refused, PositionUnknown) or "unknown" in str(refused)
    assert "`birdcage sync AZ EL`" in str(stage.refused(Goto(90.0, 30.0, "you"), PositionUnknown))
    assert stage.twin.sent_to == []


@dataclass
class Glance(ItemTask[int]):
    """A task that reads once where the dish is."""

    kind = "glance"
    holder: str

    def items(self):
        return (1,)

    def do(self, item):
        yield ReadPosition()


def test_a_task_that_needs_its_position_asks_for_a_sync_and_no_homing(twins):
    with met(twins, {"tasks": {Glance.kind: Glance}}) as stage:
        stage.do(BeginTask(Glance.kind, {}, "you"))
        stage.step(2.0)
        why = [event.task.why for event in stage.events if isinstance(event, TaskChanged)][-1]
    assert "Sync it: `birdcage sync AZ EL`" in why
    assert "Home it" not in why


def test_told_it_knows_and_goes_where_it_is_sent(stage):
    found = stage.do(Sync(200.0, None, "you"))
    assert (found.az_deg, found.el_deg) == pytest.approx((200.0, 30.0))
    assert stage.state.homed is True
    assert stage.twin.sent_to == [], "nothing moves by it"
    stage.do(Goto(260.0, 40.0, "you"))
    assert stage.twin.points_az_deg == pytest.approx(260.0)
    assert stage.twin.motors[0].deg == pytest.approx(60.0)
    assert stage.state.position.az_deg == pytest.approx(260.0)


@pytest.mark.parametrize(("zero_az_deg", "turn_deg", "az_deg", "counted_deg"), [
    (200.0, 0.0, 110.0, -90.0), (200.0, 200.0, 110.0, 270.0), (350.0, 0.0, 20.0, 30.0), (10.0, -260.0, 150.0, -220.0),
])  # fmt: skip
def test_its_cable_keeps_its_range(twins, zero_az_deg, turn_deg, az_deg, counted_deg):
    """It turns by 270 degrees from where it was switched on, wherever that points."""
    with met(twins, zero_az_deg=zero_az_deg, turn_deg=turn_deg) as stage:
        stage.do(Sync(stage.twin.points_az_deg, 30.0, "you"))
        stage.do(Goto(az_deg, 30.0, "you"))
        assert stage.twin.motors[0].deg == pytest.approx(counted_deg)
        assert stage.twin.points_az_deg == pytest.approx(az_deg)
        limits = stage.state.cable_min_deg, stage.state.cable_max_deg
        assert limits[1] - limits[0] == pytest.approx(540.0)
        assert stage.state.position.cable_deg - limits[0] == pytest.approx(counted_deg + 270.0)


def test_stop_aims_by_what_it_was_told(stage):
    stage.do(Sync(200.0, 30.0, "you"))
    stage.station.submit(Goto(290.0, 30.0, "you"))
    stage.step(3.0)
    stage.station.stop("you")
    stage.step(5.0)
    assert 20.0 < stage.twin.motors[0].deg < 60.0
    assert stage.state.last_stop.confirmed is True


def test_it_is_not_told_in_motion_and_is_while_held(stage):
    stage.do(Sync(200.0, 30.0, "you"))
    stage.station.submit(Goto(290.0, 30.0, "you"))
    stage.step(2.0)
    assert stage.refused(Sync(10.0, 30.0, "you"), BirdcageError, within_s=1.0).reason == "moving"
    stage.station.stop("you")
    stage.step(5.0)
    found = stage.do(Sync(10.0, None, "you", agreed=True))
    assert found.az_deg == pytest.approx(10.0)
    assert stage.state.held is not None, "it moves nothing, so it releases nothing"
    stage.do(Release("you"))


@pytest.mark.parametrize("axis", [0, 1])
def test_it_is_not_told_while_somebody_else_turns_it_slowly(stage, axis):
    deg = stage.twin.motors[axis].deg
    stage.twin.motors[axis] = type(stage.twin.motors[axis])(stage.clock, deg, 1.0)
    stage.twin.motors[axis].go(deg + 20.0)
    refused = stage.refused(Sync(200.0, 30.0, "you"), BirdcageError)
    assert (refused.reason, str(refused)) == ("moving", "The dish is moving. Wait until it stops, then sync it.")
    assert stage.state.position is None
    stage.step(25.0)
    assert stage.do(Sync(200.0, None, "you")).az_deg == pytest.approx(200.0)


def test_what_it_believes_otherwise_is_asked_first(stage):
    stage.do(Sync(200.0, 30.0, "you"))
    asked = stage.refused(Sync(230.0, 30.0, "you"), ConfirmationNeeded)
    assert "azimuth 200.00" in str(asked)
    assert "+30.00" in str(asked)
    assert stage.state.position.az_deg == pytest.approx(200.0)
    assert stage.do(Sync(200.0, 30.0, "you")).az_deg == pytest.approx(200.0), "nothing to ask about"
    assert stage.do(Sync(230.0, 30.0, "you", agreed=True)).az_deg == pytest.approx(230.0)


def test_an_elevation_that_it_measures_stays_its_own(stage):
    asked = stage.refused(Sync(200.0, 55.0, "you"), ConfirmationNeeded)
    assert "30.00" in str(asked)
    assert "55.00" in str(asked)
    assert stage.do(Sync(200.0, 55.0, "you", agreed=True)).el_deg == pytest.approx(30.0)


@pytest.mark.parametrize("wrong", [Sync(361.0, 30.0, "you"), Sync(-1.0, 30.0, "you"), Sync(float("nan"), 30.0, "you"),
                                   Sync(10.0, 91.0, "you")])  # fmt: skip
def test_what_is_no_direction_is_refused(stage, wrong):
    stage.refused(wrong, OutOfRange)
    assert stage.state.position is None


def test_who_has_control_is_asked_and_not_overruled(stage):
    stage.do(AcquireLease("birdcage serve"))
    assert "birdcage serve has control" in str(stage.refused(Sync(200.0, 30.0, "you"), LeaseDenied))


def test_a_dish_that_knows_by_itself_is_told_nothing():
    bench = Bench().connect()
    with pytest.raises(CommandRefused, match="knows by itself where it points"):
        bench.do(Sync(180.0, 45.0, "you"))


def test_its_json_form():
    request = Sync(200.0, None, "you", agreed=True)
    told = to_json(request)
    assert told == {"v": 1, "type": "Sync", "az_deg": 200.0, "el_deg": None, "holder": "you", "agreed": True}
    assert request_from_json(told) == request


def test_a_restart_takes_it_away(stage):
    stage.do(Sync(200.0, 30.0, "you"))
    stage.do(Goto(260.0, 30.0, "you"))
    stage.twin.restart()
    stage.step(3.0)
    state = stage.state
    assert (state.position, state.homed, state.position_lost) == (None, False, "unsynced")
    assert "`birdcage sync AZ EL`" in state.fault.meaning
    assert "home" not in state.fault.remedy


class Desk:
    """One state folder; one program after the other at the same machine."""

    def __init__(self, twins, folder):
        self._twins, self.port = twins, folder / "tty"
        self.port.touch()
        self.settings = {"state_folder": folder, "identify": lambda _port: "usb:2e8a:000a:E6"}

    def meet(self, **stands):
        self._twins.StarterTwin.address = str(self.port)
        return met(self._twins, self.settings, **stands)


@pytest.fixture
def desk(twins, tmp_path):
    yield Desk(twins, tmp_path)
    twins.StarterTwin.address = "starter"


def told(desk, **stands):
    with desk.meet(**stands) as stage:
        stage.do(Sync(stage.twin.points_az_deg, 30.0, "you"))
        stage.step(1.0)


@pytest.mark.parametrize("turn_deg", [0.0, 120.0])
def test_the_next_program_knows_it(desk, turn_deg):
    told(desk, turn_deg=turn_deg)
    with desk.meet(turn_deg=turn_deg) as later:
        assert later.state.position.az_deg == pytest.approx((200.0 + turn_deg) % 360.0)
        later.do(Goto(250.0, 30.0, "you"))
        assert later.twin.points_az_deg == pytest.approx(250.0)
        left = later.twin.motors[0].deg
        later.step(1.0)
    with desk.meet(turn_deg=left) as later:
        assert later.state.position.az_deg == pytest.approx(250.0), "it was left elsewhere, and that was kept"


def test_one_that_is_known_for_what_it_is_only_once_met(desk):
    for _ in range(2):
        with desk.meet(machine="late_starter", turn_deg=120.0) as stage:
            if stage.state.position is None:
                assert stage.state.position_lost == "unsynced"
                stage.do(Sync(320.0, None, "you"))
            assert stage.state.position.az_deg == pytest.approx(320.0)
            stage.step(1.0)
    with desk.meet(machine="late_starter", turn_deg=120.0) as stage:
        assert stage.state.position is not None
        stage.twin.restart()
        stage.step(3.0)
        assert stage.state.position_lost == "unsynced"


@pytest.mark.parametrize("stands_deg", [119.0, -240.0, 0.0])
def test_one_that_stands_elsewhere_has_to_be_told_anew(desk, stands_deg):
    """Another program has moved it, or it was without power."""
    told(desk, turn_deg=120.0)
    with desk.meet(turn_deg=stands_deg) as later:
        assert later.state.position is None
        assert later.state.position_lost == "unsynced"


def test_one_that_was_plugged_in_anew_has_to_be_told_anew(desk):
    """Its port is another file then: it was without power, and may have been turned by hand."""
    told(desk, turn_deg=120.0)
    desk.port.rename(desk.port.with_name("old"))
    desk.port.touch()
    with desk.meet(turn_deg=120.0) as later:
        assert later.state.position is None


def test_one_left_at_its_zero_is_not_taken_for_the_same_the_next_day(desk, monkeypatch):
    """There it would stand after each power-up, wherever that is."""
    told(desk, turn_deg=0.0)
    monkeypatch.setattr("birdcage.station.zero_memory.START_S", -1000.0)
    with desk.meet(turn_deg=0.0) as later:
        assert later.state.position is None
    told(desk, turn_deg=120.0)
    with desk.meet(turn_deg=120.0) as later:
        assert later.state.position is not None


@pytest.mark.parametrize("damage", ["", "[]", "{", '{"zero": {"pan": NaN}}', '{"zero": {"pan": "x"}, "counted": {}}'])
def test_a_damaged_note_is_none(desk, damage):
    told(desk, turn_deg=120.0)
    (note,) = desk.settings["state_folder"].rglob("zero.json")
    note.write_text(damage)
    with desk.meet(turn_deg=120.0) as later:
        assert later.state.position is None
