"""Maps on the disk: each direction once, whole after a crash, and never lost without a word."""

import sqlite3
from dataclasses import replace

import pytest
from birdcage.base.errors import StoreError
from birdcage.base.store import open_database
from birdcage.skymap import map_file
from birdcage.skymap.map_file import MapWriter, NewMap, find_map, heard_so_far, list_maps, read_map
from birdcage.skymap.plan import MapPlan

from tests.skymap.made import made_map, sample

PLAN = MapPlan(160.0, 162.0, 25.0, 26.0, 1.0)
NEW = NewMap("k1", PLAN, "tuner", "counts", decibels=False, demo=True, about={"dish": "Carryout G2"})
SET = {"transponder": "1", "lnb": "18 V"}


def write(path, samples, new=NEW, told=SET, *, ends=False):
    writer = MapWriter(path, new)
    for each in samples:
        writer.add(each, told)
    if ends:
        writer.end(samples[-1].utc)
    writer.close()
    return writer


def test_what_was_written_is_read_back_whole(tmp_path):
    path = tmp_path / "signal.sqlite"
    wanted = made_map(PLAN, lambda az, el: az + el)
    cross = sample(None, 170.0, 40.0, 500.0, cross_number=0, lock=True, snr_db=9.5, polarisation="H")
    writer = write(path, [cross, *wanted.samples], ends=True)
    assert (writer.problem, writer.kept, writer.number) == ("", 6, 1)
    read = read_map(path, 1)
    assert read.samples == wanted.samples
    assert read.crosses == (cross,)
    assert read.settings == (SET,)
    assert (read.plan, read.about, read.demo, read.is_complete) == (PLAN, {"dish": "Carryout G2"}, True, True)
    assert read.ended == wanted.samples[-1].utc
    assert read.grid().tolist() == [[185.0, 186.0, 187.0], [186.0, 187.0, 188.0]]


def test_a_map_that_is_resumed_keeps_each_direction_once_and_its_first_value(tmp_path):
    path = tmp_path / "signal.sqlite"
    samples = made_map(PLAN, lambda az, el: az).samples
    write(path, samples[:3])
    assert find_map(path, "k1").ended is None
    assert heard_so_far(path, "k1")[0] == {each.cell for each in samples[:3]}
    write(path, [replace(samples[2], value=-1.0), *samples[3:]])
    assert [each.value for each in read_map(path, 1).samples] == [each.value for each in samples]
    assert [head.heard for head in list_maps(path)] == [6]


def test_another_setting_of_the_receiver_is_kept_beside_the_first(tmp_path):
    path = tmp_path / "signal.sqlite"
    samples = made_map(PLAN, lambda az, el: az).samples
    write(path, samples[:3])
    write(path, samples[3:], told={"transponder": "2"})
    read = read_map(path, 1)
    assert read.settings == (SET, {"transponder": "2"})
    assert [each.settings for each in read.samples] == [0, 0, 0, 1, 1, 1]


def test_two_maps_lie_side_by_side_and_an_unfinished_one_has_no_end(tmp_path):
    path = tmp_path / "signal.sqlite"
    samples = made_map(PLAN, lambda az, el: az).samples
    write(path, samples, ends=True)
    write(path, samples[:1], replace(NEW, key="k2"))
    assert [(head.number, head.key, head.heard, head.ended is None) for head in list_maps(path)] == [
        (2, "k2", 1, True), (1, "k1", 6, False),
    ]  # fmt: skip
    assert str(read_map(path, 2).grid()[1, 0]) == "nan"


def test_a_full_disk_is_told_and_what_was_kept_stays(tmp_path, monkeypatch):
    path = tmp_path / "signal.sqlite"
    samples = made_map(PLAN, lambda az, el: az).samples
    write(path, samples[:2])

    def nearly_full(path, migrations):
        connection = open_database(path, migrations)
        pages = connection.execute("PRAGMA page_count").fetchone()[0]
        connection.execute(f"PRAGMA max_page_count = {pages}")
        return connection

    monkeypatch.setattr(map_file, "open_database", nearly_full)
    writer = MapWriter(path, NEW)
    for cell in range(2, 6):
        writer.add(replace(samples[cell], target="x" * 4000), SET)
        writer.flush()
    writer.close()
    assert "full" in writer.problem
    assert "resume the map" in writer.problem
    kept, _crosses = heard_so_far(path, "k1")
    assert {each.cell for each in samples[:2]} <= kept
    assert len(kept) == 2 + writer.kept < 6


def test_what_is_no_map_is_refused_and_left_alone(tmp_path):
    path = tmp_path / "signal.sqlite"
    assert (list_maps(path), heard_so_far(path, "k1")) == ([], (frozenset(), ()))
    write(path, made_map(PLAN, lambda az, el: az).samples)
    with pytest.raises(StoreError, match="no map 7"):
        read_map(path, 7)
    with sqlite3.connect(path) as connection:
        connection.execute("UPDATE map SET plan = '{}'")
    with pytest.raises(StoreError, match="damaged"):
        read_map(path, 1)
    write(path, made_map(PLAN, lambda az, el: az).samples, replace(NEW, key="k2"))
    assert [head.number for head in list_maps(path)] == [2]
