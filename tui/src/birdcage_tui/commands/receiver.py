"""Commands that set the receiver in the dish, on the signal page."""

from __future__ import annotations

from birdcage.rotator.feature import ENABLE_LNA, EVEN_LEVEL, TRANSPONDER
from birdcage.station.state import LinkPhase

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext
from birdcage_tui.shown.view import YOU

WHERE = ("signal",)


def _can_set(context: CommandContext, feature: str, lacks: str) -> str | None:
    """Return why a feature of the dish can't be set now; `lacks` says what a dish without it has not."""
    state = context.state
    if state.dish is None or state.link.state is not LinkPhase.UP:
        return "The dish does not answer."
    if feature not in state.dish.features or not state.dish.features[feature].is_writable:
        return f"The {state.dish.name} has no {lacks}."
    if state.held is not None:
        return "STOP is latched. Enter releases it."
    if state.holder not in (None, YOU):
        return f"{state.holder} has control."
    return None


def can_supply(context: CommandContext) -> str | None:
    """Return why the LNB can't be fed with 13 V now."""
    return _can_set(context, ENABLE_LNA, "command for the supply of its LNB")


def can_tune(context: CommandContext) -> str | None:
    """Return why the dish's tuner can't be tuned now."""
    return _can_set(context, TRANSPONDER, "tuner that can be tuned")


def can_hear_both(context: CommandContext) -> str | None:
    """Return why the dish's tuner can't hear both polarisations in turn now."""
    state = context.state
    if state.dish is None or state.link.state is not LinkPhase.UP:
        return "The dish does not answer."
    if EVEN_LEVEL not in state.dish.features:
        return f"The {state.dish.name} has no command that hears both polarisations."
    return None


RECEIVER = (
    Command(
        "signal-transponder", ("n",), "n", "Transponder …", "Tune the dish's own receiver to a transponder.", "Signal",
        can_tune, where=WHERE,
    ),
    Command(
        "signal-13v", ("V",), "V", "13 V for the LNB …",
        "Switch the supply of the LNB from 18 V to 13 V, after a question.", "Signal", can_supply, where=WHERE,
    ),
    Command(
        "signal-polarisations", ("b",), "b", "Both polarisations …",
        "Show horizontal and vertical over time, after a question: each reading switches the LNB's supply.", "Signal",
        can_hear_both, where=WHERE,
    ),
)  # fmt: skip
