"""A single-threaded line shell, as the Winegard consoles have: it knows menus and nothing of what they do."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass
from typing import Protocol

from birdcage.sim.chance import seeded
from birdcage.sim.machine import Machine
from birdcage.sim.settings import LINE_ENDS, SimSettings

LONGEST_MEMORY = 10_000
"""Lines remembered in `ConsoleShell.received`."""


@dataclass(frozen=True, slots=True)
class Pause:
    """A command takes time: `seconds` of dish time, during which no input is read."""

    seconds: float


@dataclass(frozen=True, slots=True)
class Listen:
    """A command waits for a key, `seconds` of dish time at most; the script is told whether one came."""

    seconds: float
    takes: bytes | None = None
    """Which keys are gone once they were noticed; any other begins the next command. None: as for a stream."""


@dataclass(frozen=True, slots=True)
class Enter:
    """Go to another menu."""

    menu: str


@dataclass(frozen=True, slots=True)
class Die:
    """The shell's task ends, or never comes back from this command: only a power cycle helps."""


Step = str | Pause | Listen | Enter | Die
"""What a command yields: text (with LF line ends), or one of the above."""
Script = Generator[Step, bool | None, None]
KEYS_THAT_END = b"q\r\n"
"""What a stream takes for itself when it ends (setting `stream_key`); any other byte begins the next command."""


class Menu(Protocol):
    """One level of the console."""

    prompt: str

    def run(self, words: list[str]) -> Script:
        """Carry out one line, never empty. An unknown command answers with its error text."""


def quitting(what: str, unknown: Callable[[], Script]) -> Script:
    """Do what a `q` does that leaves no submenu: a knob of each console, as the sources disagree."""
    if what == "kill":
        yield Die()
    elif what == "leave":
        yield Enter("root")
    elif what == "error":
        yield from unknown()


class ScriptShell(ABC):
    """Reads the wire into lines, and runs one script at a time; input waits meanwhile. What a line is, a subclass says.

    Times are seconds of dish time (`Machine.dish_s`).
    """

    def __init__(self, machine: Machine, settings: SimSettings, send: Callable[[bytes], None]) -> None:
        self.menu = "root"
        self.alive = True
        self.hears: Callable[[bytes], bytes] = bytes
        """What gets through of what comes off the wire: a firmware that falls asleep puts its own here."""
        self.received: deque[tuple[float, str]] = deque(maxlen=LONGEST_MEMORY)
        self._machine, self._settings, self._send = machine, settings, send
        self._rng = seeded("shell", settings.seed)
        self._input, self._line = bytearray(), bytearray()
        self._script: Script | None = None
        self._run = 0
        """Counts resets: what was to happen before one does not happen after it."""

    def feed(self, data: bytes) -> None:
        """Take bytes off the wire."""
        if self.alive:
            self._input += self.hears(data)
            self._read()

    def say(self, text: str) -> None:
        """Print something unsolicited, or a part of an answer."""
        self._send(text.encode("latin-1", "replace").replace(b"\n", LINE_ENDS[self._settings.line_end]))

    def play(self, script: Script) -> None:
        """Run a script as if a command had started it: the boot log."""
        self._script = script
        self._advance()

    def reset(self, *, alive: bool = True) -> None:
        """Lose everything, as in a reboot; `alive` False leaves the shell dead."""
        self._input.clear()
        self._line.clear()
        self._script = None
        self._run += 1
        self.menu = "root"
        self.alive = alive

    @abstractmethod
    def _read(self) -> None:
        """Begin what stands in the input, unless a script runs."""

    @abstractmethod
    def _advance(self) -> None:
        """Run the script up to its next pause."""

    def _latency(self) -> Pause:
        """Return how long the shell takes to answer this time."""
        return Pause(self._rng.uniform(self._settings.latency_min, self._settings.latency_max))


class ConsoleShell(ScriptShell):
    """Buffers input while a command runs, echoes when it reads, and has no backspace.

    Source: docs/reference/consoles.md, *Shell*.
    """

    def __init__(
        self,
        machine: Machine,
        settings: SimSettings,
        menus: Mapping[str, Menu],
        send: Callable[[bytes], None],
        echo: Callable[[bytes], None],
    ) -> None:
        super().__init__(machine, settings, send)
        self._menus = menus
        self._echo = echo if settings.echo else _nothing
        self._after_cr = False
        self._listening: Listen | None = None

    def reset(self, *, alive: bool = True) -> None:
        """Lose everything, as in a reboot; `alive` False leaves the shell dead."""
        super().reset(alive=alive)
        self._after_cr, self._listening = False, None

    def _read(self) -> None:
        if self._listening and self._input[:1] == b"\n" and self._after_cr and self._settings.lf_after_cr == "ignore":
            del self._input[0]  # the rest of the line end that started the stream
            self._after_cr = False
        if self._listening is not None and self._input:
            self._end_wait(self._listening)
        while self._input and self._script is None and self.alive:
            byte = self._input.pop(0)
            after_cr, self._after_cr = self._after_cr, byte == 0x0D
            if byte == 0x0A and after_cr and self._settings.lf_after_cr == "ignore":
                continue
            if byte in (0x0D, 0x0A):
                self._echo(LINE_ENDS[self._settings.line_end])
                self._start()
            else:
                self._line.append(byte)
                self._echo(bytes((byte,)))

    def _end_wait(self, wait: Listen) -> None:
        takes = wait.takes
        if takes is None:
            takes = KEYS_THAT_END if self._settings.stream_key == "swallow" else b""
        if self._input[0] in takes:
            self._after_cr = self._input.pop(0) == 0x0D
        self._listening = None
        self._run += 1
        self._advance(key=True)

    def _start(self) -> None:
        line = self._line.decode("latin-1")
        self._line.clear()
        self.received.append((self._machine.now, line))
        self._script = self._command(line.split())
        self._advance()

    def _command(self, words: list[str]) -> Script:
        yield self._latency()
        if words:
            yield from self._menus[self.menu].run(words)

    def _advance(self, *, key: bool | None = None) -> None:
        run = self._run
        while self._script is not None:
            try:
                step = self._script.send(key)
            except StopIteration:
                self._script = None
                self.say(self._menus[self.menu].prompt)
                return
            key = None
            if run != self._run:
                return  # the command rebooted the board: what it would have done next is gone
            if isinstance(step, str):
                self.say(step)
            elif isinstance(step, Enter):
                self.menu = step.menu
            elif isinstance(step, Die):
                self.reset(alive=False)
            else:
                self._resume_in(step.seconds)
                if isinstance(step, Listen):
                    self._listening = step
                    self._read()
                return

    def _resume_in(self, seconds: float) -> None:
        run = self._run

        def resume() -> None:
            if run == self._run:
                self._listening = None
                self._advance()
                self._read()

        self._machine.at_dish(self._machine.dish_s + seconds, resume)


def _nothing(data: bytes) -> None:
    """Echo is off."""
