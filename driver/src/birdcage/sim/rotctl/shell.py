"""A rotctld's end of the wire: it reads commands off a stream, not lines, and answers each in one piece.

`docs/reference/rotctl.md`, *Commands*: a letter, or a long name behind a backslash, then arguments parted by blanks or
line ends. What it does not know it leaves unanswered, and tries the next byte.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from birdcage.sim.chance import seeded
from birdcage.sim.machine import Machine
from birdcage.sim.rotctl.answers import LONG, TAKES, Answerer, TypedCommand
from birdcage.sim.rotctl.knobs import RotctlSettings
from birdcage.sim.shell import LONGEST_MEMORY, Script

SPLIT_S = 0.005
"""How much later the second segment of a split reply comes."""
_NAME = re.compile(r"\\([A-Za-z0-9_]{1,32})")


@dataclass(frozen=True, slots=True)
class Cut:
    """What was read off the stream: a command, or None where it only skipped something."""

    command: TypedCommand | None
    used: int


class RotctldShell:
    """Implements `birdcage.sim.firmware.Shell`."""

    def __init__(
        self, machine: Machine, settings: RotctlSettings, answerer: Answerer, send: Callable[[bytes], None]
    ) -> None:
        self.menu, self.alive = "root", True
        self.hears: Callable[[bytes], bytes] = bytes
        self.received: deque[tuple[float, str]] = deque(maxlen=LONGEST_MEMORY)
        self._machine, self._settings, self._answerer, self._send = machine, settings, answerer, send
        self._rng = seeded("shell", settings.seed)
        self._read, self._busy, self._run = "", False, 0

    def feed(self, data: bytes) -> None:
        """Take bytes off the wire."""
        if self.alive:
            self._read += self.hears(data).decode("latin-1")
            self._go_on()

    def say(self, text: str) -> None:
        """Print something unsolicited."""
        self._send(text.encode("latin-1", "replace"))

    def play(self, script: Script) -> None:
        """A server starts without a word."""
        for _step in script:
            pass

    def reset(self, *, alive: bool = True) -> None:
        """Lose everything that was not answered."""
        self._read, self._busy, self.alive = "", False, alive
        self._run += 1

    def _go_on(self) -> None:
        while not self._busy and self._read:
            cut = cut_command(self._read, self._settings.knows)
            if cut is None:
                return
            self._read = self._read[cut.used :]
            if cut.command is not None:
                self._begin(cut.command)

    def _begin(self, command: TypedCommand) -> None:
        self.received.append((self._machine.now, command.text))
        self._busy, run = True, self._run
        pause_s = self._rng.uniform(self._settings.latency_min, self._settings.latency_max)

        def answer() -> None:
            if run != self._run:
                return
            self._busy = False
            told = self._answerer.answer(command)
            if told:
                self._tell(told)
            self._go_on()

        self._machine.at_dish(self._machine.dish_s + pause_s, answer)

    def _tell(self, told: str) -> None:
        first, end, rest = told.partition("\n")
        if not (self._settings.split and rest):
            self.say(told)
            return
        self.say(first + end)
        self._busy, run = True, self._run

        def later() -> None:
            if run == self._run:
                self._busy = False
                self.say(rest)
                self._go_on()

        self._machine.at_dish(self._machine.dish_s + SPLIT_S, later)


def cut_command(read: str, knows: str = "") -> Cut | None:
    """Cut the first command off what was read; None while more must come. `knows`: its letters, empty for all."""
    blanks = len(read) - len(read.lstrip())
    if blanks:
        return Cut(None, blanks)
    if read[0] == "#":
        end = read.find("\n")
        return None if end < 0 else Cut(None, end + 1)
    extended = "" if read[0].isalnum() or read[0] in "\\_" else read[0]
    rest = read[len(extended) :]
    if not rest:
        return None
    letter, used = rest[0], 1
    if letter == "\\":
        found = _NAME.match(rest)
        if found is None:
            return Cut(None, len(extended) + 1) if len(rest) > 1 else None
        if found.end() == len(rest):
            return None  # the byte behind a long name is part of it
        letter, used = LONG.get(found[1], ""), found.end()
    takes = TAKES.get(letter)
    if takes is None or (knows and letter not in knows):
        return Cut(None, len(extended) + used)
    arguments, end = _arguments(rest[used:], takes)
    if arguments is None:
        return None
    used += end
    return Cut(TypedCommand(letter, arguments, extended), len(extended) + used)


def _arguments(rest: str, takes: int) -> tuple[tuple[str, ...] | None, int]:
    """Return so many words and where they end; None while one of them may go on. -1 takes the rest of the line."""
    if takes < 0:
        line, end, _ = rest.partition("\n")
        return ((line.strip(),) if end else None), len(line) + len(end)
    words, at = list[str](), 0
    for _ in range(takes):
        found = re.compile(r"\s*(\S+)(?=\s)").match(rest, at)
        if found is None:
            return None, 0
        words.append(found[1])
        at = found.end()
    return tuple(words), at
