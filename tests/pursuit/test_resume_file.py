"""What is kept of a pursuit on disk, whatever the disk does."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.pursuit.resume_file import FILE, KeptPursuit, ResumeFile

NOW = datetime(2026, 11, 21, 12, 0, 0, 123456, tzinfo=UTC)
KEPT = KeptPursuit(
    "25544", "ISS (ZARYA)", NOW, NOW + timedelta(minutes=5), NOW, 123.4, 56.7, 125.0, 56.5, NOW, 145.8e6, -0.5
)


@pytest.mark.parametrize("kept", [KEPT, replace(KEPT, aos=None, frequency_hz=None, left=True)])
def test_what_was_written_is_read(tmp_path, kept):
    ResumeFile(tmp_path / "new").write(kept)
    assert ResumeFile(tmp_path / "new").read() == kept


def test_nothing_is_read_where_nothing_was_written_or_all_was_removed(tmp_path):
    memory = ResumeFile(tmp_path)
    assert memory.read() is None
    memory.clear()
    memory.write(KEPT)
    memory.clear()
    assert memory.read() is None
    assert memory.problem == ""


@pytest.mark.parametrize("change", [
    {"since": "yesterday"}, {"since": "2026-11-21T12:00:00"}, {"az_deg": None}, {"az_deg": "1"}, {"az_deg": True},
    {"left": 0}, {"text": 25544}, {"more": 1}, {"reach_end": 12},
])  # fmt: skip
def test_what_nobody_here_has_written_is_nothing(tmp_path, change):
    ResumeFile(tmp_path).write(KEPT)
    values = json.loads((tmp_path / FILE).read_text())
    (tmp_path / FILE).write_text(json.dumps(values | change))
    assert ResumeFile(tmp_path).read() is None


@pytest.mark.parametrize("text", ["", "[]", "{", '{"text": "x"}', "\x00"])
def test_half_a_file_is_nothing(tmp_path, text):
    (tmp_path / FILE).write_text(text)
    assert ResumeFile(tmp_path).read() is None


def test_a_disk_that_takes_nothing_is_a_sentence_and_not_the_end(tmp_path):
    (tmp_path / "file").write_text("")
    memory = ResumeFile(tmp_path / "file")
    memory.write(KEPT)
    assert "cannot be written" in memory.problem
