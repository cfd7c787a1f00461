"""Passes as a table for people."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.cli.table import cut, fitting, tell_table, widths_of
from birdcage.sky.age import expected_error
from birdcage.sky.age_words import REENTERED, degrees
from birdcage.sky.doppler import doppler_hz
from birdcage.sky.downlinks_age import is_doubtful
from birdcage.sky.downlinks_words import satdump_words

if TYPE_CHECKING:
    from birdcage.sky.export.fields import Heard
    from birdcage.sky.pass_row import PassRow

HEAD = ("AOS (UTC)", "LOS", "NAME", "MAX", "AZIMUTHS", "REACH", "FROM", "BEST", "NOT WHERE", "SUN", "AGE", "ERROR")
RIGHT = frozenset({"MAX", "REACH", "BEST", "AGE", "DOPPLER"})
SIGNAL = ("DOWNLINK", "SATDUMP")
SPARED = ("AGE", "SATDUMP", "SUN", "BEST", "NOT WHERE", "FROM", "DOWNLINK", "ERROR")
"""What a narrow terminal goes without, the first one first."""
SHORTEST_NAME = 16


def tell_passes(
    rows: Sequence[PassRow], start: datetime, freq_hz: float | None = None, width: int | None = None, *,
    heard: Heard | None = None, now: datetime | None = None,
) -> tuple[str, ...]:  # fmt: skip
    """Print passes, one a line, at most `width` wide. The date stands where it changes; `-` is nothing, or not known.

    What is `heard` of a satellite has columns where any is. Return the columns that there was no room for.
    """
    if not rows:
        return ()
    head = HEAD if freq_hz is None else (*HEAD, "DOPPLER")
    lines = [_cells(row, start, freq_hz) for row in rows]
    signals = [_signal(row, heard, start if now is None else now) for row in rows]
    if any(each != ("-", "-") for each in signals):
        head, lines = (*head, *SIGNAL), [(*line, *each) for line, each in zip(lines, signals, strict=True)]
    spared = [each for each in SPARED if each in head]
    shown, name_width = fitting(head, widths_of(head, lines), width, spared, "NAME", SHORTEST_NAME)
    name = head.index("NAME")
    lines = [(*line[:name], cut(line[name], name_width), *line[name + 1 :]) for line in lines]
    tell_table(
        [head[column] for column in shown],
        [[line[column] for column in shown] for line in lines],
        "".join("r" if head[column] in RIGHT else " " for column in shown),
    )
    return tuple(name for column, name in enumerate(head) if column not in shown)


def _cells(row: PassRow, start: datetime, freq_hz: float | None) -> tuple[str, ...]:
    passing, found = row.passing, row.reach
    day = "" if passing.aos.date() == start.date() else f"{passing.aos:%m-%d} "
    azimuths = (passing.aos_azimuth_deg, passing.tca_azimuth_deg, passing.los_azimuth_deg)
    stays = passing.always_up
    reach = "-" if not found.intervals else minutes(found.total_s)
    if stays and found.intervals:
        reach = "in parts" if found.lost else "always"
    cells = (
        "always up" if stays else f"{day}{passing.aos:%H:%M:%S}{'<' if passing.already_up else ''}",
        "-" if stays else f"{passing.los:%H:%M:%S}{'>' if passing.still_up else ''}",
        f"{'* ' if row.favourite else ''}{passing.name}",
        f"{passing.max_elevation_deg:.1f}°",
        " ".join(f"{az % 360.0:3.0f}°" for az in azimuths),
        reach,
        f"{found.intervals[0].start:%H:%M:%S}" if found.intervals and not (stays and not found.lost) else "-",
        "-" if found.best_el_deg is None else f"{found.best_el_deg:.1f}°",
        ", ".join(found.words()) or "-",
        _sun(row),
        _age(row.epoch_age_s),
        _error(row),
    )
    if freq_hz is None:
        return cells
    return (*cells, f"{doppler_hz(freq_hz, row.at_aos.range_rate_km_s) / 1e3:+.2f} kHz")


def _signal(row: PassRow, heard: Heard | None, now: datetime) -> tuple[str, str]:
    """Return `1701.3 AHRPT`, and what SatDump calls it; `?` behind what is doubtful."""
    found = None if heard is None else heard(row.passing.norad_id, row.passing.name)
    if found is None:
        return "-", "-"
    doubt = " ?" if is_doubtful(found.downlink, now) else ""
    told = f"{found.center_hz / 1e6:.10g} {found.downlink.mode}".rstrip() + doubt
    return told, satdump_words(found.downlink) or "-"


def minutes(seconds: float) -> str:
    """Return a span as `8:05`, hours in front where there are any."""
    whole = round(seconds)
    hours, rest = divmod(whole, 3600)
    return f"{hours}:{rest // 60:02}:{rest % 60:02}" if hours else f"{rest // 60}:{rest % 60:02}"


def _sun(row: PassRow) -> str:
    """Return how much of the pass is lit, and how near the Sun is where that is near."""
    lit = "lit" if row.sunlit_share > 0.99 else "dark" if row.sunlit_share < 0.01 else f"{row.sunlit_share:.0%} lit"
    return lit if row.sun is None or row.sun.separation_deg > 10.0 else f"{lit}, {row.sun.separation_deg:.1f}° off"


def _age(seconds: float) -> str:
    hours = seconds / 3600.0
    return f"{hours:.0f} h" if abs(hours) < 48.0 else f"{hours / 24.0:.0f} d"


def _error(row: PassRow) -> str:
    """Return how far off the dish may look at TCA, by the age of the elements: a glyph and the median."""
    found = expected_error(row.elements, row.passing.tca, row.at_tca.range_km)
    if found.reentry is not None:
        return f"{found.glyph} {REENTERED}"
    return f"{found.glyph} {degrees(found.pointing_median_deg)}"
