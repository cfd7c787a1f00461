"""Motor tests of a dish in `journal.sqlite`: what was measured of each axis, and when."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import astuple, dataclass, fields
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import StoreError
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database

if TYPE_CHECKING:
    import sqlite3


@dataclass(frozen=True, slots=True)
class MotorTest:
    """What one test has told of one axis: degrees and seconds. None for what it did not tell.

    `up` is towards greater angles, `down` towards lesser ones. The fields are the columns of the table.
    """

    utc: datetime
    axis: str
    """Its name: `azimuth`."""
    way_deg: float
    """How far each way was."""
    speed_up: float | None = None
    speed_up_sigma: float | None = None
    speed_down: float | None = None
    speed_down_sigma: float | None = None
    speed_nominal: float | None = None
    """As the machine told then; else as its facts say."""
    acceleration_up: float | None = None
    acceleration_up_sigma: float | None = None
    acceleration_down: float | None = None
    acceleration_down_sigma: float | None = None
    acceleration_nominal: float | None = None
    arrival_deg: float | None = None
    """How far from its target it came to rest at most."""
    readings: int = 0
    """How many readings in motion the figures go by."""
    stalled_at_deg: float | None = None
    """Where it was read last before it stalled; None if it did not."""

    @property
    def speed(self) -> tuple[float, float] | None:
        """Speed of both directions together, and its sigma."""
        return both((self.speed_up, self.speed_up_sigma), (self.speed_down, self.speed_down_sigma))

    @property
    def acceleration(self) -> tuple[float, float] | None:
        """Acceleration of both directions together, and its sigma."""
        up = self.acceleration_up, self.acceleration_up_sigma
        return both(up, (self.acceleration_down, self.acceleration_down_sigma))


def both(*directions: tuple[float | None, float | None]) -> tuple[float, float] | None:
    """Return the mean of figures by their sigmas, and its sigma; None where there is no figure."""
    known = [(value, max(sigma, 1e-9)) for value, sigma in directions if value is not None and sigma is not None]
    if not known:
        return None
    weights = [sigma**-2 for _value, sigma in known]
    mean = sum(value * weight for (value, _), weight in zip(known, weights, strict=True)) / sum(weights)
    return mean, sum(weights) ** -0.5


_COLUMNS = tuple(field.name for field in fields(MotorTest))


class MotorTestBook:
    """Keeps tests from any thread without waiting; a thread of its own writes, once there is something."""

    def __init__(self, path: Path | None) -> None:
        """`path` is the journal; None keeps nothing."""
        self.problem: str | None = None
        """Why tests are not being kept, in a sentence; None when all is well."""
        self._path = path
        self._writer: BackgroundWriter[tuple[str, MotorTest]] | None = None
        self._connection: sqlite3.Connection | None = None

    def add(self, dish: str, test: MotorTest) -> None:
        """Keep a test of this dish. Returns at once."""
        if self._path is None:
            return
        if self._writer is None:
            self._writer = BackgroundWriter("motor tests", self._write, size=64)
        self._writer.offer((dish, test))

    def flush(self, timeout_s: float = 2.0) -> bool:
        """Wait until all is on disk; False if that took too long."""
        return self._writer is None or self._writer.flush(timeout_s)

    def close(self) -> None:
        """Write what is waiting and end the thread."""
        if self._writer is not None:
            self._writer.close()

    def _write(self, items: Iterable[tuple[str, MotorTest]], _dropped: int) -> None:
        rows = [(dish, test.utc.astimezone(UTC).isoformat(timespec="milliseconds"), *astuple(test)[1:])
                for dish, test in items]  # fmt: skip
        if not rows or self._path is None:
            return
        import sqlite3  # when there is something to keep: a face paints without it

        columns = ("dish", *_COLUMNS)
        try:
            if self._connection is None:
                self._connection = open_database(self._path, MIGRATIONS)
            self._connection.executemany(
                f"INSERT INTO motor_test ({', '.join(columns)}) "  # noqa: S608 - our own names
                f"VALUES ({', '.join('?' * len(columns))})",
                rows,
            )
            self.problem = None
        except (StoreError, sqlite3.Error) as error:
            # The test has told what it found. Who closes the book can tell that it is not kept.
            self.problem = f"Motor tests are not being kept: {error}"
            if self._connection is not None:
                self._connection.close()
                self._connection = None


def read_motor_tests(path: Path, dish: str, limit: int = 100) -> list[MotorTest]:
    """Return the latest tests of this dish (`station.wear.dish_key`), newest first; none if no journal exists yet.

    StoreError if it can't be read.
    """
    if not path.exists():
        return []
    connection = open_database(path, MIGRATIONS)
    try:
        rows = connection.execute(
            f"SELECT {', '.join(_COLUMNS)} FROM motor_test WHERE dish = ? ORDER BY id DESC LIMIT ?",  # noqa: S608 - ours
            (dish, limit),
        ).fetchall()
    finally:
        connection.close()
    return [MotorTest(datetime.fromisoformat(utc), *rest) for utc, *rest in rows]
