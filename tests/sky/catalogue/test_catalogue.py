"""What goes in comes out; the newest elements stay; what the user said outlives them."""

from __future__ import annotations

import sqlite3
import threading
from datetime import UTC, datetime

import pytest
from birdcage.base.errors import BirdcageError, StoreError
from birdcage.sky.catalogue import Catalogue

SET = datetime(2026, 7, 4, 20, 15, tzinfo=UTC)


def test_elements_come_out_as_they_went_in_to_the_last_bit_and_after_a_restart(path, catalogue, sat):
    one, other = sat(), sat("LUCH", 123456789, days=0.1 + 0.2, eccentricity=0.1 + 0.2, revolution=0)
    assert catalogue.add([one, other]) == (2, 0, 0)
    with Catalogue(path) as again:
        assert set(again.all()) == {one, other}
        assert again.get(43013) == one
        assert again.get("luch") == other
        assert again.get("123456789") == other


def test_the_newest_epoch_stays_whichever_comes_first(catalogue, sat):
    older, newer = sat(days=0), sat(days=1)
    assert catalogue.add([newer, older]) == (1, 0, 0)
    assert catalogue.get(43013) == newer
    assert catalogue.add([older]) == (0, 0, 1)
    assert catalogue.get(43013) == newer
    latest = sat(days=2)
    assert catalogue.add([latest]) == (0, 1, 0)
    assert catalogue.get(43013) == latest


def test_of_two_of_one_epoch_the_first_stays_whoever_sends_the_other(catalogue, sat):
    catalogue.add([sat()])
    assert catalogue.add([sat("JPSS-1", source="satnogs")], group="satnogs") == (0, 0, 1)
    assert catalogue.get(43013) == sat()
    assert catalogue.entry(43013).groups == ("satnogs",)


def test_elements_without_a_name_take_the_one_that_is_known(catalogue, sat):
    catalogue.add([sat(days=0)])
    catalogue.add([sat("", days=1)])
    catalogue.add([sat("43013", days=2)])
    assert catalogue.get("NOAA 20") == sat(days=2)


def test_satellites_without_a_number_are_told_apart_by_name(catalogue, sat):
    catalogue.add([sat("OBJECT A", 0), sat("OBJECT B", 0)])
    assert [each.name for each in catalogue.all()] == ["OBJECT A", "OBJECT B"]
    assert catalogue.get("object b") == sat("OBJECT B", 0)
    assert catalogue.get("object c") is None
    assert catalogue.get(0) is None


def test_a_whole_group_replaces_its_members_and_loses_no_elements(catalogue, sat):
    one, two, three = (sat(f"SAT {n}", n) for n in (1, 2, 3))
    catalogue.add([one, two], group="geo", whole_group=True)
    catalogue.add([two], group="mine")
    catalogue.add([three], group="geo")
    assert catalogue.all("geo") == (one, two, three)
    catalogue.add([three], group="geo", whole_group=True)
    assert catalogue.all("geo") == (three,)
    assert catalogue.all("mine") == (two,)
    assert len(catalogue.all()) == 3
    assert [(group.name, group.count) for group in catalogue.groups.all()] == [("geo", 1), ("mine", 1)]


def test_what_the_user_said_outlives_new_elements_and_a_removal(catalogue, sat):
    catalogue.add([sat()])
    catalogue.set_favourite("noaa 20")
    catalogue.set_priority(43013, 7)
    catalogue.set_tags(43013, ["HRPT", " L band "])
    catalogue.set_time_offset(43013, -1.25, now=SET)
    catalogue.add([sat(days=3)])
    catalogue.remove([43013])
    assert catalogue.get(43013) is None
    catalogue.add([sat(days=1)])
    entry = catalogue.entry(43013)
    assert (entry.favourite, entry.priority, entry.tags) == (True, 7, ("HRPT", "L band"))
    assert (entry.time_offset_s, entry.time_offset_set) == (-1.25, SET)
    assert catalogue.favourites() == (entry,)


def test_favourites_come_by_priority_and_can_be_taken_back(catalogue, sat):
    catalogue.add([sat("B", 1), sat("A", 2), sat("C", 3)])
    for number in (1, 2, 3):
        catalogue.set_favourite(number)
    catalogue.set_priority(3, 5)
    assert [each.name for each in catalogue.favourites()] == ["C", "A", "B"]
    catalogue.set_favourite(2, favourite=False)
    assert [each.name for each in catalogue.favourites()] == ["C", "B"]


def test_a_time_offset_is_forgotten_with_its_date_and_nonsense_is_refused(catalogue, sat):
    catalogue.add([sat()])
    catalogue.set_time_offset(43013, 2.0)
    catalogue.set_time_offset(43013, None)
    entry = catalogue.entry(43013)
    assert (entry.time_offset_s, entry.time_offset_set) == (None, None)
    for nonsense in (4000.0, float("nan"), float("-inf")):
        with pytest.raises(ValueError, match="time offset"):
            catalogue.set_time_offset(43013, nonsense)
    with pytest.raises(ValueError, match="0 to 9"):
        catalogue.set_priority(43013, 10)


def test_nothing_is_said_of_a_satellite_that_is_not_there(catalogue):
    for say in (catalogue.set_favourite, lambda each: catalogue.set_tags(each, ["x"])):
        with pytest.raises(BirdcageError) as caught:
            say(4711)
        assert caught.value.reason == "no_satellite"


def test_a_batch_that_fails_leaves_everything_as_it_was(catalogue, sat):
    catalogue.add([sat()], group="weather")

    def broken():
        yield sat("NEW", 5)
        raise RuntimeError("the source broke off")

    with pytest.raises(RuntimeError):
        catalogue.add(broken(), group="weather", whole_group=True)
    assert catalogue.all("weather") == (sat(),)
    with pytest.raises(StoreError):
        catalogue.add([sat("NEW", 5), sat("BAD", 6, raan_deg=None)], group="weather", whole_group=True)
    assert catalogue.all("weather") == catalogue.all() == (sat(),)
    catalogue.add([sat("NEW", 5)])
    assert len(catalogue.all()) == 2


def test_another_thread_opens_it_for_itself_and_a_change_is_seen(path, catalogue, sat):
    before = catalogue.version
    assert catalogue.search("noaa") == ()

    def other():
        with Catalogue(path) as own:
            own.add([sat()])

    thread = threading.Thread(target=other)
    thread.start()
    thread.join(5)
    assert catalogue.version != before
    assert [each.name for each in catalogue.search("noaa")] == ["NOAA 20"]
    seen = catalogue.version
    catalogue.set_favourite(43013)
    assert catalogue.version != seen
    assert catalogue.search("noaa")[0].favourite


def test_a_damaged_file_is_named(path, sat):
    path.parent.mkdir()
    path.write_bytes(b"no database at all" * 100)
    with pytest.raises(StoreError) as caught:
        Catalogue(path)
    assert caught.value.reason == "damaged"
    assert str(path) in str(caught.value)


def test_a_file_that_loses_its_tables_is_told_in_a_sentence(path, catalogue, sat):
    with sqlite3.connect(path) as other:
        other.execute("DROP TABLE satellite")
    other.close()
    with pytest.raises(StoreError, match="can't be used"):
        catalogue.all()
    with pytest.raises(StoreError, match="can't be used"):
        catalogue.add([sat()])


def test_elements_dated_in_the_future_give_way_to_any_others_and_are_kept_where_there_are_none(catalogue, sat):
    def add(*days):
        catalogue.add([sat(days=each) for each in days], fetched=sat().epoch)
        return (catalogue.get(43013).epoch - sat().epoch).days

    assert add(2000) == 2000, "nothing is thrown away: it may be the clock that is wrong"
    assert add(3000) == 3000
    assert add(-5) == -5, "one that was kept before is healed by the next good one"
    assert add(400, 7) == 7
    assert add(400) == 7
    assert add(6) == 7


def test_of_two_with_one_name_the_one_dated_ahead_does_not_count(catalogue, sat):
    now = datetime.now(UTC)
    catalogue.add([sat(norad_id=1, epoch=now), sat(norad_id=2, epoch=now.replace(year=now.year + 20))])
    assert catalogue.get("NOAA 20").norad_id == 1
