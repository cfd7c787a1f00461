"""Files that somebody else may have made: read at once or refused at once, and never without end."""

from __future__ import annotations

import os
import socket
import sqlite3
from pathlib import Path

import pytest
from birdcage.base.alignments import load_sets
from birdcage.base.config import edit, load
from birdcage.base.errors import ConfigError, StoreError
from birdcage.base.journal import read_journal
from birdcage.base.places import load_places
from birdcage.base.presets import load_presets
from birdcage.base.user_file import read_user_file
from birdcage.calibration.peaks_file import load_peaks
from birdcage.gps.clock_check import recall
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.downlinks_read import read_file
from birdcage.sky.formats import read_path
from birdcage.sky.horizon_file import read_horizon_file


@pytest.fixture
def pipe(tmp_path):
    """A pipe without a writer: opening it waits for ever."""
    path = tmp_path / "pipe"
    os.mkfifo(path)
    return path


def test_a_file_is_read_up_to_its_bound(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"0123456789")
    assert read_user_file(path, 10) == b"0123456789"
    with pytest.raises(OSError, match="larger than"):
        read_user_file(path, 9)
    with pytest.raises(FileNotFoundError):
        read_user_file(tmp_path / "none")


def test_what_is_no_file_is_named(tmp_path, pipe):
    server = socket.socket(socket.AF_UNIX)
    server.bind(str(tmp_path / "s"))
    with server:
        for path, kind in (
            (pipe, "a pipe"),
            (tmp_path, "a folder"),
            (tmp_path / "s", "a socket"),
            ("/dev/zero", "a device"),
        ):
            with pytest.raises(OSError, match=f"it is {kind}, not a file"):
                read_user_file(Path(path))


def test_a_pipe_in_place_of_a_file_is_told_by_every_reader(pipe, tmp_path):
    told = [
        load(pipe, environ={}).problems[0].text,
        load_presets(pipe).problems[0], load_places(pipe).problems[0], load_sets(pipe).problems[0],
        load_peaks(pipe).problems[0], read_file(pipe)[1][0], str(read_path(pipe).complaints[0]),
    ]  # fmt: skip
    for raises, kind in (
        (lambda: edit(pipe, {"place.name": "x"}), ConfigError), (lambda: read_horizon_file(pipe), OSError),
        (lambda: Catalogue(pipe), StoreError), (lambda: read_journal(pipe), StoreError),
    ):  # fmt: skip
        with pytest.raises(kind) as error:
            raises()
        told.append(str(error.value))
    assert [words for words in told if "it is a pipe, not a file" not in words] == []
    os.mkfifo(tmp_path / "clock.json")
    assert recall(tmp_path) is None


def test_names_that_a_database_kept_as_they_came_are_cleaned_once(tmp_path):
    path = tmp_path / "catalogue.sqlite"
    Catalogue(path).close()
    raw = sqlite3.connect(path)
    raw.execute(
        "INSERT INTO satellite VALUES ('evil\x1b', 'EVIL\x1b[2J', 0, '2026-07-01T00:00:00+00:00', 51, 0, 0, 0, 0, 15,"
        " 0, 0, 0, '1998\u202e', 0, '/tmp/\x9b', '2026-07-01T00:00:00+00:00')"
    )
    raw.execute("INSERT INTO membership VALUES ('evil\x1b', 'gr\x07oup')")
    raw.execute("INSERT INTO tag VALUES ('evil\x1b', 'ta\x1bg')")
    raw.execute("PRAGMA user_version = 1")
    raw.commit()
    raw.close()
    with Catalogue(path) as catalogue:
        (entry,) = catalogue.entries()
    assert (entry.name, entry.groups, entry.tags) == ("EVIL[2J", ("group",), ("tag",))
    assert (entry.elements.source, entry.elements.international_designator) == ("/tmp/", "1998")
