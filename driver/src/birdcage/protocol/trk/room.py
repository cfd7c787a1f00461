"""What the rooms of such a console share: one menu each, over an open console."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar, TypeVar

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.console.events import Reply
from birdcage.console.session import Console

LINE_S = 0.6
"""About how far apart the lines of a stream are: no source says. Only a stream's length depends on it."""
_FIRST_S = 0.1
"""How long to wait for the first line of a stream; twice as long as it is between two, when none could be read."""

T = TypeVar("T")


class Room:
    """One menu. Every method raises what `Console` raises, and NoReply (garbage) for a reply that makes no sense."""

    menu: ClassVar[str]

    def __init__(self, console: Console) -> None:
        self.console = console

    def _run(self, line: str, *, takes_s: float = 0.0) -> Reply:
        return self.console.run(self.menu, line, takes_s=takes_s)

    def _sample(self, line: str, read: Callable[[str], T | None], samples: int, within_s: float) -> tuple[T, ...]:
        """Run a command that prints until a key, and end it when `samples` of its lines could be read.

        It runs in slices, longer ones when one was in vain, and for `within_s` in all at most; what came until then
        is returned. NoReply (garbage) when that is nothing.
        """
        if samples < 1:
            raise ValueError(f"samples must be at least 1, not {samples}")
        lines: list[str] = []
        found: list[T] = []
        clock = self.console.clock
        self.console.enter(self.menu)
        until, first_s = clock.monotonic() + within_s, _FIRST_S
        while (missing := samples - len(found)) > 0 and clock.monotonic() < until:
            part: list[str] = []
            end = min(until, clock.monotonic() + (missing - 1) * LINE_S + first_s)
            self.console.stream(line, part.append, end)
            values = [value for value in map(read, part) if value is not None]
            first_s = _FIRST_S if values else first_s + 2 * LINE_S
            found += values
            lines += part
        if not found:
            printed = " / ".join(lines[:4]) or "nothing"
            raise NoReply(f"In {within_s:g} s of `{line}` the dish printed {printed!r}.", reason=Reason.GARBAGE)
        return tuple(found[:samples])
