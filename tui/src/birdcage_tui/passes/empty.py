"""What the page says when there is nothing to show: why, and which key or command changes that."""

from __future__ import annotations

from birdcage_tui.passes.desk import Desk
from birdcage_tui.view import View

NO_PLACE = "No place is set, so nobody can say what rises there."
SET_PLACE = "Setup (8), step 9 sets it; or, in a shell: birdcage place"
NO_ELEMENTS = "The catalogue holds no satellites."
GET_ELEMENTS = "In a shell: birdcage elements update fetches them, birdcage elements add FILE takes your own."


def empty_words(view: View, desk: Desk) -> list[tuple[str, str]]:
    """Return (ink, sentence) of why the list is empty."""
    sky = view.sky
    if view.settings.place is None:
        return [("text", NO_PLACE), ("dim", SET_PLACE)]
    if sky is None or sky.searched is None:
        problem = "" if sky is None else sky.problem
        return [("warn", problem)] if problem else [("dim", "Looking at the sky …")]
    if sky.problem:
        return [("warn", sky.problem)]
    if not sky.satellites:
        return [("text", NO_ELEMENTS), ("dim", GET_ELEMENTS)]
    if sky.searched < 1.0:
        return [("dim", f"Searching {sky.satellites} satellites …")]
    choice = desk.choice
    if choice.filter:
        located = None if view.track is None else view.track.located
        if located is not None and located.text == choice.filter and not located.name:
            return [("text", located.problem), ("dim", "/ changes the filter.")]
        return [("text", f'No pass has "{choice.filter}" in name, number or group.'), ("dim", "/ changes that.")]
    if desk.hearable(view):
        return [("text", f"Nothing that passes is known to send what the feed {sky.feed} hears."),
                ("dim", "h shows what it cannot hear, too.")]  # fmt: skip
    if choice.favourites_only:
        return [("text", "None of your favourites passes."), ("dim", "F shows all satellites again.")]
    if choice.reachable_only:
        return [("text", "Nothing comes within reach of this dish."), ("dim", "r shows what it cannot reach, too.")]
    return [("text", f"None of the {sky.satellites} satellites passes in the hours that were searched.")]
