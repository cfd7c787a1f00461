"""The log of passes on a full disk, with a locked database, and without a place to write to."""

from __future__ import annotations

import errno
import os

from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database
from birdcage.pursuit.pass_book import list_passes, read_samples
from birdcage.station.pursuit_state import Phase

from .pass_events import at, rows_of


def test_a_locked_database_is_told_and_made_good(story, log, paths, monkeypatch):
    monkeypatch.setattr("birdcage.base.store.BUSY_TIMEOUT_S", 0.05)
    story.phase(0, Phase.FOLLOWING)
    story.look(0.0)
    assert log.flush()
    other = open_database(paths.journal, MIGRATIONS)
    other.execute("BEGIN IMMEDIATE")
    story.look(1.0)
    story.look(2.0)
    assert log.flush()
    assert "Passes are not being kept in the journal: database is locked" in log.problem
    assert len(rows_of(next(paths.passes.iterdir()))) == 3
    other.execute("ROLLBACK")
    other.close()
    story.look(3.0)
    assert log.flush()
    assert log.problem == ""
    assert [each.utc for each in read_samples(paths.journal, 1)] == [at(0), at(1), at(2), at(3)]


def test_what_waits_too_long_for_the_database_is_counted_and_the_beginning_stays(story, log, paths, monkeypatch):
    monkeypatch.setattr("birdcage.base.store.BUSY_TIMEOUT_S", 0.02)
    monkeypatch.setattr("birdcage.pursuit.pass_log_work.MOST_HELD_BACK", 10)
    other = open_database(paths.journal, MIGRATIONS)
    other.execute("BEGIN IMMEDIATE")
    story.phase(0, Phase.FOLLOWING)
    for second in range(30):
        story.look(float(second))
    assert log.flush()
    assert "21 samples are missing in the log of passes." in log.problem
    other.execute("ROLLBACK")
    other.close()
    story.phase(400, Phase.OVER, "Done.")
    assert log.flush()
    (record,) = list_passes(paths.journal)
    assert (record.samples, record.last, record.outcome) == (9, at(29), "Done.")
    assert len(rows_of(next(paths.passes.iterdir()))) == 30


def test_a_database_that_cannot_be_made_leaves_the_file(story, log, paths):
    paths.state.parent.mkdir(parents=True, exist_ok=True)
    paths.state.write_text("a file where the folder should be")
    story.whole_pass()
    assert log.flush()
    assert "Passes are not being kept in the journal" in log.problem
    assert len(rows_of(next(paths.passes.iterdir()))) == 3


def test_a_folder_that_cannot_be_made_leaves_the_database(story, log, paths):
    paths.passes.parent.mkdir(parents=True)
    paths.passes.write_text("a file where the folder should be")
    story.whole_pass()
    assert log.flush()
    assert f"The pass is not being written to {paths.passes}" in log.problem
    (record,) = list_passes(paths.journal)
    assert (record.csv, record.samples, record.outcome) == (None, 3, "The pass is over.")


class FullDisk:
    """A file on a disk that takes so many more bytes."""

    def __init__(self, file, room):
        self.file, self.room = file, room

    def write(self, data):
        if self.room <= 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        count = self.file.write(data[: self.room])
        self.room -= count
        return count

    def __getattr__(self, name):
        return getattr(self.file, name)


def test_a_full_disk_is_told_and_no_half_line_stays(story, log, paths):
    story.phase(0, Phase.FOLLOWING)
    story.look(0.0)
    assert log.flush()
    disk = FullDisk(log._work._file._file, room=130)
    log._work._file._file = disk
    story.look(1.0)
    story.look(2.0)
    assert log.flush()
    assert "No space left on device" in log.problem
    file = next(paths.passes.iterdir())
    assert [row["utc"][17:19] for row in rows_of(file)] == ["00", "01"]
    assert file.read_bytes().endswith(b"\n")
    disk.room = 10_000
    story.look(3.0)
    assert log.flush()
    assert log.problem == ""
    assert [row["utc"][17:19] for row in rows_of(file)] == ["00", "01", "02", "03"]
    assert len(read_samples(paths.journal, 1)) == 4
