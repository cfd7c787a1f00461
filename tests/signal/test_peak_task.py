"""The dish finds the middle of a satellite by its signal, over the wire, and where there is none it says so."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import shortest_turn
from birdcage.signal.peak_task import NO_PEAK, PeakTask
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.sim.almanac import geostationary
from birdcage.sim.settings import SimSettings
from birdcage.station.events import TaskChanged
from birdcage.station.requests import AcquireLease, BeginTask, Jog
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.task_state import TaskPhase

from tests.station.conftest import Bench

ALONE = -61.5
"""A slot whose next neighbour is 11 degrees away."""


def made(address="g2?seed=1"):
    return Bench(address, {"tasks": signal_tasks()}).connect(6.0)


def begin(bench, az_deg, el_deg, width_deg=6.4):
    return bench.do(BeginTask("peak", {"az_deg": az_deg, "el_deg": el_deg, "width_deg": width_deg}, "you"))


def end_of(bench, seconds=180.0):
    end = bench.clock.monotonic() + seconds
    while bench.state.tasks and bench.clock.monotonic() < end:
        bench.step(0.5)
    return [event.task for event in bench.events if isinstance(event, TaskChanged)][-1]


def slot(bench, east_deg):
    """Return where a slot stands for this dish, true degrees."""
    settings = SimSettings()
    return geostationary(east_deg, settings.lat, settings.lon)


def off_deg(bench, to):
    position = bench.state.position
    across = shortest_turn(to[0], position.az_deg) * math.cos(math.radians(to[1]))
    return math.hypot(across, position.el_deg - to[1])


def test_a_satellite_two_degrees_off_is_found_and_the_dish_ends_on_it():
    bench = made()
    az_deg, el_deg = to = slot(bench, ALONE)
    begin(bench, az_deg + 2.0, el_deg - 1.2)
    ended = end_of(bench)
    assert (ended.phase, ended.is_done, ended.done, ended.of) == (TaskPhase.OVER, True, 25, 25), ended.why
    assert ended.why.startswith("Peak at ")
    assert (
        math.hypot((ended.found["az_deg"] - az_deg) * math.cos(math.radians(el_deg)), ended.found["el_deg"] - el_deg)
        < 0.25
    )
    assert off_deg(bench, to) < 0.3
    assert bench.state.holder is None


def test_where_there_is_nothing_it_says_so_and_goes_back():
    bench = made()
    begin(bench, 60.0, 60.0)
    ended = end_of(bench)
    assert (ended.why, ended.found) == (NO_PEAK, {})
    assert (bench.state.position.az_deg, bench.state.position.el_deg) == (
        pytest.approx(60.0, abs=0.1),
        pytest.approx(60.0, abs=0.1),
    )


def test_stop_ends_it_and_nothing_moves_after_that():
    bench = made()
    begin(bench, 150.0, 40.0)
    bench.step(8.0)
    assert bench.state.tasks
    bench.station.stop("you")
    bench.step(3.0)
    at = bench.clock.monotonic()
    bench.step(20.0)
    assert not bench.state.tasks
    assert bench.moves_since(at) == []
    assert bench.state.held is not None
    assert "The peak was not found." in end_of(bench).why


def test_a_step_by_hand_ends_it():
    bench = made()
    begin(bench, 150.0, 40.0)
    bench.step(8.0)
    bench.do(Jog(1.0, 0.0, "you"))
    assert not bench.state.tasks
    assert bench.state.activity is Activity.IDLE


def test_a_grid_that_leaves_the_limits_is_refused_with_the_limit():
    bench = made()
    begin(bench, 150.0, 19.0)
    ended = end_of(bench)
    assert not ended.is_done
    assert "18.00" in ended.why


def test_it_does_not_begin_while_somebody_else_has_control():
    bench = made()
    bench.do(AcquireLease("other"))
    before = bench.clock.monotonic()
    begin(bench, 150.0, 40.0)
    assert "other has control" in end_of(bench).why
    assert bench.moves_since(before) == []


@pytest.mark.parametrize("values", [
    {"az_deg": 150.0}, {"az_deg": "north", "el_deg": 40.0}, {"az_deg": 150.0, "el_deg": 90.0},
    {"az_deg": math.nan, "el_deg": 40.0}, {"az_deg": 150.0, "el_deg": 40.0, "width_deg": -1.0},
    {"az_deg": True, "el_deg": 40.0}, {"az_deg": 150.0, "el_deg": math.inf}, {"az": 1.0, "el_deg": 40.0},
])  # fmt: skip
def test_values_that_make_no_peak_are_refused_and_the_station_lives_on(values):
    bench = made()
    with pytest.raises(CommandRefused):
        bench.do(BeginTask("peak", values, "you"))
    bench.step(1.0)
    assert not bench.state.tasks
    assert bench.state.link.state is LinkPhase.UP


def test_the_grid_is_a_way_without_jumps():
    directions = PeakTask("you", 359.0, 40.0, 6.0).items()
    assert len(directions) == 25
    for one, other in pairwise(directions):
        across = abs(shortest_turn(one[0], other[0])) * math.cos(math.radians(40.0))
        assert across + abs(one[1] - other[1]) == pytest.approx(2.1)
