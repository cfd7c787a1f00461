"""How well it is heard, in words, and the way to the strongest signal."""

from __future__ import annotations

from birdcage.base.geometry import shortest_turn
from birdcage.signal.beam_fit import BeamFit
from birdcage.signal.peak_hold import HeardPeak, LevelNow, Trend
from birdcage.signal.source import SignalFacts
from birdcage.station.pursuit_state import Phase
from birdcage.station.state import Activity

from birdcage_tui.shown.view import View

TRENDS = {Trend.HOTTER: "▲ hotter", Trend.COLDER: "▼ colder", Trend.SAME: ""}
NEAR_DEG = 0.05
"""Nearer than this no arrow points the way: gears have more play."""


def value_text(value: float, heard: SignalFacts) -> str:
    """Return a value as its source tells it."""
    return f"{value:.{heard.decimals}f}"


def db_text(value: float, view: View) -> str:
    """Return a value in dB by two known levels, with a question mark beyond them; empty where none are known."""
    if view.scale is None:
        return ""
    return f"{view.scale.db(value):.1f} dB{'' if view.scale.covers(value) else '?'}"


def is_late(view: View, level: LevelNow) -> bool:
    """Return whether the last reading is older than its source usually lets pass between two."""
    return view.now - level.at > view.heard.pause_s


def way_to(level: LevelNow) -> tuple[float, float] | None:
    """Return the true direction of the middle of the source: by the fit, or else of the strongest signal.

    None where neither is known.
    """
    found: BeamFit | HeardPeak | None = level.fit or level.peak
    if found is None or found.az_deg is None or found.el_deg is None:
        return None
    return found.az_deg, found.el_deg


def turn_to(level: LevelNow, view: View) -> tuple[float, float] | None:
    """Return how far azimuth, clockwise, and elevation have to turn to there.

    None where that or the position is not known, and while the dish follows: what it follows moves on.
    """
    position, to = view.state.position, way_to(level)
    if position is None or view.stale or to is None or view.state.activity is Activity.FOLLOWING:
        return None
    return shortest_turn(position.az_deg, to[0]), to[1] - position.el_deg


def arrow(turn_deg: float, less: str, more: str) -> str:
    """Return the sign of the way that an axis has to go; `=` where it is there."""
    return "=" if abs(turn_deg) < NEAR_DEG else more if turn_deg > 0.0 else less


def followed_name(view: View) -> str:
    """Return what the dish follows now; empty while it follows nothing. The level is of that alone then."""
    pursuit = view.state.pursuit
    return pursuit.plan.aim.name if pursuit is not None and pursuit.phase is Phase.FOLLOWING else ""


def peak_words(view: View) -> str:
    """Return which peak the percentage is of."""
    return "the best so far" if followed_name(view) else "the peak"


def short_words(view: View, width: int) -> str:
    """Return the numbers that count with a hand on the dish, in one row: percent of the peak, trend, degrees to it.

    Empty while peak and floor cannot be told apart.
    """
    level = view.level
    if level is None or level.share is None:
        return ""
    turn = turn_to(level, view)
    way = ""
    if turn is not None:
        across, up = turn
        way = f"  {arrow(across, '◀', '▶')}{abs(across):.1f}° {arrow(up, '▼', '▲')}{abs(up):.1f}°"
    of = "of best" if followed_name(view) else "of peak"
    found = f"{max(level.share, 0.0) * 100.0:.0f} % {of}  {TRENDS[level.trend]}".rstrip() + way
    return found if len(found) <= width else found.replace(f" {of} ", "")
