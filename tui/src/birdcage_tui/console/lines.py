"""A line of the transcript as rows of characters: text or hexadecimal, with its time or without."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import Enum

from birdcage.base.text import clean
from birdcage.station.raw import Direction, printable

HEX_WIDTHS = (16, 12, 8, 4)
"""Bytes a row; the first that fits is taken."""
BY_BIRDCAGE = "   by birdcage"
"""Stands after a line that was not typed, and that is no mere question."""


class Stamps(Enum):
    """What stands before each line."""

    UTC = "UTC"
    GAP = "gap"
    """Seconds since the line before."""
    OFF = "off"

    @property
    def next(self) -> Stamps:
        """The one that the key changes to."""
        order = list(Stamps)
        return order[(order.index(self) + 1) % len(order)]


class LinePart(Enum):
    """What a line is in the talk."""

    PLAIN = "plain"
    YOURS = "yours"
    """Somebody typed it."""
    POLL = "poll"
    """The station asks for something by itself, or hears the answer: nothing changes but the menu."""
    STEP = "step"
    """A pursuit keeps the dish on its target, or hears that the step was taken."""
    ECHO = "echo"
    """The dish repeats what was typed."""
    WARNING = "warning"
    """A remark that wants to be read: of a line that is not harmless, or of something that failed."""
    MARK = "mark"
    """The transcript's mark that a harmless line was typed."""


@dataclass(frozen=True, slots=True)
class LogLine:
    """One line that passed: `>` to the dish, `<` from it; or a remark, `#`."""

    utc: datetime
    direction: Direction
    data: bytes
    part: LinePart = LinePart.PLAIN
    is_prompt: bool = False
    """Whether the dish asks for the next line with it."""

    @property
    def is_ended(self) -> bool:
        """Whether it has a line end."""
        return self.data.endswith((b"\n", b"\r"))

    @property
    def text(self) -> str:
        """What a person reads: without the line end, with everything unprintable escaped as in the transcript."""
        if self.direction == "#":
            return clean(self.data.decode("utf-8", "replace"))
        bare = self.data.rstrip(b"\r\n")
        return printable(bare or self.data)

    @property
    def ink(self) -> str:
        """Its colour; the glyph says the same."""
        if self.part in (LinePart.POLL, LinePart.ECHO, LinePart.MARK):
            return "dim"
        if self.direction == "#":
            return "warn" if self.part is LinePart.WARNING else "text"
        if self.direction == ">":
            return "accent-strong" if self.part is LinePart.YOURS else "accent"
        return "dim" if self.is_prompt else "text"


@dataclass(frozen=True, slots=True)
class CellRow:
    """One row of cells. `number` counts lines from the first that was ever taken in."""

    number: int
    stamp: str
    glyph: str
    text: str
    ink: str


def stamp_of(line: LogLine, before: LogLine | None, stamps: Stamps) -> str:
    """Return what stands before the line; always of the same width."""
    if stamps is Stamps.OFF:
        return ""
    if stamps is Stamps.UTC:
        return f"{line.utc:%H:%M:%S}.{line.utc.microsecond // 1000:03d} "
    if before is None:
        return f"{'--.---':>9} "
    return f"{f'+{max((line.utc - before.utc).total_seconds(), 0.0):.3f}':>9} "


def rows_of(
    line: LogLine, number: int, before: LogLine | None, width: int, stamps: Stamps, *, as_hex: bool
) -> list[CellRow]:
    """Lay a line out in rows of at most `width` columns: stamp, glyph, space, text."""
    stamp = stamp_of(line, before, stamps)
    room = max(width - len(stamp) - 2, 8)
    by = BY_BIRDCAGE if line.direction == ">" and line.part in (LinePart.PLAIN, LinePart.STEP) else ""
    pieces = _hex(line.data, room) if as_hex and line.direction != "#" else _wrapped(line.text + by, room)
    return [
        CellRow(number, stamp if not index else " " * len(stamp), line.direction if not index else " ", piece, line.ink)
        for index, piece in enumerate(pieces)
    ]


def _wrapped(text: str, room: int) -> list[str]:
    return [text[start : start + room] for start in range(0, len(text), room)] or [""]


def _hex(data: bytes, room: int) -> list[str]:
    count = next((each for each in HEX_WIDTHS if each * 4 + 1 <= room), HEX_WIDTHS[-1])
    pieces = []
    for start in range(0, len(data), count):
        part = data[start : start + count]
        plain = "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in part)
        pieces.append(f"{part.hex(' '):<{count * 3}} {plain}")
    return pieces or [""]
