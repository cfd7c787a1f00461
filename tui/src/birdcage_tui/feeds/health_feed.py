"""Judges the dish's health beside the app's thread, while somebody looks at it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.errors import BirdcageError, StoreError
from birdcage.diagnostics.finding import Finding
from birdcage.rotator.own_settings import SettingsTable
from birdcage.station.access import FaceStation
from birdcage.station.requests import Read

from birdcage_tui.feeds.dish_seen import DishSeen
from birdcage_tui.feeds.sheet_feed import LOOKED_S
from birdcage_tui.shown.health_state import HealthNow
from birdcage_tui.shown.system_sheet import waits_for

if TYPE_CHECKING:
    from birdcage.diagnostics.motor_test_records import MotorTest

AGAIN_S = 10.0
"""How often the journal is read while somebody looks."""
ASK_AGAIN_S = 60.0
"""How often the dish is asked for what the rules look at."""
Work = Callable[[], None]


def in_a_thread(work: Work) -> None:
    """Do it on a thread that does not keep the app from ending."""
    threading.Thread(target=work, name="health", daemon=True).start()


class HealthFeed:
    """For the app's thread; the journal is read on another one."""

    def __init__(
        self, station: FaceStation, clock: Clock, soon: Callable[[Work], object], changed: Work, journal: Path | None,
        *, settings: Callable[[], SettingsTable | None], beside: Callable[[Work], None] = in_a_thread,
    ) -> None:  # fmt: skip
        """Without a `journal` nothing is judged. `settings`: the dish's own, as far as they were read."""
        self._station, self._clock, self._soon, self._changed = station, clock, soon, changed
        self._journal, self._settings, self.beside = journal, settings, beside
        self.now = HealthNow(problem="" if journal is not None else "This app keeps no journal.")
        self._reads, self._seen = False, DishSeen()
        self._looked_at = self._asked_at = -ASK_AGAIN_S

    def look(self) -> None:
        """Somebody looks: judge on arrival and now and then, and have the dish asked for what the rules look at."""
        now = self._clock.monotonic()
        if self._seen.is_another(self._station.state):
            self.now, self._asked_at = HealthNow(problem=self.now.problem), -ASK_AGAIN_S
        arrived, self._looked_at = now - self._looked_at > LOOKED_S, now
        self._ask(now)
        if arrived or self.now.read_at is None or now - self.now.read_at >= AGAIN_S:
            self.read()

    def _ask(self, now: float) -> None:
        """Ask the dish for what the rules look at, where it was told too long ago."""
        from birdcage.diagnostics.health import features_for_health

        state = self._station.state
        if state.dish is None or waits_for(state) or now - self._asked_at < ASK_AGAIN_S:
            return
        due = [
            each for each in features_for_health(state.dish)
            if (told := state.readings.get(each)) is None or now - told.at > ASK_AGAIN_S
        ]  # fmt: skip
        self._asked_at = now
        if due:
            self._station.submit(Read(tuple(due))).add_done_callback(lambda _done: self._soon(self.read))

    def read(self) -> None:
        """Judge now; where that is being done already, its result comes soon."""
        if self._reads or self._journal is None or self._station.state.dish is None:
            return
        self._reads = True
        self.beside(partial(self._work, self._journal))

    def _work(self, journal: Path) -> None:
        from birdcage.diagnostics.health import read_health

        table = self._settings()
        unsaved = () if table is None else tuple(f"row {row.index} ({row.name})" for row in table.unsaved)
        found = self.now
        try:
            health = read_health(journal, self._station.state, self._clock.utc(), unsaved=unsaved)
            found = HealthNow(health, self._clock.monotonic(), _last_tests(journal, health.dish))
        except (BirdcageError, OSError) as error:
            found = replace(found, problem=str(error), read_at=self._clock.monotonic())
        finally:  # whatever happens, the next look judges again
            self._soon(partial(self._have, found))

    def _have(self, found: HealthNow) -> None:
        self._reads, self.now = False, found
        self._changed()

    def acknowledge(self, finding: Finding, say: Callable[[str], object]) -> None:
        """Keep that a person has seen a finding; `say` hears what came of it."""
        health, journal = self.now.health, self._journal
        if health is None or journal is None:
            return

        def work() -> None:
            from birdcage.diagnostics.history import acknowledge

            try:
                acknowledge(journal, health.dish, finding, self._clock.utc())
                words = f"Acknowledged {finding.seen_until(health.figures.days)}."
            except (BirdcageError, OSError) as error:
                words = str(error)
            self._soon(partial(self._have_told, words, say))

        self.beside(work)

    def _have_told(self, words: str, say: Callable[[str], object]) -> None:
        say(words)
        self.read()


def _last_tests(journal: Path, dish: str) -> tuple[MotorTest, ...]:
    """Return the newest motor test of each axis; none of a journal that can't be read, which the health tells."""
    from birdcage.diagnostics.motor_test_records import read_motor_tests

    try:
        return tuple({each.axis: each for each in reversed(read_motor_tests(journal, dish))}.values())
    except StoreError:
        return ()
