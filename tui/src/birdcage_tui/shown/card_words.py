"""What the cards of the dashboard say below their titles: what is so now, or why it can't be done. Pure functions.

Each returns the same from all that there is to say to the least: the longest that fits is shown.
"""

from __future__ import annotations

from birdcage_tui.drawing.cell_text import cell_len, cut, fit
from birdcage_tui.shown.level_words import value_text
from birdcage_tui.shown.next_passes import next_pass
from birdcage_tui.shown.pass_words import clock_text, count_text
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.track_words import plain_name
from birdcage_tui.shown.view import View


def fitting(variants: tuple[str, ...], width: int) -> str:
    """Return the first that fits; the last, cut, if none does."""
    return next((words for words in variants if cell_len(words) <= width), cut(variants[-1], width))


def point_words(view: View) -> tuple[str, ...]:
    """Say whom a go-to takes the dish from, else how high and low this dish points."""
    state, pursuit = view.state, pursuit_of(view.state)
    if pursuit is not None:
        return f"ends following {plain_name(pursuit.plan.aim.name)}", "ends following"
    if state.el_min_deg is None or state.el_max_deg is None:
        return "a name, or az and el", "name or az el"
    span = f"{state.el_min_deg:.0f}° to {state.el_max_deg:.0f}°"
    return f"a name or az el, {span} elevation", f"{span} elevation", f"{span} el"


def next_words(view: View, width: int) -> tuple[str, ...]:
    """Say which pass, and how high it comes; or why none is known."""
    sky = view.sky
    row = next_pass(sky, view.utc.timestamp(), view.state)
    if row is not None:
        return f"{row.name}, max {row.max_el_deg:.0f}°", fit(row.name, width)
    if view.settings.place is None:
        return ("no location set",)
    if sky is None or sky.problem:
        return ("no passes yet",)
    if sky.note:
        return ("the elements are too old", "old elements")
    if sky.searched is None or sky.searched < 1.0 or sky.until_s is None:
        return ("computing passes", "computing")
    return (f"none until {clock_text(sky.until_s, seconds=False)}Z",)


def next_time(view: View) -> tuple[str, ...]:
    """Say in how many minutes and seconds it comes into reach, or leaves it; empty where none is known."""
    now_s = view.utc.timestamp()
    row = next_pass(view.sky, now_s, view.state)
    event = None if row is None else row.next_event(now_s)
    if row is None or event is None:
        return ("",)
    count = count_text(event[0] - now_s)
    return (f"now, {count} left", "now") if row.reach.holds(now_s) else (f"in {count}", count)


def monitor_words(view: View) -> tuple[str, ...]:
    """Say what is heard now and by what, or how old the last reading is."""
    if not view.signal:
        silent = view.heard.of_dish and view.state.dish is not None and not view.state.dish.has_rssi
        if silent:
            return "no tuner in this dish", "no tuner"
        return (f"{view.heard_by}: no reading", "no reading")
    last = view.signal[-1]
    value, age_s = f"{value_text(last.value, view.heard)} {view.heard.unit}", view.now - last.at
    if age_s > view.heard.pause_s:
        return f"{value}, {age_text(age_s)} ago", f"{age_text(age_s)} old"
    return f"{value}, {view.heard_by}", value


def scan_words(view: View) -> tuple[str, ...]:
    """Say how far the map is that is kept open, else what it makes."""
    shown = view.map
    if shown is not None and not shown.is_complete:
        part = f"{shown.heard} of {shown.plan.cells}"
        return f"unfinished map, {part} heard", f"map {part}", part
    return "a map of a region, live", "a map, live", "a map"


def setup_words(view: View) -> tuple[str, ...]:
    """Say how many of its steps are done."""
    steps = view.setup_steps
    return ("--",) if steps is None else (f"{steps.done} of {steps.of} steps done", f"{steps.done} of {steps.of} done")
