"""Makes up the history of a dish: two months of ordinary days, and what goes wrong on some of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from pathlib import Path
from random import Random

from birdcage.base.journal import Journal
from birdcage.base.journal_rows import DishIncident, IncidentKind, JournalEntry, ReplyCount, ToldSetting
from birdcage.base.wear import Wear, WearBook
from birdcage.rotator.feature import Reading
from birdcage.station.known import list_models
from birdcage.station.state import LinkPhase, LinkState, StationState, TvSearch

NOW = datetime(2026, 11, 27, 9, 0, tzinfo=UTC)
"""A Friday morning."""
DAYS = 60
G2, TRAVLER = (next(each for each in list_models() if each.firmware == name) for name in ("g2", "hal205"))


@dataclass
class MadeHistory:
    """Every `days_ago` counts back from `NOW`; `hour` is of that UTC day."""

    dish: str = G2.name
    seed: int = 1
    rows: list = field(default_factory=list)
    wear: list = field(default_factory=list)

    def at(self, days_ago: float, hour: float = 12.0) -> datetime:
        day = (NOW - timedelta(days=days_ago)).replace(hour=0, minute=0)
        return min(day + timedelta(hours=hour), NOW - timedelta(minutes=1))

    def ordinary(self, *, turns: float = 4.0, lost: float = 0.0002, adapter: str = "usb:1") -> MadeHistory:
        """Two months of use: some satellites a day, a lost reply now and then."""
        random = Random(self.seed)
        for days_ago in range(DAYS):
            asked = random.randint(900, 1900)
            self.replies(days_ago, asked, sum(random.random() < lost for _ in range(asked)), adapter=adapter)
            self.turned(days_ago, 0, turns * random.uniform(0.7, 1.3))
            self.turned(days_ago, 1, turns / 4 * random.uniform(0.7, 1.3))
        for name, value in (("floor", "18.0"), ("ceiling", "65.0")):
            self.limit(DAYS, name, value)
        return self

    def fault(self, days_ago: float, reason: str, hour: float = 12.0, **more) -> MadeHistory:
        utc = self.at(days_ago, hour)
        self.rows.append(JournalEntry(utc, "dish", reason, f"A {reason} of the test.", self.dish, **more))
        return self

    def stall(self, days_ago: float, axis: str, az: float, el: float, hour: float = 12.0) -> MadeHistory:
        return self.fault(days_ago, "stall", hour, axis=axis, az_deg=az, el_deg=el)

    def incident(self, days_ago: float, kind: IncidentKind, hour: float = 12.0, *, moving: bool = False) -> MadeHistory:
        self.rows.append(DishIncident(self.at(days_ago, hour), self.dish, kind, moving, "usb:1", ""))
        return self

    def homed(self, days_ago: float, axes: str) -> MadeHistory:
        self.rows.append(DishIncident(self.at(days_ago), self.dish, IncidentKind.HOMED, False, "usb:1", axes))
        return self

    def restart(self, days_ago: float, hour: float = 12.0, *, moving: bool = False) -> MadeHistory:
        self.fault(days_ago, "reboot", hour)
        return self.incident(days_ago, IncidentKind.RESTART, hour, moving=moving)

    def off_and_on(self, days_ago: float, hour: float = 20.0, *, hours: float = 10.0) -> MadeHistory:
        """Somebody switches it off in the evening and on in the morning."""
        self.incident(days_ago, IncidentKind.SILENT, hour)
        self.fault(days_ago, "reboot", hour + hours)
        return self.incident(days_ago, IncidentKind.RESTART, hour + hours)

    def gap(self, days_ago: float, hour: float, *, lasts_s: float = 20.0, moving: bool = False) -> MadeHistory:
        self.incident(days_ago, IncidentKind.SILENT, hour, moving=moving)
        return self.incident(days_ago, IncidentKind.BACK, hour + lasts_s / 3600.0)

    def deadlock(self, days_ago: float, hour: float = 12.0, *, minutes: float = 5.0) -> MadeHistory:
        self.incident(days_ago, IncidentKind.SILENT, hour, moving=True)
        return self.incident(days_ago, IncidentKind.RESTART, hour + minutes / 60.0)

    def replies(self, days_ago: int, asked: int, lost: int, stray: int = 0, adapter: str = "usb:1") -> MadeHistory:
        self.rows.append(ReplyCount(self.dish, adapter, self.at(days_ago).date(), asked, lost, 0, stray))
        return self

    def turned(self, days_ago: int, axis: int, turns: float) -> MadeHistory:
        self.wear.append(
            (self.dish, Wear(axis, round(turns * 10), turns * 360.0, round(turns)), self.at(days_ago).date())
        )
        return self

    def limit(self, days_ago: float, name: str, value: str) -> MadeHistory:
        self.rows.append(ToldSetting(self.at(days_ago), self.dish, name, value))
        return self

    def write(self, path: Path) -> Path:
        """Put it on the disk, as a station does."""
        journal, book = Journal(path), WearBook(path)
        for row in sorted(self.rows, key=lambda each: getattr(each, "utc", NOW)):
            journal.append(row)
            if len(self.rows) > 900:
                journal.flush()
        for dish, wear, day in self.wear:
            book.add(dish, wear, day)
        assert journal.flush()
        assert book.flush()
        assert journal.problem is None, journal.problem
        assert book.problem is None
        journal.close()
        book.close()
        return path


def answering(facts=G2, **more) -> StationState:
    """A dish that is well: it answers, is homed, and its TV search is off."""
    told = {
        "driver.azimuth": ("OK", ""), "driver.elevation": ("OK", ""), "lnb_supply": (13.1, "V"),
        "polarisation": ("V", ""), "sleep_timer": (0.0, "s"), "tv_search": (False, ""),
        **more.pop("told", {}),
    }  # fmt: skip
    readings = {
        name: Reading(value, unit, 0.0, NOW) for name, (value, unit) in told.items() if name in facts.features
    }  # fmt: skip
    well = {
        "link": LinkState(LinkPhase.UP, round_trip_s=0.009), "dish": facts, "homed": True, "search": TvSearch.OFF,
        "surveyed": True, "readings": readings,
    }  # fmt: skip
    return StationState(**(well | more))


def out_of_reach(facts=G2) -> StationState:
    """A dish that was not asked: only its kind is known."""
    return StationState(dish=facts)
