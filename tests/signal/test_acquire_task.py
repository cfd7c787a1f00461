"""A satellite is found near where it should be, by its signal, over the wire."""

from __future__ import annotations

import contextlib
import math
from datetime import UTC, datetime
from itertools import pairwise

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import separation
from birdcage.rotator.feature import LOCK, NETWORK, SNR, TRANSPONDER, Reading
from birdcage.signal.acquire_task import AcquireTask
from birdcage.sim.almanac import geostationary
from birdcage.sim.settings import SimSettings
from birdcage.station.events import TaskChanged
from birdcage.station.requests import BeginTask
from birdcage.station.state import LinkPhase
from birdcage.station.task_state import TaskPhase
from birdcage.tracking.steps import PointAt, StepResult

from tests.signal.test_peak_task import made, off_deg

WHO = f"{LOCK} {SNR} {NETWORK} {TRANSPONDER}"


def slot(east_deg):
    settings = SimSettings()
    return geostationary(east_deg, settings.lat, settings.lon)


def acquire(bench, az_deg, el_deg, **values):
    values = {"az_deg": az_deg, "el_deg": el_deg, "width_deg": 6.4, "identify": WHO, **values}
    bench.do(BeginTask("acquire", values, "you"))
    end = bench.clock.monotonic() + 900.0
    while bench.state.tasks and bench.clock.monotonic() < end:
        bench.step(0.5)
    return [event.task for event in bench.events if isinstance(event, TaskChanged)][-1]


@pytest.mark.parametrize(("off_az_deg", "off_el_deg"), [(0.0, 0.0), (7.0, 2.0), (-11.0, -3.0), (-14.0, 1.0)])
def test_a_satellite_is_found_from_so_far_off_and_who_it_is(off_az_deg, off_el_deg):
    bench = made()
    az_deg, el_deg = to = slot(-61.5)
    ended = acquire(bench, az_deg + off_az_deg, el_deg + off_el_deg)
    assert ended.is_done, ended.why
    assert ended.phase is TaskPhase.OVER
    assert off_deg(bench, to) < 0.3
    assert separation(ended.found["az_deg"], ended.found["el_deg"], az_deg, el_deg) < 0.25
    assert ended.found[LOCK] is True
    assert ended.found[NETWORK] == "0x1003"
    assert ended.found[SNR] > 3.0
    assert ended.found[TRANSPONDER] == 16.0, "the one that is tuned at power-up is not sent at 18 V"


def test_from_a_sidelobe_it_goes_to_the_main_lobe():
    bench = made()
    az_deg, el_deg = to = slot(-61.5)
    aside_deg = 8.5 / math.cos(math.radians(el_deg))
    ended = acquire(bench, az_deg - aside_deg, el_deg, reach_az_deg=0.0, reach_el_deg=0.0)
    assert ended.found, ended.why
    assert off_deg(bench, to) < 0.3


def test_where_there_is_nothing_it_says_so_and_goes_back():
    bench = made()
    ended = acquire(bench, 60.0, 60.0, reach_az_deg=7.0, reach_el_deg=4.0)
    assert ended.found == {}
    assert ended.why.startswith("No signal stands out within 7° to the sides and 4° up and down.")
    assert (bench.state.position.az_deg, bench.state.position.el_deg) == (
        pytest.approx(60.0, abs=0.1), pytest.approx(60.0, abs=0.1),
    )  # fmt: skip


def test_what_lies_beyond_the_limits_is_left_out():
    bench = made()
    ended = acquire(bench, 40.0, 19.0, reach_az_deg=4.0, reach_el_deg=8.0)
    assert ended.is_done, ended.why
    assert ended.done == ended.of


@pytest.mark.parametrize("values", [
    {"reach_az_deg": 180.0, "width_deg": 0.1}, {"reach_az_deg": 180.0, "reach_el_deg": 45.0, "width_deg": 2.0},
    {"identify": "lock voltage"}, {"identify": 3.0}, {"el_deg": 89.0}, {"reach_el_deg": math.inf},
    {"patterns": (tuple([1.0] * 40),)}, {"patterns": ((),) * 40},
])  # fmt: skip
def test_values_that_make_no_search_are_refused_and_the_station_lives_on(values):
    bench = made()
    with pytest.raises(CommandRefused):
        bench.do(BeginTask("acquire", {"az_deg": 150.0, "el_deg": 40.0, **values}, "you"))
    bench.step(1.0)
    assert not bench.state.tasks
    assert bench.state.link.state is LinkPhase.UP


def test_what_is_warm_and_no_satellite_is_looked_into_once():
    """A wall of warm ground on one side: every direction there stands out, and none has a peak."""
    task = AcquireTask("you", 180.0, 30.0, 6.0, 15.0, 5.0)
    steps = task.steps(0.0, asked=True)
    step, heard = next(steps), []
    with contextlib.suppress(StopIteration):
        while True:
            if isinstance(step, PointAt):
                at = step.az_deg, step.el_deg
                heard.append(at)
            warm = 400.0 + 40.0 * max(0.0, at[0] - 180.0)
            reading = Reading(warm, "counts", 0.0, datetime(2026, 11, 24, tzinfo=UTC))
            step = steps.send(StepResult(0.0, readings={"rssi": reading}, true_az_deg=at[0], true_el_deg=at[1]))
    assert not task.found
    assert heard[-1] == (180.0, 30.0)
    assert len(heard) < 330


def test_the_spiral_covers_its_box_without_a_jump():
    directions = list(AcquireTask("you", 180.0, 30.0, 6.0, 9.0, 9.0)._spiral())
    assert len(directions) == len(set(directions)) == 49
    for one, other in pairwise(directions):
        assert separation(*one, *other) < 6.8, "at most from one ring to the next"
    assert max(separation(180.0, 30.0, *each) for each in directions) == pytest.approx(math.hypot(9.0, 9.0), abs=0.6)
