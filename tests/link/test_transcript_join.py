"""Chunks become lines: by LF, by a lone CR of what comes in, and by quiet; the split changes no line."""

from __future__ import annotations

import itertools
from datetime import UTC, datetime

import pytest
from birdcage.link.transcript_join import LineJoiner
from birdcage.link.transcript_line import TranscriptEntry
from hypothesis import given
from hypothesis import strategies as st

UTC_NOW = datetime(2026, 3, 20, 12, tzinfo=UTC)
STREAM = st.lists(st.sampled_from([b"AZ1", b"\r", b"\n", b"\r\n", b"EL45", b"\xff"]), max_size=20).map(b"".join)


def joined(direction, *chunks):
    joiner, lines = LineJoiner(), []
    for chunk in chunks:
        lines += joiner.join(TranscriptEntry(UTC_NOW, direction, chunk))
    return [entry.data for entry in [*lines, *joiner.finish()]]


@pytest.mark.parametrize("end", [b"\r", b"\n", b"\r\n", b"\r\r\n"])
def test_each_way_to_end_a_line_ends_it(end):
    assert joined("<", b"AZ1" + end + b"EL2" + end) == [b"AZ1" + end, b"EL2" + end]


def test_what_goes_out_in_one_write_is_one_line():
    assert joined(">", b"a 0 100\ra 1 30\r") == [b"a 0 100\ra 1 30\r"]


@given(st.data(), STREAM)
def test_the_split_changes_nothing(data, stream):
    cuts = sorted({0, *data.draw(st.lists(st.integers(0, len(stream)), max_size=8)), len(stream)})
    lines = joined("<", *(stream[a:b] for a, b in itertools.pairwise(cuts)))
    assert lines == joined("<", stream)
    assert b"".join(lines) == stream
