"""A cut along an axis, over the wire: what was heard where, the beam fitted to it, and how it can end."""

from __future__ import annotations

import itertools
import math

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.station.events import TaskChanged
from birdcage.station.requests import BeginTask
from birdcage.station.state import LinkPhase

from tests.signal.test_peak_task import ALONE, made, off_deg, slot


def sweep(bench, axis, az_deg, el_deg, **values):
    wanted = {"axis": axis, "az_deg": az_deg, "el_deg": el_deg, "span_deg": 16.0, "step_deg": 1.0, "width_deg": 6.0}
    bench.do(BeginTask("sweep", {**wanted, **values}, "you"))
    end = bench.clock.monotonic() + 600.0
    while bench.state.tasks and bench.clock.monotonic() < end:
        bench.step(0.5)
    return [event.task for event in bench.events if isinstance(event, TaskChanged)][-1]


@pytest.mark.parametrize(("axis", "off"), [("az", (1.7, 0.0)), ("el", (0.0, -1.3))])
def test_the_middle_is_found_on_the_line_and_gone_to(axis, off):
    bench = made()
    az_deg, el_deg = to = slot(bench, ALONE)
    ended = sweep(bench, axis, az_deg + off[0], el_deg + off[1], go=True)
    assert (ended.is_done, ended.done, ended.of) == (True, 17, 17), ended.why
    assert off_deg(bench, to) < 0.2
    line = ended.found["line"]
    assert len(line) == 17
    assert max(line, key=lambda row: row[2])[0] == pytest.approx(az_deg, abs=1.0)
    assert ended.found["rise"] == pytest.approx(143.0, abs=12.0)
    assert ended.why.startswith(f"Peak at {'azimuth' if axis == 'az' else 'elevation'} ")


def test_without_go_the_dish_ends_where_it_began():
    bench = made()
    az_deg, el_deg = slot(bench, ALONE)
    sweep(bench, "az", az_deg + 2.0, el_deg)
    assert bench.state.position.az_deg == pytest.approx(az_deg + 2.0, abs=0.1)
    assert bench.state.holder is None


def test_it_goes_one_way_and_each_direction_is_told_when_it_is_heard():
    bench = made()
    az_deg, el_deg = slot(bench, ALONE)
    sweep(bench, "az", az_deg, el_deg)
    told = [event.task.found.get("line", ()) for event in bench.events if isinstance(event, TaskChanged)]
    assert [len(line) for line in told] == sorted(len(line) for line in told)
    azimuths = [row[0] for row in told[-1]]
    assert all(one < other for one, other in itertools.pairwise(azimuths))
    assert {round(row[1], 0) for row in told[-1]} == {round(el_deg, 0)}


def test_what_lies_beyond_the_limits_is_left_out_and_nothing_else():
    bench = made()
    ended = sweep(bench, "el", 60.0, 22.0, span_deg=12.0)
    assert ended.is_done, ended.why
    assert [round(row[1]) for row in ended.found["line"]] == list(range(18, 29))
    assert ended.why == "No source stands out of the floor on this line."


def test_stop_ends_it_and_what_was_heard_is_kept():
    bench = made()
    bench.do(
        BeginTask("sweep", {"axis": "az", "az_deg": 150.0, "el_deg": 40.0, "span_deg": 20.0, "step_deg": 1.0}, "you")
    )
    bench.step(8.0)
    bench.station.stop("you")
    bench.step(3.0)
    at = bench.clock.monotonic()
    bench.step(15.0)
    ended = [event.task for event in bench.events if isinstance(event, TaskChanged)][-1]
    assert bench.moves_since(at) == []
    assert "The sweep is not complete." in ended.why
    assert len(ended.found["line"]) >= 2


@pytest.mark.parametrize("values", [
    {"axis": "skew"}, {"axis": 1.0}, {"span_deg": 0.0}, {"span_deg": math.nan}, {"step_deg": 0.0},
    {"span_deg": 360.0, "step_deg": 0.05}, {"el_deg": 90.0}, {"patterns": ((1.0,),)}, {"patterns": "x"},
])  # fmt: skip
def test_values_that_make_no_line_are_refused_and_the_station_lives_on(values):
    bench = made()
    wanted = {"axis": "az", "az_deg": 150.0, "el_deg": 40.0, "span_deg": 10.0, "step_deg": 1.0, **values}
    with pytest.raises(CommandRefused):
        bench.do(BeginTask("sweep", wanted, "you"))
    bench.step(1.0)
    assert not bench.state.tasks
    assert bench.state.link.state is LinkPhase.UP
