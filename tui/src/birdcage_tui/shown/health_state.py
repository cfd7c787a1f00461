"""What the Health tab shows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.diagnostics.health import DishHealth
    from birdcage.diagnostics.motor_test_records import MotorTest


@dataclass(frozen=True, slots=True)
class HealthNow:
    """Pure data; none before the journal was read."""

    health: DishHealth | None = None
    read_at: float | None = None
    """Monotonic seconds."""
    motor_tests: tuple[MotorTest, ...] = ()
    """The newest test of each axis."""
    problem: str = ""
    """Why it can't be read, as a sentence."""
