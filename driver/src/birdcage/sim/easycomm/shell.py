"""What reads the wire of an EasyComm rotator: lines without prompt, echo or menus."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Protocol

from birdcage.sim.chance import seeded
from birdcage.sim.firmware import Send
from birdcage.sim.machine import Machine
from birdcage.sim.settings import LINE_ENDS, SimSettings
from birdcage.sim.shell import LONGEST_MEMORY, Die, Pause, Script

LONGEST_LINE = 127
"""Bytes of a line; one that is longer is dropped without a word (docs/reference/easycomm.md, *Line*)."""


class LineFirmware(Protocol):
    """A firmware that carries out whole lines."""

    def run(self, line: str) -> Script:
        """Carry out one line, never empty."""


class LineShell:
    """Ends a line at CR or LF, and carries out one after the other; what comes meanwhile waits."""

    menu = "root"

    def __init__(self, machine: Machine, settings: SimSettings, reader: LineFirmware, send: Send) -> None:
        self.alive = True
        self.hears: Callable[[bytes], bytes] = bytes
        self.received: deque[tuple[float, str]] = deque(maxlen=LONGEST_MEMORY)
        self._machine, self._settings, self._reader, self._send = machine, settings, reader, send
        self._rng = seeded("shell", settings.seed)
        self._input, self._line = bytearray(), bytearray()
        self._script: Script | None = None
        self._run = 0

    def feed(self, data: bytes) -> None:
        """Take bytes off the wire."""
        if self.alive:
            self._input += self.hears(data)
            self._read()

    def say(self, text: str) -> None:
        """Print something."""
        self._send(text.encode("latin-1", "replace").replace(b"\n", LINE_ENDS[self._settings.line_end]))

    def play(self, script: Script) -> None:
        """Run a script as if a line had started it: the boot log."""
        self._script = script
        self._advance()

    def reset(self, *, alive: bool = True) -> None:
        """Lose everything, as in a reboot; `alive` False leaves it dead."""
        self._input.clear()
        self._line.clear()
        self._script = None
        self._run += 1
        self.alive = alive

    def _read(self) -> None:
        while self._input and self._script is None and self.alive:
            byte = self._input.pop(0)
            if byte not in (0x0D, 0x0A):
                self._line.append(byte)
                if len(self._line) > LONGEST_LINE:
                    self._line.clear()
            elif self._line:
                line = self._line.decode("latin-1")
                self._line.clear()
                self.received.append((self._machine.now, line))
                self._script = self._carry_out(line)
                self._advance()

    def _carry_out(self, line: str) -> Script:
        yield Pause(self._rng.uniform(self._settings.latency_min, self._settings.latency_max))
        yield from self._reader.run(line)

    def _advance(self) -> None:
        run = self._run
        while self._script is not None:
            try:
                step = next(self._script)
            except StopIteration:
                self._script = None
                return
            if run != self._run:
                return  # the line has restarted the board: what it would have done next is gone
            if isinstance(step, str):
                self.say(step)
            elif isinstance(step, Pause):
                self._machine.at_dish(self._machine.dish_s + step.seconds, lambda: self._resume(run))
                return
            elif isinstance(step, Die):
                self.reset(alive=False)

    def _resume(self, run: int) -> None:
        if run == self._run:
            self._advance()
            self._read()
