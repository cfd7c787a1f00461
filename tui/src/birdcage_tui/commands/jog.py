"""Steps by hand, on the pages that show where the dish points."""

from __future__ import annotations

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext, can_step

WHERE = ("dashboard", "control", "signal", "pocket")
STEPPED = (*WHERE, "calibrate")
STEPS_DEG = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
"""What one press of a jog key may be, in degrees."""
DIRECTIONS = {"left": (-1.0, 0.0), "right": (1.0, 0.0), "up": (0.0, 1.0), "down": (0.0, -1.0)}
"""Azimuth and elevation of one press, in steps."""

SKEW_DIRECTIONS = {"skew-down": -1.0, "skew-up": 1.0}
"""The same of the skew."""


def can_turn_skew(context: CommandContext) -> str | None:
    """Return why the skew cannot be turned now, or not at all."""
    dish = context.state.dish
    if dish is not None and dish.skew is None:
        return f"The {dish.name} has no skew axis."
    return can_step(context)


JOG = (
    Command(
        "left", ("left", "h"), "← h", "Step counterclockwise", "One azimuth step.", "Jog",
        can_step, where=WHERE,
    ),
    Command(
        "right", ("right", "l"), "→ l", "Step clockwise", "One azimuth step.", "Jog", can_step,
        where=WHERE,
    ),
    Command("up", ("up", "k"), "↑ k", "Step up", "One elevation step.", "Jog", can_step, where=WHERE),
    Command("down", ("down", "j"), "↓ j", "Step down", "One elevation step.", "Jog", can_step, where=WHERE),
    Command(
        "skew-down", ("less_than_sign",), "<", "Skew down a step", "One skew step, on a dish with a skew axis.", "Jog",
        can_turn_skew, where=WHERE,
    ),
    Command(
        "skew-up", ("greater_than_sign",), ">", "Skew up a step", "One skew step, on a dish with a skew axis.", "Jog",
        can_turn_skew, where=WHERE,
    ),
    Command(
        "skew", ("S",), "S", "Turn the skew to …", "Type an angle. Enter turns the feed.", "Jog",
        can_turn_skew, where=WHERE,
    ),
    Command(
        "step-down", ("minus",), "-", "Smaller step", "From 10° down to 0.01°.", "Jog", where=STEPPED,
    ),
    Command(
        "step-up", ("plus", "equals_sign"), "+", "Larger step", "From 0.01° up to 10°.", "Jog", where=STEPPED,
        footer="step",
    ),
)  # fmt: skip
