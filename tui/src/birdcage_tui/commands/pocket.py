"""Commands of the pocket view's list of passes."""

from __future__ import annotations

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext, can_release

PAGE, LIST = "pocket", ("pocket-passes",)


def can_list(context: CommandContext) -> str | None:
    """Return why there is no list: larger pages have one of their own."""
    return None if PAGE in context.scopes else "Only below 80x24. Larger: Passes (7)."


def can_see_map(context: CommandContext) -> str | None:
    """Return why there is no map to look at."""
    return (
        can_list(context) or ("" if context.has_map else "No map is open. F3 of a larger terminal begins one.") or None
    )


def can_walk(context: CommandContext) -> str | None:
    """Return why the list cannot be walked."""
    return can_list(context) or (None if LIST[0] in context.scopes else "f lists the passes first.")


def can_pick(context: CommandContext) -> str | None:
    """Return why no pass can be picked; while something is held, Enter releases that first, as everywhere."""
    if (reason := can_walk(context)) is not None:
        return reason
    if can_release(context) is None:
        return None
    if context.track is None:
        return "The tracker is still loading."
    return None if context.sky is not None and context.sky.rows else "No passes yet."


POCKET = (
    Command("pocket-passes", ("f",), "f", "Next passes", "List the next passes in reach, to follow one.", "Passes",
            can_list, "passes", (PAGE,), page=PAGE),
    Command("pocket-map", ("m",), "m", "Map of the sky", "Show the map that is open on F3, or the readings again.",
            "Map", can_see_map, where=(PAGE,), page=PAGE),
    Command("pocket-pass-up", ("up", "k"), "↑ k", "Pass above", "Select the row above.", "Passes", can_walk,
            where=LIST, page=PAGE),
    Command("pocket-pass-down", ("down", "j"), "↓ j", "Pass below", "Select the row below.", "Passes", can_walk,
            where=LIST, page=PAGE),
    Command("pocket-pick", ("enter", "right", "l"), "Enter", "Plan and follow",
            "Show where the dish would go for the selected pass. Nothing moves until you press Enter again.", "Passes",
            can_pick, "plan", LIST, page=PAGE),
    Command("pocket-back", ("left", "h"), "← h", "Back", "Close the list. Esc does it at rest.", "Passes", can_walk,
            "back", LIST, page=PAGE),
)  # fmt: skip
