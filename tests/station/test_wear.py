"""Moves, degrees and reversals of each axis, by what it was sent."""

from __future__ import annotations

import pytest
from birdcage.base.wear import WearBook, read_wear
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto
from birdcage.station.wear import dish_key, keep_wear

from .pursuit_bench import at, g2, plan_of, travler


def counted(bench, tmp_path, work):
    book = WearBook(tmp_path / "journal.sqlite")
    tally = keep_wear(bench.station, book)
    work()
    tally.write()
    book.close()
    return {
        wear.axis: wear for wear in read_wear(tmp_path / "journal.sqlite", dish_key(bench.state.dish.name, demo=True))
    }


def test_wear_that_is_not_kept_is_told(tmp_path):
    bench = g2()
    path = tmp_path / "journal.sqlite"
    path.mkdir()
    book = WearBook(path)
    tally = keep_wear(bench.station, book)
    bench.do(Goto(100, 45, "you"))
    tally.write()
    assert book.flush()
    tally.write()
    assert bench.state.warnings["wear"].startswith("Wear is not being kept: ")
    path.rmdir()
    bench.do(Goto(130, 45, "you"))
    tally.write()
    assert book.flush()
    tally.write()
    assert "wear" not in bench.state.warnings
    book.close()


def test_single_moves(tmp_path):
    bench = g2()

    def work():
        for az_deg in (100, 130, 110):
            bench.do(Goto(az_deg, 45, "you"))

    wear = counted(bench, tmp_path, work)
    assert (wear[0].moves, wear[0].reversals) == (3, 1)
    assert wear[0].degrees == pytest.approx(100 + 30 + 20, abs=0.5)
    assert 1 not in wear or wear[1].degrees < 0.5


def test_a_pass_counts_the_way_and_not_what_was_left_of_it_at_each_command(tmp_path):
    bench = g2()
    start = at(bench) + 15
    bench.do(Goto(100, 30, "you"))

    def work():
        bench.pursue(plan_of(start, lasts_s=40.0, az_rate=1.0, leave_s=start - 10), at_end="stay")
        bench.until(Phase.OVER)

    wear = counted(bench, tmp_path, work)
    assert wear[0].degrees == pytest.approx(40.0, abs=1.5)
    assert wear[1].degrees == pytest.approx(2 * (50 - 30), abs=1.5)
    assert wear[0].moves > 100
    assert wear[1].reversals < 20


def test_a_dish_whose_moves_queue(tmp_path):
    bench = travler()
    wear = counted(bench, tmp_path, lambda: bench.do(Goto(60, 47, "you"), 60))
    assert wear[0].degrees == pytest.approx(120, abs=0.5)
    assert wear[1].degrees == pytest.approx(2, abs=0.5)
