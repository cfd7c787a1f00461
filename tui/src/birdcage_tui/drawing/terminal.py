"""Textual's Linux driver for terminals that misbehave: other encodings, broken sequences, and ones that go away.

Textual's driver ends its input thread, and the app with it, at the first byte that is not UTF-8 and at sequences that
its parser does not expect. It reads a closed terminal again and again, and draws on stderr, wherever that leads. Its
output thread dies at the first write that fails, and then the app waits for it for ever. Nothing else is changed here
(docs/decisions/0024).
"""

from __future__ import annotations

import os
import select
import selectors
import sys
import termios
from codecs import getincrementaldecoder
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from time import monotonic
from typing import Any, TextIO, cast

from textual._xterm_parser import XTermParser
from textual.drivers.linux_driver import LinuxDriver
from textual.message import Message

from birdcage_tui.drawing.terminal_cells import ASK, WAIT_S, CellAnswers, window_aspect

READ_BYTES = 4096
LOOK_S = 0.1
"""How often the end of the input thread is looked for."""
PASTE_S = 0.5
"""So long after the last byte a paste is over even if its end was lost: keys mean STOP again."""
CTRL_C = "\x03"
PASTE_BEGINS, PASTE_ENDS = "\x1b[200~", "\x1b[201~"
X10_REPORT, X10_BYTES = b"\x1b[M", 3
"""The oldest form of a mouse report: three bytes follow, of any value. Textual has no use for it, and drops it."""
LEAVE = "\x1b[<u\x1b[?2004l\x1b[?1000l\x1b[?1003l\x1b[?1015l\x1b[?1006l\x1b[?1004l\x1b[?7h\x1b[?1049l\x1b[?25h"
"""Keyboard, paste, mouse, focus, wrapping, screen and cursor as they were."""


class InputDecoder:
    """Bytes of a terminal to text: what is not UTF-8 becomes U+FFFD.

    The bytes of a mouse report in X10's form become exclamation marks: two of them may look like one character, and
    Textual's parser would then take the next key for the third.
    """

    def __init__(self) -> None:
        self._decode = getincrementaldecoder("utf-8")("replace").decode
        self._last = b""
        self._of_report = 0

    def decode(self, data: bytes) -> str:
        """Return the text of the next bytes, as far as it is complete."""
        out = bytearray()
        for byte in data:
            if self._of_report:
                self._of_report -= 1
                out += b"!"
                continue
            out.append(byte)
            self._last = (self._last + bytes([byte]))[-len(X10_REPORT) :]
            if self._last == X10_REPORT:
                self._of_report = X10_BYTES
        return self._decode(bytes(out))

    def pause(self) -> None:
        """Take note that nothing comes: a report that is not whole yet is none."""
        self._of_report = 0
        self._last = b""


class PasteWatch:
    """Whether a bracketed paste is open, in which every key is text."""

    def __init__(self) -> None:
        self.is_open = False
        self._tail = ""

    def see(self, text: str) -> None:
        """Take the next text; a mark may be cut in two."""
        self._tail += text
        begins, ends = self._tail.rfind(PASTE_BEGINS), self._tail.rfind(PASTE_ENDS)
        if begins != ends:
            self.is_open = begins > ends
        self._tail = self._tail[1 - len(PASTE_BEGINS) :]


class TerminalFile:
    """The terminal as a file to write to. Once it is gone, what is written is dropped."""

    def __init__(self, file: TextIO) -> None:
        self._fd = file.fileno()
        self._encoding = file.encoding or "utf-8"
        self.is_gone = False

    def fileno(self) -> int:
        """Return the descriptor."""
        return self._fd

    def write(self, text: str) -> None:
        """Write at once; a character that the terminal's encoding lacks becomes a question mark."""
        data = memoryview(text.encode(self._encoding, "replace"))
        while data and not self.is_gone:
            try:
                data = data[os.write(self._fd, data) :]
            except OSError:
                self.is_gone = True

    def flush(self) -> None:
        """Do nothing: nothing waits here."""

    def takes_more(self) -> bool:
        """Return whether it takes more output now; False when it is gone, too."""
        with suppress(OSError, ValueError):
            return not self.is_gone and bool(select.select([], [self._fd], [], 0.0)[1])
        return False


def _is_mid_sequence(parser: XTermParser) -> bool:
    return parser._timeout_time is not None  # noqa: SLF001 - it waits for the rest, so long


class TerminalDriver(LinuxDriver):
    """Reads until the terminal is gone, and tells the app then (`terminal_gone`)."""

    _asked = False
    """Whether the terminal was asked for the size of a character."""
    _answer_due = 0.0
    """Until when its answer may come, in monotonic seconds."""

    def __init__(self, *arguments: Any, **more: Any) -> None:  # noqa: ANN401 - as Textual passes them
        super().__init__(*arguments, **more)
        # stdout is the terminal: `main` refuses another one. stderr may be a file, which is nothing to draw on.
        self._terminal = TerminalFile(cast("TextIO", sys.__stdout__))
        self._file = cast("Any", self._terminal)

    def run_input_thread(self) -> None:
        """Hand on what is typed, until the app ends or the terminal is gone."""
        parser, decoder, paste, answers = XTermParser(), InputDecoder(), PasteWatch(), CellAnswers()
        heard_at = monotonic()
        with selectors.DefaultSelector() as selector:
            selector.register(self.fileno, selectors.EVENT_READ)
            while not self.exit_event.is_set():
                if selector.select(self._wait_s(parser)):
                    heard_at = monotonic()
                    data = self._read()
                    if not data:
                        self._tell_gone()
                        break
                    text = self._without(answers, decoder.decode(data))
                    paste.see(text)
                    parser = self._feed(parser, text, paste)
                else:
                    decoder.pause()
                    if kept := answers.pause():
                        parser = self._feed(parser, kept, paste)
                    if paste.is_open and monotonic() - heard_at >= PASTE_S:
                        paste.see(PASTE_ENDS)
                        parser = self._feed(parser, PASTE_ENDS, paste)
                parser = self._hand_on(parser, parser.tick)

    @staticmethod
    def _wait_s(parser: XTermParser) -> float:
        """Return how long to wait for bytes: no longer than until an Esc turns out to be a key of its own."""
        due = parser._timeout_time  # noqa: SLF001 - Textual looks every 100 ms, which is that much later
        return LOOK_S if due is None else min(LOOK_S, max(0.0, due - monotonic()))

    def _without(self, answers: CellAnswers, text: str) -> str:
        """Return the text without what the terminal says of its characters' size, and hand that on."""
        before = answers.cell, answers.area
        text = answers.take(text, due=monotonic() < self._answer_due)
        if (answers.cell, answers.area) != before:
            with suppress(OSError):
                self._tell_aspect(answers.aspect(*os.get_terminal_size(self._terminal.fileno())))
        return text

    def ask_cell_size(self) -> None:
        """Find out how much taller than wide a character is: from the kernel, else the terminal is asked, once."""
        aspect = window_aspect(self._terminal.fileno())
        if aspect is not None:
            self._tell_aspect(aspect)
        elif not self._asked:
            self._asked, self._answer_due = True, monotonic() + WAIT_S
            self.write(ASK)

    def _tell_aspect(self, aspect: float | None) -> None:
        told: Callable[[float], object] | None = getattr(self._app, "cell_aspect_told", None)
        if told is not None and aspect is not None:
            told(aspect)

    def _read(self) -> bytes:
        try:
            return os.read(self.fileno, READ_BYTES)
        except OSError:
            return b""

    def _feed(self, parser: XTermParser, text: str, paste: PasteWatch) -> XTermParser:
        """Parse text, a character at a time: one that breaks the parser costs none of those after it."""
        for char in text:
            if char == CTRL_C and not paste.is_open and PASTE_ENDS not in text and _is_mid_sequence(parser):
                parser = XTermParser()  # no sequence of keys holds one: STOP does not wait for the end of what it cuts
            parser = self._hand_on(parser, partial(parser.feed, char))
        return parser

    def _hand_on(self, parser: XTermParser, parse: Callable[[], Iterable[Message]]) -> XTermParser:
        """Hand on what comes of parsing; return the parser, or a new one where it stumbled."""
        try:
            messages = list(parse())
        except Exception:  # noqa: BLE001 - whatever a terminal sends, the keys after it have to arrive
            return XTermParser()
        for message in messages:
            self.process_message(message)
        return parser

    def _tell_gone(self) -> None:
        gone: Callable[[], object] | None = getattr(self._app, "terminal_gone", None)
        if gone is not None:
            gone()

    def restore(self) -> bool:
        """Give the terminal back as it was, where the app no longer can; return whether it takes any words.

        Any thread; waits for nothing.
        """
        if self.attrs_before is not None:
            with suppress(termios.error):
                termios.tcsetattr(self.fileno, termios.TCSANOW, self.attrs_before)
        takes = self._terminal.takes_more()
        if takes:
            self._terminal.write(LEAVE)
        return takes
