"""Whether this machine's clock can be trusted: what the system says, else what was found last and how old that is."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

from birdcage.base.paths import write_aside_and_rename
from birdcage.base.text import clean_all
from birdcage.base.user_file import read_user_file
from birdcage.gps.system_time import RunTool, by_system, run_tool
from birdcage.gps.verdict import DOUBTFUL_S, ClockVerdict

DRIFT_S_A_DAY = 2.0
"""How far the clock of a laptop or a small board runs away, left alone: some 20 parts in a million."""
SYSTEMD_S = 0.5
"""Taken as the precision of a clock that systemd calls set: it does not say how well."""
FILE = "clock.json"
"""In the folder of the state."""


def check_clock(now: datetime, state_folder: Path, run: RunTool = run_tool) -> ClockVerdict:
    """Return what is known of the clock without asking a person or a receiver. Takes at most 4 s.

    A clock that the network sets counts at once and is remembered; else what was remembered counts, less sure each
    day. Nothing is raised: a state that can't be read or written is as none.
    """
    found = by_system(now, run)
    if not found.doubtful:
        remember(state_folder, found)
        return found
    before = recall(state_folder)
    return found if before is None else _aged(before, now, found)


def remember(state_folder: Path, verdict: ClockVerdict) -> bool:
    """Keep a verdict for the days without a network; False if that can't be done. Doubts about the source are not kept.

    A verdict that asks for the clock to be set is forgotten with all before it: the clock will be another one.
    """
    path = state_folder / FILE
    try:
        if verdict.doubtful:
            path.unlink(missing_ok=True)
            return True
        kept = {
            "source": verdict.source,
            "checked_at": verdict.checked_at.isoformat(),
            "offset_s": verdict.offset_s,
            "precision_s": SYSTEMD_S if verdict.precision_s is None else verdict.precision_s,
        }
        write_aside_and_rename(path, json.dumps(kept).encode())
    except OSError:
        return False
    return True


def recall(state_folder: Path) -> ClockVerdict | None:
    """Return the last good verdict as it was; None when there is none, or what is kept makes no sense."""
    try:
        kept = clean_all(json.loads(read_user_file(state_folder / FILE)))
        at = datetime.fromisoformat(kept["checked_at"])
        offset_s, precision_s = kept["offset_s"], float(kept["precision_s"])
        found = ClockVerdict(
            "remembered", str(kept["source"]), at, None if offset_s is None else float(offset_s), precision_s
        )
    except (OSError, ValueError, TypeError, LookupError):
        return None
    return found if at.tzinfo is not None else None


def _aged(before: ClockVerdict, now: datetime, found: ClockVerdict) -> ClockVerdict:
    age = now - before.checked_at
    if age < timedelta(0):
        doubt = (
            f"The clock went back: it says {now:%Y-%m-%d %H:%M}; the last check was at "
            f"{before.checked_at.astimezone(UTC):%Y-%m-%d %H:%M}. Set it."
        )
        return replace(found, doubt=doubt)
    precision_s = (before.precision_s or 0.0) + DRIFT_S_A_DAY * (age / timedelta(days=1))
    source = f"{before.source}, {_ago(age)} ago"
    aged = ClockVerdict("remembered", source, before.checked_at, before.offset_s, precision_s)
    worst_s = aged.worst_s or 0.0
    if worst_s > DOUBTFUL_S:
        doubt = f"{found.doubt} Last compared: {source}. It may be {worst_s:.1f} s off now."
        return replace(aged, doubt=doubt)
    return aged


def _ago(age: timedelta) -> str:
    hours = age / timedelta(hours=1)
    if hours < 2:
        return f"{age / timedelta(minutes=1):.0f} min"
    return f"{hours:.0f} h" if hours < 48 else f"{hours / 24:.0f} days"
