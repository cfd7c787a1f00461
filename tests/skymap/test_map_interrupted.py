"""A map that is cut short, waits or gives way: what it says then, and that no direction is lost or heard twice."""

from __future__ import annotations

import itertools
import threading
from types import SimpleNamespace

import pytest
from birdcage.base.config import load
from birdcage.base.errors import Held, StoreError
from birdcage.skymap import map_file, map_keeper, map_task
from birdcage.skymap.battery import Battery
from birdcage.skymap.map_file import MapWriter, NewMap, list_maps
from birdcage.skymap.plan import MapFrame, MapOrder, MapPlan
from birdcage.station.not_now import NotNow
from birdcage.station.requests import AcknowledgeFault, AcquireLease, Home, Release, ReleaseLease
from birdcage.station.task_state import TaskPhase
from birdcage.tracking.steps import HearAt

from tests.skymap.made import made_map
from tests.skymap.map_bench import SMALL, made


def test_stop_ends_it_and_it_goes_on_at_the_next_direction(tmp_path):
    bench = made(tmp_path)
    bench.begin()
    bench.run(until=lambda task: task.done == 7)
    bench.station.stop("you")
    bench.step(3.0)
    assert "What was heard of the map is kept." in bench.task.why
    ((_number, kept, ended),) = bench.heard()
    assert (kept, ended) == (bench.task.done, False)
    bench.do(Release("you"))
    bench.begin()
    assert bench.run().is_done
    samples = bench.read().samples
    assert [each.cell for each in samples] == list(SMALL.sequence)
    assert bench.heard() == [(1, 24, True)]


def test_a_program_that_dies_loses_no_direction_and_the_next_one_hears_none_again(tmp_path, monkeypatch):
    writers = []

    def writing(*told):
        writers.append(MapWriter(*told))
        return writers[-1]

    monkeypatch.setattr(map_keeper, "MapWriter", writing)
    bench = made(tmp_path)
    bench.begin()
    bench.run(until=lambda task: task.done == 9)
    writers[0].flush()
    kept = bench.read().samples
    del bench  # as by kill -9: nothing is ended in order
    after = made(tmp_path)
    after.begin()
    assert after.run().is_done
    assert len([line for line in after.lines() if line.startswith("rssi")]) == 24 - len(kept)
    samples = after.read().samples
    assert samples[: len(kept)] == kept
    assert sorted(each.cell for each in samples) == list(range(24))


def test_a_program_that_dies_after_the_last_direction_leaves_nothing_but_the_end(tmp_path):
    path = tmp_path / "signal.sqlite"
    writer = MapWriter(path, NewMap("k1", SMALL, "tuner", "counts", decibels=False, demo=True, about={}))
    for each in made_map(SMALL, lambda az, el: az).samples:
        writer.add(each, {})
    writer.close()
    bench = made(tmp_path)
    at = bench.clock.monotonic()
    bench.begin()
    assert bench.run().is_done
    assert bench.moves_since(at) == []
    assert bench.heard() == [(1, 24, True)]


def test_an_unplugged_cable_interrupts_it_and_release_lets_it_go_on(tmp_path):
    bench = made(tmp_path)
    bench.begin()
    bench.run(until=lambda task: task.done == 7)
    bench.device.unplug()
    bench.step(5.0)
    assert bench.task.phase is TaskPhase.INTERRUPTED
    done = bench.task.done
    bench.device.plug()
    bench.step(20.0)
    assert bench.state.held is not None
    assert bench.task.done == done
    bench.do(Release("you"))
    assert bench.run().is_done
    assert [each.cell for each in bench.read().samples] == list(SMALL.sequence)


def test_a_map_waits_for_its_time_and_counts_down_before_the_dish_moves(tmp_path):
    bench = made(tmp_path)
    begins_s = bench.clock.utc().timestamp() + 600.0
    bench.begin(start_s=begins_s, until_s=begins_s + 6.0)
    bench.step(590.0)
    at = bench.clock.monotonic()
    assert bench.task.phase is TaskPhase.WAITING
    assert bench.task.why.startswith("The map begins at ")
    bench.step(7.0)
    assert bench.task.phase is TaskPhase.COUNTDOWN
    assert bench.moves_since(at) == []
    assert bench.task.found["until_s"] == begins_s + 6.0
    bench.run()
    assert 3 < bench.task.done < 24
    assert "directions are heard. Resume it" in bench.task.why
    assert bench.heard() == [(1, bench.task.done, False)]


def test_the_console_is_kept_awake_in_pauses_and_left_alone_afterwards(tmp_path):
    bench = made(tmp_path)
    bench.begin(start_s=bench.clock.utc().timestamp() + 900.0)
    bench.step(5.0)
    heard = [at for at, _line in bench.received()]
    bench.step(800.0)
    heard += [at for at, line in bench.received() if line == "a" and at > heard[-1]]
    assert max(later - one for one, later in itertools.pairwise(heard[-500:])) < 60.0
    bench.run()
    bench.step(2.0)
    at = bench.clock.monotonic()
    bench.step(120.0)
    assert [line for when, line in bench.received() if when > at] == []


def test_a_low_battery_parks_the_dish_and_ends_the_map(tmp_path):
    left = [80.0]
    file = tmp_path / "birdcage.toml"
    file.write_text("[tracking]\npark_az_deg = 120.0\npark_el_deg = 30.0\n")
    bench = made(tmp_path, battery=lambda: Battery(left[0], on_mains=False), settings=load(file, environ={}))
    bench.begin(MapPlan(170.0, 190.0, 35.0, 45.0, 1.0))
    bench.run(until=lambda task: task.done == 5)
    left[0] = 9.0
    ended = bench.run()
    assert ended.why.startswith("The battery of this computer is at 9 %: the dish is parked")
    assert not ended.is_done
    assert bench.state.position.az_deg == pytest.approx(120.0, abs=0.1)
    assert bench.heard()[0][1] == ended.done


def test_a_map_around_a_target_ends_where_its_way_was_computed_to(tmp_path):
    bench = made(tmp_path)
    now_s = bench.clock.utc().timestamp()
    plan = MapPlan(-3.0, 3.0, -3.0, 3.0, 1.0, frame=MapFrame.TARGET)
    bench.begin(plan, path=((now_s, 170.0, 40.0), (now_s + 8.0, 170.2, 40.0)), target="mover")
    assert bench.task.found["until_s"] == now_s + 8.0
    ended = bench.run()
    assert 3 < ended.done < 49
    assert ended.why.startswith(
        f"The way of the target was computed up to here. {ended.done} of 49 directions are heard."
    )
    assert bench.heard() == [(1, ended.done, False)]


def test_what_a_moving_target_has_out_of_reach_now_is_left_for_later(tmp_path):
    bench = made(tmp_path)
    now_s = bench.clock.utc().timestamp()
    plan = MapPlan(0.0, 0.0, -2.0, 2.0, 1.0, MapOrder.COLUMNS, MapFrame.TARGET)
    bench.begin(plan, path=((now_s, 170.0, 18.5), (now_s + 3600.0, 171.0, 18.6)), target="mover")
    ended = bench.run()
    assert ended.why.startswith("3 of 5 directions are heard. 2 more are out of reach. Resume it")
    assert bench.heard() == [(1, 3, False)]
    now_s = bench.clock.utc().timestamp()
    bench.begin(plan, path=((now_s, 175.0, 30.0), (now_s + 3600.0, 176.0, 30.0)), target="mover")
    assert bench.run().why == "The map is complete: 5 directions."


def test_a_direction_in_which_nothing_could_be_read_is_left_for_later(tmp_path, monkeypatch):
    bench = made(tmp_path)
    told = HearAt
    asked = []

    def without_level(az_deg, el_deg, **more):
        asked.append(az_deg)
        return told(az_deg, el_deg, **{**more, "ids": () if len(asked) == 4 else more["ids"]})

    monkeypatch.setattr(map_task, "HearAt", without_level)
    bench.begin()
    ended = bench.run()
    assert ended.why.startswith("23 of 24 directions are heard. 1 could not be read. Resume it")
    assert bench.heard() == [(1, 23, False)]
    bench.begin()
    assert bench.run().is_done
    assert bench.heard() == [(1, 24, True)]


def test_a_cross_that_was_cut_short_and_those_of_the_next_program_have_numbers_of_their_own(tmp_path):
    bench = made(tmp_path)
    reference = {"reference": (176.0, 43.0), "reference_every_s": 3600.0}
    bench.begin(**reference)
    bench.step(4.0)
    bench.station.stop("you")
    bench.run()
    bench.do(Release("you"))
    bench.begin(**reference)
    assert bench.run().is_done
    numbers = [each.cross_number for each in bench.read().crosses]
    assert numbers == sorted(numbers)
    assert set(numbers) == {0, 1, 2}
    assert 0 < numbers.count(0) < 10
    assert (numbers.count(1), numbers.count(2)) == (10, 10)


def test_a_park_position_out_of_reach_is_said(tmp_path):
    file = tmp_path / "birdcage.toml"
    file.write_text("[tracking]\npark_az_deg = 120.0\npark_el_deg = 5.0\n")
    bench = made(tmp_path, battery=lambda: Battery(9.0, on_mains=False), settings=load(file, environ={}))
    bench.begin()
    assert "the park position is out of reach, so the dish stays here" in bench.run().why


def test_a_map_that_is_refused_leaves_no_thread_and_no_file(tmp_path):
    bench = made(tmp_path)
    bench.station.stop("you")
    bench.step(1.0)
    before = threading.active_count()
    with pytest.raises(Held):
        bench.begin()
    bench.step(1.0)
    assert threading.active_count() == before
    assert list_maps(bench.path) == []


def test_after_a_reboot_of_the_dish_it_waits_until_it_is_homed_and_repeats_its_reference(tmp_path):
    bench = made(tmp_path)
    bench.begin(reference=(176.0, 43.0), reference_every_s=3600.0)
    bench.run(until=lambda task: task.done == 7)
    bench.device.reboot()
    bench.step(60.0)
    assert bench.task.phase is TaskPhase.INTERRUPTED
    assert "Home it. The map then repeats its reference, and goes on." in bench.task.why
    done, at = bench.task.done, bench.clock.monotonic()
    bench.step(60.0)
    assert bench.moves_since(at) == []
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    bench.do(Home("you"), 120.0)
    assert bench.run().is_done
    read = bench.read()
    assert [each.cell for each in read.samples] == list(SMALL.sequence)
    again = [each.utc for each in read.crosses if each.cross_number == 1]
    assert read.samples[done - 1].utc < min(again) < max(again) < read.samples[done].utc


def test_an_unattended_dish_is_homed_by_itself_after_a_reboot_and_the_map_goes_on(tmp_path):
    bench = made(tmp_path, station={"home_after_reboot": True})
    bench.begin(reference=(176.0, 43.0), reference_every_s=3600.0)
    bench.run(until=lambda task: task.done == 7)
    bench.device.reboot()
    ended = bench.run()
    assert ended.is_done, ended.why
    assert [each.cell for each in bench.read().samples] == list(SMALL.sequence)
    assert {each.cross_number for each in bench.read().crosses} >= {0, 1}


def test_a_full_disk_ends_it_and_says_what_to_do(tmp_path, monkeypatch):
    bench = made(tmp_path)
    bench.begin()
    bench.run(until=lambda task: task.done == 5)

    def full(path, migrations):
        raise StoreError(f"{path} cannot be used: database or disk is full")

    monkeypatch.setattr(map_file, "open_database", full)
    ended = bench.run()
    assert not ended.is_done
    assert "disk is full" in ended.why
    assert "resume the map" in ended.why
    monkeypatch.undo()
    bench.begin()
    assert bench.run().is_done
    assert [each.cell for each in bench.read().samples] == list(SMALL.sequence)


def test_not_now_of_the_owner_leaves_the_dish_alone_until_it_is_over(tmp_path):
    said = {"status": 0}
    answer = SimpleNamespace(over=True, first_line="wind")

    def ask(_command):
        answer.status = said["status"]
        return answer

    bench = made(tmp_path, station={"not_now": NotNow("asks", every_s=2.0, ask=ask)})
    bench.begin()
    bench.run(until=lambda task: task.done == 5)
    said["status"] = 1
    bench.step(8.0)
    done, at = bench.task.done, bench.clock.monotonic()
    bench.step(20.0)
    assert (bench.task.done, bench.moves_since(at)) == (done, [])
    assert bench.task.why == "Not now: wind."
    said["status"] = 0
    assert bench.run().is_done
    assert [each.cell for each in bench.read().samples] == list(SMALL.sequence)


def test_whoever_takes_control_gets_the_dish_and_the_map_goes_on_afterwards(tmp_path):
    bench = made(tmp_path)
    bench.begin()
    bench.run(until=lambda task: task.done == 5)
    bench.do(AcquireLease("rotctld", take_over=True))
    bench.step(5.0)
    assert bench.task.phase is TaskPhase.YIELDED
    bench.do(ReleaseLease("rotctld"))
    bench.step(2.0)
    assert bench.task.phase is TaskPhase.COUNTDOWN
    assert bench.run().is_done
