"""A satellite is found near where it should be, by its signal, over the wire."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from birdcage.base.geometry import separation
from birdcage.rotator.feature import LOCK, NETWORK, SNR, TRANSPONDER
from birdcage.signal.acquire_task import AcquireTask
from birdcage.sim.almanac import geostationary
from birdcage.sim.settings import SimSettings
from birdcage.station.events import TaskChanged
from birdcage.station.requests import BeginTask
from birdcage.station.task_state import TaskPhase

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


def test_the_spiral_covers_its_box_without_a_jump():
    directions = list(AcquireTask("you", 180.0, 30.0, 6.0, 9.0, 9.0)._spiral())
    assert len(directions) == len(set(directions)) == 49
    for one, other in pairwise(directions):
        assert separation(*one, *other) < 6.8, "at most from one ring to the next"
    assert max(separation(180.0, 30.0, *each) for each in directions) == pytest.approx(math.hypot(9.0, 9.0), abs=0.6)
