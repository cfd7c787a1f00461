"""Commands of the map of the sky, on the signal page."""

from __future__ import annotations

from birdcage.station.task_state import TaskPhase

from birdcage_tui.commands.signal import can_find
from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext
from birdcage_tui.shown.map_book import map_task

WHERE, INSIDE, OFFER = ("signal",), ("map",), ("map-offer",)


def can_pause(context: CommandContext) -> str | None:
    """Return why no map can be paused."""
    task = map_task(context.state.tasks)
    return "No map is under way." if task is None or task.phase is TaskPhase.OVER else None


def _inside(name: str, keys: tuple[str, ...], shown: str, title: str, text: str) -> Command:
    return Command(name, keys, shown, title, text, "Map", where=INSIDE, page="signal")


def _offer(name: str, keys: tuple[str, ...], shown: str, title: str, text: str, footer: str = "") -> Command:
    return Command(name, keys, shown, title, text, "Horizon of the map", where=OFFER, page="signal", footer=footer)


SKY_MAP = (
    Command(
        "map-begin", ("m",), "m", "Map the sky …", "Choose region, step and time. An estimate shows before it begins.",
        "Map", can_find, footer="map", where=WHERE,
    ),
    Command(
        "map-list", ("M",), "M", "Maps …", "Look at a map that is kept, newest first.", "Map", where=WHERE,
    ),
    Command(
        "map-pause", ("e",), "e", "Pause the map", "End it for now. u resumes it at any time, today or next week.",
        "Map", can_pause, where=WHERE,
    ),
    Command(
        "map-resume", ("u",), "u", "Resume the map …", "Go on with the map that is shown. Asks first.", "Map",
        can_find, where=WHERE,
    ),
    Command(
        "map-enter", ("i",), "i", "Into the map",
        "Put the cursor into the map, or leave it. Enter goes in, too, while the map is shown.", "Map", where=WHERE,
    ),
    Command(
        "map-whole", ("z",), "z", "Map alone", "Give the whole page to the map, or show the level above it again.",
        "Map", where=WHERE,
    ),
    Command(
        "map-colours", ("c",), "c", "Colours of the map", "Blue to yellow, violet to yellow, red, grey. Night is red.",
        "Map", where=WHERE,
    ),
    Command(
        "map-cuts", ("d",), "d", "Cuts of the map", "Draw the cursor's row and column along the edges, or not.", "Map",
        where=WHERE,
    ),
    Command(
        "map-lessons", ("y",), "y", "What this map teaches …",
        "The horizon, north and tilt, or beam and noise. Nothing is kept before you accept it.", "Map", where=WHERE,
    ),
    _inside("map-left", ("left", "h"), "← h", "Cursor left", "One direction of the map."),
    _inside("map-right", ("right", "l"), "→ l", "Cursor right", "One direction of the map."),
    _inside("map-up", ("up", "k"), "↑ k", "Cursor up", "One direction of the map."),
    _inside("map-down", ("down", "j"), "↓ j", "Cursor down", "One direction of the map."),
    _inside("map-far-left", ("shift+left", "home"), "Home", "Cursor far left", "Ten directions of the map."),
    _inside("map-far-right", ("shift+right", "end"), "End", "Cursor far right", "Ten directions of the map."),
    _inside("map-far-up", ("shift+up", "pageup"), "PgUp", "Cursor far up", "Ten directions of the map."),
    _inside("map-far-down", ("shift+down", "pagedown"), "PgDn", "Cursor far down", "Ten directions of the map."),
    _offer(
        "map-offer-left", ("left", "h", "up", "k"), "← ↑", "Point before", "Of a proposed horizon, the one to the left."
    ),
    _offer(
        "map-offer-right", ("right", "l", "down", "j"), "→ ↓", "Next point",
        "Of a proposed horizon, the one to the right.",
    ),
    _offer("map-offer-accept", ("a",), "a", "Accept the point", "Or take that back, and go to the next.", "accept"),
    _offer("map-offer-all", ("A",), "A", "Accept all", "Accept every point of the proposed horizon, or none."),
    _offer("map-offer-keep", ("enter",), "Enter", "Keep the points", "Put what is accepted into the horizon.", "keep"),
    _offer("map-offer-leave", ("q",), "q", "Discard the proposal", "Take it off the map. The horizon stays unchanged."),
    Command(
        "map-goto", ("g", "enter"), "g Enter", "Point there …",
        "Offer to point the dish at the cursor. Enter sends it.", "Map", where=INSIDE, page="signal", footer="point",
    ),
)  # fmt: skip
