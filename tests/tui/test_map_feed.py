"""A map in the app: what the station tells at once, the rest from the file, never waiting for the disk."""

from __future__ import annotations

import json
from dataclasses import replace

import map_stand_in
import numpy as np
import pytest
from birdcage.base.clock import VirtualClock
from birdcage.station.control_messages import as_line
from birdcage.station.events import TaskChanged
from birdcage.station.json_form import event_from_json, to_json
from birdcage.station.task_state import TaskPhase
from birdcage_tui.feeds.map_feed import AGAIN_S, DETAILS_S, MapFeed
from stand_in import Station, at_rest

KEY = map_stand_in.KEY


class House:
    """A feed whose work beside is done when the test says so."""

    def __init__(self, path, *tasks):
        self.clock = VirtualClock()
        self.station = Station(replace(at_rest(self.clock), tasks=tasks))
        self.waiting, self.changes = [], 0
        self.feed = MapFeed(
            self.station, self.clock, lambda work: work(), self._changed, path, beside=self.waiting.append
        )
        self.feed.begin()

    def _changed(self):
        self.changes += 1

    def tell(self, task, after_s=1.0):
        self.clock.advance(after_s)
        self.feed._on_event(TaskChanged(self.clock.monotonic(), self.clock.utc(), task))

    def work(self):
        while self.waiting:
            self.waiting.pop(0)()

    @property
    def shown(self):
        return self.feed.book.shown


def heard(count):
    return map_stand_in.made(heard=count)


def test_a_map_that_is_half_done_is_whole_after_attaching(tmp_path):
    sky = heard(300)
    house = House(map_stand_in.keep(tmp_path / "signal.sqlite", sky), map_stand_in.task(sky))
    assert house.shown is None, "the disk is not waited for"
    house.work()
    assert house.shown.heard == 300
    assert house.changes == 1
    assert house.shown.value(sky.samples[7].cell) == sky.samples[7].value
    assert house.shown.samples[sky.samples[7].cell].scatter == 0.7
    assert house.shown.next_cell == sky.plan.sequence[300]


def test_what_the_station_tells_is_drawn_before_the_file_is_read(tmp_path):
    house = House(map_stand_in.keep(tmp_path / "signal.sqlite", heard(100)), map_stand_in.task(heard(100)))
    house.work()
    before = house.shown
    house.tell(map_stand_in.task(heard(103)))
    assert house.waiting == [], "nothing is missing"
    assert house.shown.heard == 103
    newest = heard(103).samples[-1]
    assert house.shown.value(newest.cell) == newest.value
    assert before.value(newest.cell) is None, "a map that is shown is never changed"
    assert house.shown.loudest == int(np.nanargmax(house.shown.grid))


def test_what_was_missed_comes_from_the_file_and_not_more_often_than_that(tmp_path):
    path = map_stand_in.keep(tmp_path / "signal.sqlite", heard(100))
    house = House(path, map_stand_in.task(heard(100)))
    house.work()
    map_stand_in.keep(path, heard(400))
    house.tell(map_stand_in.task(heard(400), newest=5), after_s=AGAIN_S)
    assert house.shown.heard == 105
    assert len(house.waiting) == 1
    house.work()
    assert house.shown.heard == 400
    house.tell(map_stand_in.task(heard(500), newest=5), after_s=1.0)
    assert house.waiting == []
    house.tell(map_stand_in.task(heard(500), newest=5), after_s=AGAIN_S)
    assert len(house.waiting) == 1


def test_time_and_scatter_of_the_newest_come_from_the_file_once_a_minute(tmp_path):
    path = map_stand_in.keep(tmp_path / "signal.sqlite", heard(100))
    house = House(path, map_stand_in.task(heard(100)))
    house.work()
    map_stand_in.keep(path, heard(110))
    house.tell(map_stand_in.task(heard(110)), after_s=AGAIN_S)
    assert house.waiting == []
    newest = heard(110).samples[-1].cell
    assert newest not in house.shown.samples
    house.tell(map_stand_in.task(heard(110)), after_s=DETAILS_S)
    house.work()
    assert house.shown.samples[newest].n == 10


def test_its_end_is_told_and_read_at_once(tmp_path):
    sky = heard(50)
    house = House(map_stand_in.keep(tmp_path / "signal.sqlite", sky), map_stand_in.task(sky))
    house.work()
    house.tell(map_stand_in.task(sky, phase=TaskPhase.OVER, why="STOP by you."), after_s=0.1)
    assert house.feed.ended_words == "STOP by you."
    assert len(house.waiting) == 1
    house.tell(map_stand_in.task(sky, number=2))
    assert house.feed.ended_words is None, "it goes on"


def test_a_map_begins_before_its_first_direction_is_on_the_disk(tmp_path):
    path = tmp_path / "signal.sqlite"
    none = map_stand_in.task(heard(1), newest=0, done=0)
    house = House(path, none)
    house.work()
    assert house.shown is None
    assert house.feed.book.begun == 1
    map_stand_in.keep(path, heard(1))
    house.tell(map_stand_in.task(heard(1)))
    house.work()
    assert house.shown.heard == 1
    assert house.feed.book.begun == 1


def test_a_map_that_a_person_has_opened_stays_until_another_one_begins(tmp_path):
    path = map_stand_in.keep(tmp_path / "signal.sqlite", heard(100))
    map_stand_in.keep(path, heard(7), key="older")
    house = House(path, map_stand_in.task(heard(100)))
    house.work()
    house.feed.open("older")
    house.work()
    assert house.shown.heard == 7
    house.tell(map_stand_in.task(heard(101)), after_s=DETAILS_S)
    assert house.waiting == [], "the file is not read for what is not shown"
    assert house.shown.key == "older"
    house.tell(map_stand_in.task(heard(101), number=2), after_s=AGAIN_S)
    house.work()
    assert house.shown.key == KEY


def test_the_maps_that_are_kept_are_listed_newest_first(tmp_path):
    path = map_stand_in.keep(tmp_path / "signal.sqlite", heard(100))
    map_stand_in.keep(path, heard(7), key="second")
    found = []
    house = House(path)
    house.feed.list(found.append)
    assert found == []
    house.work()
    assert [(each.key, each.heard) for each in found[0]] == [("second", 7), (KEY, 100)]


@pytest.mark.parametrize("words", ["damaged", ""])
def test_a_file_that_cannot_be_read_says_why(tmp_path, words):
    path = tmp_path / "signal.sqlite"
    path.write_bytes(b"no database at all" * 100)
    found = []
    house = House(path)
    house.feed.list(found.append)
    house.work()
    assert isinstance(found[0], str)
    assert str(path) in found[0] or "signal.sqlite" in found[0]


def test_other_tasks_are_none_of_it(tmp_path):
    house = House(tmp_path / "signal.sqlite")
    house.tell(replace(map_stand_in.task(heard(3)), kind="sweep"))
    assert house.waiting == []
    assert house.shown is None


def test_a_map_of_another_program_is_drawn_as_it_tells(tmp_path):
    sky = heard(100)
    house = House(map_stand_in.keep(tmp_path / "signal.sqlite", sky), map_stand_in.task(sky))
    house.work()
    told = TaskChanged(house.clock.monotonic(), house.clock.utc(), map_stand_in.task(heard(103)))
    house.feed._on_event(event_from_json(json.loads(as_line(to_json(told)))))
    assert house.shown.heard == 103


def test_a_file_that_cannot_be_read_is_a_problem_until_it_can_and_reading_goes_on(tmp_path, monkeypatch):
    path = map_stand_in.keep(tmp_path / "signal.sqlite", heard(100))
    house = House(path, map_stand_in.task(heard(100)))

    def gone(*_args):
        raise OSError("the stick was pulled")

    with monkeypatch.context() as broken:
        broken.setattr("birdcage_tui.feeds.map_feed.read_map", gone)
        house.work()
    assert "the stick was pulled" in house.feed.problem
    assert house.shown is None
    house.tell(map_stand_in.task(heard(100)), after_s=AGAIN_S)
    house.work()
    assert house.feed.problem == ""
    assert house.shown.heard == 100


def test_the_next_direction_is_the_one_that_the_task_tells_and_not_one_out_of_reach(tmp_path):
    sky = heard(300)
    house = House(map_stand_in.keep(tmp_path / "signal.sqlite", sky), map_stand_in.task(sky))
    house.work()
    further = sky.plan.sequence[700]
    house.tell(map_stand_in.task(sky, next=float(further)))
    assert house.shown.next_cell == further


def test_without_that_word_the_next_direction_comes_after_the_newest(tmp_path):
    sky = heard(300)
    left_out = replace(sky, samples=sky.samples[:200] + sky.samples[210:])
    house = House(map_stand_in.keep(tmp_path / "signal.sqlite", left_out), map_stand_in.task(left_out))
    house.work()
    assert house.shown.next_cell == sky.plan.sequence[300]
