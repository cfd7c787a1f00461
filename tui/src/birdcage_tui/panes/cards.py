"""The row of cards: what a person does most, each with its key and one line that is true now."""

from __future__ import annotations

from collections.abc import Callable

from textual.geometry import Region

from birdcage_tui.commands import BY_NAME
from birdcage_tui.commands.mending import held_up, motion_mend
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.allowed import can_move
from birdcage_tui.shown.card_words import (
    fitting,
    monitor_words,
    next_time,
    next_words,
    point_words,
    scan_words,
    setup_words,
)
from birdcage_tui.shown.event_words import finding_now
from birdcage_tui.shown.map_book import map_task
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

CARDS = (
    ("goto", "Point"), ("next-pass", "Next pass"), ("page-signal", "Monitor"), ("scan-sky", "Scan the sky"),
    ("page-setup", "Setup"),
)  # fmt: skip
"""Command and title of each, from the left."""


class CardsPane(Pane):
    """Two rows: keys and titles, and what is so of each. A click anywhere on a card does it."""

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the cards side by side, as wide as one another; grey with its reason where one can't be given."""
        for index, (name, title) in enumerate(CARDS):
            left, right = index * cells.width // len(CARDS), (index + 1) * cells.width // len(CARDS)
            if index:
                for y in range(2):
                    cells.put(left, y, "│", "line")
            left, command = left + 1, BY_NAME[name]
            dim, room = held_up(command, view) is not None, right - left - 2
            x = cells.put(left, 0, f" {command.shown} ", "bar-dim" if dim else "key")
            x = cells.put(x + 1, 0, title, "dim" if dim else "strong")
            if name == "next-pass":
                cells.put(x + 1, 0, fitting(next_time(view), right - x - 2), "text")
            cells.put(left + 1, 1, fitting(_words(name, view, room, dim=dim), room), "dim")
            self.hot.append((Region(left, 0, right - left - 1, 2), name))


def _words(name: str, view: View, room: int, *, dim: bool) -> tuple[str, ...]:
    """Return what stands on a card."""
    if name == "next-pass":
        return next_words(view, room)
    if dim:
        return _reason(name, view)
    told: dict[str, Callable[[View], tuple[str, ...]]] = {
        "goto": point_words, "page-signal": monitor_words, "scan-sky": scan_words, "page-setup": setup_words,
    }  # fmt: skip
    return told[name](view)


def _reason(name: str, view: View) -> tuple[str, ...]:
    """Say in a few words why the dish can't be moved so; row 2 tells all of it when the key is pressed."""
    task = map_task(view.state.tasks)
    if name == "scan-sky" and task is not None:
        return (f"map under way, {task.done or 0} of {task.of}", f"{task.done or 0} of {task.of}")
    if name == "scan-sky" and can_move(view) is None:
        if finding_now(view.state) is not None:
            return ("searching already", "searching")
        if pursuit_of(view.state) is not None:
            return ("the dish follows a target", "following")
        dish = view.state.dish
        if view.heard.of_dish and dish is not None and not dish.has_rssi:
            return ("no tuner in this dish", "no tuner")
    mend = motion_mend(view)
    if mend is None:
        return ("not now",)
    return (f"{mend.shown}: {mend.words}" if mend.shown else mend.words,)
