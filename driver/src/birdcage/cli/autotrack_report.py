"""Autotrack's plan as a table and a timeline for people, and as values for JSON."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.cli.pass_table import minutes
from birdcage.cli.say import iso, say, tell
from birdcage.cli.table import cut, tell_table

if TYPE_CHECKING:
    from birdcage.pursuit.now import Scheduled

HEAD = ("", "FROM (UTC)", "TO", "NAME", "PRIORITY", "BEST", "LASTS", "WHY")
WIDTH = 100
"""Of the timeline, where stdout is no terminal."""
LONGEST_NAME = 20
TICK = len("00:00 ")


def tell_schedule(rows: Sequence[Scheduled], begin: datetime, hours: float, width: int | None) -> None:
    """Print each pass with what becomes of it, then when the dish is busy, and how much that is."""
    if not rows:
        say(f"No favourite comes within reach in {hours:g} hours.")
        return
    tell_table(HEAD, [_cells(row, begin) for row in rows], "    rrr")
    tell("")
    for line in timeline(rows, begin, hours, width or WIDTH):
        tell(line)
    kept = [row for row in rows if row.kept]
    lasts = minutes(sum(row.reach_s for row in kept))
    say(f"{len(kept)} of {len(rows)} passes would be followed, {lasts} in all. BEST is without refraction.")


def timeline(rows: Sequence[Scheduled], begin: datetime, hours: float, width: int) -> Iterator[str]:
    """Yield a line for each satellite, the busiest hours side by side under an axis of UTC.

    A column has a pass that is followed, else one that is left out, else nothing.
    """
    blocks = (sys.stdout.encoding or "").lower().replace("-", "") == "utf8"
    followed, left, nothing = ("█", "░", "·") if blocks else ("#", "-", ".")
    names = list(dict.fromkeys((row.name, row.norad_id) for row in rows))
    label = min(max(len(name) for name, _ in names), LONGEST_NAME)
    columns = max(width - label - 2, 24)
    step = timedelta(hours=hours) / columns
    yield f"{'':{label}}  {_axis(begin, step, columns)}"
    for key in names:
        cells = [nothing] * columns
        for row in sorted((each for each in rows if (each.name, each.norad_id) == key), key=lambda each: each.kept):
            first = max(int((row.reach_start - begin) / step), 0)
            last = min(max(int((row.reach_end - begin) / step), first), columns - 1)
            cells[first : last + 1] = [followed if row.kept else left] * (last + 1 - first)
        yield f"{cut(key[0] or str(key[1]), label):{label}}  {''.join(cells)}"
    yield f"{'':{label}}  {followed} followed  {left} left out"


def _axis(begin: datetime, step: timedelta, columns: int) -> str:
    """Return an axis with as many full hours as there is room for."""
    every = next((each for each in (1, 2, 3, 4, 6, 12, 24) if timedelta(hours=each) / step >= TICK + 1), 24)
    cells = [" "] * columns
    hour = begin.replace(minute=0, second=0, microsecond=0)
    while (at := int((hour - begin) / step)) < columns - TICK:
        if hour >= begin and hour.hour % every == 0:
            cells[at : at + 5] = f"{hour:%H:%M}"
        hour += timedelta(hours=1)
    return "".join(cells).rstrip()


def _cells(row: Scheduled, begin: datetime) -> tuple[str, ...]:
    day = "" if row.reach_start.date() == begin.date() else f"{row.reach_start:%m-%d} "
    return (
        "follow" if row.kept else "-",
        f"{day}{row.reach_start:%H:%M:%S}",
        f"{row.reach_end:%H:%M:%S}",
        row.name or str(row.norad_id),
        str(row.priority),
        f"{row.max_reach_elevation_deg:.1f}°",
        minutes(row.reach_s),
        row.why,
    )


def values_of_schedule(rows: Sequence[Scheduled], begin: datetime, hours: float) -> dict[str, object]:
    """Return the plan for JSON."""
    return {
        "start": iso(begin),
        "hours": hours,
        "refraction": "none",
        "passes": [
            {
                "name": row.name,
                "norad_id": row.norad_id,
                "reach_start": iso(row.reach_start),
                "reach_end": iso(row.reach_end),
                "reach_s": round(row.reach_s, 1),
                "max_reach_elevation_deg": round(row.max_reach_elevation_deg, 3),
                "priority": row.priority,
                "kept": row.kept,
                "why": row.why or None,
            }
            for row in rows
        ],
    }
