"""Commands of the pocket view's list of passes."""

from __future__ import annotations

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.view import View

PAGE, LIST = "pocket", ("pocket-passes",)


def can_list(view: View) -> str | None:
    """Return why there is no list: larger pages have one of their own."""
    return None if PAGE in view.scopes else "Only below 80x24. Larger: Passes (7)."


def can_walk(view: View) -> str | None:
    """Return why the list cannot be walked."""
    return can_list(view) or (None if LIST[0] in view.scopes else "f lists the passes first.")


def can_pick(view: View) -> str | None:
    """Return why no pass can be picked; while something is held, Enter releases that first, as everywhere."""
    if (reason := can_walk(view)) is not None:
        return reason
    if can_release(view) is None:
        return None
    if view.track is None:
        return "The tracker is still loading."
    return None if view.sky is not None and view.sky.rows else "No passes yet."


POCKET = (
    Command("pocket-passes", ("f",), "f", "Next passes", "List the next passes in reach, to follow one.", "Passes",
            can_list, "passes", (PAGE,), page=PAGE),
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
