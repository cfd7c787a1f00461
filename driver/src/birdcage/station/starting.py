"""A dish that starts by itself: homes, prints its log meanwhile, and then searches for TV satellites."""

from __future__ import annotations

import math

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.rotator.facts import SearchSwitch
from birdcage.station.mover import Mover
from birdcage.station.state import Activity, LinkPhase, TvSearch
from birdcage.station.state_store import StateStore

LOG_LINES = 3
"""So many lines from a dish that does not answer are a log; fewer may be late answers."""
UNREADABLE = "\N{REPLACEMENT CHARACTER}"


class Starting:
    """For a dish that can be homed by its power alone; of any other only its boot marks tell."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna, mover: Mover) -> None:
        self._store, self._antenna, self._mover = store, antenna, mover
        self._heard = 0
        self._marks: set[str] = set()
        """The boot marks of the last start that was heard."""
        self._mark_at = -math.inf

    def begins_by(self, mark: str) -> bool:
        """Take in a boot mark; return whether another start began than the one before, as each comes once in one."""
        now = self._store.clock.monotonic()
        is_new = mark in self._marks or now > self._mark_at + self._antenna.rotator.facts.boot_s
        self._marks, self._mark_at = ({mark} if is_new else self._marks | {mark}), now
        return is_new

    def hear(self, line: str, *, met: bool) -> None:
        """Take in an unsolicited line; a log that streams while nothing answers is shown."""
        if self._antenna.rotator.facts.homing_s is not None or self._store.state.link.state is LinkPhase.UP:
            return
        if UNREADABLE in line or (met and self._antenna.rotator.is_answer(line)):
            return
        self._heard += 1
        if self._heard >= (LOG_LINES if met else 1):
            self._mover.activity(Activity.INITIALIZING, line.strip())

    def ended(self) -> None:
        """A boot mark came: where the search can't be switched off for good, it begins now."""
        if self._antenna.rotator.facts.search_switch is SearchSwitch.UNTIL_POWER_UP:
            self._store.change(search=TvSearch.RUNNING)

    def answers(self) -> None:
        """The dish answers: what it printed until now is done."""
        self._heard = 0
