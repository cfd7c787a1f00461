"""What the Health tab shows, around a stand-in: two findings and the figures of a quiet month."""

from datetime import UTC, datetime, timedelta

from birdcage.diagnostics.figures import DayFigures, HealthFigures, LinkFigures, MotorFigures
from birdcage.diagnostics.finding import Finding, Urgency
from birdcage.diagnostics.health import DishHealth
from birdcage.station.state import TvSearch
from birdcage_tui.shown.health_state import HealthNow

SINCE = datetime(2026, 3, 10, 9, 12, tzinfo=UTC)
STALLS = Finding(
    "stall.elevation", Urgency.HURTS, "EL stalled twice since Tuesday, at 62° and 65°.",
    "Something blocks the arm, or its cable pulls.", ("Look at the cable by the arm.", "Home it."), SINCE, SINCE, 2,
)  # fmt: skip
SLEEP = Finding("sleep", Urgency.NOTE, "Sleep timer (NVS 38): 420 s.", "What sleep does is unknown.", (), lasts=True)
MOTORS = (
    MotorFigures("azimuth", 0, None, None, 1204, 310.0, 290.0, 1204.0, SINCE),
    MotorFigures("elevation", 2, None, None, 640, 120.0, 118.0, None, None),
)
LINK = LinkFigures(0.009, 41220, 3, 1, 0, 1, None, 0, 1, True, TvSearch.OFF, None)
DAYS = tuple(
    DayFigures(SINCE.date() + timedelta(days=number), int(number == 4), int(number == 6), 0, 12 * (number == 8), 3.0)
    for number in range(30)
)
NOW = HealthNow(
    DishHealth("Carryout G2 (demo)", (STALLS, SLEEP), HealthFigures(30, MOTORS, LINK, DAYS), "Looked at 30 days."), 0.0
)
WELL = HealthNow(DishHealth("Carryout G2 (demo)", (), HealthFigures(30, MOTORS, LINK, DAYS), "Looked at 30 days."), 0.0)
