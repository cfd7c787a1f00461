"""What a pass heard against elevation, and the files that hooks made of it, as tables for people and as values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.cli.say import iso, tell
from birdcage.cli.table import tell_table
from birdcage.pursuit.heard_by_elevation import HeardBin, Way, levels_by_elevation, snr_by_elevation
from birdcage.pursuit.made_files import size_of

if TYPE_CHECKING:
    from birdcage.pursuit.pass_record import MadeFile, PassSample

BAR = 12
"""Columns of a bar."""
EIGHTHS = " ▏▎▍▌▋▊▉"
TIMES_SCATTER = 4.0
"""A bar spans so many times the scatter of one reading at least: noise stays small."""
NOTHING = "-"


def tell_heard(samples: Sequence[PassSample]) -> None:
    """Print level and SNR, a line each range of elevation; a dash where nothing was heard."""
    levels, snr = levels_by_elevation(samples), snr_by_elevation(samples)
    if not levels and not snr:
        tell(f"{'heard':14} {NOTHING}")
        return
    for unit in dict.fromkeys(each.unit for each in levels):
        _tell_bins(f"level against elevation, {unit}", [each for each in levels if each.unit == unit])
    if snr:
        _tell_bins("SNR against elevation, dB", snr)


def _tell_bins(title: str, bins: Sequence[HeardBin]) -> None:
    low, high = _scale(bins)
    digits = 1 if high - low < 100.0 else 0
    tell(f"\n{title}; bars from {low:.{digits}f} to {high:.{digits}f}; ± scatter of one reading, N readings")
    ways = [way for way in Way if any(each.way is way for each in bins)]
    head = ["EL", *(word for way in ways for word in (way.value.upper(), "±", "N", ""))]
    rows: dict[float, list[str]] = {}
    for each in bins:
        row = rows.setdefault(
            each.low_deg, [f"{each.low_deg:g} to {each.high_deg:g}°", *[NOTHING, NOTHING, "0", ""] * len(ways)]
        )
        at = 1 + 4 * ways.index(each.way)
        scatter = NOTHING if each.scatter is None else f"{each.scatter:.{digits + 1}f}"
        row[at : at + 4] = [f"{each.mean:.{digits}f}", scatter, str(each.n), _bar(each.mean, low, high)]
    tell_table(head, list(rows.values()), "r" + "rrrl" * len(ways))


def _scale(bins: Sequence[HeardBin]) -> tuple[float, float]:
    """Return where bars begin and end: around all means, and wide enough for noise to look like noise."""
    low, high = min(each.mean for each in bins), max(each.mean for each in bins)
    least = TIMES_SCATTER * max((each.scatter or 0.0 for each in bins), default=0.0)
    spare = max(least - (high - low), (high - low) * 0.1, 1e-6)
    return low - spare / 2.0, high + spare / 2.0


def _bar(value: float, low: float, high: float) -> str:
    """Return a bar of at most `BAR` columns, to the eighth of one."""
    eighths = round((value - low) / (high - low) * BAR * 8)
    return "█" * (eighths // 8) + EIGHTHS[eighths % 8].strip()


def tell_files(files: Sequence[MadeFile]) -> None:
    """Print what hooks made, with its size of now; a dash where they told of nothing."""
    if not files:
        tell(f"{'files':14} {NOTHING}")
        return
    tell("\nfiles that hooks made")
    tell_table(("SIZE", "FILES", "WHERE"), [_file_row(each) for each in files], "rr")


def _file_row(file: MadeFile) -> tuple[str, str, str]:
    now = size_of(file.path)
    if now is not None:
        return _size(now[0]), str(now[1]), file.path
    before = "never seen" if file.size_bytes is None else f"was {_size(file.size_bytes)}"
    return "gone", NOTHING, f"{file.path} ({before})"


def _size(size_bytes: int) -> str:
    size, unit = float(size_bytes), "B"
    for larger in ("kB", "MB", "GB", "TB"):
        if size < 1000.0:
            break
        size, unit = size / 1000.0, larger
    return f"{size:.0f} {unit}" if unit == "B" or size >= 100.0 else f"{size:.1f} {unit}"


def values_of_heard(samples: Sequence[PassSample]) -> dict[str, object]:
    """Return both for JSON: lists of bins, empty where nothing was heard."""
    return {
        "level_by_elevation": [_bin_values(each) for each in levels_by_elevation(samples)],
        "snr_by_elevation": [_bin_values(each) for each in snr_by_elevation(samples)],
    }


def _bin_values(heard: HeardBin) -> Mapping[str, object]:
    scatter = None if heard.scatter is None else round(heard.scatter, 6)
    return {**asdict(heard), "way": heard.way.value, "mean": round(heard.mean, 6), "scatter": scatter}


def values_of_files(files: Sequence[MadeFile]) -> list[dict[str, object]]:
    """Return files for JSON: as they are now, or as they were seen last and `exists` false."""
    told: list[dict[str, object]] = []
    for each in files:
        size_bytes, count = size_of(each.path) or (each.size_bytes, each.files)
        told.append({
            "utc": iso(each.utc), "path": each.path, "exists": Path(each.path).exists(), "size_bytes": size_bytes,
            "files": count,
        })  # fmt: skip
    return told
