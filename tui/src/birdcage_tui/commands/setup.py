"""Commands of the setup page alone."""

from __future__ import annotations

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import can_move

WHERE = ("setup",)

SETUP = (
    Command(
        "setup-do", ("enter",), "Enter", "Do the step",
        "Do the usual action of this step. While STOP is latched or a fault waits, release that first.",
        "Setup", where=WHERE, footer="do step",
    ),
    Command("setup-up", ("up",), "↑", "Step above", "Show the step above. The dish doesn't move.", "Setup",
            where=WHERE),
    Command("setup-down", ("down",), "↓", "Step below", "Show the step below. The dish doesn't move.", "Setup",
            where=WHERE),
    Command("setup-skip", ("s",), "s", "Skip the step", "Leave this step open and go on.", "Setup",
            where=WHERE, footer="skip"),
    Command("setup-back", ("b",), "b", "Back a step",
            "Go to the previous step; from a preview, to the current one.", "Setup", where=WHERE, footer="back"),
    Command("setup-open", ("o",), "o", "Open the page of this step",
            "Open the page for this step. 8 comes back.", "Setup", where=WHERE, footer="page"),
    Command("setup-wiring", ("w",), "w", "Wiring", "Show the connector, its wires and warnings. w goes back.", "Setup",
            where=WHERE, footer="wiring"),
    Command("setup-next-cause", ("right",), "→", "Next cause", "Show the next likely cause.", "Setup",
            where=WHERE),
    Command("setup-previous-cause", ("left",), "←", "Previous cause", "Show the previous cause.", "Setup",
            where=WHERE),
    Command("setup-first", ("F",), "F", "First satellite", "Show the last step: a satellite is found by its signal.",
            "Setup", where=WHERE),
    Command("setup-goto", ("g",), "g", "Go to …", "Type a direction once the area is clear.", "Motion", can_move,
            where=WHERE),
)  # fmt: skip
