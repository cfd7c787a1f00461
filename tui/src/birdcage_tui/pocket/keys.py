"""The pocket view's touch targets: jog, step, a few commands, and STOP over the whole width."""

from __future__ import annotations

from collections.abc import Sequence

from textual.geometry import Region

from birdcage_tui.commands import BY_NAME
from birdcage_tui.commands.everywhere import can_end_search
from birdcage_tui.commands.mending import held_up
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.resume_words import resume_words
from birdcage_tui.shown.stop_words import searching
from birdcage_tui.shown.unready import worst
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.skew import has_skew
from birdcage_tui.widgets.status import StopButton

JOG = (("left", "◀"), ("up", "▲"), ("down", "▼"), ("right", "▶"))
MORE = (("goto", "g go to"), ("home", "H home"), ("pocket-passes", "f pass"), ("help", "? help"), ("palette", ": all"))
BRIEF = {"help": "?", "palette": ":", "goto": "g go"}
"""The same, one after the other, where others stand beside them and there is no room for all words."""
LISTED = (
    ("pocket-pass-up", "▲"),
    ("pocket-pass-down", "▼"),
    ("pocket-pick", "Enter plan"),
    ("pocket-back", "Esc back"),
)
"""While the passes are listed."""
OFFERED = (*LISTED[:2], ("offer-follow", "Enter follow"), LISTED[3])
SKEWED = tuple(("skew", "S skew") if name == "home" else (name, words) for name, words in MORE)
"""The same for a dish with a third axis, which homes by itself."""
MENDS = {"place-set": "L place", "elements-add": "I add"}
"""What the pocket view names as missing, and has a key for."""
TONE = ("signal-tone", "t tone")
"""Where there is room for one more."""
MAP = ("pocket-map", "m map")
"""Where one is open."""
ROOMY = 44
"""Columns from which the row of commands keeps off the edges."""
STEP_WIDTH = 13
"""Columns of `[-] 0.05° [+]`."""


def _centred(words: str, width: int) -> str:
    """Return `words` in the middle, or one to the right of it: a jump label covers the left end."""
    words = words[:width]
    return words.rjust((width + len(words) + 1) // 2).ljust(width)


def _release_words(view: View) -> str:
    """Return what Enter does to what is wrong."""
    if view.state.fault is not None:
        return "Enter acknowledge"
    return "Enter release" if view.state.held is not None else "Enter own limits"


def more_keys(view: View, width: int) -> list[tuple[str, str]]:
    """Return the commands of the lowest row and their words: first those that the words above name by their keys."""
    keys = list(SKEWED if has_skew(view) else MORE)
    if can_release(view) is None:
        keys = [("release", _release_words(view)), *keys[2:]]
    if view.map is not None:
        keys.insert(len(keys) - 2, MAP)
    if resume_words(view):
        keys.insert(1 if keys[0][0] == "release" else 0, ("resume", "U resume"))
    finding = worst(view)
    if searching(view) and can_end_search(view) is None:
        keys.insert(0, ("search", "K end it"))
    elif finding is not None and finding.brief:
        keys.insert(0, (finding.command, MENDS[finding.command]))
    for name, brief in BRIEF.items():
        if sum(len(words) + 2 for _, words in keys) > width:
            keys = [(command, brief if command == name else words) for command, words in keys]
    if sum(len(words) + 2 for _, words in (*keys, TONE)) <= width:
        keys.append(TONE)
    return keys


class PocketKeys(Pane):
    """Two rows of buttons; the jog buttons grow when the pane is taller."""

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the jog row, as tall as there is room for, and the row of commands."""
        tall = max(cells.height - 1, 1)
        if "pocket-passes" in view.scopes:
            offered = "offer-follow" in view.scopes
            keys = OFFERED if offered else LISTED
            if view.may_move:  # Esc stops it
                keys = (*keys[:3], (keys[3][0], "← back"))
            self._row(cells, Region(0, 0, cells.width, tall), keys, view)
        else:
            self._jog(cells, tall, view)
        if cells.height < 2:
            return
        edge = 1 if cells.width >= ROOMY else 0  # in line with the jog buttons
        width = cells.width - 2 * edge
        self._row(cells, Region(edge, tall, width, 1), more_keys(view, width), view)

    def _row(self, cells: Cells, place: Region, keys: Sequence[tuple[str, str]], view: View) -> None:
        """Share a row out among buttons, by the lengths of their words."""
        parts = [len(words) + 2 for _, words in keys]
        taken = 0
        for (command, words), part in zip(keys, parts, strict=True):
            x, taken = place.width * taken // sum(parts), taken + part
            end = place.width * taken // sum(parts)
            self._key(cells, Region(place.x + x, place.y, end - x, place.height), command, words, view)

    def _jog(self, cells: Cells, tall: int, view: View) -> None:
        room = max(cells.width - 2 - STEP_WIDTH - 1, 3 * len(JOG))
        for index, (command, sign) in enumerate(JOG):
            x, end = 1 + room * index // len(JOG), 1 + room * (index + 1) // len(JOG)
            self._key(cells, Region(x, 0, end - x, tall), command, sign, view)
        x = cells.width - 1 - STEP_WIDTH
        self._key(cells, Region(x, 0, 3, tall), "step-down", "-", view)
        cells.put(x + 3, tall // 2, f"{view.step_deg:g}°".center(7), "strong")
        self._key(cells, Region(x + 10, 0, 3, tall), "step-up", "+", view)

    def _key(self, cells: Cells, place: Region, command: str, words: str, view: View) -> None:
        """Draw one button and make it press: in brackets; in round ones, and dim, while it is refused."""
        refused = held_up(BY_NAME[command], view) is not None
        ink = "dim" if refused else "key"
        middle = place.y + place.height // 2
        left, right = "()" if refused else "[]"
        if place.height > 1:
            left, right = ("╎", "╎") if refused else ("│", "│")
            line = ("╌" if refused else "─") * (place.width - 2)
            for y in range(place.y, place.bottom):
                cells.put(place.x, y, f"{left}{' ' * (place.width - 2)}{right}", ink)
            cells.put(place.x, place.y, f"╭{line}╮", ink)
            cells.put(place.x, place.bottom - 1, f"╰{line}╯", ink)
            words = f"({words})" if refused and place.width >= 5 else words
        cells.put(place.x, middle, f"{left}{_centred(words, place.width - 2)}{right}", ink)
        self.hot.append((place, command))


class StopBar(StopButton):
    """STOP for a thumb: the press counts, wherever it lands on the bar."""

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it looks the same whatever happens
        """Say what it is, in the middle."""
        for y in range(cells.height):
            words = "■  S T O P" if y == cells.height // 2 else ""
            cells.put(0, y, words.center(cells.width), "fault-row")
