"""What a rotctld answers, line by line: pure, no I/O (`docs/reference/rotctl.md`, *Replies*)."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from enum import Enum

from birdcage.base.reason import Reason

CODE = re.compile(r"RPRT\s+(-?\d+)")
"""What ends a command that sets, and any that fails."""
NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?|[+-]?(?:nan|inf)", re.IGNORECASE)
REASONS = {
    -1: Reason.BAD_PARAMETER,
    -4: Reason.UNSUPPORTED,
    -5: Reason.TIMEOUT,
    -9: Reason.REFUSED,
    -11: Reason.UNSUPPORTED,
    -14: Reason.BUSY,
    -21: Reason.OUT_OF_RANGE,
    -22: Reason.PERMISSION,
}
"""What programs are told of each code; of all others that it failed."""
WORDS = {
    -1: "invalid parameter, or beyond its range",
    -2: "invalid configuration",
    -3: "out of memory",
    -4: "not implemented",
    -5: "the rotator did not answer the server in time",
    -6: "input or output error: the server has lost its rotator",
    -7: "internal error",
    -8: "protocol error",
    -9: "the rotator rejected it",
    -10: "truncated",
    -11: "not available",
    -13: "bus error",
    -14: "the bus is busy",
    -15: "invalid argument",
    -17: "beyond its domain",
    -18: "deprecated",
    -19: "security error",
    -20: "the rotator is not powered on",
    -21: "beyond its range",
    -22: "access denied",
}
"""The codes of Hamlib 4.7, by `docs/reference/rotctl.md`, *Codes*."""


def reason_of(code: int) -> Reason:
    """Return the reason that a code stands for."""
    return REASONS.get(code, Reason.FAILED)


def words_of(code: int) -> str:
    """Return a code as a person reads it: `RPRT -6 (input or output error: …)`."""
    words = WORDS.get(code)
    return f"RPRT {code}" if words is None else f"RPRT {code} ({words})"


def number(text: str) -> float:
    """Return a number that `NUMBER` matches; a comma counts as its point, as some servers print it so."""
    return float(text.replace(",", "."))


class Heard(Enum):
    """What a line was to a reply that is due."""

    PART = "part"
    """It belongs to it, and more is to come."""
    END = "end"
    OTHERS = "others"
    """It belongs to the next one: the server answers nothing to this command."""
    STRAY = "stray"
    """It belongs to none."""


@dataclass(slots=True, eq=False)
class ServerReply(ABC):
    """The reply to one command: what came of it so far."""

    command: str
    code: int | None = None
    """Of its `RPRT`; None while, or where, there is none."""
    lines: list[str] = field(default_factory=list)
    done: bool = False
    skipped: bool = False
    """Whether a later command was answered, and this one never will be."""
    sent_at: float = 0.0
    at: float = 0.0
    """When its last line began to arrive, in monotonic seconds."""

    @property
    def is_over(self) -> bool:
        """Whether nothing more comes."""
        return self.done or self.skipped

    @property
    def is_refused(self) -> bool:
        """Whether it is an error."""
        return self.code is not None and self.code < 0

    def hear(self, text: str) -> Heard:
        """Take in a line, if it belongs to this."""
        code = CODE.fullmatch(text)
        return self._code(int(code[1])) if code is not None else self._line(text)

    def _end(self) -> Heard:
        self.done = True
        return Heard.END

    def _code(self, code: int) -> Heard:
        if code >= 0:
            return Heard.STRAY  # behind the values of the command before, as some servers write it
        self.code = code
        return self._end()

    @abstractmethod
    def _line(self, text: str) -> Heard:
        """Take in a line that is no code."""


class CodeReply(ServerReply):
    """Of a command that sets: its code and nothing else."""

    def _code(self, code: int) -> Heard:
        self.code = code
        return self._end()

    def _line(self, text: str) -> Heard:
        return Heard.OTHERS if NUMBER.fullmatch(text) else Heard.STRAY


class PositionReply(ServerReply):
    """Of `p`: azimuth and elevation, a line each; on one line, too."""

    def _line(self, text: str) -> Heard:
        words = text.split()
        if not words or len(self.lines) + len(words) > 2 or not all(map(NUMBER.fullmatch, words)):
            return Heard.STRAY
        self.lines += words
        return self._end() if len(self.lines) == 2 else Heard.PART

    @property
    def angles(self) -> tuple[float, float]:
        """Azimuth and elevation in degrees, as told."""
        az_deg, el_deg = map(number, self.lines)
        return az_deg, el_deg


class WordReply(ServerReply):
    """Of a command that asks for one value: a line."""

    def _line(self, text: str) -> Heard:
        self.lines.append(text)
        return self._end()


class ExtendedReply(ServerReply):
    """Of a command with `+` before it: its long name, `key: value` for each value, and its code always."""

    def _code(self, code: int) -> Heard:
        self.code = code
        return self._end()

    def _line(self, text: str) -> Heard:
        self.lines.append(text)
        return Heard.PART

    def value(self, key: str) -> str | None:
        """Return what stands behind a key; None where it is not there."""
        found = (line.partition(":") for line in self.lines)
        return next((value.strip() for name, _, value in found if name.strip() == key), None)


class StateReply(ServerReply):
    """Of `dump_state`: lines up to `done`, or, in its old form, until nothing more comes."""

    def _line(self, text: str) -> Heard:
        self.lines.append(text)
        return self._end() if text.strip().lower() == "done" else Heard.PART


@dataclass(frozen=True, slots=True)
class ServerState:
    """What a server tells of its rotator. What it does not tell is None."""

    model: str | None = None
    """Hamlib's number of it."""
    min_az_deg: float | None = None
    max_az_deg: float | None = None
    min_el_deg: float | None = None
    max_el_deg: float | None = None
    south_zero: bool | None = None
    kind: str | None = None
    """`AzEl`, `Az`, `El`, `Other`, `Unknown`."""

    @property
    def has_azimuths(self) -> bool:
        """Whether it tells a range of the azimuth that can be one."""
        return self.min_az_deg is not None and self.max_az_deg is not None and self.max_az_deg > self.min_az_deg

    @property
    def has_elevations(self) -> bool:
        """The same of the elevation."""
        return self.min_el_deg is not None and self.max_el_deg is not None and self.max_el_deg > self.min_el_deg


_TAGS = ("min_az", "max_az", "min_el", "max_el")


def read_state(lines: list[str]) -> ServerState:
    """Read the lines of `dump_state`, leniently: unknown tags, missing ones, and the old form of bare numbers.

    Both forms begin with the version of the protocol and the number of the model.
    """
    tags, bare = dict[str, str](), list[str]()
    for line in lines:
        tag, equals, value = line.partition("=")
        if equals:
            tags[tag.strip().lower()] = value.strip()
        elif NUMBER.fullmatch(line.strip()):
            bare.append(line.strip())
    for tag, value in zip(_TAGS, bare[2:], strict=False):
        tags.setdefault(tag, value)
    angles = {tag: number(tags[tag]) if NUMBER.fullmatch(tags.get(tag, "")) else None for tag in _TAGS}
    south = tags.get("south_zero")
    return ServerState(
        model=bare[1] if len(bare) > 1 else None,
        min_az_deg=angles["min_az"],
        max_az_deg=angles["max_az"],
        min_el_deg=angles["min_el"],
        max_el_deg=angles["max_el"],
        south_zero=None if south is None else south not in ("", "0"),
        kind=tags.get("rot_type") or None,
    )
