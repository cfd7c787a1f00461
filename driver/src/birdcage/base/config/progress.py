"""`[setup]`: how far the setup is, one line a step; it can be left and resumed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import ClassVar, NamedTuple

from birdcage.base.config.field import Complaint, Section, setting

_WHEN = r"\d{4}-\d\d-\d\dT\d\d:\d\dZ"
_LINE = re.compile(rf"(done|skipped|begun) ({_WHEN})(?:: (.*))?")
_CLOCK = re.compile(rf"(?:compared|gps) {_WHEN}: ([+-]\d+(?:\.\d+)?) s|trusted {_WHEN}")


class KeptStep(NamedTuple):
    """One step as the file keeps it."""

    word: str
    """`done`, `skipped`, or `begun`: half of it is done, and it goes on from there."""
    when: str
    """UTC, `2026-03-20T12:00Z`."""
    evidence: str

    @property
    def text(self) -> str:
        """The line for the file."""
        return f"{self.word} {self.when}: {self.evidence}" if self.evidence else f"{self.word} {self.when}"

    @property
    def done(self) -> bool:
        """Whether nothing is left to do."""
        return self.word == "done"

    @property
    def skipped(self) -> bool:
        """Whether it was left out."""
        return self.word == "skipped"

    @classmethod
    def read(cls, text: str) -> KeptStep | None:
        """Read a line of the file; None when it is none."""
        found = _LINE.fullmatch(text)
        return None if found is None else cls(found[1], found[2], found[3] or "")


@dataclass(frozen=True, slots=True)
class SetupSettings(Section):
    """What `birdcage setup` has done, and what it has seen. Take a line away to have its step asked again."""

    section: ClassVar[str] = "setup"

    link: str | None = setting(None, "Step 1, the link: `done`, `begun` or `skipped`, when, and the evidence.")
    dish: str | None = setting(None, "Step 2, which dish it is.")
    search: str | None = setting(None, "Step 3, the TV search.")
    home: str | None = setting(None, "Step 4, homing: only whether it was skipped, as the dish itself knows the rest.")
    feed: str | None = setting(None, "Step 5, the feed.")
    limits: str | None = setting(None, "Step 6, the limits.")
    direction: str | None = setting(None, "Step 7, which way the axes turn.")
    level: str | None = setting(None, "Step 8, whether the base is level.")
    place: str | None = setting(None, "Step 9, place and clock.")
    north: str | None = setting(None, "Step 10, north.")
    first: str | None = setting(None, "Step 11, the first satellite.")
    clock: str | None = setting(
        None,
        "The clock of this machine: `compared WHEN: +1 s` against a watch, `gps WHEN: +0.1 s`, or `trusted WHEN`.",
    )

    def kept(self, step: str) -> KeptStep | None:
        """Return what is kept of a step; None for nothing. AttributeError when there is no such step."""
        text = getattr(self, step)
        return None if text is None else KeptStep.read(text)

    @property
    def begun(self) -> bool:
        """Whether anything is kept at all."""
        return any(getattr(self, field.name) is not None for field in fields(self))

    @property
    def clock_offset_s(self) -> float | None:
        """How far this machine's clock was ahead of a watch or GPS, 0 if it is trusted; None if not compared."""
        found = _CLOCK.fullmatch(self.clock or "")
        if found is None:
            return None
        return float(found[1]) if found[1] else 0.0

    def complaints(self) -> Iterator[Complaint]:
        """Yield lines that the setup can't have written."""
        for field in fields(self):
            text = getattr(self, field.name)
            good = _CLOCK.fullmatch(text or "") if field.name == "clock" else KeptStep.read(text or "")
            if text is not None and good is None:
                yield field.name, f"is {text[:60]!r}, which the setup did not write; take the line away to do it again"
