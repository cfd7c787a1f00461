from __future__ import annotations

import os
from datetime import UTC, datetime

import pytest
from birdcage.base.held import HeldFile, HeldNote, HeldReason

UTC_THEN = datetime(2026, 11, 22, 12, 3, 11, tzinfo=UTC)


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.setenv("LOGNAME", "anna")
    return HeldFile(tmp_path / "dish")


def test_a_dish_without_the_file_is_free(file):
    assert file.read() is None


@pytest.mark.parametrize(
    ("by", "who"),
    [
        ("you", "anna"), ("Ctrl+C", "anna (Ctrl+C)"), ("birdcage", "birdcage"),
        ("anna (birdcage hold)", "anna (birdcage hold)"),
    ],
)  # fmt: skip
def test_who_since_when_and_why_is_read_again(file, by, who):
    file.write(HeldNote(by, UTC_THEN, HeldReason.STOP, "/dev/ttyUSB0"))
    assert file.read() == HeldNote(who, UTC_THEN, HeldReason.STOP, "/dev/ttyUSB0")
    assert file.read().sentence == f"HELD by {who} since 2026-11-22 12:03:11Z."
    file.remove()
    assert file.read() is None
    file.remove()


DAMAGED = (
    b"", b"{", b"[]", b"null", b"\xff\x00", b'{"by": "you"}', b"[" * 4096,
    b'{"by": 1, "user": "a", "utc": "2026-11-22", "reason": "stop", "port": ""}',
)  # fmt: skip


@pytest.mark.parametrize("text", DAMAGED)
def test_a_damaged_file_holds_the_dish_and_says_so(file, text):
    file.path.parent.mkdir()
    file.path.write_bytes(text)
    note = file.read()
    assert "damaged" in note.sentence
    assert str(file.path) in note.sentence
    assert note.utc is not None
    file.remove()
    assert file.read() is None


def test_what_is_no_file_holds_the_dish_and_is_not_waited_for(file):
    file.path.parent.mkdir()
    os.mkfifo(file.path)
    assert "damaged" in file.read().sentence


def test_names_reach_no_terminal_with_control_characters(file):
    note = HeldNote("Gpred\x1b]0;owned\x07ict", UTC_THEN, HeldReason.OTHER, "/dev/tty\nUSB0", detail="st\x9bop")
    file.write(note)
    assert "\x1b" not in file.read().by
    assert file.read().why == "stop"


def test_a_disk_without_room_keeps_the_latch_without_its_words(file, monkeypatch):
    def full(_descriptor):
        raise OSError(28, "No space left on device")

    file.path.parent.mkdir()
    monkeypatch.setattr(os, "fsync", full)
    file.write(HeldNote("you", UTC_THEN))
    assert file.read() is not None


def test_a_folder_that_cannot_be_made_is_told(tmp_path):
    (tmp_path / "dish").write_text("in the way")
    with pytest.raises(OSError, match="dish"):
        HeldFile(tmp_path / "dish").write(HeldNote("you", UTC_THEN))
