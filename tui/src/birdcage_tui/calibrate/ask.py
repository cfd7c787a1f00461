"""What the Calibrate tab asks in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

if TYPE_CHECKING:
    from birdcage_tui.shown.calibration import CalibrateNow

LONGEST = 40


def begin() -> tuple[str, str, str]:
    """Return title, words and consent of forgetting all peaks."""
    words = (
        "Do this after you move the base: the old peaks no longer apply. This deletes all peaks. The alignment in use "
        "and the saved sets stay, and nothing moves. u restores the peaks while the app runs."
    )
    return "Delete all peaks", words, "delete them"


def name(now: CalibrateNow | None) -> FieldsScreen:
    """Return the form that asks for the name of a set; the one in force is offered."""
    active = "" if now is None or now.guide is None else now.guide.active
    known = [] if now is None else [each.entry.name for each in now.sets]
    words = (
        "Save the fit under this name and use it for all pointing. Nothing moves now. "
        "The same direction will point elsewhere than before."
        + (f" Saved: {', '.join(known)}; the same name replaces." if known else "")
    )

    def check(values: Values) -> str:
        text = " ".join(values[0].split())
        if not text or len(text) > LONGEST or not text.isprintable():
            return "Type a name for this setup of the dish: Roof."
        return ""

    return FieldsScreen("Use this fit", words, (FieldRow("name", active, "Roof"),), check)
