"""Commands of the signal page."""

from __future__ import annotations

from birdcage.signal.level_scale import why_no_scale

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext, can_move, can_step
from birdcage_tui.shown.event_words import FINDING, finding_now
from birdcage_tui.shown.pursuit import pursuit_of

WHERE = ("signal",)


def deaf(context: CommandContext) -> str | None:
    """Return why nothing can be heard, whatever the dish does; None where there is a source."""
    dish = context.state.dish
    if context.heard.of_dish and dish is not None and not dish.has_rssi:
        return f"The {dish.name} has no tuner to read."
    return None


def can_find(context: CommandContext) -> str | None:
    """Return why the dish cannot find the peak by itself now."""
    state = context.state
    if (reason := deaf(context)) is not None:
        return f"{reason} s chooses another source."
    if state.position is None or state.position_lost is not None:
        return can_step(context) or "Where the dish points is unknown. Home it first."
    if (task := finding_now(state)) is not None:
        return f"{FINDING[task.kind]} is under way. Space stops it."
    if pursuit_of(state) is not None:
        return "The dish follows a target. End that first."
    return can_move(context)


def can_scale(context: CommandContext) -> str | None:
    """Return why what is heard needs no scale."""
    return why_no_scale(context.heard) or None


SIGNAL = (
    Command(
        "signal-find", ("f",), "f", "By the signal …",
        "Find the peak, step-track, on-off, drift scan, or acquire a satellite.",
        "Signal", can_find, footer="find", where=WHERE,
    ),
    Command(
        "signal-sweep", ("w",), "w", "Sweep …", "Measure the signal along azimuth or elevation, and draw it.",
        "Signal", can_find, footer="sweep", where=WHERE,
    ),
    Command(
        "signal-view", ("v",), "v", "Next view", "The last minute, the sweep, the map, or an RTL-SDR's waterfall.",
        "Signal", footer="view", where=WHERE,
    ),
    Command(
        "signal-source", ("s",), "s", "Source …", "Hear by another source: the dish, your receiver, a program.",
        "Signal", footer="source", where=WHERE,
    ),
    Command(
        "signal-peak", ("p",), "p", "To the peak …", "Offer the way to the strongest signal. Enter sends the dish.",
        "Signal", footer="to peak", where=WHERE,
    ),
    Command(
        "signal-tone", ("t",), "t", "Tone on, off", "Hear the signal: a pitch, or over ssh the terminal's bell.",
        "Signal", footer="tone", where=(*WHERE, "pocket"),
    ),
    Command(
        "signal-mark", ("enter",), "Enter", "Set a marker", "Mark the newest reading: time, level and direction.",
        "Signal", where=WHERE,
    ),
    Command(
        "signal-unmark", ("X",), "X", "Clear the markers", "Take all markers off the strip.", "Signal", where=WHERE,
    ),
    Command(
        "signal-tune", ("F",), "F", "Frequency …", "Tune an RTL-SDR: channel, sample rate, width, gain.", "Signal",
        where=WHERE,
    ),
    Command(
        "signal-levels", ("D",), "D", "Two known levels …", "Make decibels of counts by two levels that you know.",
        "Signal", can_scale, where=WHERE,
    ),
    Command(
        "signal-record", ("r",), "r", "Record on, off", "Keep every reading with its time and direction.", "Signal",
        footer="record", where=WHERE,
    ),
    Command(
        "signal-replay", ("R",), "R", "Replay …", "Choose a recording, and see it as it was. The dish stays live.",
        "Signal", where=WHERE,
    ),
    Command(
        "signal-forget", ("x",), "x", "Forget the peak", "Begin anew with peak and floor, in another part of the sky.",
        "Signal", where=WHERE,
    ),
)  # fmt: skip
