"""Step-track keeps the dish on a satellite that wanders, and remembers its sidereal day."""

from __future__ import annotations

import math

import pytest
from birdcage.base.geometry import separation
from birdcage.signal.ear import SourceEar
from birdcage.signal.sidereal_memory import (
    SIDEREAL_DAY_S,
    FoundDirection,
    SiderealMemory,
    SiderealOrbit,
)
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.station.requests import BeginTask

from tests.signal.test_peak_by_source import WIDTH_DEG, Planted, run
from tests.station.conftest import Bench

T0_S = 1_763_748_000.0
AZ_DEG, EL_DEG, INCLINATION_DEG = 180.0, 40.0, 4.0


def inclined(time_s):
    """Return where a satellite with an inclination stands: a slim figure of eight about its slot."""
    angle = 2.0 * math.pi * (time_s - T0_S) / SIDEREAL_DAY_S
    return AZ_DEG + 0.3 * math.sin(2.0 * angle), EL_DEG + INCLINATION_DEG * math.sin(angle)


def found_at(time_s, sigma_deg=0.02):
    return FoundDirection(time_s, *inclined(time_s), sigma_deg)


def miss_deg(orbit, time_s):
    there = orbit.at(time_s)
    return separation(there.az_deg, there.el_deg, *inclined(time_s))


def test_a_day_of_peaks_predicts_the_next_within_a_hundredth():
    orbit = SiderealOrbit([found_at(T0_S + 900.0 * index) for index in range(96)])
    for hours in (1, 6, 13, 20):
        time_s = T0_S + SIDEREAL_DAY_S + 3600.0 * hours
        assert miss_deg(orbit, time_s) < 0.01
        assert orbit.at(time_s).sigma_deg < 0.02


def test_a_few_peaks_predict_a_while_and_say_how_long():
    orbit = SiderealOrbit([found_at(T0_S + 600.0 * index) for index in range(6)])
    last_s = T0_S + 3000.0
    assert miss_deg(orbit, last_s + 600.0) < 0.1
    assert orbit.at(last_s + 600.0).sigma_deg < 0.2
    assert orbit.at(last_s + 6.0 * 3600.0).sigma_deg > 1.0, "six hours on it can't be known"


def test_one_peak_tells_where_it_is_and_that_it_may_go():
    orbit = SiderealOrbit([found_at(T0_S)])
    assert miss_deg(orbit, T0_S) < 1e-6
    assert orbit.at(T0_S).sigma_deg < 0.1 < 0.2 < orbit.at(T0_S + 900.0).sigma_deg


def test_the_error_of_a_prediction_is_what_it_says():
    off = []
    for begin_h in range(0, 24, 3):
        begin_s = T0_S + begin_h * 3600.0
        orbit = SiderealOrbit([found_at(begin_s + 900.0 * index) for index in range(8)])
        for ahead_s in (900.0, 1800.0, 3600.0, 7200.0):
            time_s = begin_s + 6300.0 + ahead_s
            off.append(miss_deg(orbit, time_s) / orbit.at(time_s).sigma_deg)
    assert max(off) < 2.5
    assert sum(each < 1.0 for each in off) > 0.6 * len(off)


def test_what_was_found_outlives_the_program_and_the_old_is_forgotten(tmp_path):
    path = tmp_path / "state" / "step-track.jsonl"
    memory = SiderealMemory(path)
    memory.add("TDRS", found_at(T0_S))
    memory.add("TDRS", found_at(T0_S + 900.0))
    memory.add("OTHER", found_at(T0_S + 901.0))
    path.write_text(path.read_text() + '{"name": "TDRS", "utc": "2025-\nno line\n\x00\xff{"name": 3}\n')
    again = SiderealMemory(path)
    known = again.of("TDRS", T0_S + 1000.0)
    assert [each.time_s for each in known] == [T0_S, T0_S + 900.0]
    assert (known[1].az_deg, known[1].el_deg) == inclined(T0_S + 900.0)
    later_s = T0_S + 6 * SIDEREAL_DAY_S
    assert again.of("TDRS", later_s) == []
    again.add("TDRS", found_at(later_s))
    assert path.read_text().count("\n") == 1, "what is too old is left out of the file"


class Wanders(Planted):
    """A source that goes the way of an inclined satellite."""

    def tick(self, bench):
        self.to = inclined(bench.clock.utc().timestamp())
        super().tick(bench)


def follow(memory=None, seconds=0.0, **values):
    source, made = Wanders((AZ_DEG, EL_DEG)), []
    bench = Bench("g2?seed=1", {"tasks": signal_tasks(lambda _source: SourceEar(source, made[0].clock), memory)})
    made.append(bench)
    bench.connect(30.0)
    here = inclined(bench.clock.utc().timestamp())
    asked = {"az_deg": here[0] + 0.8, "el_deg": here[1] - 0.5, "width_deg": WIDTH_DEG, **values}
    bench.do(BeginTask("step-track", asked, "you"))
    offs, end = [], bench.clock.monotonic() + seconds
    while bench.state.tasks and bench.clock.monotonic() < end:
        source.tick(bench)
        resting = bench.state.motion is None and not source.watchers
        bench.step(0.05 if source.watchers else 1.0)
        position = bench.state.position
        if resting and bench.state.motion is None and not source.watchers and len(offs) < 5000:
            offs.append(separation(position.az_deg, position.el_deg, *inclined(bench.clock.utc().timestamp())))
    return bench, source, offs


def test_the_dish_stays_on_it_for_hours():
    bench, _source, offs = follow(seconds=3 * 3600.0, hours=24.0)
    (task,) = bench.state.tasks
    assert task.found["peaks"] >= 8
    settled = offs[len(offs) // 6 :]
    assert max(settled) < 0.1 * WIDTH_DEG
    assert sum(settled) / len(settled) < 0.05 * WIDTH_DEG


def test_what_is_remembered_makes_peaks_rare(tmp_path):
    path = tmp_path / "step-track.jsonl"
    memory = SiderealMemory(path)
    now_s = Bench("g2?seed=1", {}).clock.utc().timestamp()
    for index in range(96):
        memory.add("TDRS", found_at(now_s - SIDEREAL_DAY_S + 900.0 * index - 3600.0))
    bench, _source, offs = follow(path, seconds=3 * 3600.0, name="TDRS", every_s=7200.0)
    (task,) = bench.state.tasks
    assert task.found["peaks"] <= 3
    assert task.found["remembered"] >= 90
    assert max(offs[10:]) < 0.1 * WIDTH_DEG


def test_one_that_falls_silent_is_given_up_and_the_dish_stays_where_it_should_be():
    bench, source, _offs = follow(seconds=1200.0, every_s=60.0)
    source.rise = 0.0
    ended = run(bench, source, seconds=1500.0)
    assert ended.is_done
    assert ended.why.startswith("The satellite was not heard three times in a row.")
    position = bench.state.position
    assert separation(position.az_deg, position.el_deg, *inclined(bench.clock.utc().timestamp())) < 1.0


def test_it_ends_when_its_time_is_over():
    bench, source, _offs = follow(seconds=60.0, hours=0.05)
    ended = run(bench, source, seconds=600.0)
    assert ended.is_done
    assert ended.why.startswith("The time is over.")


def test_a_disk_that_is_full_is_told_and_it_goes_on(tmp_path):
    path = tmp_path / "step-track.jsonl"
    path.mkdir()
    bench, _source, _offs = follow(path, seconds=600.0, name="TDRS")
    (task,) = bench.state.tasks
    assert "step-track.jsonl can't be" in task.found["trouble"]
    assert task.found["peaks"] >= 1


def test_stop_ends_it_and_nothing_moves_after_that():
    bench, _source, _offs = follow(seconds=600.0, every_s=60.0)
    bench.station.stop("you")
    bench.step(3.0)
    at = bench.clock.monotonic()
    bench.step(600.0)
    assert not bench.state.tasks
    assert bench.moves_since(at) == []


def test_a_neighbour_that_appears_is_not_taken_for_it():
    bench, source, _offs = follow(seconds=1200.0, every_s=60.0)
    before = bench.state.tasks[0].found["peaks"]
    there = inclined(bench.clock.utc().timestamp())
    source.tick = lambda bench: Planted.tick(source, bench)
    source.to = there[0] + 3.2, there[1]
    ended = run(bench, source, seconds=1500.0)
    assert ended.why.startswith("The satellite was not heard three times in a row.")
    assert ended.found["peaks"] == before


def test_where_nothing_is_heard_at_first_it_ends_at_once():
    bench, _source, _offs = follow(seconds=600.0, az_deg=90.0)
    assert not bench.state.tasks


@pytest.mark.parametrize("values", [{"every_s": 1.0}, {"hours": 0.0}, {"name": 7}, {"width_deg": math.nan}])
def test_values_that_make_no_sense_are_refused(values):
    from birdcage.base.errors import CommandRefused

    with pytest.raises(CommandRefused):
        follow(**values)
