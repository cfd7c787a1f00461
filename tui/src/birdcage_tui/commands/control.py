"""Commands of the control page, of its digits, and of its list of presets."""

from __future__ import annotations

from birdcage.base.config import feed_label
from birdcage.station.state import LinkPhase

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext, can_move, can_release

PAGE, HERE = "control", ("control",)
DIGITS, PRESETS = ("digits",), ("presets",)


def can_power(context: CommandContext) -> str | None:
    """Return why the motors' current cannot be switched now. STOP's hold is no reason: it moves nothing."""
    state, dish = context.state, context.state.dish
    if state.link.state is not LinkPhase.UP:
        return "The dish does not answer."
    if dish is not None and not dish.has_motor_power:
        return f"The {dish.name} has no motor current command."
    return None


def can_engage(context: CommandContext) -> str | None:
    """Return why the current cannot be put on now: the dish may jerk, so that is a motion."""
    state = context.state
    if state.link.state is LinkPhase.UP and state.held is not None:
        return "STOP is latched. Enter releases it."
    return can_power(context)


def can_stow(context: CommandContext) -> str | None:
    """Return why the dish cannot be folded flat now."""
    state = context.state
    if state.link.state is not LinkPhase.UP or state.dish is None:
        return "The dish does not answer."
    if not state.dish.has_stow:
        return f"The {state.dish.name} has no stow."
    if not state.stow_allowed:
        return f"Stow is locked by the feed {feed_label(state.feed_name) or 'in use'}."
    return can_move(context)


def can_set_speed(context: CommandContext) -> str | None:
    """Return why no speed can be set."""
    state, dish = context.state, context.state.dish
    if state.link.state is not LinkPhase.UP or dish is None:
        return "The dish does not answer."
    return None if dish.has_speeds else "This dish has no speed setting."


def can_go(context: CommandContext) -> str | None:
    """Return why Enter on a preset does nothing; while something is held, it releases that first, as everywhere."""
    return None if can_release(context) is None else can_move(context)


CONTROL = (
    Command(
        "digits", ("n",), "n", "Nudge digits", "Step one digit of the target up or down.",
        "Control", where=HERE, footer="digits",
    ),
    Command(
        "presets", ("p",), "p", "Presets", "Show the saved directions.", "Control", where=HERE,
        footer="presets",
    ),
    Command(
        "engage", ("E",), "E", "Engage the motors …", "Switch the motor current on. Asks first.", "Control", can_engage,
        where=HERE,
    ),
    Command(
        "release-motors", ("R",), "R", "Release the motors …", "Current off: the dish may fall. Asks first.",
        "Control", can_power, where=HERE,
    ),
    Command("stow", ("W",), "W", "Stow …", "Fold the dish flat. Asks first.", "Control", can_stow, where=HERE),
    Command(
        "speeds", ("v",), "v", "Maximum speeds …", "In degrees a second, until the dish restarts.", "Control",
        can_set_speed, where=HERE,
    ),
    Command(
        "preset-add", ("a",), "a", "Save as preset …", "Save the current direction.", "Presets", where=HERE,
    ),
    Command("preset-undo", ("u",), "u", "Undo deletion", "Restore the last deleted preset.", "Presets", where=HERE),
    Command("preset-filter", ("slash",), "/", "Filter presets", "Type part of a name or note.", "Presets", where=HERE),
    Command(
        "digit-left", ("left", "h"), "← h", "Digit to the left", "Select a coarser digit.", "Digits", where=DIGITS,
        page=PAGE,
    ),
    Command(
        "digit-right", ("right", "l"), "→ l", "Digit to the right", "Select a finer digit.", "Digits", where=DIGITS,
        page=PAGE, footer="digit",
    ),
    Command(
        "digit-up", ("up", "k"), "↑ k", "Digit up", "Step this digit of the target up.", "Digits", can_move,
        where=DIGITS, page=PAGE, footer="nudge",
    ),
    Command(
        "digit-down", ("down", "j"), "↓ j", "Digit down", "Step this digit of the target down.", "Digits",
        can_move, where=DIGITS, page=PAGE,
    ),
    Command(
        "preset-go", ("enter",), "Enter", "Go to the preset", "Turn the dish to the selected preset.",
        "Presets", can_go, "go", where=PRESETS, page=PAGE,
    ),
    Command("preset-up", ("up", "k"), "↑ k", "Preset above", "Select the row above.", "Presets", where=PRESETS,
            page=PAGE),
    Command("preset-down", ("down", "j"), "↓ j", "Preset below", "Select the row below.", "Presets", where=PRESETS,
            page=PAGE),
    Command("preset-edit", ("e",), "e", "Edit the preset …", "Name, azimuth, elevation, note.", "Presets",
            where=PRESETS, page=PAGE, footer="edit"),
    Command("preset-delete", ("d", "delete"), "d", "Delete the preset", "u restores it.", "Presets", where=PRESETS,
            page=PAGE, footer="delete"),
)  # fmt: skip
