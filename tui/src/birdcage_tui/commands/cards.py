"""Commands of the dashboard's row of cards, where no other command does it already."""

from __future__ import annotations

from birdcage_tui.commands.signal import can_find
from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext
from birdcage_tui.shown.next_passes import next_pass
from birdcage_tui.shown.pass_words import clock_text

WHERE = ("dashboard",)


def can_show_next(context: CommandContext) -> str | None:
    """Return why there is no next pass to plan."""
    sky = context.sky
    if sky is None:
        return "No passes yet."
    if next_pass(sky, sky.t_s, context.state) is not None:
        return None
    if sky.problem or sky.note:
        return sky.problem or sky.note
    if sky.searched is None or sky.searched < 1.0 or sky.until_s is None:
        return "Passes are still being computed."
    return f"No pass in reach until {clock_text(sky.until_s, seconds=False)}Z."


CARDS = (
    Command(
        "next-pass", ("n",), "n", "Next pass",
        "Show the plan of the next pass in reach on F2. Nothing moves until you press Enter there.",
        "Passes", can_show_next, where=WHERE,
    ),
    Command(
        "scan-sky", ("w",), "w", "Scan the sky …",
        "Map a region of the sky on F3, live. An estimate shows before it begins.",
        "Signal", can_find, where=WHERE,
    ),
)  # fmt: skip
