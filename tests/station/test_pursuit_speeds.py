"""Speeds that a pursuit has changed are put back on every way out of it."""

from __future__ import annotations

import pytest
from birdcage.base.config import Settings
from birdcage.base.errors import CommandRefused
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import AcquireLease, EndPursuit, Goto, Release
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase
from birdcage.station.station import Station
from birdcage.tracking.steps import LimitSpeeds, ReadPosition, Wait

from .pursuit_bench import PARK, PursuitBench, at, g2, plan_of


def slowing(guide):
    """A controller that slows the azimuth down, and then only looks."""
    now = (yield LimitSpeeds({0: 7.0})).now_s
    while now < guide.until_s:
        yield ReadPosition()
        now = (yield Wait(now + 1.0)).now_s


@pytest.fixture
def bench(monkeypatch):
    monkeypatch.setattr("birdcage.tracking.steering.choice.controller_for", lambda *_, **__: ("slowing", slowing))
    bench = g2()
    bench.pursue(plan_of(at(bench) + 40.0), **PARK)
    bench.until(Phase.FOLLOWING).step(8.0)
    assert speed(bench) == pytest.approx(7.0, abs=0.02)
    return bench


def speed(bench):
    """What the dish itself goes at."""
    with bench.device.lock:
        bench.device.machine.run()
        return bench.device.dish.axes[0].data.max_rate_deg_s


def settled(bench):
    return speed(bench) == pytest.approx(65.0, abs=0.02) and bench.state.readings["speed.azimuth"].value > 64.9


def test_at_the_end_before_it_parks(bench):
    bench.until(Phase.PARKING)
    assert settled(bench)


def test_when_it_is_ended(bench):
    bench.do(EndPursuit("you"))
    bench.step(3)
    assert settled(bench)


def test_after_stop(bench):
    bench.station.stop("you")
    bench.step(8)
    assert settled(bench)
    assert bench.state.held is not None


def test_before_whoever_takes_over_moves_anything(bench):
    bench.do(AcquireLease("Gpredict", take_over=True))
    bench.station.submit(Goto(200, 40, "Gpredict"))
    bench.step(5)
    lines = bench.lines()
    assert lines.index("mv 0 7222") < next(i for i, line in enumerate(lines) if line.startswith("a 0 200"))
    assert settled(bench)


def test_by_a_hand(bench):
    bench.do(Goto(200, 40, "you"))
    bench.step(5)
    assert settled(bench)


def test_at_reconnection_after_a_lost_link(bench):
    bench.device.unplug()
    bench.step(2)
    bench.device.plug()
    bench.step(12)
    assert bench.pursuit.phase is Phase.INTERRUPTED
    assert settled(bench)
    bench.do(Release("you"))


def test_when_the_program_is_closed(bench):
    bench.session.close()
    assert speed(bench) == pytest.approx(65.0, abs=0.02)


def test_a_dish_that_does_not_take_its_speed_back_is_a_fault(bench):
    def refuse(_motor, _speed):
        raise CommandRefused("The dish shows 7°/s.", reason="bad_parameter")

    bench.station._antenna.rotator.protocol.set_speed = refuse
    bench.do(EndPursuit("you"))
    bench.step(3)
    assert bench.state.fault.reason == "speed"
    assert bench.state.link.state is LinkPhase.UP


def test_stop_while_the_console_is_in_another_menu_to_set_a_speed():
    bench = g2()
    start = at(bench) + 40.0
    bench.pursue(
        plan_of(start, lasts_s=60.0, az_rate=3.0, leave_s=start - 39.0), controller="velocity", velocity_allowed=True
    )
    bench.until(Phase.FOLLOWING).step(start + 6.0 - at(bench))
    write, pressed = bench.sim.write, []

    def press(data):
        write(data)
        if data.startswith(b"mv 0") and not pressed:
            pressed.append(bench.device.truth().az_deg)
            bench.station.stop("you")

    bench.sim.write = press
    bench.step(8.0)
    assert pressed, "it sets its speed again and again"
    truth = bench.device.truth()
    assert not truth.moving
    assert abs(truth.az_deg - pressed[0]) < 3.0
    assert bench.state.last_stop.confirmed is True
    assert bench.pursuit.phase is Phase.OVER
    assert settled(bench)
    since = bench.clock.monotonic()
    bench.step(60)
    assert bench.moves_since(since) == []


def test_a_plan_made_meanwhile_counts_on_the_dish_s_own_speeds(bench):
    assert bench.state.readings["speed.azimuth"].value == pytest.approx(7.0, abs=0.02)
    assert mount_of(bench.state, Settings()).model.azimuth.speed_deg_s == pytest.approx(65.0, abs=0.02)
    bench.do(EndPursuit("you"))
    bench.step(3)
    assert not bench.state.speeds_lent
    assert mount_of(bench.state, Settings()).model.azimuth.speed_deg_s == pytest.approx(65.0, abs=0.02)


class Again(PursuitBench):
    """A program with a state folder, and the one after it, at the same dish."""

    def begin_again(self, **changes):
        for port in self.opened:
            port.close()
        settings = StationSettings(**{
            "port": "sim:test", "firmware": "g2", "open_link": self._open, **self.options, **changes,
        })  # fmt: skip
        self.station = Station(self.clock, settings)
        self.session = Session(self.clock, self.station)
        self.connect(12.0)


@pytest.fixture
def killed(monkeypatch, tmp_path):
    monkeypatch.setattr("birdcage.tracking.steering.choice.controller_for", lambda *_, **__: ("slowing", slowing))
    bench = Again("g2?seed=1", {"state_folder": tmp_path}).connect()
    bench.pursue(plan_of(at(bench) + 40.0), **PARK)
    bench.until(Phase.FOLLOWING).step(8.0)
    assert speed(bench) == pytest.approx(7.0, abs=0.02)
    return bench


def test_by_the_next_program_where_this_one_was_killed(killed):
    killed.begin_again()
    assert settled(killed)
    assert not killed.state.speeds_lent
    assert not (killed.options["state_folder"] / "speeds.json").exists()


def test_but_not_at_another_dish(killed):
    killed.begin_again(port="/dev/another")
    assert speed(killed) == pytest.approx(7.0, abs=0.02)


def test_a_speed_that_could_not_be_remembered_is_not_changed(monkeypatch, tmp_path):
    monkeypatch.setattr("birdcage.tracking.steering.choice.controller_for", lambda *_, **__: ("slowing", slowing))
    (tmp_path / "file").write_text("no folder")
    bench = Again("g2?seed=1", {"state_folder": tmp_path / "file"}).connect()
    bench.pursue(plan_of(at(bench) + 40.0), **PARK)
    bench.until(Phase.OVER)
    assert "speeds.json cannot be written" in bench.pursuit.why
    assert speed(bench) == pytest.approx(65.0, abs=0.02)
