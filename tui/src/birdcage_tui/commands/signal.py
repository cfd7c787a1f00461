"""Commands of the signal page."""

from __future__ import annotations

from birdcage_tui.commands.table import Command

WHERE = ("signal",)

SIGNAL = (
    Command(
        "signal-peak", ("p",), "p", "To the peak …", "Offer the way to the strongest signal. Enter sends the dish.",
        "Signal", footer="to peak", where=WHERE,
    ),
    Command(
        "signal-tone", ("t",), "t", "Tone on, off", "Ring the terminal's bell, faster as the signal rises.", "Signal",
        footer="tone", where=WHERE,
    ),
    Command(
        "signal-forget", ("x",), "x", "Forget the peak", "Begin anew with peak and floor, in another part of the sky.",
        "Signal", footer="forget", where=WHERE,
    ),
)  # fmt: skip
