"""One command line of the user's, from its start to its end, on threads of its own."""

from __future__ import annotations

import os
import shlex
import threading
from collections.abc import Callable, Mapping
from typing import IO

from birdcage.base.clock import RealClock
from birdcage.base.process_group import ProcessGroup

GRACE_S = 5.0
"""Between being asked to end and being killed."""
LOOK_S = 0.05
KILL_S = 2.0
"""How long a killed process may take to go: one that waits for a broken disk does not go at all."""
LINES = 200
LINE_BYTES = 1000
"""What is kept of the output; what comes after is read, so that the command is not held up, and dropped."""

WALL = RealClock()
"""Commands run in real time, whatever the clock of the station does."""

Say = Callable[[str], None]


class UserCommand:
    """Starts at once; `say` gets each line of its output and how it ended, on a thread of the command's.

    It has `environment` beside the program's own, and `told` on stdin.
    """

    def __init__(
        self, command: str, environment: Mapping[str, str], told: str, say: Say, *, deadline_s: float,
        grace_s: float = GRACE_S,
    ) -> None:  # fmt: skip
        self._say, self._deadline_s, self._grace_s = say, deadline_s, grace_s
        self._ending = threading.Event()
        self._lines = 0
        self.first_line = ""
        """What it has printed first, cleaned; empty if it has printed nothing."""
        self._what = command.strip() or "(empty)"
        self._group = self._begin(command, environment)
        self._threads: list[threading.Thread] = []
        if self._group is not None:
            self._start(self._tell, self._group.child.stdin, told.encode())
            self._reading = self._start(self._read, self._group.child.stdout)
            self._start(self._watch, self._group)

    @property
    def over(self) -> bool:
        """Whether it has ended, with all that it started."""
        return not any(each.is_alive() for each in self._threads)

    @property
    def status(self) -> int | None:
        """Its exit status, negative for a signal; None while it runs, and if it could not be started."""
        return None if self._group is None else self._group.child.poll()

    def end(self) -> None:
        """Ask it to end, and have it killed when the grace is over. Does not wait."""
        if self._group is not None and not self.over:
            self._group.ask()  # at once: the program may be gone before a thread comes to it
        self._ending.set()

    def leave(self) -> None:
        """Have what was asked to end killed by somebody else when the grace is over, as this program ends before."""
        if self._group is not None and self._group.alive():
            self._group.kill_later(self._grace_s)

    def wait(self, timeout_s: float) -> bool:
        """Wait until it has ended; False if that took too long."""
        until = _now() + timeout_s
        for each in self._threads:
            each.join(max(until - _now(), 0.0))
        return self.over

    def _begin(self, command: str, environment: Mapping[str, str]) -> ProcessGroup | None:
        try:
            words = shlex.split(command)
        except ValueError as error:
            self._say(f"{self._what}: not started, it cannot be read ({error}).")
            return None
        if not words:
            self._say(f"{self._what}: not started, it is empty.")
            return None
        try:
            group = ProcessGroup(words, {**os.environ, **environment})
        except (OSError, ValueError) as error:
            why = getattr(error, "strerror", None) or str(error)
            self._say(f"{self._what}: not started, {words[0]}: {why}.")
            return None
        self._say(f"{self._what}: started.")
        return group

    def _start(self, work: Callable[..., None], *given: object) -> threading.Thread:
        thread = threading.Thread(target=work, args=given, name="user command", daemon=True)
        self._threads.append(thread)
        thread.start()
        return thread

    def _tell(self, pipe: IO[bytes], line: bytes) -> None:
        try:
            with pipe:
                pipe.write(line)
        except OSError:
            # A command that does not read what it is told is as good as one that does.
            return

    def _read(self, pipe: IO[bytes]) -> None:
        with pipe:
            for raw in iter(lambda: pipe.readline(LINE_BYTES), b""):
                self._lines += 1
                if self._lines <= LINES:
                    decoded = raw.decode("utf-8", "replace").rstrip("\r\n").expandtabs()
                    text = "".join(each if each.isprintable() else "?" for each in decoded)
                    self.first_line = self.first_line or text
                    self._say(text)
                elif self._lines == LINES + 1:
                    self._say(f"{self._what}: prints more than {LINES} lines; the rest is dropped.")

    def _watch(self, group: ProcessGroup) -> None:
        """Tell how it ends; see to it that all of it does."""
        until = _now() + self._deadline_s
        told = late = False
        while group.alive():
            if not told and group.child.poll() is not None:
                self._tell_end(group, "but a program that it started still runs")
                told = True
            late = _now() >= until
            if late or self._ending.wait(LOOK_S):
                self._make_end(group, f"{self._deadline_s:g} s are over" if late else "birdcage asks it to")
                break
        self._reading.join(self._grace_s)  # whoever left the group may hold the pipe for ever
        if not told:
            self._tell_end(group)

    def _make_end(self, group: ProcessGroup, why: str) -> None:
        self._say(f"{self._what}: is to end, {why}.")
        group.ask()
        until = _now() + self._grace_s
        while group.alive() and _now() < until:
            WALL.wait(None, min(_now() + LOOK_S, until))
        if not group.alive():
            return
        group.kill()
        self._say(f"{self._what}: did not end within {self._grace_s:g} s, and was killed.")
        until = _now() + KILL_S
        while group.child.poll() is None and _now() < until:
            WALL.wait(None, _now() + LOOK_S)

    def _tell_end(self, group: ProcessGroup, more: str = "") -> None:
        status = group.child.poll()
        if status is None:
            self._say(f"{self._what}: does not end even so (process {group.child.pid}).")
            return
        how = f"ended with status {status}" if status >= 0 else f"was ended by signal {-status}"
        self._say(f"{self._what}: {how}{f', {more}' if more else ''}.")


def _now() -> float:
    return WALL.monotonic()
