"""Where log records go: to stderr by `-v` and `-vv`, to a rotating file by `--log`.

Rooms write to the standard library's loggers under `birdcage`: decisions and changes of state as INFO, exchanges on
the wire and readings as DEBUG. Records are formatted where they are made and written by a thread of their own, so that
neither a slow disk nor a terminal that is held (Ctrl+S) ever makes the wire wait.
"""

from __future__ import annotations

import contextlib
import logging
import stat
import sys
from datetime import UTC, datetime
from logging.handlers import RotatingFileHandler
from pathlib import Path
from typing import TextIO

from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import ConfigError

ROOT = "birdcage"
FILE_BYTES = 2_000_000
FILES_KEPT = 4
"""Older files: FILE.1 is the youngest of them."""
CLOSE_S = 0.5
"""How long the end of a program waits for what is still to be written."""


class LogOutput:
    """Begins with nothing; `set` is called as options are met, and again where they stand twice."""

    def __init__(self, stream: TextIO | None = None) -> None:
        """`stream`: another one than stderr."""
        self._stream = stream
        self._terminal: _Background | None = None
        self._file: _Background | None = None
        self.path: Path | None = None
        """The file that is written; None if none was asked for."""

    @property
    def problem(self) -> str:
        """Why records were lost, as a sentence; empty while none were."""
        return next((each.problem for each in (self._file, self._terminal) if each is not None and each.problem), "")

    def set(self, *, verbosity: int = 0, file: Path | None = None) -> None:
        """Write to stderr from `verbosity` 1 (decisions, changes of state) or 2 (every exchange), and all to `file`.

        ConfigError when the file can't be written.
        """
        root = logging.getLogger(ROOT)
        if verbosity > 0:
            if self._terminal is None:
                self._terminal = _Background(
                    "log to stderr", logging.StreamHandler(self._stream or sys.stderr), "%H:%M:%S"
                )
                root.addHandler(self._terminal)
            self._terminal.setLevel(logging.DEBUG if verbosity > 1 else logging.INFO)
        if file is not None and file != self.path:
            handler = _rotating(file)
            if self._file is not None:
                self._drop(self._file)
            self._file, self.path = _Background("log file", handler, "%Y-%m-%dT%H:%M:%S"), file
            root.addHandler(self._file)
        levels = [each.level for each in (self._terminal, self._file) if each is not None]
        if levels:
            root.setLevel(min(level or logging.DEBUG for level in levels))
            root.propagate = False

    def close(self) -> str:
        """Write what is left, within a deadline, and write no more. Return why records were lost, as `problem`."""
        for each in (self._terminal, self._file):
            if each is not None:
                self._drop(each)
        problem = self.problem
        self._terminal = self._file = self.path = None
        root = logging.getLogger(ROOT)
        root.setLevel(logging.NOTSET)
        root.propagate = True
        return problem

    @staticmethod
    def _drop(handler: _Background) -> None:
        logging.getLogger(ROOT).removeHandler(handler)
        handler.close()


class _Background(logging.Handler):
    """Formats a record at once, and has `handler` write it later."""

    def __init__(self, name: str, handler: logging.StreamHandler, stamp: str) -> None:  # type: ignore[type-arg]
        super().__init__()
        self._handler = handler
        self._handler.setFormatter(logging.Formatter("%(message)s"))
        # A full disk or a closed terminal is told once, by `problem`, and not by a traceback for each record.
        self._handler.handleError = self._failed  # type: ignore[method-assign, assignment]
        self.problem = ""
        self.setFormatter(_Line(stamp))
        self._writer: BackgroundWriter[logging.LogRecord] = BackgroundWriter(name, self._write, size=8192)

    def emit(self, record: logging.LogRecord) -> None:
        """Queue the finished line."""
        plain = logging.makeLogRecord({"msg": self.format(record), "levelno": record.levelno})
        self._writer.offer(plain)

    def close(self) -> None:
        """Write what is queued, and close the stream unless it is stderr."""
        ended = self._writer.close(CLOSE_S)
        if ended and isinstance(self._handler, RotatingFileHandler):
            with contextlib.suppress(OSError):  # a full disk keeps what is buffered, and `problem` tells of it
                self._handler.close()
        super().close()

    def _write(self, records: list[logging.LogRecord], dropped: int) -> None:
        for record in records:
            self._handler.emit(record)
        if dropped:
            self._handler.emit(logging.makeLogRecord({"msg": f"{dropped} records were lost: the writer was too slow."}))

    def _failed(self, _record: logging.LogRecord) -> None:
        self.problem = f"The log can't be written: {sys.exc_info()[1]}"


class _Line(logging.Formatter):
    """`12:03:20.123Z station  the link is up`: UTC, and the room without the word that all have in common."""

    def __init__(self, stamp: str) -> None:
        super().__init__()
        self._stamp = stamp

    def format(self, record: logging.LogRecord) -> str:
        """Return one line; what is not printable, a line end included, is escaped."""
        utc = datetime.fromtimestamp(record.created, UTC)
        room = record.name.removeprefix(f"{ROOT}.").split(".")[0]
        grade = f"{record.levelname}: " if record.levelno >= logging.WARNING else ""
        text = "".join(each if each.isprintable() else each.encode("unicode_escape").decode() for each in
                       record.getMessage())  # fmt: skip
        return f"{utc.strftime(self._stamp)}.{utc.microsecond // 1000:03}Z {room:8} {grade}{text}"


def _rotating(file: Path) -> RotatingFileHandler:
    try:
        if file.exists() and not stat.S_ISREG(file.stat().st_mode):
            raise ConfigError(f"{file} (--log) is not a regular file. Name another one.")
        file.parent.mkdir(parents=True, exist_ok=True)
        return RotatingFileHandler(file, maxBytes=FILE_BYTES, backupCount=FILES_KEPT, encoding="utf-8",
                                   errors="backslashreplace")  # fmt: skip
    except OSError as error:
        raise ConfigError(f"{file} (--log) can't be written: {error.strerror}. Name another file.") from error
