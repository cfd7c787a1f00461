"""Commands of the setup page alone."""

from __future__ import annotations

from birdcage_tui.commands.table import Command, can_move

WHERE = ("setup",)

SETUP = (
    Command(
        "setup-do", ("enter",), "Enter", "Do the step",
        "Do what is most often right here. While STOP is latched or a fault waits, it releases that first.",
        "Setup", where=WHERE, footer="do step",
    ),
    Command("setup-up", ("up",), "↑", "Step above", "Look at the step above. Nothing jogs on this page.", "Setup",
            where=WHERE),
    Command("setup-down", ("down",), "↓", "Step below", "Look at the step below. Nothing jogs on this page.", "Setup",
            where=WHERE),
    Command("setup-skip", ("s",), "s", "Skip the step", "Leave it open and go on; it can be done later.", "Setup",
            where=WHERE, footer="skip"),
    Command("setup-back", ("b",), "b", "Back a step", "Make the step before this one the present one.", "Setup",
            where=WHERE, footer="back"),
    Command("setup-open", ("o",), "o", "Open the page of this step",
            "The page that shows more of it; F8 or 8 comes back here.", "Setup", where=WHERE, footer="page"),
    Command("setup-wiring", ("w",), "w", "Wiring", "The connector's wires and what to beware of; w goes back.", "Setup",
            where=WHERE, footer="wiring"),
    Command("setup-next-cause", ("right",), "→", "Next cause", "The next likely cause of the silence.", "Setup",
            where=WHERE),
    Command("setup-previous-cause", ("left",), "←", "Previous cause", "The likelier cause before it.", "Setup",
            where=WHERE),
    Command("setup-goto", ("g",), "g", "Go to …", "Type where to, once the area is clear.", "Motion", can_move,
            where=WHERE),
)  # fmt: skip
