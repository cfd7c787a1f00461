"""Whether this computer runs on its battery, and for how much longer."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Battery:
    """What the system tells of it."""

    percent: float
    on_mains: bool | None
    """Whether the computer runs on mains power; None if the system does not say."""

    def is_low(self, percent: float) -> bool:
        """Return whether it is used, and has no more than this left."""
        return self.on_mains is False and self.percent <= percent


def read_battery() -> Battery | None:
    """Return it; None on a computer that has none, or does not tell."""
    import psutil  # only where something runs for hours

    try:
        told = psutil.sensors_battery()
    except (AttributeError, OSError, RuntimeError, ValueError):  # a system without it, or one that tells nonsense
        return None
    return None if told is None else Battery(float(told.percent), told.power_plugged)
