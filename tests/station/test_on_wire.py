"""A face hears every chunk of the wire, and every remark, whether or not files are kept."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.errors import BirdcageError
from birdcage.base.paths import Paths
from birdcage.station.build import open_session
from birdcage.station.raw import Grade, LineJoiner
from birdcage.station.requests import Raw
from birdcage.station.session import Session

from .conftest import Bench


def wired(tmp_path, *, files):
    settings = Settings()
    settings = replace(settings, link=replace(settings.link, transcript=files))
    session = open_session(
        port="sim:g2",
        firmware="g2",
        baud=None,
        settings=settings,
        paths=Paths.in_folder(tmp_path),
        clock=VirtualClock(),
    )
    heard = []
    return session, heard, session.on_wire(heard.append)


@pytest.mark.parametrize("files", [True, False])
def test_every_line_and_remark_is_heard(tmp_path, files):
    session, heard, end = wired(tmp_path, files=files)
    session.step(8)
    session.station.submit(Raw("a 1 90", confirmed=Grade.RUINS))
    session.step(1)
    joiner = LineJoiner()
    lines = [(line.direction, line.text) for entry in heard for line in joiner.join(entry)] + [
        (line.direction, line.text) for line in joiner.finish()
    ]
    mark = (
        "#",
        "raw by console: a 1 90 (MOVES, confirmed; Elevation 90.00 deg is 25.00 deg above the limit of 65.00 deg.)",
    )
    assert lines.index(mark) + 1 == lines.index((">", r"a 1 90\r"))
    assert ("<", "MOT>") in lines
    end()
    count = len(heard)
    session.station.submit(Raw("a"))
    session.step(1)
    assert len(heard) == count
    session.close()
    kept = "".join(path.read_text() for path in tmp_path.rglob("wire-*.txt"))
    assert (mark[1] in kept) == files


def test_a_session_without_a_transcript_says_so():
    bench = Bench()
    with pytest.raises(BirdcageError, match="without a transcript"):
        Session(bench.clock, bench.station).on_wire(lambda _: None)
