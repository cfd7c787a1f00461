"""Wear is added up in the journal's file."""

from __future__ import annotations

from birdcage.base.journal import Journal, read_journal
from birdcage.base.wear import Wear, WearBook, read_wear


def test_it_adds_up_over_runs_and_dishes_stay_apart(tmp_path):
    path = tmp_path / "journal.sqlite"
    assert read_wear(path, "G2") == []
    for _run in range(2):
        book = WearBook(path)
        book.add("G2", Wear(0, 2, 30.5, 1))
        book.add("G2", Wear(0, 1, 10.0, 0))
        book.add("G2 (demo)", Wear(0, 7, 700.0, 7))
        book.add("G2", Wear(1, 1, 4.0, 0))
        book.close()
    azimuth, elevation = read_wear(path, "G2")
    assert (azimuth.moves, azimuth.degrees, azimuth.reversals) == (6, 81.0, 2)
    assert (elevation.axis, elevation.degrees) == (1, 8.0)
    assert azimuth.since is not None


def test_the_journal_of_faults_has_the_same_file(tmp_path):
    path = tmp_path / "journal.sqlite"
    Journal(path).close()
    book = WearBook(path)
    book.add("G2", Wear(0, 1, 1.0, 0))
    book.close()
    assert read_journal(path) == []


def test_what_cannot_be_written_is_said_and_kept_for_later(tmp_path):
    path = tmp_path / "journal.sqlite"
    path.mkdir()
    book = WearBook(path)
    book.add("G2", Wear(0, 1, 1.0, 0))
    assert book.flush()
    assert book.problem is not None
    path.rmdir()
    book.add("G2", Wear(0, 1, 2.0, 0))
    book.close()
    assert book.problem is None
    assert [wear.degrees for wear in read_wear(path, "G2")] == [3.0]
