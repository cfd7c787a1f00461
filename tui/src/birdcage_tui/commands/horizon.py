"""Commands for the horizon: trees and roofs, recorded where the dish looks along their upper edge."""

from __future__ import annotations

from birdcage.station.state import LinkPhase

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import CommandContext
from birdcage_tui.shown.view import STALE_S, is_moving

HERE = ("control",)


def can_keep(context: CommandContext) -> str | None:
    """Return why no horizon can be kept."""
    return context.horizon.problem or None


def can_mark(context: CommandContext) -> str | None:
    """Return why where the dish points is no point of the horizon now: only what was just read at rest is one."""
    state, position = context.state, context.state.position
    if context.horizon.problem:
        return context.horizon.problem
    if state.link.state is not LinkPhase.UP:
        return "The dish does not answer, so its position is unknown."
    if position is None or state.homed is False:
        return "The dish position is unknown, so no horizon point was added."
    if position.modelled:
        return "The position is only modelled. Wait for the end of this motion."
    if is_moving(state) or context.asked or state.raw_motion:
        return "The dish is moving or may move. Wait until it rests."
    age_s = context.now - position.told_at
    if age_s > STALE_S:
        return f"The position is {age_s:.0f} s old. Wait for a new reading."
    if abs(position.el_deg) > 90.0:
        return f"Elevation {position.el_deg:.2f}° is beyond the zenith. Point the dish at the horizon."
    return None


def can_undo(context: CommandContext) -> str | None:
    """Return why nothing of the horizon can be taken back."""
    return None if context.horizon.undo else "No horizon changes to undo."


def can_clear(context: CommandContext) -> str | None:
    """Return why there is nothing to clear."""
    return context.horizon.problem or (None if context.horizon.mask else "The horizon is already flat.")


HORIZON = (
    Command(
        "horizon-mark", ("m",), "m", "Mark the horizon",
        "The dish points at the top of a tree or roof: add a horizon point. Nothing moves.", "Horizon",
        can_mark, where=HERE, footer="mark horizon",
    ),
    Command(
        "horizon-record", ("M",), "M", "Record the horizon",
        "Each rest of a second after a jog adds a point, until you press M again. "
        "A new point replaces one at the same azimuth.",
        "Horizon", can_keep, where=HERE,
    ),
    Command(
        "horizon-type", ("t",), "t", "Type a horizon point …", "Type azimuth and elevation in true degrees.",
        "Horizon", can_keep, where=HERE,
    ),
    Command(
        "horizon-draw", ("D",), "D", "Draw the horizon …",
        "Draw the line of trees and roofs with mouse or arrows. Nothing moves.", "Horizon", can_keep,
        where=HERE,
    ),
    Command(
        "horizon-undo", ("z",), "z", "Undo horizon", "Undo the last horizon change.", "Horizon", can_undo,
        where=HERE,
    ),
    Command(
        "horizon-clear", ("Z",), "Z", "Clear the horizon …", "Delete all points. Asks first.", "Horizon",
        can_clear, where=HERE,
    ),
)  # fmt: skip
