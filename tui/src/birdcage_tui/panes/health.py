"""Link and hardware health: one line a fact, unknown as a dash."""

from __future__ import annotations

from itertools import pairwise

from birdcage.base.config import feed_label
from birdcage.station.state import LinkPhase, StationState

from birdcage_tui.commands.everywhere import can_end_search
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cell_len, cut
from birdcage_tui.shown.hardware import hardware_is_well, hardware_words
from birdcage_tui.shown.state_words import LINK, SEARCH, age_text, through
from birdcage_tui.shown.view import Trip, View
from birdcage_tui.widgets.pane import Pane

_OK, _NO, _UNKNOWN = ("●", "good"), ("▲", "warn"), ("·", "dim")
Fact = tuple[tuple[str, str], str, str]
"""Glyph and ink, name, value."""
COLUMN_S = 5.0
"""Seconds that a column of cells stands for in the strip of replies."""
GAP_S = 15.0
"""A longer silence is a gap, not a slope."""
LEAST_TOP_MS = 20.0
AXIS = 7
STRIP_ROWS = 6
"""Rows that heading and strip take: the pane gives them, or none."""


def _search_hint(view: View) -> str:
    """Return which key ends a search, where one does at once."""
    return "" if can_end_search(view) is not None else ": K ends it"


def _feed(state: StationState) -> tuple[str, ...]:
    """Return feed, beam and whether it may be stowed, from all that there is to say to the least."""
    name, stow = feed_label(state.feed_name) or "--", "stow allowed" if state.stow_allowed else "stow locked"
    if state.beam is None:
        return (f"{name}, beam unknown, {stow}",)
    beams = f"beam {state.beam.words}", f"beam {state.beam.brief}", f"beam {state.beam.size}"
    return (*(f"{name}, {beam}, {stow}" for beam in beams), f"{name} {state.beam.size}, {stow}")


def _shared(facts: list[Fact]) -> list[Fact]:
    """Return the facts with the port in the row of the link, and the offsets in that of the limits."""
    values = {name: value for _, name, value in facts}
    link = f"{values['link'].removesuffix(' a reply')}, {values['port'].replace('  heard', ', heard')}"
    offsets = values["offsets"].removeprefix("az ").replace("  el ", " ")
    limits = f"{values['limits'].removesuffix(' elevation')}, offset {offsets}"
    both = {"link": link, "limits": limits}
    return [(mark, name, both.get(name, value)) for mark, name, value in facts if name not in ("port", "offsets")]


def _strip_words(view: View, shown: list[Trip]) -> str:
    """Return since when the link is up, how slow the slowest answer was, and the noise since then."""
    link = view.state.link
    noise = f"{link.stray_bytes} stray bytes" if link.stray_bytes else "no stray bytes"
    up = f"Link up for {age_text(view.now - link.since)}, {noise}"
    if not shown:
        return up
    slowest = max(trip.seconds for trip in shown) * 1000
    return f"{up}. Slowest reply {slowest:.0f} ms in the last {age_text(view.now - shown[0].at)}"


def _link_strip(cells: Cells, y: int, view: View) -> None:
    """Draw how fast the dish has answered lately, newest at the right, from row `y` to the bottom.

    Nothing while the link is down: there is nothing to time.
    """
    width, height = cells.width - 2 - AXIS, cells.height - y - 1
    if not view.link_up or width < 20 or height < 2:
        return
    shown = [trip for trip in view.trips if view.now - trip.at <= width * COLUMN_S]
    cells.put(1, y, cut(_strip_words(view, shown), cells.width - 2), "dim")
    if not shown:
        return
    top_ms = max(LEAST_TOP_MS, max(trip.seconds for trip in shown) * 1200)
    canvas, dots = Braille(width, height), height * 4 - 1
    slowest: dict[int, float] = {}  # of each column of dots
    for trip in shown:
        column = width * 2 - 1 - int(view.now / COLUMN_S * 2) + int(trip.at / COLUMN_S * 2)
        slowest[column] = max(slowest.get(column, 0.0), trip.seconds)
    points = [(column, dots * (1 - seconds * 1000 / top_ms)) for column, seconds in sorted(slowest.items())]
    canvas.line(0, dots, width * 2 - 1, dots, "line", every=4)
    for one, other in pairwise(points):
        if other[0] - one[0] <= GAP_S / COLUMN_S * 2:
            canvas.line(*one, *other, "accent")
    canvas.dot(*points[-1], "accent")
    cells.right(AXIS, y + 1, f"{top_ms:.0f} ms", "dim")
    cells.right(AXIS, y + height, "0 ms", "dim")
    canvas.onto(cells, 1 + AXIS, y + 1)


class HealthPane(Pane):
    """What the port, the dish and its firmware are like. One column, two when there is room."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Health"

    def draw(self, cells: Cells, view: View) -> None:
        """Write the facts in order of weight."""
        facts = self.facts(view)
        if cells.height >= len(facts) + STRIP_ROWS:
            _link_strip(cells, cells.height - STRIP_ROWS, view)
        low = len(facts) > cells.height
        if low:  # one row for firmware and hardware
            marks = {name: mark for mark, name, _value in facts}
            facts = [(marks["hardware"] if name == "firmware" else mark, name, value) for mark, name, value in facts]
            facts = [fact for fact in facts if fact[1] != "hardware"]
        if len(facts) > cells.height:  # what belongs together shares a row
            facts = _shared(facts)
        columns = 2 if cells.width >= 64 and len(facts) > cells.height else 1
        if columns == 1 and len(facts) > cells.height:
            facts = facts[: cells.height]
        rows = -(-len(facts) // columns)
        width = cells.width // columns
        for index, ((glyph, ink), name, value) in enumerate(facts):
            x, y = index // rows * width, index % rows
            cells.put(x + 1, y, glyph, ink)
            cells.put(x + 3, y, name, "dim")
            room = max(width - 14, 0)
            values = self._values(name, value, view, low=low)
            fitting = next((words for words in values if cell_len(words) <= room), values[-1])
            cells.put(x + 13, y, cut(fitting, room), "text")

    @staticmethod
    def _values(name: str, value: str, view: View, *, low: bool) -> tuple[str, ...]:
        """Return what is said of a fact, from all that there is to say to the least."""
        if name == "feed":
            return _feed(view.state)
        if name == "hardware":
            return hardware_words(view)
        if name == "firmware" and low:
            return tuple(value if words == "--" else f"{value}, {words}" for words in hardware_words(view))
        return (value,)

    @staticmethod
    def facts(view: View) -> list[Fact]:
        """Return (glyph and ink, name, value) of every fact."""
        state, link = view.state, view.state.link
        up = link.state is LinkPhase.UP
        ok = _OK if up else _UNKNOWN  # read before the link went, it may hold no longer
        heard = f"  heard {age_text(view.now - link.last_reply)} ago" if link.last_reply is not None else ""
        trip = "--" if link.round_trip_s is None else f"{link.round_trip_s * 1000:.0f} ms a reply"
        noise = f", {link.stray_bytes} stray bytes" if link.stray_bytes else ""
        setting = state.dish.search_setting if state.dish is not None else None
        where = f" ({setting.label})" if setting is not None and setting.id in state.readings else _search_hint(view)
        limits = "--"
        if state.el_min_deg is not None and state.el_max_deg is not None:
            limits = f"{state.el_min_deg:.1f}° to {state.el_max_deg:.1f}° elevation"
        offset = f"az {state.az_offset_deg:+.2f}°  el {state.el_offset_deg:+.2f}°"
        if lean := state.alignment.lean_words():
            offset += f"  {lean}"
        found, homed = "homed", {True: "yes", False: "NO", None: "--"}[state.homed]
        by_itself = state.dish is not None and state.dish.homing_s is None
        if state.dish is not None and state.dish.must_be_synced:
            found, homed = "synced", {True: "yes", False: "NO: Y syncs it", None: "--"}[state.homed]
        elif state.dish is not None and state.dish.never_homes:
            homed = "never: it has no homing"
        elif by_itself:
            homed += ", at power-up"
        search = SEARCH[state.search].removeprefix("TV search ")
        clock = view.clock
        told = (_UNKNOWN, "clock", "--") if clock is None else ((clock.glyph, clock.ink), "clock", clock.words)
        return [
            (_OK if up else _NO, "link", f"{LINK[link.state][1]}{f', {trip}{noise}' if up else ''}"),
            (_OK if up else _UNKNOWN, "port", f"{through(state.port.split('?')[0] or '--', view)}{heard}"),
            *((_NO, subject, words) for subject, words in state.warnings.items()),
            (_UNKNOWN if state.homed is None else ok if state.homed else _NO, found, homed),
            (
                {"off": ok, "off until power-up": ok, "none": ok, "RUNNING": _NO}.get(search, _UNKNOWN),
                "TV search",
                search + where,
            ),
            told,
            (ok if state.el_min_deg is not None else _UNKNOWN, "limits", limits),
            (_UNKNOWN, "firmware", state.firmware_version or "--"),
            ({True: ok, False: _NO, None: _UNKNOWN}[hardware_is_well(view)], "hardware", hardware_words(view)[0]),
            (_UNKNOWN, "feed", _feed(state)[0]),
            (_UNKNOWN, "offsets", offset),
        ]
