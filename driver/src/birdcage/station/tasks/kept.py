"""Keeps a task on disk, so that the program which comes after can take it up where this one died."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import CommandRefused
from birdcage.base.paths import write_aside_and_rename
from birdcage.base.reason import Reason
from birdcage.base.text import clean_all
from birdcage.base.user_file import read_user_file
from birdcage.station.task import ItemTask, Task
from birdcage.station.task_state import KeptTask

FILE = "task.json"
CLOSE_S = 0.2

Kinds = Mapping[str, Callable[..., Task]]
"""Tasks by their kind; those that can be taken up again are dataclasses of plain values."""


class TaskFile:
    """`task.json` in the state folder, of one dish at one port; a thread of its own writes.

    Nothing is kept where there is no folder.
    """

    def __init__(self, folder: Path | None, port: str, firmware: str, kinds: Kinds) -> None:
        self._path = None if folder is None else folder / FILE
        self._dish, self._kinds = {"port": port, "firmware": firmware}, kinds
        self._values: dict[str, Any] = {}
        """Of the task that can be taken up."""
        self._text: bytes | None = None
        """What is on disk, or on its way there."""
        self._writer: BackgroundWriter[bytes | None] | None = None
        self.kept = self._read()
        """What the program before this one did not finish; None if there is nothing, or it is damaged."""

    def _read(self) -> KeptTask | None:
        if self._path is None:
            return None
        try:
            told = clean_all(json.loads(read_user_file(self._path)))
            if {key: told[key] for key in self._dish} != self._dish or told["kind"] not in self._kinds:
                return None
            self._values = {str(name): _with_tuples(value) for name, value in told["values"].items()}
            utc = datetime.fromisoformat(told["utc"]).astimezone(UTC)
            return KeptTask(told["kind"], str(self._values["holder"]), int(told["done"]), int(told["of"]), utc)
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            return None

    def again(self) -> Task:
        """Return it, as far as it was; it stays on disk. CommandRefused if there is nothing to be taken up."""
        kept = self.kept
        if kept is None:
            raise CommandRefused("There is no task to resume. Nothing was sent.", reason=Reason.ABSENT)
        try:
            task = self._kinds[kept.kind](**self._values)
            if not isinstance(task, ItemTask):
                raise TypeError(kept.kind)
            task.done = min(max(kept.done, 0), len(task.items()))
        except (TypeError, ValueError) as error:
            self.drop()
            sentence = f"What is kept of the {kept.kind} does not fit this version: begin it anew. Nothing was sent."
            raise CommandRefused(sentence, reason=Reason.DAMAGED) from error
        return task

    def keep(self, task: Task, utc: datetime) -> None:
        """Keep how far a task is, if it is one that can be taken up; it takes the place of any other."""
        if not isinstance(task, ItemTask) or not task.is_kept:
            return
        assert is_dataclass(task), "what is kept are its fields"
        done, of = task.progress
        values = {field.name: getattr(task, field.name) for field in fields(task) if field.init}
        told = {**self._dish, "kind": task.kind, "values": values, "done": done, "of": of, "utc": utc.isoformat()}
        self._write(json.dumps(told).encode())

    def forget(self, task: Task) -> None:
        """A task is over: there is nothing left to be taken up."""
        if isinstance(task, ItemTask) and task.is_kept:
            self._write(None)

    def drop(self) -> None:
        """What the program before this one did not finish is not wanted any more."""
        self.kept = None
        self._write(None)

    def close(self) -> None:
        """Let what is on its way reach the disk."""
        if self._writer is not None:
            self._writer.close(CLOSE_S)

    def _write(self, text: bytes | None) -> None:
        if self._path is None or text == self._text is not None:
            return
        self._text = text
        if self._writer is None:
            self._writer = BackgroundWriter("keep the task", self._put)
        self._writer.offer(text)

    def _put(self, wishes: list[bytes | None], _dropped: int) -> None:
        path = self._path
        if not wishes or path is None:
            return
        with contextlib.suppress(OSError):  # then the next program does not know of it
            if wishes[-1] is None:
                path.unlink(missing_ok=True)
            else:
                write_aside_and_rename(path, wishes[-1])


def _with_tuples(value: Any) -> Any:  # noqa: ANN401 - whatever JSON holds
    """Return a value as a task was given it: JSON knows lists only, and tasks hold tuples."""
    return tuple(_with_tuples(item) for item in value) if isinstance(value, list) else value
