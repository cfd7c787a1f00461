"""Messages of the DiSEqC bus in words: the examples of the page, the vectors of public programs, and nonsense."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from birdcage.coax.messages import LONGEST, read_message, typed_message

PAGE = (Path(__file__).parents[2] / "docs/reference/diseqc.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"^\| ((?:[0-9A-F]{2} )+)\| (from .+) \|$", PAGE, re.MULTILINE)


def test_the_examples_of_the_page_are_what_is_said():
    assert len(EXAMPLES) == 6
    for typed, words in EXAMPLES:
        assert str(read_message(typed_message(typed))) == f"{typed.strip()}: {words}"


@pytest.mark.parametrize(("typed", "angle"), [
    ("E0 31 6E E0 A0", "10° east"),  # README of pbasista/diseqc-tool
    ("E0 31 6E D0 A0", "10° west"),
    ("E0 31 6E E0 C5", "12.3125° east"),
    ("E0 31 6E E1 CA", "28.625° east"),  # tables of VDR, tvheadend and enigma2, for 28.6°
    ("E0 31 6E D2 15", "33.3125° west"),
    ("E0 31 6E E5 00", "80° east"),
    ("E0 31 6E E0 00", "0°"),
    ("E0 31 6E D0 00", "0°"),
])  # fmt: skip
def test_an_angle_is_told_in_degrees(typed, angle):
    assert read_message(typed_message(typed)).data == angle


def test_another_dialect_of_angles_is_not_guessed():
    assert "0140" in read_message(typed_message("E0 31 6E 01 40")).data


@pytest.mark.parametrize(("byte", "words"), [
    ("F0", "position A, option A, vertical, low band"),
    ("F4", "position B, option A, vertical, low band"),
    ("F8", "position A, option B, vertical, low band"),
    ("FD", "position B, option B, vertical, high band"),
    ("10", "low band"),
    ("22", "horizontal"),
    ("00", "no change"),
])  # fmt: skip
def test_a_committed_switch_sets_and_clears_what_the_byte_names(byte, words):
    assert read_message(typed_message(f"E0 10 38 {byte}")).data == words


@pytest.mark.parametrize(("typed", "words"), [
    ("E0 31 68 00", "until it is halted"),
    ("E0 31 69 7F", "for 127 s"),
    ("E0 31 69 80", "by 128 steps"),
    ("E0 31 68 FF", "by 1 step"),
    ("E0 31 6A 00", "number 0, which enables the limits and stores nothing"),
    ("E0 31 6A 05", "number 5"),
    ("E0 31 6B 00", "number 0, the reference at 0°"),
    ("E0 10 39 FF", "input 16 of 16"),
])  # fmt: skip
def test_what_a_positioner_or_switch_is_told(typed, words):
    assert read_message(typed_message(typed)).data == words


def test_east_and_west_limits_are_two_commands():
    assert "east limit" in read_message(typed_message("E0 31 66")).command
    assert "west limit" in read_message(typed_message("E0 31 67")).command
    assert "takes 0 bytes of data, not 1" in read_message(typed_message("E0 31 66 01")).doubt


def test_a_reply_says_how_it_went_and_what_it_holds():
    asked = typed_message("E2 31 64")
    assert read_message(asked).wants_reply
    reply = read_message(typed_message("E4 C1"), asked)
    assert reply.is_reply
    assert reply.words == "reply: OK; move completed, limits enabled, position reference lost"
    assert read_message(typed_message("E4 C1")).data == "data C1", "what it answers is not known"
    assert "not supported" in read_message(typed_message("E5")).words
    assert "parity" in read_message(typed_message("E6")).words
    assert "not recognised" in read_message(typed_message("E7")).words


@pytest.mark.parametrize(("typed", "doubt"), [
    ("70 08", "begins with E0, E1, E2 or E3"),
    ("E0", "needs 3 bytes or more"),
    ("E0 31", "needs 3 bytes or more"),
    ("E0 10 38", "takes 1 byte of data, not 0"),
    ("E0 31 6E E1", "takes 2 bytes of data, not 1"),
])  # fmt: skip
def test_what_a_device_will_hardly_understand_is_said(typed, doubt):
    assert doubt in str(read_message(typed_message(typed)))


def test_what_is_not_known_stays_bytes():
    told = read_message(typed_message("E0 AA 6C 01 02"))
    assert (told.address, told.data, told.doubt) == ("address AA", "data 01 02", "")
    assert "6C" in told.command


@pytest.mark.parametrize("typed", ["E0 10 38 F3", "e01038f3", "0xE0,0x10,0x38,0xF3", " e0  10 38,f3 "])
def test_bytes_are_typed_in_several_ways(typed):
    assert typed_message(typed) == bytes.fromhex("E01038F3")


def test_a_single_digit_is_a_byte():
    assert typed_message("E0 1 38 F0") == bytes((0xE0, 0x01, 0x38, 0xF0))


@pytest.mark.parametrize(("typed", "sentence"), [
    ("E0 GG", "'GG' is no byte in hex. Give 1 to 6 bytes, as E0 10 38 F0."),
    ("E0 10 38 F", None),
    ("E01", "'E01' is no byte in hex"),
    ("", "and 0 were given"),
    ("E0 10 38 F0 00 00 00", "and 7 were given"),
    ("E010 38", "'E010' is no byte in hex"),
])  # fmt: skip
def test_what_is_no_message_says_what_to_give(typed, sentence):
    if sentence is None:
        assert typed_message(typed) == bytes((0xE0, 0x10, 0x38, 0x0F))
        return
    with pytest.raises(ValueError, match=re.escape(sentence)):
        typed_message(typed)


def test_every_message_of_one_to_six_bytes_has_words():
    for first in (0x00, 0x31, 0x70, *range(0xE0, 0xE9), 0xFF):
        for command in range(256):
            for length in range(1, LONGEST + 1):
                told = read_message(bytes((first, 0x31, command, 0xE1, 0xCA, 0x00)[:length]))
                assert told.words
                assert told.words.isprintable()
    with pytest.raises(ValueError, match="at least one byte"):
        read_message(b"")
