"""What the Calibrate tab asks in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.control.fields import Field, FieldsScreen, Values

if TYPE_CHECKING:
    from birdcage_tui.calibrate.feed import CalibrateNow

LONGEST = 40


def begin() -> tuple[str, str, str]:
    """Return title, words and consent of forgetting all peaks."""
    words = (
        "All peaks are forgotten: right when the base was moved, for they told how it stood. The dish is pointed as "
        "before, the sets stay, and nothing moves. u brings the peaks back while the app runs."
    )
    return "Forget all peaks", words, "forget them"


def name(now: CalibrateNow | None) -> FieldsScreen:
    """Return the form that asks for the name of a set; the one in force is offered."""
    active = "" if now is None or now.guide is None else now.guide.active
    known = [] if now is None else [each.entry.name for each in now.sets]
    words = (
        "The fit is kept under this name, and all that points goes by it from now on. Nothing moves, but directions "
        "of before are others now." + (f" Kept already: {', '.join(known)}; the same name replaces." if known else "")
    )

    def check(values: Values) -> str:
        text = " ".join(values[0].split())
        if not text or len(text) > LONGEST or not text.isprintable():
            return "A name, please: one for this way to put the dish up, such as Roof."
        return ""

    return FieldsScreen("Point by this fit", words, (Field("name", active, "Roof"),), check)
