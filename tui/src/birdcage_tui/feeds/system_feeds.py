"""What the System page reads and does, tab by tab."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from birdcage.base.clock import Clock
from birdcage.station.access import FaceStation

from birdcage_tui.feeds.health_feed import HealthFeed
from birdcage_tui.feeds.motor_run_feed import MotorRunFeed
from birdcage_tui.feeds.own_settings_feed import OwnSettingsFeed
from birdcage_tui.feeds.sheet_feed import SheetFeed


class SystemFeeds:
    """One feed for each kind of tab; none reads before somebody looks."""

    def __init__(
        self, station: FaceStation, clock: Clock, soon: Callable[[Callable[[], None]], object],
        changed: Callable[[], None], say: Callable[[str], object], *, backups: Path | None, journal: Path | None,
    ) -> None:  # fmt: skip
        self.sheets = SheetFeed(station, clock, soon, changed, say)
        """What the dish tells, and lets be set."""
        self.motor_run = MotorRunFeed(station, clock, soon, say)
        """Runs a motor while its key is held."""
        self.own_settings = OwnSettingsFeed(station, clock, soon, changed, say, backups)
        """The settings that the dish keeps itself."""
        self.health = HealthFeed(
            station, clock, soon, changed, journal, settings=lambda: self.own_settings.now.table
        )  # fmt: skip
        """What needs somebody."""
