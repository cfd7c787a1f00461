"""What is kept of one dish: faults, restarts, its link, replies and wear by day, limits that changed."""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, date, datetime, time, timedelta
from pathlib import Path

from birdcage.base.errors import StoreError
from birdcage.base.journal import ENTRIES, entry_of
from birdcage.base.journal_rows import DishIncident, IncidentKind, JournalEntry, ReplyCount, ToldSetting, stamp
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database
from birdcage.base.wear import Wear
from birdcage.diagnostics.finding import Finding

DAYS = 30
"""How many days are judged, unless somebody says otherwise; as many before them are what they are compared with."""
DEMO = "DEMO: "
"""How the sentence of a simulated dish's fault begins in a journal that does not say whose it is."""


@dataclass(frozen=True, slots=True)
class WearDay:
    """What one axis did on one UTC day."""

    axis: int
    """Motor number."""
    day: date
    moves: int
    degrees: float
    """By how much it was sent, there and back."""


@dataclass(frozen=True, slots=True)
class Acknowledged:
    """Up to where a person has seen a finding."""

    utc: datetime
    """When."""
    latest: str
    """When it had happened last, as the journal writes times; empty for what only is so."""
    grade: float


@dataclass(frozen=True, slots=True)
class DishHistory:
    """The last `days` of one dish, and as many before: `recent` parts them."""

    dish: str
    now: datetime
    days: int = DAYS
    faults: tuple[JournalEntry, ...] = ()
    incidents: tuple[DishIncident, ...] = ()
    replies: tuple[ReplyCount, ...] = ()
    wear: tuple[WearDay, ...] = ()
    totals: tuple[Wear, ...] = ()
    """What each axis has done since counting began."""
    settings: tuple[ToldSetting, ...] = ()
    """What limits or starts motion, each time that it was told anew, from the beginning on."""
    acknowledged: Mapping[str, Acknowledged] = field(default_factory=dict)
    """By the finding's id."""
    problem: str = ""
    """Why there is no history, as a sentence; empty where there is one, or none yet."""

    @property
    def begin(self) -> datetime:
        """When the days begin that are judged: at 00:00 UTC of the first one."""
        return datetime.combine(self.span[0], time(), UTC)

    @property
    def span(self) -> tuple[date, date]:
        """The first UTC day that is judged, and the day after the last, which is today."""
        end = self.now.astimezone(UTC).date() + timedelta(days=1)
        return end - timedelta(days=self.days), end

    def recent_faults(self, reason: str) -> list[JournalEntry]:
        """Return the faults of one reason in the days that are judged, oldest first."""
        return [each for each in self.faults if each.reason == reason and each.utc >= self.begin]

    def recent_incidents(self, *kinds: IncidentKind) -> list[DishIncident]:
        """Return what happened of some kinds in the days that are judged, oldest first."""
        return [each for each in self.incidents if each.kind in kinds and each.utc >= self.begin]

    def worn(self, axis: int, first: date, before: date) -> WearDay:
        """Return what an axis did from one UTC day until another, which no longer counts."""
        mine = [each for each in self.wear if each.axis == axis and first <= each.day < before]
        return WearDay(axis, first, sum(each.moves for each in mine), sum(each.degrees for each in mine))

    def asked(self, first: date, before: date) -> ReplyCount:
        """Return the replies from one UTC day until another, which no longer counts, through whichever adapter."""
        mine = [each for each in self.replies if first <= each.day < before]
        return ReplyCount(
            self.dish, ", ".join(dict.fromkeys(each.adapter for each in mine)), first,
            sum(each.asked for each in mine), sum(each.unanswered for each in mine), sum(each.late for each in mine),
            sum(each.stray_bytes for each in mine),
        )  # fmt: skip


def list_dishes(journal: Path) -> list[str]:
    """Return the dishes that the journal knows, the one that was used last first. StoreError if it can't be read."""
    if not journal.exists():
        return []
    connection = open_database(journal, MIGRATIONS)
    try:
        rows = connection.execute(
            """SELECT dish FROM (
                SELECT dish, max(day) AS last FROM reply_day GROUP BY dish
                UNION ALL SELECT dish, max(day) FROM wear_day GROUP BY dish
                UNION ALL SELECT dish, max(utc) FROM fault WHERE dish != '' GROUP BY dish
                UNION ALL SELECT dish, max(utc) FROM incident WHERE dish != '' GROUP BY dish
            ) GROUP BY dish ORDER BY max(last) DESC"""
        ).fetchall()
    finally:
        connection.close()
    return [dish for (dish,) in rows]


def read_history(journal: Path, dish: str, now: datetime, days: int = DAYS) -> DishHistory:
    """Return what is kept of a dish, by the name that its wear is kept under; slow: never on a thread that paints.

    A journal that can't be read is a `problem`, and no error.
    """
    if not journal.exists():
        return DishHistory(dish, now, days)
    try:
        connection = open_database(journal, MIGRATIONS)
        try:
            return _read(connection, dish, now, days)
        finally:
            connection.close()
    except (StoreError, sqlite3.Error) as error:
        return DishHistory(dish, now, days, problem=f"The journal can't be read: {error}")


def _read(connection: sqlite3.Connection, dish: str, now: datetime, days: int) -> DishHistory:
    begin = now - timedelta(days=2 * days)
    since, first_day = stamp(begin), begin.astimezone(UTC).date().isoformat()
    # Before faults said whose they are, only those of a simulated dish were marked.
    old = "sentence LIKE ?" if dish.endswith(" (demo)") else "sentence NOT LIKE ?"
    faults = connection.execute(
        f"{ENTRIES} WHERE kind = 'dish' AND utc >= ? AND (dish = ? OR (dish = '' AND {old})) ORDER BY utc, id",
        (since, dish, f"{DEMO}%"),
    ).fetchall()
    incidents = connection.execute(
        "SELECT utc, dish, kind, moving, adapter, sentence FROM incident WHERE dish = ? AND utc >= ? ORDER BY utc, id",
        (dish, since),
    ).fetchall()
    replies = connection.execute(
        """SELECT dish, adapter, day, asked, unanswered, late, stray_bytes FROM reply_day
        WHERE dish = ? AND day >= ? ORDER BY day""",
        (dish, first_day),
    ).fetchall()
    wear = connection.execute(
        "SELECT axis, day, moves, degrees FROM wear_day WHERE dish = ? AND day >= ? ORDER BY day", (dish, first_day)
    ).fetchall()
    totals = connection.execute(
        "SELECT axis, moves, degrees, reversals, since FROM wear WHERE dish = ? ORDER BY axis", (dish,)
    ).fetchall()
    settings = connection.execute(
        "SELECT utc, dish, name, value FROM told_setting WHERE dish = ? ORDER BY id", (dish,)
    ).fetchall()
    seen = connection.execute("SELECT finding, utc, latest, grade FROM finding_seen WHERE dish = ?", (dish,)).fetchall()
    return DishHistory(
        dish, now, days,
        faults=tuple(map(entry_of, faults)),
        incidents=tuple(
            DishIncident(_time(utc), name, IncidentKind(kind), bool(moving), adapter, sentence)
            for utc, name, kind, moving, adapter, sentence in incidents
        ),
        replies=tuple(ReplyCount(name, by, date.fromisoformat(day), *counts) for name, by, day, *counts in replies),
        wear=tuple(WearDay(axis, date.fromisoformat(day), moves, degrees) for axis, day, moves, degrees in wear),
        totals=tuple(Wear(axis, moves, deg, turns, _time(began)) for axis, moves, deg, turns, began in totals),
        settings=tuple(ToldSetting(_time(utc), name, setting, value) for utc, name, setting, value in settings),
        acknowledged={finding: Acknowledged(_time(utc), latest, grade) for finding, utc, latest, grade in seen},
    )  # fmt: skip


def _time(text: str) -> datetime:
    return datetime.fromisoformat(text)


def acknowledge(journal: Path, dish: str, finding: Finding, now: datetime) -> None:
    """Keep that a person has seen a finding up to now; it returns once it has happened again, or is worse.

    What only is so, and happens at no time, returns after the days that are judged if it is still so.
    StoreError where that can't be kept. ValueError for one that lasts until its cause is gone.
    """
    if finding.lasts:
        raise ValueError(f"{finding.id} goes by itself")
    connection = open_database(journal, MIGRATIONS)
    try:
        connection.execute(
            """INSERT INTO finding_seen (dish, finding, utc, latest, grade) VALUES (?, ?, ?, ?, ?)
            ON CONFLICT (dish, finding) DO UPDATE SET utc = excluded.utc, latest = excluded.latest,
            grade = excluded.grade""",
            (dish, finding.id, stamp(now), _latest(finding), finding.grade),
        )
    except sqlite3.Error as error:
        raise StoreError(
            f"{journal} can't be written: {error}. Check its permissions and the room on the disk."
        ) from error
    finally:
        connection.close()


def unseen(findings: Sequence[Finding], history: DishHistory) -> tuple[Finding, ...]:
    """Return the findings that were never acknowledged, or too long ago, and those that have happened again since."""
    since = history.now - timedelta(days=history.days)
    return tuple(each for each in findings if not _is_seen(each, history.acknowledged.get(each.id), since))


def _is_seen(finding: Finding, seen: Acknowledged | None, since: datetime) -> bool:
    if seen is None or finding.lasts or (finding.latest is None and seen.utc <= since):
        return False
    return _latest(finding) <= seen.latest and finding.grade <= seen.grade


def _latest(finding: Finding) -> str:
    return "" if finding.latest is None else stamp(finding.latest)
