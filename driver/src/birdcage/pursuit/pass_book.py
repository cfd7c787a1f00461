"""Reads the log of passes: what was followed, how well, and every sample of it."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from birdcage.base.errors import StoreError
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database
from birdcage.pursuit.pass_record import HEAD, SAMPLE, MadeFile, PassHead, PassSample, Remark, stamp

if TYPE_CHECKING:
    import sqlite3

WITHIN_DB = 0.5
"""What of the signal may be lost before a sample counts as off."""
_TIMES = frozenset({"utc", "aos", "los", "reach_start", "reach_end", "started", "elements_epoch"})


@dataclass(frozen=True, slots=True)
class PassRecord:
    """One pass of the log, and what its samples come to. Without samples, all of that is None."""

    number: int
    head: PassHead
    ended: datetime | None
    """None while it is under way, and where the program died in mid-pass."""
    outcome: str | None
    csv: Path | None
    """Its file, whether that is still there or not; None if none could be made."""
    samples: int
    last: datetime | None
    """Of the last sample."""
    square_sum: float | None
    """Of the errors, in square degrees."""
    max_error_deg: float | None
    told_db: int
    """How many samples say what is lost."""
    within: int
    """How many of those lose no more than `WITHIN_DB`."""

    @property
    def rms_deg(self) -> float | None:
        """The root mean square of the error."""
        return None if self.square_sum is None else (self.square_sum / self.samples) ** 0.5

    @property
    def within_share(self) -> float | None:
        """Which part of the samples loses no more than `WITHIN_DB`; None if no beam was known."""
        return self.within / self.told_db if self.told_db else None

    @property
    def followed_s(self) -> float | None:
        """From the beginning to the last sample."""
        return None if self.last is None else (self.last - self.head.started).total_seconds()


@dataclass(frozen=True, slots=True)
class Total:
    """Many passes together."""

    passes: int
    followed_s: float
    rms_deg: float | None
    max_error_deg: float | None
    within_share: float | None


def list_passes(
    journal: Path, *, last: int | None = None, since: datetime | None = None, name: str | None = None,
    number: int | None = None, also: Collection[int] = (),
) -> list[PassRecord]:  # fmt: skip
    """Return passes in order of time, the newest last; none if there is no journal.

    `last`: the latest so many of them; `since`: those that began then or later; `name`: with this in their name, or
    with this catalogue number, or with one of `also`; `number`: the one. StoreError if the journal can't be read.
    """
    numbers = ", ".join(str(int(each)) for each in also)
    asked = {
        "started >= :since": since is not None,
        rf"(name LIKE :part ESCAPE '\' OR CAST(norad_id AS TEXT) = :name OR norad_id IN ({numbers}))": name is not None,
        "id = :number": number is not None,
    }
    where = " AND ".join(condition for condition, counts in asked.items() if counts) or "1"
    part = "" if name is None else name.strip().replace("\\", "\\\\").replace("%", r"\%").replace("_", r"\_")
    values = {
        "since": None if since is None else stamp(since),
        "part": f"%{part}%",
        "name": None if name is None else name.strip(),
        "number": number,
        "last": -1 if last is None else last,
    }
    query = f"""
        SELECT p.id, p.ended, p.outcome, p.csv, {", ".join(f"p.{each}" for each in HEAD)},
            count(s.utc), max(s.utc), sum(s.error_deg * s.error_deg), max(s.error_deg), count(s.loss_db),
            coalesce(sum(s.loss_db <= {WITHIN_DB}), 0)
        FROM (SELECT * FROM pass WHERE {where} ORDER BY started DESC, id DESC LIMIT :last) p
        LEFT JOIN pass_sample s ON s.pass = p.id GROUP BY p.id ORDER BY p.started, p.id
    """  # noqa: S608 - names and numbers of our own
    with _reading(journal) as connection:
        rows = [] if connection is None else connection.execute(query, values).fetchall()
    return [_record(row) for row in rows]


def read_samples(journal: Path, number: int) -> list[PassSample]:
    """Return every sample of a pass, in order of time. StoreError if the journal can't be read."""
    query = f"SELECT {', '.join(SAMPLE)} FROM pass_sample WHERE pass = ? ORDER BY rowid"  # noqa: S608 - our own names
    with _reading(journal) as connection:
        rows = [] if connection is None else connection.execute(query, (number,)).fetchall()
    return [PassSample(**_values(SAMPLE, row)) for row in rows]


def read_remarks(journal: Path, number: int) -> list[Remark]:
    """Return the remarks on a pass, in order. StoreError if the journal can't be read."""
    query = "SELECT utc, text FROM pass_remark WHERE pass = ? ORDER BY rowid"
    with _reading(journal) as connection:
        rows = [] if connection is None else connection.execute(query, (number,)).fetchall()
    return [Remark(**_values(("utc", "text"), row)) for row in rows]


def read_files(journal: Path, number: int) -> list[MadeFile]:
    """Return the files that hooks have told of, in order, as they were when they were looked at last.

    StoreError if the journal can't be read.
    """
    query = "SELECT utc, path, size_bytes, files FROM pass_file WHERE pass = ? ORDER BY utc, rowid"
    with _reading(journal) as connection:
        rows = [] if connection is None else connection.execute(query, (number,)).fetchall()
    return [MadeFile(**_values(("utc", "path", "size_bytes", "files"), row)) for row in rows]


def worst_moments(samples: Sequence[PassSample], count: int = 3, apart_s: float = 10.0) -> list[PassSample]:
    """Return the samples of the greatest errors, the worst first, none nearer to another than `apart_s`."""
    found: list[PassSample] = []
    for sample in sorted(samples, key=lambda each: -each.error_deg):
        if all(abs((sample.utc - each.utc).total_seconds()) >= apart_s for each in found):
            found.append(sample)
            if len(found) == count:
                break
    return found


def total_of(passes: Sequence[PassRecord]) -> Total:
    """Return what some passes come to; each sample counts the same."""
    told = [(each.square_sum, each.samples) for each in passes if each.square_sum is not None]
    samples, told_db = sum(count for _, count in told), sum(each.told_db for each in passes)
    return Total(
        len(passes),
        sum(each.followed_s or 0.0 for each in passes),
        (sum(square for square, _ in told) / samples) ** 0.5 if samples else None,
        max((each.max_error_deg for each in passes if each.max_error_deg is not None), default=None),
        sum(each.within for each in passes) / told_db if told_db else None,
    )


@contextmanager
def _reading(journal: Path) -> Iterator[sqlite3.Connection | None]:
    """Give a connection, or None if there is no journal: none is made."""
    import sqlite3

    if not journal.exists():
        yield None
        return
    connection = open_database(journal, MIGRATIONS)
    try:
        yield connection
    except sqlite3.Error as error:
        raise StoreError(f"{journal} cannot be read: {error}.") from error
    finally:
        connection.close()


def _record(row: Sequence[Any]) -> PassRecord:
    number, ended, outcome, csv, *rest = row
    head = _values(HEAD, rest)
    samples, last, square_sum, max_error_deg, told_db, within = rest[len(HEAD) :]
    return PassRecord(
        number, PassHead(**head | {"demo": bool(head["demo"])}), _time(ended), outcome,
        None if csv is None else Path(csv), samples, _time(last), square_sum, max_error_deg, told_db, within,
    )  # fmt: skip


def _values(names: Sequence[str], row: Sequence[Any]) -> dict[str, Any]:
    return {name: _time(value) if name in _TIMES else value for name, value in zip(names, row, strict=False)}


def _time(text: str | None) -> datetime | None:
    return None if text is None else datetime.fromisoformat(text).astimezone(UTC)
