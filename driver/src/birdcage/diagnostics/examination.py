"""All that a rule may look at: the history of a dish, and its present state."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime, timedelta
from functools import cached_property

from birdcage.base.journal_rows import JournalEntry
from birdcage.diagnostics.finding import Finding
from birdcage.diagnostics.history import DishHistory
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import Reading
from birdcage.station.state import LinkPhase, StationState

RECENT = timedelta(days=7)
"""What is younger needs somebody now; what is older is worth knowing."""


@dataclass(frozen=True)
class Examination:
    """A dish under examination. Of a dish that was not reached, the state tells only its facts."""

    history: DishHistory
    state: StationState
    now: datetime
    unsaved: tuple[str, ...] = ()
    """The settings that were changed in the dish and not saved, as it calls them, where they were read."""

    @property
    def facts(self) -> Facts | None:
        """What kind of dish it is; None if that is not known."""
        return self.state.dish

    @property
    def answers(self) -> bool:
        """Whether the dish answers now: only then its state tells something of the present."""
        return self.state.link.state is LinkPhase.UP

    @cached_property
    def faults(self) -> tuple[JournalEntry, ...]:
        """The faults of the days that are judged, with the one that is shown now, should the journal lack it."""
        kept = [each for each in self.history.faults if each.utc >= self.history.begin]
        fault = self.state.fault
        if fault is not None and all(abs(each.utc - fault.utc) > timedelta(seconds=1) for each in kept):
            kept.append(
                JournalEntry(
                    fault.utc, "dish", fault.reason, fault.what, self.history.dish, fault.axis, fault.homing,
                    fault.az_deg, fault.el_deg,
                )
            )  # fmt: skip
        return tuple(sorted(kept, key=lambda each: each.utc))

    def of_reason(self, reason: str, *, homing: bool = False) -> list[JournalEntry]:
        """Return the faults of one reason, oldest first."""
        return [each for each in self.faults if each.reason == reason and each.homing is homing]

    def is_recent(self, moment: datetime) -> bool:
        """Return whether something happened in the last days."""
        return moment > self.now - RECENT

    def reading(self, feature: str) -> Reading | None:
        """Return what the dish told of a feature; None if it did not, or does not answer now."""
        return self.state.readings.get(feature) if self.answers else None

    @property
    def switch(self) -> str:
        """What cuts the dish's power."""
        return "power switch" if self.facts is None else self.facts.power_switch

    @property
    def home_it(self) -> str:
        """How this dish finds its references, as a step."""
        if self.facts is not None and self.facts.must_be_synced:
            return "Look along it and sync it: Y in the app, or `birdcage sync AZ EL`."
        if self.facts is not None and self.facts.no_homing:
            return self.facts.no_homing
        stops = self.facts is not None and self.facts.homing_stoppable
        return f"Home it: H in the app, or `birdcage home`. Keep clear{'' if stops else ': no STOP ends a homing'}."


Rule = Callable[[Examination], Iterator[Finding]]
"""Looks at one thing, and yields what it finds; nothing where all is well."""
