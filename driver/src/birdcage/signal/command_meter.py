"""A program that prints levels, a line each: started, asked where it wants that, and ended."""

from __future__ import annotations

import contextlib
import io
import math
import os
import queue
import shlex
import shutil
import threading
from collections.abc import Callable

from birdcage.base.clock import Clock
from birdcage.base.process_group import ProcessGroup
from birdcage.base.text import clean
from birdcage.signal.meter import MeterError, MeterReading, level_in
from birdcage.signal.output_lines import OutputLines

CHUNK = 65_536
LEAST_S = 0.01
"""Levels closer together are not told: a program that prints without end would fill every memory."""
ENDS_S = 1.0
ERRORS_S = 0.2
MOST_WAITING = 1000


class CommandMeter:
    """What it prints to standard error is no level. The last line that holds none is shown when it ends."""

    def __init__(
        self, command: str, clock: Clock, *, ask_every_s: float | None = None, dwell_s: float = 0.0,
        level_of: Callable[[str], float | None] = level_in, patience_s: float = math.inf,
    ) -> None:  # fmt: skip
        """`ask_every_s`: how often it is sent an empty line, None for a program that prints unasked.

        `patience_s`: what prints lines for so long, and no level, is given up with the last of its lines.
        """
        self._command, self._clock, self._dwell_s, self._level_of = command, clock, dwell_s, level_of
        self._ask_every_s, self._patience_s = ask_every_s, patience_s
        self._level_at = 0.0
        self._group: ProcessGroup | None = None
        self._errors: threading.Thread | None = None
        self._lines: queue.Queue[tuple[str, float] | None] = queue.Queue(MOST_WAITING)
        self._asked_at: float | None = None
        self._last_words = ""

    def open(self) -> None:
        """Start it. MeterError where there is no such program."""
        try:
            words = shlex.split(self._command)
        except ValueError as error:
            raise MeterError(f"The command can't be read ({error}): {clean(self._command)}") from error
        if not words or shutil.which(words[0]) is None:
            raise MeterError(f"There is no program {words[0] if words else ''!r}. Install it, or write its whole path.")
        try:
            group = self._group = ProcessGroup(words, os.environ, errors_apart=True)
            group.leash()
        except OSError as error:
            raise MeterError(f"{words[0]} can't be started ({error.strerror}).") from error
        self._lines, self._asked_at, self._last_words = queue.Queue(MOST_WAITING), None, ""
        self._level_at = self._clock.monotonic() - LEAST_S
        told = group, self._lines
        threading.Thread(target=self._listen, args=told, name="signal lines", daemon=True).start()
        self._errors = threading.Thread(target=self._listen_to_errors, args=told, name="signal errors", daemon=True)
        self._errors.start()

    def read(self, within_s: float) -> MeterReading | None:
        """Return the level of the next line; lines without one are passed over."""
        assert self._group is not None, "it was opened"
        until = self._clock.monotonic() + within_s
        while (now := self._clock.monotonic()) < until:
            asks_at = self._ask(self._group, now)
            try:
                told = self._lines.get(timeout=min(until, asks_at) - now)
            except queue.Empty:
                continue
            if told is None:
                raise MeterError(self._ending(self._group))
            line, at = told
            value = self._level_of(line)
            if value is None:
                self._last_words = line.strip() or self._last_words
                if at > self._level_at + self._patience_s:
                    raise MeterError(self._puzzle())
                continue
            if self._ask_every_s is None and at < self._level_at + LEAST_S:
                continue
            self._level_at = at
            if self._ask_every_s is None:
                return MeterReading(value, at - self._dwell_s / 2.0, self._dwell_s)
            asked_at = self._asked_at
            if asked_at is not None and at >= asked_at:  # else it answers no question of ours
                self._asked_at = None
                return MeterReading(value, (asked_at + at) / 2.0, at - asked_at)
        return None

    def close(self) -> None:
        """End it with all that it has started."""
        group, self._group = self._group, None
        if group is None:
            return
        if group.alive():
            group.ask()
            until = self._clock.monotonic() + ENDS_S
            while group.alive() and self._clock.monotonic() < until:
                self._clock.wait(None, self._clock.monotonic() + 0.02)
            if group.alive():
                group.kill()
        group.unleash()
        for stream in (group.child.stdin, group.child.stdout, group.child.stderr):
            if stream is not None and (stream is group.child.stdin or not group.alive()):
                with contextlib.suppress(OSError, ValueError):
                    stream.close()
        with contextlib.suppress(Exception):
            group.child.wait(ENDS_S)

    def _ask(self, group: ProcessGroup, now: float) -> float:
        """Ask it where it is time; return when to look again."""
        if self._ask_every_s is None or self._asked_at is not None or group.child.stdin is None:
            return math.inf
        if now >= self._next_ask_at:
            with contextlib.suppress(OSError):  # it has ended, which its last line tells
                group.child.stdin.write(b"\n")
                group.child.stdin.flush()
            self._asked_at, self._next_ask_at = now, now + self._ask_every_s
            return math.inf
        return self._next_ask_at

    _next_ask_at = -math.inf

    def _listen(self, group: ProcessGroup, lines: queue.Queue[tuple[str, float] | None]) -> None:
        """Put its lines into the queue, with the time at which each was whole; None at the end."""
        stream = group.child.stdout
        assert isinstance(stream, io.BufferedReader), "it is piped"
        splitter = OutputLines()
        with contextlib.suppress(OSError, ValueError):
            while data := stream.read1(CHUNK):
                at = self._clock.monotonic()
                for line in splitter.lines(data):
                    with contextlib.suppress(queue.Full):
                        lines.put_nowait((line, at))
        for line in splitter.rest():
            with contextlib.suppress(queue.Full):
                lines.put_nowait((line, self._clock.monotonic()))
        with contextlib.suppress(queue.Full):
            lines.put(None, timeout=ENDS_S)

    def _listen_to_errors(self, group: ProcessGroup, lines: queue.Queue[tuple[str, float] | None]) -> None:
        stream = group.child.stderr
        assert isinstance(stream, io.BufferedReader), "it is piped"
        splitter = OutputLines()
        with contextlib.suppress(OSError, ValueError):
            while data := stream.read1(CHUNK):
                for line in splitter.lines(data):
                    if line.strip() and lines is self._lines:
                        self._last_words = line.strip()
        for line in splitter.rest():
            if lines is self._lines:
                self._last_words = line.strip()

    def _puzzle(self) -> str:
        return f"{self._command.split()[0]} prints no level, but {self._last_words[:80]!r}."

    def _ending(self, group: ProcessGroup) -> str:
        with contextlib.suppress(Exception):
            group.child.wait(ENDS_S)
        if self._errors is not None:
            self._errors.join(ERRORS_S)  # why it has ended may stand there
        code, last = group.child.poll(), self._last_words[:80].rstrip(".")
        name = self._command.split()[0]
        how = "has closed its output" if code is None else f"has ended with exit status {code}"
        return f"{name} {how}{f': {last}' if last else ''}."


def rtl_power_level(line: str) -> float | None:
    """Return the power of a whole line of rtl_power, in dB; None for any other line.

    `date, time, Hz low, Hz high, Hz step, samples, dB, dB, …`: the powers of its steps are added up.
    """
    cells = [cell.strip() for cell in line.split(",")]
    if len(cells) < 7:
        return None
    try:
        float(cells[2]), float(cells[3])
        levels = [float(cell) for cell in cells[6:] if cell]
    except ValueError:
        return None
    levels = [each for each in levels if math.isfinite(each)]
    return 10.0 * math.log10(sum(10.0 ** (each / 10.0) for each in levels)) if levels else None
