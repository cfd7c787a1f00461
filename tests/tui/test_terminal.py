"""What a terminal may send, and what becomes of what is written to one that is gone."""

from __future__ import annotations

import os
import sys
import threading
from types import SimpleNamespace

import pytest

if sys.platform == "win32":
    pytest.skip("Textual has another driver there", allow_module_level=True)

from birdcage_tui.drawing.terminal import InputDecoder, PasteWatch, TerminalDriver, TerminalFile
from hypothesis import given
from hypothesis import strategies as some
from textual import events

BOUND_S = 20.0


class Typed(TerminalDriver):
    """Reads from a pipe, and keeps what it hands on."""

    def __init__(self, fd):
        self.fileno, self.exit_event, self.got = fd, threading.Event(), []
        self._app = SimpleNamespace(terminal_gone=lambda: self.got.append("gone"))

    def process_message(self, message):
        self.got.append(message)


def read(*writes):
    """Return the keys and the end of what was typed, in pieces."""
    reader, writer = os.pipe()
    driver = Typed(reader)
    for data in writes:
        os.write(writer, data)
    os.close(writer)
    driver.run_input_thread()
    os.close(reader)
    return [each.key if isinstance(each, events.Key) else each for each in driver.got]


@pytest.mark.parametrize(
    "junk",
    [
        b"\xe9", b"\xff\xfe", b"\xe2\x94", b"\x1b[M \xf0\x91", b"\x1b[M \xc3\xa9", b"\x1b[97:65;2u", b"\x1b[97;5:1u",
        b"\x1b[99999999;1u", b"\x1b[;u", b"\x1b[<0;0;0M", b"\x1b[" + b"1" * 60,
    ],
)  # fmt: skip
def test_a_key_after_junk_arrives(junk):
    got = read(junk + b" ")
    assert got[-2:] == ["space", "gone"]


@pytest.mark.parametrize("begun", [b"\x1b", b"\x1b[", b"\x1bO", b"\x1b[1;", b"\x1b[<0;1", b"\x1b]0;", b"\x1bP"])
def test_ctrl_c_waits_for_the_end_of_no_sequence(begun):
    assert read(begun + b"\x03") == ["ctrl+c", "gone"]


def test_a_ctrl_c_in_a_paste_is_text():
    got = read(b"\x1b[200~a\x03b\x1b[201~ ")
    assert [type(each).__name__ for each in got[:1]] == ["Paste"]
    assert got[1:] == ["space", "gone"]


@given(some.binary(max_size=60))
def test_no_bytes_end_the_input_or_eat_the_keys_long_after_them(junk):
    reader, writer = os.pipe()
    driver = Typed(reader)
    os.write(writer, junk + b"\x1b[201~" + b"q" * 40 + b" ")
    os.close(writer)
    driver.run_input_thread()
    os.close(reader)
    keys = [each.key for each in driver.got if isinstance(each, events.Key)]
    assert keys[-1] == "space"


def test_latin_1_is_typed_as_a_replacement():
    assert read(b"caf\xe9 x")[:6] == ["c", "a", "f", "replacement_character", "space", "x"]


@given(some.text(), some.integers(1, 4))
def test_utf_8_in_any_pieces_is_what_it_was(text, size):
    data = text.encode()
    decoder = InputDecoder()
    if b"\x1b[M" not in data:
        assert "".join(decoder.decode(data[at : at + size]) for at in range(0, len(data), size)) == text


def test_a_report_that_is_not_whole_by_the_next_pause_eats_no_key():
    decoder = InputDecoder()
    assert decoder.decode(b"\x1b[M") == "\x1b[M"
    decoder.pause()
    assert decoder.decode(b" ") == " "
    assert decoder.decode(b"\x1b[M \xc3\xa9 ") == "\x1b[M!!! "


def test_a_paste_is_seen_to_begin_and_end_even_in_pieces():
    watch = PasteWatch()
    for text, is_open in (("\x1b[20", False), ("0~abc", True), ("x" * 50, True), ("\x1b[201", True), ("~", False)):
        watch.see(text)
        assert watch.is_open is is_open


def test_keys_mean_something_again_after_a_paste_without_an_end():
    reader, writer = os.pipe()
    driver, pasted = Typed(reader), threading.Event()

    def hear(message):
        driver.got.append(message)
        if isinstance(message, events.Paste):
            pasted.set()

    driver.process_message = hear
    thread = threading.Thread(target=driver.run_input_thread)
    thread.start()
    os.write(writer, b"\x1b[200~180 45")
    assert pasted.wait(BOUND_S)
    os.write(writer, b" ")
    os.close(writer)
    thread.join(BOUND_S)
    os.close(reader)
    assert driver.got[0].text == "180 45"
    assert driver.got[1].key == "space"


def test_a_file_whose_reader_is_gone_takes_everything_and_waits_for_nobody():
    reader, writer = os.pipe()
    file = TerminalFile(SimpleNamespace(fileno=lambda: writer, encoding="ascii"))
    file.write("38.5° ok")
    assert os.read(reader, 100) == b"38.5? ok"
    os.close(reader)
    for _ in range(100):
        file.write("x" * 10_000)
    assert file.is_gone
    assert not file.takes_more()
    os.close(writer)
