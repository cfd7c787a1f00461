"""The worst of what the station lacks, as one plain line with the key that mends it. Pure functions of a view."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.station.state import LinkPhase, TvSearch

from birdcage_tui.shown.stop_words import searching
from birdcage_tui.shown.view import View

if TYPE_CHECKING:
    from birdcage.ready.check import Check

SETUP = "page-setup"
NO_LOCATION = "No location set. L sets it."
"""The same sentence on every page; `L` works on all of them."""
SETUP_STEPS = {
    "place": "place", "port": "link", "dish": "dish", "search": "search", "limits": "limits", "feed": "feed",
}  # fmt: skip
"""Which step of the setup asks for what is looked at."""


@dataclass(frozen=True, slots=True)
class Unready:
    """One line for *What next*."""

    ink: str
    words: str
    brief: str = ""
    """The same for a terminal of 40 columns, where it must be fixed and a key does that there; else empty."""
    command: str = ""
    """What its key does; empty where no key of the app mends it."""
    plain: str = ""
    """The same without its key, for where that does nothing."""
    step: str = ""
    """The step of the setup that the cursor is put on; empty for none."""


def worst(view: View) -> Unready | None:
    """Return the worst of what is not ready; None where nothing is, or nothing is known yet."""
    left = [check for check in view.ready or () if _lacks(check, view)]
    if not left:
        return None
    check = next((each for each in left if each.state == "must"), left[0])
    sentence, key, command, deed = _told(check)
    glyph, ink = ("✗", "warn-strong") if check.state == "must" else ("▲", "text")
    words = f"{glyph} {sentence} {key}: {deed}." if key and deed else f"{glyph} {sentence}"
    brief = BRIEF.get(check.subject, "") if check.state == "must" and key else ""
    step = SETUP_STEPS.get(check.subject, "") if command == SETUP else ""
    return Unready(ink, words, brief, command, f"{glyph} {sentence}", step)


def setup_step(view: View) -> str:
    """Return the step of the setup that mends what *What next* names; empty for none."""
    found = worst(view)
    return "" if found is None else found.step


def _lacks(check: Check, view: View) -> bool:
    """Return whether it is still so by what the station knows, and nothing else on the page says it."""
    state = view.state
    match check.subject:
        case "place":
            return view.settings.place is None
        case "dish":
            return not (view.link_up and state.dish is not None)
        case "port":
            return state.link.state is LinkPhase.LOST and not state.port
        case "search":
            off = state.search in (TvSearch.OFF, TvSearch.OFF_UNTIL_POWER_UP, TvSearch.NONE)
            return not (view.link_up and off) and not searching(view)
        case "config":
            return False  # row 2 says it
        case _:
            return True


def _told(check: Check) -> tuple[str, str, str, str]:
    """Return sentence, key, command and deed; no key where only an editor or a shell mends it.

    No deed where the sentence itself says what the key does.
    """
    match check.subject:
        case "elements" | "favourites" if check.name != "favourites":
            return _elements(check)
        case "favourites":
            return "No satellite is marked as a favourite.", "7", "page-passes", "* there marks one"
        case "ephemeris":
            return f"Ephemeris: {check.words}. Remedy: {check.remedy}.", "", "", ""
        case "downlinks" | "hooks":
            return f"{check.subject.capitalize()}: {check.words}. Fix the file.", "", "", ""
    words = check.words.partition(", the default")[0]
    if check.subject == "feed" and words == check.words:
        return f"The feed {words}.", "8", SETUP, DEEDS["feed"]
    sentence = SENTENCES.get(check.subject, "{name}: {words}.").format(name=check.name, words=words)
    if check.subject == "place":
        return sentence, "L", "place-set", ""
    return sentence, "8", SETUP, DEEDS.get(check.subject, "open Setup")


SENTENCES = {
    "place": NO_LOCATION,
    "dish": "The dish is not known: {words}.",
    "port": "No port is set.",
    "search": "The TV search may move the dish: not known to be off.",
    "limits": "Cable limits are the firmware's. Your coax may be shorter.",
    "feed": "Which feed is fitted? birdcage assumes {words}.",
}
_OLD = "✗ Old elements. I: add newer ones"
BRIEF = {"place": f"✗ {NO_LOCATION}", "elements": _OLD, "favourites": _OLD}
DEEDS = {"search": "switch it off", "limits": "set yours", "feed": "tell which", "port": "find the dish"}


def _elements(check: Check) -> tuple[str, str, str, str]:
    key, command, deed = "I", "elements-add", "add newer ones"
    if not check.remedy.startswith("birdcage elements"):
        return f"Elements: {check.words}.", "", "", ""
    if check.subject == "favourites":
        unfit = "too old to find it" if check.state == "must" else "old: expect a larger error"
        return f"The elements of {check.name} are {unfit}.", key, command, deed
    if check.name == "epochs":
        return "Some elements are dated ahead of this computer's clock.", key, command, deed
    if check.state == "must":
        return "Elements: only the old ones that ship.", key, command, f"{deed}, or run `{check.remedy}`"
    return f"Elements: {check.words}.", key, command, deed
