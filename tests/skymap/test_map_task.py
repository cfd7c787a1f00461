"""A map over the wire: where the dish goes, what is kept of it, and how it can end and go on."""

from __future__ import annotations

import math
from statistics import fmean

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import shortest_turn
from birdcage.skymap.map_file import list_maps
from birdcage.skymap.map_request import MapRequest
from birdcage.skymap.plan import MapFrame, MapOrder, MapPlan
from birdcage.station.requests import BeginTask

from tests.skymap.map_bench import SMALL, made


def test_every_direction_is_heard_once_where_the_dish_rests(tmp_path):
    bench = made(tmp_path)
    bench.begin()
    ended = bench.run()
    assert (ended.is_done, ended.done, ended.of) == (True, 24, 24), ended.why
    assert ended.why == "The map is complete: 24 directions."
    read = bench.read()
    assert [each.cell for each in read.samples] == list(SMALL.sequence)
    assert read.is_complete
    assert read.ended is not None
    for each in read.samples:
        x, y = SMALL.at(each.cell)
        assert (each.az_deg, each.el_deg) == (pytest.approx(x, abs=0.08), pytest.approx(y, abs=0.08))
    assert {each.n for each in read.samples} == {10}
    assert read.about["dish"] == "Carryout G2"
    assert read.settings[0]["transponder"]
    assert bench.state.holder is None


SLOW_LINE = "latency_min=0.02&latency_max=0.1"
ONE = ["", "q", "dvb", "rssi 10", "", "q", "mot", "a"]
"""What follows a move: to the tuner and back, and the look that shows where the dish rests."""


def test_a_direction_costs_nine_lines_and_the_dish_is_seen_there_before_it_goes_on(tmp_path):
    bench = made(tmp_path, f"g2?seed=1&{SLOW_LINE}")
    bench.begin(MapPlan(170.0, 197.4, 40.0, 40.0, 1.37, MapOrder.ROWS))
    bench.run(until=lambda task: task.done == 1)
    bench.run(until=lambda task: task.done == 20)
    text = "\n".join(bench.lines())
    moves = [part.splitlines()[1:] for part in text.split("\na 0 ")[1:]]
    assert len(moves) >= 19
    assert [each for each in moves[2:18] if each != ONE] == []


def test_the_tuner_is_not_read_before_the_dish_must_rest(tmp_path):
    bench = made(tmp_path, "g2?seed=1&latency_min=0.001&latency_max=0.002")
    bench.begin(MapPlan(170.0, 197.4, 40.0, 40.0, 1.37, MapOrder.ROWS))
    bench.run(until=lambda task: task.done == 15)
    told = bench.received()
    gaps = [
        next(at for at, line in told[index:] if line.startswith("rssi")) - begun
        for index, (begun, line) in enumerate(told)
        if line.startswith("a 0 ") and index > 60
    ]
    assert len(gaps) > 5
    lasts_s = 2.0 * math.sqrt(1.37 / bench.state.dish.azimuth.acceleration_deg_s2)
    assert min(gaps) > lasts_s - 0.003  # the way to the menu may be quicker than it was of late


def test_what_is_heard_of_a_dish_that_comes_later_than_it_must_is_heard_again_at_rest(tmp_path):
    bench = made(tmp_path)
    bench.sim.dish.axes[0].data.max_rate_deg_s = 2.0  # it has told 65, and does not keep to that
    bench.begin(MapPlan(170.0, 174.1, 40.0, 40.0, 1.01, MapOrder.ROWS))
    assert bench.run(120.0).is_done
    samples = bench.read().samples
    assert [each.az_deg for each in samples] == pytest.approx([170.0, 171.01, 172.02, 173.03, 174.04], abs=0.08)
    told = bench.received()
    moves = [(at, float(line[4:])) for at, line in told if line.startswith("a 0 ")]
    reads = [at for at, line in told if line.startswith("rssi")]
    assert len(reads) == 2 * 4 + 1
    offset_s = bench.clock.utc().timestamp() - bench.clock.monotonic()
    for each in samples[1:]:
        (sent,) = [at for at, deg in moves if abs(deg - each.az_deg) < 0.1]
        assert each.utc.timestamp() - offset_s > sent + 1.01 / 2.0


@pytest.mark.parametrize("speed", [0.4, 65.0])
def test_the_tuner_is_read_at_rest_only(tmp_path, speed):
    bench = made(tmp_path, f"g2?seed=1&az_speed={speed}")
    write, moving = bench.sim.write, []

    def writing(data):
        if data.startswith(b"rssi"):
            moving.append(bench.device.truth().moving)
        write(data)

    bench.sim.write = writing
    bench.begin(MapPlan(170.0, 176.0, 40.0, 40.0, 1.37, MapOrder.ROWS))
    bench.run()
    assert moving == [False] * 5


@pytest.mark.parametrize("at", ["dvb", "rssi 10", "q"])
def test_stop_on_the_way_to_the_tuner_stops_the_dish(tmp_path, at):
    bench = made(tmp_path, f"g2?seed=1&{SLOW_LINE}")
    bench.begin(MapPlan(120.0, 240.0, 40.0, 40.0, 8.0, MapOrder.ROWS))
    bench.run(until=lambda task: task.done == 3)
    write, stopped = bench.sim.write, []

    def writing(data):
        write(data)
        if data == f"{at}\r".encode() and not stopped and bench.state.motion is not None:
            stopped.append(bench.clock.monotonic())
            bench.station.stop("you")

    bench.sim.write = writing
    bench.run()
    bench.step(3.0)
    assert stopped
    assert bench.state.held is not None
    assert bench.state.last_stop.confirmed is True
    to = {line for line in bench.moves_since(stopped[0]) if line.startswith("a 0")}
    before = [line for when, line in bench.received() if line.startswith("a 0") and when < stopped[0]][-1]
    assert all(abs(float(line[4:]) - float(before[4:])) < 8.0 for line in to), "no new direction"
    assert bench.heard()[0][1] == bench.task.done


def test_what_is_beyond_the_limits_is_left_out_and_told(tmp_path):
    bench = made(tmp_path)
    bench.begin(MapPlan(180.0, 182.0, 16.0, 19.0, 1.0))
    ended = bench.run()
    assert ended.why == "The map is complete: 6 directions. 6 more are out of reach."
    assert {each.el_deg > 17.9 for each in bench.read().samples} == {True}
    assert bench.heard() == [(1, 6, True)]


def test_a_reference_cross_comes_first_every_so_often_and_last(tmp_path):
    bench = made(tmp_path)
    bench.begin(reference=(176.0, 43.0), reference_every_s=8.0)
    ended = bench.run()
    assert ended.is_done, ended.why
    crosses = bench.read().crosses
    numbers = sorted({each.cross_number for each in crosses})
    assert numbers == list(range(len(numbers)))
    assert len(numbers) >= 3
    assert len(crosses) == 10 * len(numbers)
    assert crosses[0].utc < bench.read().samples[0].utc
    assert crosses[-1].utc > bench.read().samples[-1].utc
    assert len(bench.read().samples) == 24


def test_a_map_around_a_moving_target_stays_with_it(tmp_path):
    bench = made(tmp_path)
    now_s = bench.clock.utc().timestamp()
    path = ((now_s, 170.0, 30.0), (now_s + 1000.0, 190.0, 50.0))
    plan = MapPlan(-1.0, 1.0, -1.0, 1.0, 1.0, MapOrder.SPIRAL, MapFrame.TARGET)
    bench.begin(plan, path=path, target="mover")
    assert bench.run().is_done
    read = bench.read()

    for each in read.samples:
        x, y = plan.at(each.cell)
        right = shortest_turn(each.aim_az_deg, each.az_deg) * math.cos(math.radians(each.el_deg))
        assert (right, each.el_deg - each.aim_el_deg) == (pytest.approx(x, abs=0.1), pytest.approx(y, abs=0.1))
    assert read.about["target"] == "mover"


def test_the_scatter_is_that_of_one_of_the_readings_that_are_counted(tmp_path):
    bench = made(tmp_path)
    bench.begin(MapPlan(178.0, 183.0, 40.0, 40.0, 1.0), reads=8)
    bench.run()
    samples = bench.read().samples
    assert {each.n for each in samples} == {80}
    noise = fmean(each.scatter for each in samples)
    assert noise > 1.0  # ten are averaged by the firmware: between such means it is a third of that


def test_a_quiet_dish_turns_slower_and_gets_its_speed_back(tmp_path):
    bench = made(tmp_path)
    bench.begin(quiet=True)
    bench.run(until=lambda task: task.done == 3)
    slower = dict(bench.state.speeds_lent)
    assert slower
    bench.run()
    bench.step(3.0)
    assert bench.state.speeds_lent == {}
    assert [line for line in bench.lines() if line.startswith("mv ")]


def test_a_map_over_north_goes_on_there(tmp_path):
    bench = made(tmp_path)
    bench.begin(MapPlan(358.0, 362.0, 40.0, 40.0, 1.0, MapOrder.ROWS))
    assert bench.run().is_done
    assert [round(each.az_deg) % 360 for each in bench.read().samples] == [358, 359, 0, 1, 2]


def test_snr_and_lock_are_read_where_that_is_asked_for(tmp_path):
    bench = made(tmp_path)
    bench.begin(MapPlan(178.0, 179.0, 40.0, 40.0, 1.0), details=True)
    bench.run()
    assert all(each.snr_db is not None and each.lock is not None for each in bench.read().samples)


@pytest.mark.parametrize(("values", "words"), [
    ({"step_deg": 0.0}, "step is 0"), ({"key": ""}, "key is empty"), ({"order": "zigzag"}, "zigzag"),
    ({"source": "sdr"}, "no signal source called sdr"), ({"reads": -1}, "reads is -1"),
    ({"frame": "target"}, "needs a path"), ({"x_high_deg": math.inf}, "has no ends"), ({"spin": 1.0}, "no spin"),
    ({"path": ((0.0, 1.0),), "frame": "target"}, "a row of the path"), ({"until_s": math.nan}, "until_s is nan"),
])  # fmt: skip
def test_values_that_make_no_map_are_refused_and_nothing_moves(tmp_path, values, words):
    bench = made(tmp_path)
    at = bench.clock.monotonic()
    with pytest.raises(CommandRefused, match=words):
        bench.do(BeginTask("map", {**MapRequest(SMALL, "k1").values(), **values}, "you"))
    bench.step(3.0)
    assert bench.moves_since(at) == []
    assert list_maps(bench.path) == []
