"""The rows beneath the findings: motors, link and power in figures."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime, timedelta

from birdcage.base.journal_rows import DishIncident, IncidentKind
from birdcage.diagnostics.examination import Examination
from birdcage.diagnostics.history import DishHistory
from birdcage.diagnostics.motor_rules import TURN_DEG
from birdcage.diagnostics.power_rules import all_restarts
from birdcage.rotator.feature import DRIVER, LNB_SUPPLY, Reading
from birdcage.station.state import FaultReason, StationState, TvSearch


@dataclass(frozen=True, slots=True)
class MotorFigures:
    """One axis. What is not known is None."""

    axis: str
    """Its name."""
    stalls: int
    """In the days that are judged; a failed homing counts."""
    driver: Reading | None
    """What its driver tells of itself now."""
    driver_is_good: bool | None
    moves: int
    """In the days that are judged."""
    turns: float
    """In the days that are judged: degrees there and back, in full circles."""
    turns_before: float
    """In as many days before them."""
    turns_in_all: float | None
    """Since `counted_since`; None where nothing was counted."""
    counted_since: datetime | None


@dataclass(frozen=True, slots=True)
class LinkFigures:
    """Line, power and what stands in the dish now. What is not known is None."""

    round_trip_s: float | None
    asked: int
    """Lines that were sent in the days that are judged."""
    unanswered: int
    late: int
    """Answers that came later than a stream of targets could wait for."""
    stray_bytes: int
    restarts: int
    """Restarts, whoever caused them."""
    last_restart: DishIncident | None
    silences: int
    """How often the dish stopped answering."""
    port_losses: int
    """How often the port went away."""
    homed: bool | None
    search: TvSearch
    lnb_supply: Reading | None


@dataclass(frozen=True, slots=True)
class DayFigures:
    """One UTC day."""

    day: date
    stalls: int
    restarts: int
    losses: int
    """How often the dish stopped answering, or its port went away."""
    unanswered: int
    turns: float
    """Of all axes together, in full circles."""


@dataclass(frozen=True, slots=True)
class HealthFigures:
    """All of them."""

    days: int
    """How many days are judged."""
    motors: tuple[MotorFigures, ...]
    link: LinkFigures
    by_day: tuple[DayFigures, ...] = ()
    """The days that are judged, the oldest first."""


def health_figures(history: DishHistory, state: StationState, now: datetime) -> HealthFigures:
    """Return the figures of a dish. Of one whose kind is not known, no motor is told."""
    seen = Examination(history, state, now)
    first, end = history.span
    restarts = all_restarts(seen)
    counted = history.asked(first, end)
    link = LinkFigures(
        round_trip_s=state.link.round_trip_s if seen.answers else None,
        asked=counted.asked, unanswered=counted.unanswered, late=counted.late, stray_bytes=counted.stray_bytes,
        restarts=len(restarts),
        last_restart=restarts[-1] if restarts else None,
        silences=len(history.recent_incidents(IncidentKind.SILENT)),
        port_losses=len(history.recent_incidents(IncidentKind.LOST)),
        homed=state.homed if seen.answers else None,
        search=state.search if seen.answers else TvSearch.UNKNOWN,
        lnb_supply=seen.reading(LNB_SUPPLY),
    )  # fmt: skip
    return HealthFigures(history.days, _motors(seen), link, tuple(_day(seen, day) for day in _days(first, end)))


def _days(first: date, end: date) -> list[date]:
    return [first + timedelta(days=number) for number in range((end - first).days)]


def _day(seen: Examination, day: date) -> DayFigures:
    history, after = seen.history, day + timedelta(days=1)
    losses = history.recent_incidents(IncidentKind.SILENT, IncidentKind.LOST)
    numbers = {each.axis for each in history.wear}
    return DayFigures(
        day,
        sum(each.reason == FaultReason.STALL and each.utc.date() == day for each in seen.faults),
        sum(each.utc.date() == day for each in all_restarts(seen)),
        sum(each.utc.date() == day for each in losses),
        history.asked(day, after).unanswered,
        sum(history.worn(number, day, after).degrees for number in numbers) / TURN_DEG,
    )


def _motors(seen: Examination) -> tuple[MotorFigures, ...]:
    if seen.facts is None:
        return ()
    history, found = seen.history, []
    first, end = history.span
    before = first - timedelta(days=history.days)
    stalled = [each for each in seen.faults if each.reason == FaultReason.STALL]
    for number, axis in seen.facts.numbered.items():
        feature_id = f"{DRIVER}.{axis.name}"
        feature, driver = seen.facts.features.get(feature_id), seen.reading(feature_id)
        mark = None if feature is None else feature.health
        now, earlier = history.worn(number, first, end), history.worn(number, before, first)
        total = next((each for each in history.totals if each.axis == number), None)
        found.append(
            MotorFigures(
                axis.name, sum(each.axis == axis.name for each in stalled), driver,
                None if mark is None or driver is None else mark.is_good(driver.value), now.moves,
                now.degrees / TURN_DEG, earlier.degrees / TURN_DEG, None if total is None else total.degrees / TURN_DEG,
                None if total is None else total.since,
            )
        )  # fmt: skip
    return tuple(found)
