"""Our client against Hamlib's own rotctld with its dummy, in real time; it is killed in a pass, and started again."""

from __future__ import annotations

import socket
import time
from contextlib import closing, contextmanager
from datetime import timedelta

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import Settings
from birdcage.base.geometry import separation, shortest_turn
from birdcage.link.opening import open_link
from birdcage.rotator import machines
from birdcage.rotator.axis import CableRange
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit_state import PursuitOptions
from birdcage.station.requests import Goto, Pursue, Release, Watch
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.station import Station
from birdcage.testing.passing import PLACE
from hamlib_program import free_port, start_hamlib

SPEEDS = {"azimuth.speed_deg_s": 6.0, "elevation.speed_deg_s": 6.0}
"""Of the dummy, as an owner says it in [dish.facts]."""


class Daemon:
    """`rotctld -m 1`, always on the same port."""

    def __init__(self):
        self.port, self.process = free_port(), None
        self.url = f"rotctl://127.0.0.1:{self.port}"

    def start(self):
        self.process, first = start_hamlib("rotctld", self.port)
        first.close()

    def kill(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process = None

    def position(self):
        """Ask it on a connection of our own."""
        with socket.create_connection(("127.0.0.1", self.port), 5.0) as connection:
            connection.sendall(b"p\n")
            told = b""
            while told.count(b"\n") < 2:
                told += connection.recv(64)
        az, el = map(float, told.split())
        return az, el


@pytest.fixture
def daemon():
    daemon = Daemon()
    daemon.start()
    yield daemon
    daemon.kill()


@contextmanager
def station_at(daemon):
    """Run a station on the wall's clock and give it, with a function that lets it run until something holds."""
    clock = RealClock()
    station = Station(
        clock,
        StationSettings(
            port=daemon.url,
            firmware="rotctl",
            own_facts=SPEEDS,
            open_link=lambda name, baud: open_link(name, baud=baud, clock=clock),
        ),
    )
    with closing(Session(clock, station)) as session:
        station.submit(Watch("test", frozenset({"position"}), 2.0))

        def until(holds, within_s=20.0):
            end = clock.monotonic() + within_s
            while not holds(station.state):
                assert clock.monotonic() < end, station.state
                session.step(0.05)

        until(lambda state: state.surveyed and state.position is not None and state.activity is Activity.IDLE)
        yield station, until


def plan_up_now(station):
    """Plan a made-up pass that is under way."""
    from birdcage.sky.demo_orbits import demo_orbits
    from birdcage.sky.passes.search import search
    from birdcage.sky.propagate import Fleet
    from birdcage.sky.targets.model import Satellite
    from birdcage.tracking.planning.planner import plan_pass

    now = RealClock().utc()
    by_id = {each.norad_id: each for each in demo_orbits(now, PLACE)}
    low = [each for each in by_id.values() if each.mean_motion_rev_day > 10.0]
    mount = mount_of(station.state, Settings())
    plans = [
        plan_pass(Satellite(by_id[passing.norad_id]), PLACE, mount, now, passing=passing)
        for passing in search(Fleet(low), PLACE, now - timedelta(minutes=20), 0.5)
        if passing.aos < now - timedelta(seconds=30) and passing.los > now + timedelta(seconds=90)
    ]
    up = [plan for plan in plans if plan.legs and plan.legs[0].end_s > now.timestamp() + 80.0]
    assert up, "no made-up pass is up"
    return min(up, key=lambda plan: abs(shortest_turn(0.0, plan.sky.at(now.timestamp())[0])))


def test_the_whole_of_its_protocol(daemon):
    machine, clock = machines.make("rotctl"), RealClock()
    machine.open(daemon.url, None, clock, Hooks())
    try:
        machine.meet()
        assert machine.facts.cable == CableRange(-180.0, 450.0)
        assert (machine.facts.elevation.min_deg, machine.facts.elevation.max_deg) == (0.0, 90.0)
        assert machine.survey().features["info"] == "Dummy rotator"
        assert dict(machine.look().angles) == {"azimuth": 0.0, "elevation": 0.0}
        machine.send({"azimuth": -90.0, "elevation": 30.0})
        machine.listen(clock.monotonic() + 1.0)
        machine.stop_now(StopOrder(StopBy.COMMAND))
        assert machine.settle(1.0) == (None,)
        stands = machine.look()
        assert -30.0 < stands.angles["azimuth"] < -2.0
        assert machine.read(["status_flags"])["status_flags"].value == "none"
        assert machine.write("speed_level", 40.0).value == 40.0
    finally:
        machine.close(0.0)


def test_killed_and_restarted_in_a_pass_it_stays_where_it_is_until_a_person_says_so(daemon):
    with station_at(daemon) as (station, until):
        plan = plan_up_now(station)
        start = plan.sky.at(time.time())
        went = station.submit(Goto(start[0] % 360.0, start[1], "test"))
        until(lambda _state: went.done(), 90.0)
        went.result(0)
        begun = station.submit(Pursue(plan, "test", PursuitOptions(at_end="stay")))
        until(lambda _state: begun.done())
        until(lambda state: state.activity is Activity.FOLLOWING, 60.0)
        end = time.monotonic() + 4.0
        until(lambda _state: time.monotonic() > end)
        told, sky = daemon.position(), plan.sky.at(time.time())
        assert separation(told[0], told[1], *sky) < 1.0

        daemon.kill()
        until(lambda state: state.link.state is LinkPhase.LOST)
        assert station.state.position_lost is not None
        assert station.state.activity is not Activity.FOLLOWING
        daemon.start()
        until(lambda state: state.link.state is LinkPhase.UP and state.position_lost is None)
        end = time.monotonic() + 3.0
        until(lambda _state: time.monotonic() > end)
        assert daemon.position() == (0.0, 0.0), "another dummy, and nothing was sent to it"
        assert station.state.held is not None
        assert (
            station.state.pursuit.why == "Link lost: the dish stays still. Release it to resume while the pass lasts."
        )
        station.submit(Release("test"))
        until(lambda state: state.activity is Activity.SLEWING)
        until(lambda _state: daemon.position() != (0.0, 0.0))
        station.stop("test")
        until(lambda state: state.last_stop is not None and state.last_stop.confirmed is not None)
        assert (station.state.last_stop.means, station.state.last_stop.confirmed) == ("command", True)
