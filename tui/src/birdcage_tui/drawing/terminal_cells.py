"""How much taller than wide a character is on this terminal: from its window in pixels, or by asking it."""

from __future__ import annotations

import re
import struct
from contextlib import suppress

ASPECT = 2.0
"""Height over width of a character where nothing tells."""
LEAST, MOST = 1.0, 4.0
"""What is outside is no font: it is not believed."""
ASK = "\x1b[16t\x1b[14t"
"""XTWINOPS: the size of a character in pixels, and of the text area. Terminals that do not know them say nothing."""
_ANSWER = re.compile(r"\x1b\[([46]);(\d{1,5});(\d{1,5})t")
_BEGUN = re.compile(r"\x1b\[[46](?:;\d{0,5}){0,2}$")
_BARELY = re.compile(r"\x1b(?:\[(?:[46](?:;\d{0,5}){0,2})?)?$")
WAIT_S = 2.0
"""So long after asking an Esc may be the beginning of an answer, and waits for what follows; later it is a key."""


def aspect_of(width_px: float, height_px: float) -> float | None:
    """Return the height over the width of a character of that size; None if that is no font."""
    aspect = height_px / width_px if width_px > 0 else 0.0
    return aspect if LEAST <= aspect <= MOST else None


def window_aspect(fd: int) -> float | None:
    """Return the aspect by the window's size in pixels, as the kernel knows it; None if it does not."""
    with suppress(ImportError, OSError):
        import fcntl
        import termios

        told = fcntl.ioctl(fd, termios.TIOCGWINSZ, bytes(8))
        rows, columns, width_px, height_px = struct.unpack("HHHH", told)
        if rows and columns:
            return aspect_of(width_px / columns, height_px / rows)
    return None


class CellAnswers:
    """Takes the answers to `ASK` out of what is typed: Textual would take their digits for keys."""

    def __init__(self) -> None:
        self._kept = ""
        self.cell: tuple[int, int] | None = None
        """Width and height of a character in pixels, once told."""
        self.area: tuple[int, int] | None = None
        """Width and height of the text area in pixels, once told."""

    def take(self, text: str, *, due: bool = False) -> str:
        """Return the text without answers. The beginning of one is kept back until the rest has come.

        `due`: an answer may come now, so that an Esc alone may begin one.
        """
        text = self._kept + text
        for kind, height, width in _ANSWER.findall(text):
            size = int(width), int(height)
            if kind == "6":
                self.cell = size
            else:
                self.area = size
        text = _ANSWER.sub("", text)
        begun = (_BARELY if due else _BEGUN).search(text)
        self._kept = "" if begun is None else begun.group()
        return text[: len(text) - len(self._kept)]

    def pause(self) -> str:
        """Return what was kept back: nothing more comes, so it was none."""
        kept, self._kept = self._kept, ""
        return kept

    def aspect(self, columns: int, rows: int) -> float | None:
        """Return what the answers say, the size of a character first; None before they have come."""
        if self.cell is not None and (aspect := aspect_of(*self.cell)) is not None:
            return aspect
        if self.area is None or not columns or not rows:
            return None
        return aspect_of(self.area[0] / columns, self.area[1] / rows)
