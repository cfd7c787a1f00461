"""Commands of the System page: its tabs, reading and setting what the dish tells, its own settings, its health."""

from __future__ import annotations

from birdcage.station.state import LinkPhase

from birdcage_tui.commands.table import Command, Reason, always
from birdcage_tui.shown.allowed import CommandContext, can_move

PAGE = "system"
HERE, SHEET, SETTINGS, HEALTH = (PAGE,), ("system-sheet",), ("system-settings",), ("system-health",)


def can_ask_dish(context: CommandContext) -> str | None:
    """Return why the dish cannot be asked for anything."""
    return None if context.state.link.state is LinkPhase.UP else "The dish does not answer."


def can_test_motors(context: CommandContext) -> str | None:
    """Return why the motors can't be tested now."""
    from birdcage.diagnostics.motor_test_words import not_measured

    dish = context.state.dish
    unmeasured = "" if dish is None else not_measured(dish)
    return can_move(context) or unmeasured or None


def _tab(name: str, key: str, title: str, text: str) -> Command:
    return Command(f"system-{name}", (key,), key, title, text, "Tabs", where=HERE)


def _sheet(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, refused: Reason = always,
           footer: str = "") -> Command:  # fmt: skip
    return Command(f"sheet-{name}", keys, shown, title, text, "Values", refused, footer, SHEET, page=PAGE)


def can_change_settings(context: CommandContext) -> str | None:
    """Return why none of the dish's own settings can be written."""
    dish = context.state.dish
    if dish is not None and not dish.has_own_settings:
        return f"The {dish.name} has no settings that can be read."
    return can_ask_dish(context)


def _settings(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, refused: Reason = always,
              footer: str = "") -> Command:  # fmt: skip
    return Command(f"settings-{name}", keys, shown, title, text, "NVS", refused, footer, SETTINGS, page=PAGE)


def _health(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, refused: Reason = always,
            footer: str = "") -> Command:  # fmt: skip
    return Command(f"health-{name}", keys, shown, title, text, "Health", refused, footer, HEALTH, page=PAGE)


SYSTEM = (
    _tab("health", "h", "Health", "What needs attention, and what to do about it."),
    _tab("hardware", "b", "Hardware", "Firmware, board, drivers, pins, switches, memory."),
    _tab("motors", "m", "Motors", "Speeds, accelerations, gains, positions; what may be set."),
    _tab("settings", "n", "NVS", "The dish's own settings: look, edit, save, back up, restore."),
    _tab("receiver", "d", "DVB", "Tuner, channel, transponders, DiSEqC."),
    Command("system-read", ("r",), "r", "Read now", "Read this tab. What switches something asks first.", "System",
            can_ask_dish, "read", where=HERE),
    _sheet("up", ("up", "k"), "↑ k", "Row above", "Select the row above."),
    _sheet("down", ("down", "j"), "↓ j", "Row below", "Select the row below."),
    _sheet("left", ("left",), "←", "Axis to the left", "Select the value of the axis to the left."),
    _sheet("right", ("right",), "→", "Axis to the right", "Select the value of the axis to the right."),
    _sheet("page-up", ("pageup",), "PgUp", "A page up", "Select a row further up."),
    _sheet("page-down", ("pagedown",), "PgDn", "A page down", "Select a row further down."),
    _sheet("open", ("enter",), "Enter", "Show all", "Show all lines of the value, its source, limits and hazards.",
           footer="show all"),
    _sheet("set", ("e",), "e", "Set …", "Set the value: range, old value, hazard. Asks first.", can_ask_dish, "set"),
    _sheet("test", ("t",), "t", "Test the motors …",
           "Measure speed and acceleration against nominal, and watch for stalls. The dish moves. Asks first.",
           can_test_motors),
    _sheet("run", ("plus", "equals_sign"), "+", "Run the motor while held",
           "Turn the selected motor up or clockwise. Letting go sends STOP. Asks first.", can_move),
    _sheet("run-back", ("minus",), "-", "Run it back while held", "The same, down or counterclockwise.", can_move),
    _sheet("undo", ("u",), "u", "Undo", "Put back the value that was set last. Asks first.", can_ask_dish, "undo"),
    _settings("up", ("up", "k"), "↑ k", "Row above", "Select the row above."),
    _settings("down", ("down", "j"), "↓ j", "Row below", "Select the row below."),
    _settings("page-up", ("pageup",), "PgUp", "A page up", "Select a row further up."),
    _settings("page-down", ("pagedown",), "PgDn", "A page down", "Select a row further down."),
    _settings("open", ("enter",), "Enter", "What is it", "Show what is known of the row, and what it risks."),
    _settings("edit", ("e",), "e", "Edit …", "Type a new value. Nothing is written yet.", can_change_settings, "edit"),
    _settings("drop", ("x", "delete"), "x", "Drop the edit", "Forget the new value of this row."),
    _settings("write", ("w",), "w", "Write …", "Show old and new values, then write them to the dish's memory.",
              can_change_settings, "write"),
    _settings("save", ("s",), "s", "Save …", "Save the dish's memory to flash. It counts from the next power cycle.",
              can_change_settings, "save"),
    _settings("undo", ("u",), "u", "Undo", "Drop all edits; with none, bring back what the last write replaced.",
              footer="undo"),
    _settings("filter", ("slash",), "/", "Filter rows", "Type part of a name, number or value.", footer="filter"),
    _settings("modified", ("o",), "o", "Only modified", "Show only rows that are not as the factory left them."),
    _settings("backup", ("B",), "B", "Back up", "Write the whole table to a file.", can_change_settings),
    _settings("restore", ("R",), "R", "Restore …", "Mark the rows that differ from a backup. w writes them.",
              can_change_settings),
    _settings("compare", ("c",), "c", "Compare …", "Show how the dish differs from a backup.", can_change_settings),
    _health("up", ("up", "k"), "↑ k", "Row above", "Select the row above."),
    _health("down", ("down", "j"), "↓ j", "Row below", "Select the row below."),
    _health("open", ("enter",), "Enter", "Explain", "Show why, and what to do.", footer="explain"),
    _health("acknowledge", ("a",), "a", "Acknowledge", "You have seen it. It comes back when it happens again.",
            footer="acknowledge"),
)  # fmt: skip
