"""What reads the wire of an EasyComm rotator: lines without prompt, echo or menus."""

from __future__ import annotations

from typing import Protocol

from birdcage.sim.firmware import Send
from birdcage.sim.machine import Machine
from birdcage.sim.settings import SimSettings
from birdcage.sim.shell import Die, Pause, Script, ScriptShell

LONGEST_LINE = 127
"""Bytes of a line; one that is longer is dropped without a word (docs/reference/easycomm.md, *Line*)."""


class LineFirmware(Protocol):
    """A firmware that carries out whole lines."""

    def run(self, line: str) -> Script:
        """Carry out one line, never empty."""


class LineShell(ScriptShell):
    """Ends a line at CR or LF, and carries out one after the other; what comes meanwhile waits."""

    def __init__(self, machine: Machine, settings: SimSettings, reader: LineFirmware, send: Send) -> None:
        super().__init__(machine, settings, send)
        self._reader = reader

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
        yield self._latency()
        yield from self._reader.run(line)

    def _advance(self) -> None:
        run = self._run
        while self._script is not None:
            try:
                step = next(self._script)
            except StopIteration:
                if run == self._run:  # else the line has restarted the board, whose start goes on
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
