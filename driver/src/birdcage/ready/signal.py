"""Whether the program or receiver that the feed's signal is read from tells a level."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from birdcage.ready.check import Check

if TYPE_CHECKING:
    from birdcage.base.config import Settings

WITHIN_S = 4.0
"""rtl_power tells its first level after some seconds."""


def signal(settings: Settings) -> Iterator[Check]:
    """Read one level of it, where the feed names a `[signal.NAME]`. It is begun for that, and ended."""
    from birdcage.base.clock import RealClock
    from birdcage.signal.meter import MeterError
    from birdcage.signal.metered import meter_of

    name = settings.active_feed.signal
    if name not in settings.signals:
        return
    clock, profile = RealClock(), settings.signals[name]
    until = clock.monotonic() + WITHIN_S + 2.0 * profile.dwell_s
    remedy = f"start it, or set signal.{name} in birdcage.toml"
    meter = meter_of(name, settings, clock)
    try:
        meter.open()
        while clock.monotonic() < until:
            level = meter.read(0.2)
            if level is not None:
                yield Check("signal", "signal", "good", f"{name} tells {level.value:.1f} {profile.unit}")
                return
        yield Check("signal", "signal", "look", f"{name} has told no level", remedy)
    except MeterError as error:
        yield Check("signal", "signal", "look", f"{name}: {error}", remedy)
    finally:
        meter.close()
