"""Going on with what STOP, a hand or the end of the program has interrupted, in words: what moves, and where to."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from birdcage_tui.drawing.cell_text import fit
from birdcage_tui.shown.allowed import RESUME_KEY, can_resume
from birdcage_tui.shown.pass_words import count_text
from birdcage_tui.shown.view import View

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan


def resume_words(view: View, *, sentence: bool = False) -> str:
    """Return the key, what it resumes and where the dish goes by it; empty for nothing.

    `U resume LEO 1 + autotrack (4:44 left): dish moves to 231°/44°`. As a sentence: `U resumes LEO 1 …`.
    """
    if view.track is None or can_resume(view) is not None:
        return ""
    found, left = view.track.resumable, view.track.unfinished
    if found is None:
        from birdcage.pursuit.now import Resumable

        assert left is not None, "one of both can be resumed"
        found = Resumable(left.name, None, left.reach_end, autotrack=False)
    name, plan, end, autotrack = found.name, found.plan, found.reach_end, found.autotrack
    words = f"{RESUME_KEY} {'resumes' if sentence else 'resume'} {fit(name.removeprefix('DEMO '), 24)}"
    if autotrack and plan is not None:
        words += " + autotrack"
    if end is not None:
        seconds = max(int((end - view.utc).total_seconds()), 0)
        words += f" ({f'{seconds // 60}:{seconds % 60:02}' if seconds < 3600 else count_text(seconds)} left)"
    elif left is not None or plan is not None:
        words += " (always up)"
    if plan is None:
        return f"{words}: dish moves when a pass comes" if autotrack else f"{words}: dish moves"
    return f"{words}: dish moves to {direction_words(plan, view.utc)}"


def direction_words(plan: Plan, utc: datetime) -> str:
    """Return where a plan takes the dish from that moment on: `231°/44°`, where it is in reach next."""
    t_s = utc.timestamp()
    start_s = next((leg.start_s for leg in plan.legs if leg.end_s > t_s), t_s)
    az_deg, el_deg = plan.sky.at(max(start_s, t_s))
    return f"{az_deg % 360.0:.0f}°/{el_deg:.0f}°"
