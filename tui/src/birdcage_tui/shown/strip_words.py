"""What the strip says of what it shows: its statistics, and each marker against now."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import fmean

from birdcage.base.geometry import separation, shortest_turn
from birdcage.signal.source import Scale, SignalFacts

from birdcage_tui.drawing.cell_text import cell_len
from birdcage_tui.shown.level_words import arrow, is_late, value_text
from birdcage_tui.shown.markers import Marker
from birdcage_tui.shown.view import SignalSample, View


def statistics_text(shown: Sequence[SignalSample], heard: SignalFacts, width: int) -> str:
    """Return mean, standard deviation, least and greatest of what is shown; as much as there is room for."""
    values = [each.value for each in shown]
    digits, mean = heard.decimals + 1, fmean(values)
    # As `statistics.stdev`, which counts in fractions and takes longer than drawing the curve.
    squares = sum((value - mean) ** 2 for value in values)
    scatter = f" ±{math.sqrt(squares / (len(values) - 1)):.{digits}f}" if len(values) > 1 else ""
    parts = [f"mean {mean:.{digits}f}{scatter} {heard.unit}",
             f"min {value_text(min(values), heard)}  max {value_text(max(values), heard)}",
             f"{len(values)} readings" if len(values) > 1 else "1 reading"]  # fmt: skip
    while cell_len("  ".join(parts)) > width and len(parts) > 1:
        parts.pop()
    return "  ".join(parts)


def marker_text(marker: Marker, view: View, *, wide: bool) -> str:
    """Return one row of the list: number, time, level, and how much now differs from it in level and direction."""
    heard, level = view.heard, view.level
    differs = f"{'--':>6}"
    if level is not None and not is_late(view, level):
        differs = f"{_difference(marker, level.level, view, wide=wide):>6}"
    time = f"{marker.utc:%H:%M:%S}" + ("Z" if wide else "")
    return f"{marker.number} {time} {value_text(marker.level, heard):>5} {differs} {_way(marker, view, wide=wide)}"


def _difference(marker: Marker, level: float, view: View, *, wide: bool) -> str:
    """Return how much stronger it is now: in dB where that is known."""
    heard, scale, by = view.heard, view.scale, level - marker.level
    if scale is not None:
        sure = scale.covers(level) and scale.covers(marker.level)
        return f"{by * scale.db_per_step:+.1f}{' dB' if wide else 'dB'}{'' if sure else '?'}"
    return f"{by:+.{max(heard.decimals, 1)}f}{' dB' if heard.scale is Scale.LOG and wide else ''}"


def _way(marker: Marker, view: View, *, wide: bool) -> str:
    """Return how far it is from here to where the dish pointed then."""
    position = view.state.position
    if position is None or view.stale or marker.az_deg is None or marker.el_deg is None:
        return "--"
    if not wide:
        return f"{separation(position.az_deg, position.el_deg, marker.az_deg, marker.el_deg):.1f}°"
    across, up = shortest_turn(position.az_deg, marker.az_deg), marker.el_deg - position.el_deg
    return f"{arrow(across, '◀', '▶')}{abs(across):.2f}° {arrow(up, '▼', '▲')}{abs(up):.2f}°"


def set_words(marker: Marker, heard: SignalFacts) -> str:
    """Return what was marked, in a sentence."""
    where = "" if marker.az_deg is None or marker.el_deg is None else f" at {marker.az_deg:.2f}°/{marker.el_deg:.2f}°"
    level = f"{value_text(marker.level, heard)} {heard.unit}"
    return f"Marker {marker.number}: {level}{where}, {marker.utc:%H:%M:%S}Z. X clears all markers."
