"""Lines typed before, kept between runs."""

from __future__ import annotations

from pathlib import Path

from birdcage.base.paths import write_aside_and_rename
from birdcage.base.text import clean
from birdcage.base.user_file import check_regular, read_user_file

KEPT = 1000
SLACK = 200
"""The file may grow by so many lines before it is cut."""
MOST_BYTES = 10_000_000


class History:
    """What was typed, oldest first. `path` None keeps nothing after the end of the program."""

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self.problem = ""
        """Why lines are not kept, as a sentence; empty when they are."""
        self.lines: list[str] = self._read()
        self._at: int | None = None
        self._draft = ""

    def add(self, line: str) -> None:
        """Keep a line; not one that is blank, and not the same twice in a row."""
        self._at = None
        line = line.strip()
        if not line or (self.lines and self.lines[-1] == line):
            return
        self.lines.append(line)
        if self._path is None:
            return
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            if self._path.exists():
                check_regular(self._path)
            with self._path.open("a", encoding="utf-8") as file:
                file.write(f"{line}\n")
                file.flush()
        except OSError as error:
            self._fail(error)

    def older(self, draft: str) -> str:
        """Return the line before the one shown; `draft`, what was being typed, comes back after the newest."""
        if self._at is None:
            self._draft, self._at = draft, len(self.lines)
        self._at = max(self._at - 1, 0)
        return self.lines[self._at] if self.lines else draft

    def newer(self, shown: str) -> str:
        """Return the line after the one shown."""
        if self._at is None:
            return shown
        self._at += 1
        if self._at >= len(self.lines):
            self._at = None
            return self._draft
        return self.lines[self._at]

    def find(self, needle: str, skip: int = 0) -> str | None:
        """Return the newest different line with `needle` in it, after passing over `skip` of them."""
        matches = dict.fromkeys(line for line in reversed(self.lines) if needle and needle in line)
        return next((line for index, line in enumerate(matches) if index == skip), None)

    def _read(self) -> list[str]:
        if self._path is None or not self._path.exists():
            return []
        try:
            text = read_user_file(self._path, MOST_BYTES).decode("utf-8", "replace")
            lines = [clean(line) for line in text.splitlines() if line.strip()]
            if len(lines) > KEPT + SLACK:
                lines = lines[-KEPT:]
                write_aside_and_rename(self._path, "".join(f"{line}\n" for line in lines).encode())
        except OSError as error:
            self._fail(error)
            return []
        return lines

    def _fail(self, error: OSError) -> None:
        self.problem = f"Lines are not saved: {self._path}: {error.strerror or error}."
