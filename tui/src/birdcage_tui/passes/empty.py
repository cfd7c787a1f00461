"""What the page says when there is nothing to show: why, and which key or command changes that."""

from __future__ import annotations

from birdcage.base.config import feed_label

from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.shown.unready import NO_LOCATION
from birdcage_tui.shown.view import View

NO_ELEMENTS = "The catalogue holds no satellites."
GET_ELEMENTS = "In a shell: `birdcage elements update` fetches them, `birdcage elements add FILE` adds yours."


def empty_words(view: View, selection: PassSelection) -> list[tuple[str, str]]:
    """Return (ink, sentence) of why the list is empty."""
    sky = view.sky
    if view.settings.place is None:
        return [("text", NO_LOCATION)]
    if sky is None or sky.searched is None:
        problem = "" if sky is None else sky.problem
        return [("warn", problem)] if problem else [("dim", "Reading the catalogue …")]
    if sky.problem:
        return [("warn", sky.problem)]
    if not sky.satellites:
        return [("text", NO_ELEMENTS), ("dim", GET_ELEMENTS)]
    if sky.searched < 1.0:
        return [("dim", f"Searching {sky.satellites} satellites …")]
    choice = selection.choice
    if choice.filter:
        located = None if view.track is None else view.track.located
        if located is not None and located.text == choice.filter and not located.name:
            return [("text", located.problem), ("dim", "/ changes the filter.")]
        return [("text", f'No pass matches "{choice.filter}".'), ("dim", "/ changes the filter.")]
    if selection.hearable(view):
        return [("text", f"No passing satellite sends what the feed {feed_label(sky.feed)} can hear."),
                ("dim", "h shows the other satellites too.")]  # fmt: skip
    if choice.favourites_only:
        return [("text", "No passes of your favourites soon."), ("dim", "F shows all satellites again.")]
    if choice.reachable_only:
        return [("text", "No passes in reach of this dish."), ("dim", "r shows passes out of reach too.")]
    return [("text", f"No passes soon: {sky.satellites} satellites searched.")]
