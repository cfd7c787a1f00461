"""What a task hears along a line: printed as it comes, and not lost where the task is cut short."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from birdcage.cli.say import say, tell, tell_json

if TYPE_CHECKING:
    from birdcage.cli.station_command import StationCommand
    from birdcage.station.task_state import TaskState


class LineHeard:
    """Prints each direction once, or with `--json` one object: at the end, or as far as it came."""

    def __init__(self, write: Callable[[Sequence[float]], str], *, as_json: bool) -> None:
        """`write` makes a line of the numbers of one direction."""
        self._write, self._as_json = write, as_json
        self._told = 0
        self._last: TaskState | None = None

    def show(self, task: TaskState) -> None:
        """Print what is new."""
        self._last = task
        line = task.found.get("line", ())
        assert isinstance(line, tuple), "it is rows of numbers"
        if not self._as_json:
            for row in line[self._told :]:
                tell(self._write(row))
        self._told = len(line)

    @contextmanager
    def kept(self, dish: StationCommand) -> Iterator[None]:
        """Whatever ends the command: with `--json` print what was heard until then, marked as not complete."""
        try:
            yield
        except BaseException:
            if self._as_json and self._told and self._last is not None:
                tell_json({**self._last.found, "complete": False, "demo": dish.state.demo})
            raise

    def tell_end(self, task: TaskState, *, demo: bool) -> bool:
        """Print how it ended; return whether a source was found."""
        is_found = "rise" in task.found
        if self._as_json:
            tell_json({**task.found, "complete": True, "demo": demo})
        elif is_found:
            tell(task.why)
        if not is_found:
            say(task.why)
        return is_found
