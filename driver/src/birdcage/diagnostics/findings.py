"""The rules, and what they find in one dish, the most urgent first.

The next rule is a function in one of the rooms of rules, and its line in `RULES`.
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from birdcage.diagnostics import link_rules, motor_rules, power_rules, setting_rules
from birdcage.diagnostics.examination import Examination, Rule
from birdcage.diagnostics.finding import Finding
from birdcage.diagnostics.history import DishHistory, unseen
from birdcage.station.state import StationState

RULES: tuple[Rule, ...] = (
    motor_rules.failed_homing,
    motor_rules.moved_unasked,
    motor_rules.stalls,
    setting_rules.tv_search,
    power_rules.silent_now,
    motor_rules.drivers,
    power_rules.restarts,
    power_rules.deadlocks,
    setting_rules.not_homed,
    link_rules.replies,
    power_rules.losses,
    setting_rules.changed_limits,
    setting_rules.lnb,
    setting_rules.journal,
    setting_rules.pending,
    motor_rules.stuck_speed,
    motor_rules.wear,
    setting_rules.sleep_timer,
)
"""Of findings that are equally urgent, the earlier rule's come first."""


def findings(
    history: DishHistory, state: StationState, now: datetime, unsaved: Sequence[str] = ()
) -> tuple[Finding, ...]:  # fmt: skip
    """Return what needs somebody, the most urgent first; what was acknowledged is left out (`unseen`).

    `state` of a dish that was not reached has its facts (`StationState.dish`) at most. `unsaved` are the settings that
    were changed and not saved, as the dish calls them (`SettingsTable.unsaved`).
    """
    seen = Examination(history, state, now, tuple(unsaved))
    found = [each for rule in RULES for each in rule(seen)]
    return unseen(sorted(found, key=lambda each: each.urgency), history)
