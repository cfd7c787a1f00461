"""What the journal keeps, row by row: faults, what happened to dish and link, replies by day, settings that changed."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, date, datetime
from enum import StrEnum
from typing import ClassVar, Protocol


class JournalRow(Protocol):
    """Something that the journal can keep."""

    @property
    def statement(self) -> str:
        """The SQL that keeps it, with a `?` for each of its `cells`."""

    def cells(self) -> tuple[object, ...]:
        """Return what goes into the database."""


def stamp(utc: datetime) -> str:
    """Return a time as the journal's file has it: ISO 8601, UTC, to the millisecond. It sorts as text."""
    return utc.astimezone(UTC).isoformat(timespec="milliseconds")


@dataclass(frozen=True, slots=True)
class JournalEntry:
    """One fault, or the end of a task."""

    statement: ClassVar[str] = (
        "INSERT INTO fault (utc, kind, reason, sentence, dish, axis, homing, az_deg, el_deg) "
        "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"
    )

    utc: datetime
    kind: str
    """What sort: `dish` of a fault, `task` of the end of a task, `journal` where entries are missing."""
    reason: str
    """A word that a program can test."""
    sentence: str
    """For a person."""
    dish: str = ""
    """Whose, by the name that its wear is kept under; empty in entries of an older birdcage."""
    axis: str = ""
    """The name of the axis; empty where it is of none, or of an unknown one."""
    homing: bool = False
    """Whether that axis failed to find its reference."""
    az_deg: float | None = None
    """True direction where the dish stood; None where that was not known."""
    el_deg: float | None = None

    def cells(self) -> tuple[object, ...]:
        """Return what goes into the database."""
        return (
            stamp(self.utc), self.kind, self.reason, self.sentence, self.dish, self.axis, self.homing, self.az_deg,
            self.el_deg,
        )  # fmt: skip


class IncidentKind(StrEnum):
    """What happened to dish or link."""

    RESTART = "restart"
    """The boot text of a dish that had answered before was heard."""
    START = "start"
    """The boot text of a dish was heard that had not answered this program yet: it was just switched on, maybe."""
    SILENT = "silent"
    """The dish no longer answers; its port is there."""
    LOST = "lost"
    """The port is gone."""
    BACK = "back"
    """The dish answers again."""
    HOMED = "homed"
    """Axes that were homed, which the sentence names, have found their references."""
    SAVED = "saved"
    """The dish saved settings of its own, which count from its next power cycle on."""


@dataclass(frozen=True, slots=True)
class DishIncident:
    """Something that happened to dish or link, and is no fault by itself."""

    statement: ClassVar[str] = (
        "INSERT INTO incident (utc, dish, kind, moving, adapter, sentence) VALUES (?, ?, ?, ?, ?, ?)"
    )

    utc: datetime
    dish: str
    kind: IncidentKind
    moving: bool = False
    """Whether the dish was moving just before."""
    adapter: str = ""
    """By which adapter the dish was reached, as its port is identified."""
    sentence: str = ""
    """What the dish or the system said of it."""

    def cells(self) -> tuple[object, ...]:
        """Return what goes into the database."""
        return stamp(self.utc), self.dish, self.kind.value, self.moving, self.adapter, self.sentence


@dataclass(frozen=True, slots=True)
class ReplyCount:
    """Lines that were sent to a dish through one adapter on one UTC day, and what became of them; rows add up."""

    statement: ClassVar[str] = """INSERT INTO reply_day (dish, adapter, day, asked, unanswered, late, stray_bytes)
        VALUES (?, ?, ?, ?, ?, ?, ?) ON CONFLICT (dish, adapter, day) DO UPDATE SET asked = asked + excluded.asked,
        unanswered = unanswered + excluded.unanswered, late = late + excluded.late,
        stray_bytes = stray_bytes + excluded.stray_bytes"""

    dish: str
    adapter: str
    day: date
    asked: int
    unanswered: int
    """No answer came in time, or none that could be read."""
    late: int
    """The answer came later than a stream of targets could wait for."""
    stray_bytes: int
    """Bytes that nothing asked for, or that could not be read."""

    def cells(self) -> tuple[object, ...]:
        """Return what goes into the database."""
        return (
            self.dish, self.adapter, self.day.isoformat(), self.asked, self.unanswered, self.late, self.stray_bytes,
        )  # fmt: skip


@dataclass(frozen=True, slots=True)
class ToldSetting:
    """A setting in the dish that limits or starts motion, as it was told; kept only where it differs from before."""

    statement: ClassVar[str] = """INSERT INTO told_setting (utc, dish, name, value) SELECT ?1, ?2, ?3, ?4
        WHERE ?4 IS NOT (SELECT value FROM told_setting WHERE dish = ?2 AND name = ?3 ORDER BY id DESC LIMIT 1)"""

    utc: datetime
    dish: str
    name: str
    """The id of its feature."""
    value: str

    def cells(self) -> tuple[object, ...]:
        """Return what goes into the database."""
        return stamp(self.utc), self.dish, self.name, self.value
