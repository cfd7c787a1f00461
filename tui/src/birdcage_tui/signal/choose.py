"""Which source is heard: each with its unit, its rate, how long it measures, and who has it."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.signal.source import MONITOR

from birdcage_tui.shown.source_choice import SourceChoice
from birdcage_tui.widgets.choice_screen import ChoiceRow, ChoiceScreen


def source_question(choices: Sequence[SourceChoice]) -> ChoiceScreen:
    """Return the list of them."""
    return ChoiceScreen("Source of the signal", [_row(each) for each in choices])


def _row(choice: SourceChoice) -> ChoiceRow:
    """Return what it tells and how often; then where it is, or what is wrong with it."""
    facts = choice.facts
    rate = f"{facts.rate_hz:.1f}/s" if facts.rate_hz >= 0.95 else f"every {1.0 / facts.rate_hz:.0f} s"
    if facts.of_dish:
        rate = "as often as the wire allows"
    dwell = "" if facts.dwell_s is None else f", each {facts.dwell_s:g} s long"
    owner = {"": "", MONITOR: ", in use"}.get(choice.owner, f", in use for {choice.owner}")
    first = f"{facts.label:<10} {facts.unit}, {rate}{dwell}{owner}"
    return ChoiceRow(facts.id, first, choice.trouble or facts.where, choice.chosen, bool(choice.trouble))
