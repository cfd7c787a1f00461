"""What the Calibrate tab asks in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.signal.peak_task import SIDE, SPACING

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


def find(target: str, width_deg: float) -> tuple[str, str, str]:
    """Return title, words and consent of finding the peak of an object by the signal."""
    reach_deg = width_deg * SPACING * (SIDE - 1) / 2
    words = (
        f"The dish goes through {SIDE * SIDE} directions around here, up to {reach_deg:.1f}° to each side, and ends in "
        "the middle of the source. That is saved as a peak, with its uncertainty. Without a source it comes back here, "
        "and nothing is saved. Keep its swing clear. Space stops it."
    )
    return f"Find the peak of {target}", words, "area is clear: begin"


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
