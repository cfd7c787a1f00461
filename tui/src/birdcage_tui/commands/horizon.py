"""Commands for the horizon: trees and roofs, recorded where the dish looks along their upper edge."""

from __future__ import annotations

from birdcage_tui.commands.table import Command
from birdcage_tui.view import STALE_S, View

HERE = ("control",)


def can_keep(view: View) -> str | None:
    """Return why no horizon can be kept."""
    return view.horizon.problem or None


def can_mark(view: View) -> str | None:
    """Return why where the dish points is no point of the horizon now: only what was just read at rest is one."""
    state, position = view.state, view.state.position
    if view.horizon.problem:
        return view.horizon.problem
    if not view.link_up:
        return "The dish does not answer: where it points is not read."
    if position is None or state.homed is False:
        return "Where the dish points is not known: no point of the horizon."
    if position.modelled:
        return "Where the dish points is computed and was not read: wait for the end of this motion."
    if view.moving or view.asked or state.raw_motion:
        return "The dish moves, or may: a point of the horizon is where it rests."
    age_s = view.position_age_s
    if age_s is None or age_s > STALE_S:
        return f"Where the dish points was read {age_s or 0.0:.0f} s ago: too old for a point of the horizon."
    if abs(position.el_deg) > 90.0:
        return f"The dish leans back, to {position.el_deg:.2f}°: that is no point of a horizon."
    return None


def can_undo(view: View) -> str | None:
    """Return why nothing of the horizon can be taken back."""
    return None if view.horizon.undo else "Nothing of the horizon was changed here: there is nothing to take back."


def can_clear(view: View) -> str | None:
    """Return why there is nothing to clear."""
    return view.horizon.problem or (None if view.horizon.mask else "The horizon is flat already: no point is kept.")


HORIZON = (
    Command(
        "horizon-mark", ("m",), "m", "Mark the horizon",
        "Where the dish points now is where a tree or a roof ends: a point of the horizon. Nothing moves.", "Horizon",
        can_mark, where=HERE, footer="mark horizon",
    ),
    Command(
        "horizon-record", ("M",), "M", "Record the horizon",
        "Each rest of a second after a jog becomes a point, until M again. One at the same azimuth is replaced.",
        "Horizon", can_keep, where=HERE,
    ),
    Command(
        "horizon-type", ("t",), "t", "Type a point of the horizon …", "Azimuth and elevation, in true degrees.",
        "Horizon", can_keep, where=HERE,
    ),
    Command(
        "horizon-draw", ("D",), "D", "Draw the horizon …",
        "With the mouse along the line of trees and roofs, or with the arrows. Nothing moves.", "Horizon", can_keep,
        where=HERE,
    ),
    Command(
        "horizon-undo", ("z",), "z", "Undo horizon", "Take back the last change of the horizon.", "Horizon", can_undo,
        where=HERE,
    ),
    Command(
        "horizon-clear", ("Z",), "Z", "Clear the horizon …", "Take out all points: flat. Asks first.", "Horizon",
        can_clear, where=HERE,
    ),
)  # fmt: skip
