"""Reads numbers from raw text of unknown origin: within bounds, with an error that says what is wrong."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.errors import StoreError
from birdcage.base.text import clean
from birdcage.base.user_file import read_user_file
from birdcage.signal.recordings import DEMO

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MOST_BYTES = 80_000_000
"""The largest of the published ones is a matrix in tenths of a degree: 54 MB."""
MOST_VALUES = 4_000_000
MOST_LINES, LONGEST_LINE = 400_000, 400_000
SHOWN = 24
"""So much of a wrong word stands in the error."""


class NumberFile:
    """The lines of a file, without comments and empty ones."""

    def __init__(self, path: Path, most_bytes: int = MOST_BYTES) -> None:
        self.name = clean(path.name)
        try:
            data = read_user_file(path, most_bytes)
        except OSError as error:
            raise StoreError(f"{clean(str(path))} can't be read: {error.strerror or error}.") from error
        try:
            self._text = data.decode("ascii")
        except UnicodeDecodeError as error:
            raise StoreError(f"{self.name} is no raw text of a sky scan: byte {error.start + 1} is no ASCII.") from None
        self.cut = bool(data) and not data.endswith((b"\n", b"\r"))
        """Whether the last line has no end, as where the power failed."""
        self.demo = any(DEMO in line for line in self._text[:1000].splitlines() if line.startswith("#"))

    def fields(self) -> Iterator[tuple[int, list[str]]]:
        """Yield the number of each line, from 1, and its words."""
        for number, line in enumerate(io.StringIO(self._text), start=1):
            if number > MOST_LINES or len(line) > LONGEST_LINE:
                raise self.wrong(number, "no map has such long lines, or so many of them.")
            words = line.split()
            if words and not words[0].startswith("#"):
                yield number, words

    def wrong(self, number: int, what: str) -> StoreError:
        """Return the error for a line."""
        return StoreError(f"{self.name}, line {number}: {what}")

    def number(self, line: int, word: str) -> float:
        """Return a word as a number: NaN and inf are such."""
        try:
            return float(word)
        except ValueError:
            raise self.wrong(line, f"“{word[:SHOWN]}” is no number.") from None

    def finite(self, line: int, word: str) -> float:
        """Return a word as a finite number."""
        value = self.number(line, word)
        if not math.isfinite(value):
            raise self.wrong(line, f"“{word[:SHOWN]}” stands where a finite number belongs.")
        return value

    def matrix(self) -> NDArray[np.float64]:
        """Return rows of numbers, all of one length."""
        import numpy as np

        rows: list[NDArray[np.float64]] = []
        for number, words in self.fields():
            if rows and len(words) != len(rows[0]):
                raise self.wrong(number, f"{len(words)} numbers, where the first line has {len(rows[0])}.")
            if (len(rows) + 1) * len(words) > MOST_VALUES:
                raise self.wrong(number, f"more than {MOST_VALUES} numbers are too many for a map.")
            try:
                rows.append(np.array(words, dtype=np.float64))
            except ValueError:
                raise self.wrong(number, self._culprit(number, words)) from None
        if not rows:
            raise StoreError(f"{self.name} holds no numbers.")
        return np.array(rows)

    def _culprit(self, number: int, words: list[str]) -> str:
        for word in words:
            self.number(number, word)
        return "a word is no number."
