"""`birdcage motors run`: on a virtual clock what goes to the motor and how it ends; on a pty how signals end it."""

from __future__ import annotations

import signal
import time

import pytest
from birdcage.base.errors import BirdcageError, Held, LinkError, MotionRefused
from birdcage.cli.motor_run import run_motor
from birdcage.cli.station_command import StationCommand
from birdcage.easycomm.facts import RP2040_FACTS
from birdcage.sim.easycomm.rp2040 import Rp2040Board
from birdcage.station.requests import Goto
from birdcage.station.state import Activity
from pty_dish import PtyDish

from tests.cli.conftest import owning
from tests.easycomm.test_rotator import lines, met

AZ, EL, HOLDER = "duty.azimuth", "duty.elevation", "birdcage motors run"
AT = "&az=90&el=30"


class OnStage(StationCommand):
    """A command over a station on a virtual clock: time passes while it waits."""

    def __init__(self, stage):
        super().__init__(stage.station, moves=True)
        self.stage = stage
        self.at = lambda _seconds: None
        self.begun = None

    def _next(self, hear=None, wait_s=0.1):
        if self._events.empty():
            self.stage.step(max(wait_s, 0.0))
            if self.stage.state.activity is Activity.MOTOR_RUN:
                self.begun = self.begun or self.now
                self.at(self.now - self.begun)
            if self._events.empty():
                return False
        return super()._next(hear, 0.0)

    def on_signal(self, number):
        raise AssertionError("nothing but the run itself is asked for")

    call_stop = show_network = let_go = on_signal


def ran(stage, feature=AZ, value=0.1, seconds=1.0, at=None):
    command = OnStage(stage)
    command.at = at or command.at
    return run_motor(command, feature, value, seconds, HOLDER)


def motor_lines(stage):
    return [(round(at, 2), line) for at, line in stage.twin.device.shell.received if line.startswith(("DUTY", "STOP"))]


@pytest.mark.parametrize("seconds", [0.5, 3.0])
def test_it_runs_for_its_time_and_then_stop_goes_out(seconds):
    with met(AT) as stage:
        turned = ran(stage, seconds=seconds)
        (began, duty), (ended, stop) = motor_lines(stage)
        assert (duty, stop) == ("DUTY_AZ0.10", "STOP")
        assert ended - began == pytest.approx(seconds, abs=0.25)
        assert not stage.truth.moving
        assert turned.by_deg == pytest.approx(stage.truth.az_deg - 90.0, abs=0.1)
        assert turned.position.az_deg == pytest.approx(stage.truth.az_deg, abs=0.1)
        assert (stage.state.activity, stage.state.held, stage.state.holder) == (Activity.IDLE, None, None)


def test_the_other_axis_the_other_way():
    with met(AT) as stage:
        turned = ran(stage, EL, -0.1)
        assert turned.axis == "elevation"
        assert turned.by_deg == pytest.approx(stage.truth.el_deg - 30.0, abs=0.1)
        assert turned.by_deg < -1.0


def test_a_limit_on_the_way_ends_it_early_and_is_told():
    with met("&az=90&el=75") as stage:
        with pytest.raises(BirdcageError, match=r"its limit that way is 90\.00°") as told:
            ran(stage, EL, 0.2, 5.0)
        assert not isinstance(told.value, MotionRefused), "it was begun"
        (began, _), (ended, stop) = motor_lines(stage)
        assert stop == "STOP"
        assert ended - began < 4.0
        assert stage.clock.monotonic() - ended < 1.0, "it is told at once"
        assert stage.truth.el_deg < 90.0


def test_a_motor_that_does_not_turn_is_told_however_short_it_runs():
    with met(AT) as stage:
        with pytest.raises(BirdcageError, match="The azimuth was not seen to turn: 90"):
            ran(stage, AZ, 0.001)
        with pytest.raises(BirdcageError, match="The azimuth is not seen to turn, so STOP was sent"):
            ran(stage, AZ, 0.001, 5.0)
        assert [line for _, line in motor_lines(stage)].count("STOP") == 2


def test_stop_by_a_person_ends_it_and_begins_nothing_after():
    with met(AT) as stage:
        with pytest.raises(BirdcageError, match="STOP by you"):
            ran(stage, seconds=5.0, at=lambda s: s > 1.0 and stage.state.held is None and stage.station.stop("you"))
        assert motor_lines(stage)[0][1] == "DUTY_AZ0.10"
        with pytest.raises(Held, match="HELD by you"):
            ran(stage)
        assert len([line for line in lines(stage) if line.startswith("DUTY")]) == 1


def test_a_stop_that_is_not_answered_at_the_end_is_told(monkeypatch):
    stop, asked = Rp2040Board._stop, []

    def deaf(self, *axes):
        asked.append(self.now_s)
        return stop(self, *axes) if len(asked) > 3 else ""

    monkeypatch.setattr(Rp2040Board, "_stop", deaf)
    with met(AT) as stage:
        with pytest.raises(BirdcageError, match="The run did not end in order: STOP by birdcage"):
            ran(stage)
        assert len(asked) > 3
        assert stage.state.held is not None


def test_a_dish_that_goes_on_turning_after_its_answer_to_stop_is_told(monkeypatch):
    monkeypatch.setattr(Rp2040Board, "_stop", lambda board, *_: board._position())
    says = r"not seen at rest within 8 s\. If it moves, only the motor supply stops it\."
    with met(AT) as stage, pytest.raises(BirdcageError, match=says):
        ran(stage)


def test_a_lost_line_is_told_with_what_alone_stops_the_motor():
    with met(AT) as stage:
        gone = []

        def pull(seconds):
            if seconds > 0.5 and not gone:
                gone.append(stage.twin.device.unplug())

        with pytest.raises(LinkError, match="The motor may run on: only the motor supply stops it"):
            ran(stage, seconds=5.0, at=pull)


def test_it_is_refused_while_the_dish_moves():
    with met(AT) as stage:
        stage.station.submit(Goto(150.0, 30.0, "you"))
        stage.step(0.5)
        with pytest.raises(BirdcageError):
            ran(stage)
        assert motor_lines(stage) == []


@pytest.fixture
def at(run, rotator):
    return lambda *words: run(*words, port=rotator.path, firmware="easycomm")


@pytest.fixture
def rotator(run):
    """A rotator on a pty that was told where it points."""
    dish = PtyDish("seed=1&az=90&el=30", "easycomm")
    told = run("sync", 90, 30, "--yes", port=dish.path, firmware="easycomm")
    assert told.exit_code == 0, told.stderr
    yield dish
    dish.close()


@pytest.fixture
def owner(rotator):
    """A program that has its port."""
    with owning(rotator, "easycomm") as session:
        yield session


def test_it_asks_first_and_says_what_ends_it(at, rotator):
    asked = at("motors", "run", AZ, "0.1")
    assert asked.exit_code == 2
    words = " ".join(asked.stderr.split())
    assert "Run the motor, azimuth: at +0.1 for 1 s, without a target." in words
    assert "sends STOP when the time is over, at Ctrl+C" in words
    assert RP2040_FACTS.features[AZ].hazard in words
    assert "Give --yes" in words
    assert not any(line.startswith("DUTY") for line in rotator.lines())


def test_with_yes_it_runs_and_prints_where_the_dish_is_then(at, rotator, as_json):
    ran = at("motors", "run", AZ, "-0.1", "--seconds", "0.5", "--yes", "--json")
    assert ran.exit_code == 0, ran.stderr
    told, truth = as_json(ran), rotator.device.truth()
    assert told["azimuth_deg"] == pytest.approx(truth.az_deg, abs=0.1)
    assert told["turned_deg"] == pytest.approx(truth.az_deg - 90.0, abs=0.1)
    assert told["turned_deg"] < -0.5
    assert rotator.lines().count("STOP") == 1


def test_through_a_station_it_is_the_same(at, rotator, owner):
    ran = at("motors", "run", EL, "0.1", "--seconds", "1.5", "--yes")
    assert ran.exit_code == 0, ran.stderr
    assert "The elevation turned by +" in ran.stderr
    assert [line for line in rotator.lines() if line.startswith(("DUTY", "STOP"))] == ["DUTY_EL0.10", "STOP"]
    assert not rotator.device.truth().moving
    assert owner.station.state.held is None
    owner.station.stop("you")
    rotator.wait_for(lambda _truth: owner.station.state.held is not None)
    refused = at("motors", "run", EL, "0.1", "--yes")
    assert refused.exit_code == 4
    assert "HELD by" in refused.stderr


def ended_by(start, rotator, number):
    """Send a signal to a run that has begun; return what it said."""
    words = ("motors", "run", AZ, "0.1", "--seconds", 5, "--yes", "--port", rotator.path, "--firmware", "easycomm")
    process = start(*words)
    rotator.wait_for_motion()
    called = time.monotonic()
    process.send_signal(number)
    rotator.wait_for(lambda _truth: "STOP" in rotator.lines(called), 0.5)
    _out, err = process.communicate(timeout=30)
    assert process.returncode == 128 + number, err
    rotator.wait_for(lambda truth: not truth.moving, 3.0)
    return err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP], ids=lambda each: each.name)
def test_a_signal_sends_stop_first(start, rotator, number):
    err = ended_by(start, rotator, number)
    assert ("`birdcage release` lets it move again." in err) is (number == signal.SIGINT)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP], ids=lambda each: each.name)
def test_a_signal_ends_it_through_a_station_too(start, rotator, owner, number):
    ended_by(start, rotator, number)
    assert (owner.station.state.held is not None) is (number == signal.SIGINT)


@pytest.mark.parametrize(
    ("words", "code", "says"),
    [
        ((AZ, "0"), 2, "Give a number that is not 0."),
        ((AZ, "fast"), 2, "Give a number that is not 0."),
        ((AZ, "0.5"), 4, "0.5 is outside -0.35 to 0.35"),
        ((AZ, "0.1", "--seconds", "60"), 2, "0.5<=x<=5.0"),
        (("kp", "0.1"), 1, "It has duty.azimuth and duty.elevation."),
    ],
)
def test_what_makes_no_sense_is_refused_before_the_port_is_opened(run, words, code, says):
    refused = run("motors", "run", *words, "--yes", port="/dev/ttyUSB99", firmware="easycomm")
    assert refused.exit_code == code
    assert says in refused.stderr


def test_a_dish_without_such_a_motor_says_so(run):
    refused = run("motors", "run", AZ, "0.1", "--yes")
    assert refused.exit_code == 1
    assert "This dish has no motor duty.azimuth that can be run without a target. It has none." in refused.stderr


def test_set_names_the_command(run):
    refused = run("set", AZ, "0.1", "--yes", port="/dev/ttyUSB99", firmware="easycomm")
    assert refused.exit_code == 1
    assert "`birdcage motors run duty.azimuth VALUE`" in refused.stderr
