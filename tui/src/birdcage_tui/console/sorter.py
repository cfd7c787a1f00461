"""Tells who said a line: somebody at this console, the station by itself, or the dish."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Protocol

from birdcage.station.raw import Grade, parse_mark

from birdcage_tui.console.lines import LinePart, LogLine

ANSWER_S = 2.0
"""What comes later than this is no answer to a poll: a dish that restarts prints for seconds."""

LINE_END = re.compile(r"\r\n|\r|\n")


class Speech(Protocol):
    """What the machine's own language tells of a line."""

    def only_asks(self, line: str, prompt: str) -> bool:
        """Return whether a line at a prompt changes nothing but the menu."""

    def says_target(self, text: str) -> bool:
        """Return whether a line from the dish says where it goes. Whatever else it says to a step is seen."""

    def is_prompt(self, text: str) -> bool:
        """Return whether a line from the dish is a prompt and nothing else."""


class Sorter:
    """Reads the talk line by line. What it cannot place stays plain, and so in sight."""

    def __init__(self, speech: Speech) -> None:
        self._speech = speech
        self._typed: str | None = None
        self._prompt = ""
        """What the dish wrote last; one of before a gap holds until the next, as the station asks for it first."""
        self._sent: LogLine | None = None
        """The last line that went out, until the dish has repeated it."""
        self._polled: LogLine | None = None
        self._owed = 0
        """Prompts that the poll or the step under way still waits for."""
        self._stepped: frozenset[str] | None = None
        """The commands of the step under way; None: it is a poll."""

    def sort(self, line: LogLine, *, step: bool = False) -> LogLine:
        """Return the line with the part it plays, and whether it is a prompt; `step`: a pursuit sent it."""
        prompt = line.direction == "<" and not line.is_ended and self._speech.is_prompt(line.text)
        line = replace(line, is_prompt=prompt)
        if line.direction == "#":
            part = self._remark(line)
        elif line.direction == ">":
            part = self._out(line, step=step)
        else:
            part = self._in(line)
        return replace(line, part=part)

    def _remark(self, line: LogLine) -> LinePart:
        mark = parse_mark(line.text)
        if mark is None:
            self._polled = None
            return LinePart.PLAIN
        self._typed = mark.line.strip()
        if mark.grade > Grade.HARMLESS:
            return LinePart.WARNING
        return LinePart.PLAIN if mark.about else LinePart.MARK

    def _out(self, line: LogLine, *, step: bool) -> LinePart:
        self._sent, self._polled, self._stepped = line, None, None
        text = line.data.decode("ascii", "replace")
        said, ends = [part.strip() for part in LINE_END.split(text.rstrip("\r\n"))], len(LINE_END.findall(text))
        if self._typed is not None and self._typed in said:
            self._typed = None
            return LinePart.YOURS
        if all(not part or self._speech.only_asks(part, self._prompt) for part in said):
            self._polled, self._owed = line, ends
            return LinePart.POLL
        if step:
            self._polled, self._owed, self._stepped = line, ends, frozenset(said)
            return LinePart.STEP
        return LinePart.PLAIN

    def _in(self, line: LogLine) -> LinePart:
        sent, self._sent = self._sent, None
        self._prompt = line.text if line.is_prompt else self._prompt
        polled = self._polled
        if polled is not None and self._owed and (line.utc - polled.utc).total_seconds() < ANSWER_S:
            self._owed -= line.is_prompt
            if self._stepped is None:
                return LinePart.POLL
            taken = line.is_prompt or line.text.strip() in self._stepped or self._speech.says_target(line.text)
            return LinePart.STEP if taken else LinePart.PLAIN
        self._polled = None
        return LinePart.ECHO if sent is not None and _bare(sent) == _bare(line) != b"" else LinePart.PLAIN


def _bare(line: LogLine) -> bytes:
    return line.data.strip(b"\r\n ")
