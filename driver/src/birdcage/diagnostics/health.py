"""A dish's health as one value: the findings, the figures, and what was looked at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from birdcage.diagnostics.figures import HealthFigures, health_figures
from birdcage.diagnostics.finding import Finding
from birdcage.diagnostics.findings import findings
from birdcage.diagnostics.history import DAYS, read_history
from birdcage.diagnostics.wording import many, share
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import DRIVER, LNB_SUPPLY, POLARISATION, SLEEP_TIMER, TV_SEARCH
from birdcage.station.state import LinkPhase, StationState
from birdcage.station.wear import dish_key

READ_FOR_HEALTH = (LNB_SUPPLY, POLARISATION, SLEEP_TIMER, TV_SEARCH)
"""The features that the rules look at, those of the drivers apart; what a dish lacks is left out."""


@dataclass(frozen=True, slots=True)
class DishHealth:
    """What needs somebody, and the figures."""

    dish: str
    """The name that its history is kept under."""
    findings: tuple[Finding, ...]
    figures: HealthFigures
    looked_at: str
    """What was looked at, in sentences: `Looked at 30 days of a dish. Counted …`."""

    @property
    def headline(self) -> str:
        """The most urgent finding, or that there is none."""
        return self.findings[0].text if self.findings else "Nothing needs attention."

    @property
    def needs_you(self) -> bool:
        """Whether somebody has to do something."""
        return any(each.needs_you for each in self.findings)


def features_for_health(facts: Facts) -> tuple[str, ...]:
    """Return what has to be read of a dish for its health: ids that `Read` takes."""
    drivers = [each for each in facts.features if each.split(".")[0] == DRIVER]
    return tuple(each for each in (*READ_FOR_HEALTH, *drivers) if each in facts.features)


def read_health(
    journal: Path, state: StationState, now: datetime, *, dish: str | None = None, days: int = DAYS,
    unsaved: Sequence[str] = (),
) -> DishHealth:  # fmt: skip
    """Read the history of the dish in the state, or of `dish` (`list_dishes`), and judge it.

    Any thread, but slow: some files are read.
    """
    if dish is None:
        dish = "" if state.dish is None else dish_key(state.dish.name, demo=state.demo)
    history = read_history(journal, dish, now, days)
    figures = health_figures(history, state, now)
    return DishHealth(dish, findings(history, state, now, unsaved), figures, _looked_at(dish, figures, state))


def _looked_at(dish: str, figures: HealthFigures, state: StationState) -> str:
    link, stalls = figures.link, sum(each.stalls for each in figures.motors)
    moves = sum(each.moves for each in figures.motors)
    parts = [
        many(moves, "move"), many(stalls, "stall"), many(link.restarts, "restart"),
        f"lost replies: {share(link.unanswered, link.asked)}" if link.asked else "lost replies: --",
    ]  # fmt: skip
    of = f" of the {dish}" if dish else ""
    return f"Looked at {many(figures.days, 'day')}{of}. Counted {', '.join(parts)}. {_present(state)}"


def _present(state: StationState) -> str:
    if state.link.state is LinkPhase.UP:
        return "The dish answers, and its present state is included."
    why = "The dish was not asked"
    if state.link.state is LinkPhase.SILENT:
        why = "The dish was asked and did not answer"
    elif state.link.state is LinkPhase.LOST and state.port:
        why = "The dish could not be asked through its port"
    return f"{why}: its present state is unknown."
