"""Peaks are kept as they are taken, one line of JSON each: a crash loses none.

The file holds those of the dish as it stands. Who moves its base removes them and begins anew.
"""

from __future__ import annotations

import json
import math
import os
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

from birdcage.base.errors import StoreError
from birdcage.base.paths import Paths, write_aside_and_rename
from birdcage.base.reason import Reason
from birdcage.base.text import clean_all
from birdcage.base.user_file import check_regular, read_user_file
from birdcage.calibration.peak import MeasuredPeak

MOST_BYTES = 20_000_000
_ANGLES = ("true_az_deg", "true_el_deg", "dish_az_deg", "dish_el_deg", "sigma_deg")


@dataclass(frozen=True, slots=True)
class Peaks:
    """What the file holds, as far as it could be read."""

    entries: tuple[MeasuredPeak, ...] = ()
    problems: tuple[str, ...] = ()
    """Sentences with file and line. Such lines stay in the file, and count for nothing."""


def peaks_file(paths: Paths) -> Path:
    """Return where peaks are kept."""
    return paths.own / "peaks.jsonl"


def load_peaks(path: Path) -> Peaks:
    """Read the file; one that is absent is empty. Nothing is raised: what is wrong stands in `problems`."""
    try:
        lines = _lines(path)
    except FileNotFoundError:
        return Peaks()
    except OSError as error:
        return Peaks((), (f"{path} can't be read ({error.strerror or error}).",))
    entries, problems = [], []
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        try:
            entries.append(_peak(line))
        except (ValueError, TypeError, KeyError) as wrong:
            problems.append(f"{path} line {number} is no peak ({wrong}).")
    return Peaks(tuple(entries), tuple(problems))


def add_peak(path: Path, peak: MeasuredPeak) -> MeasuredPeak:
    """Put a peak at the end, on the disk when this returns; return it with its number. StoreError if it can't be."""
    kept = replace(peak, number=1 + max((each.number for each in load_peaks(path).entries), default=0))
    line = json.dumps({**asdict(kept), "utc": kept.utc.astimezone(UTC).isoformat(timespec="milliseconds")}) + "\n"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists():
            check_regular(path)
        with path.open("ab") as file:
            if file.tell() and not _ends_line(path):
                file.write(b"\n")  # the last line was cut off by a crash: this one is not to be lost with it
            file.write(line.encode())
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        raise StoreError(f"{path} can't be written ({error.strerror or error}): the peak was not saved.") from error
    return kept


def remove_peaks(path: Path, *numbers: int) -> Peaks:
    """Take out the peaks with these numbers, or all of them without a number; return what is left.

    StoreError, with nothing written, if there is no such number or the file can't be written.
    """
    kept = load_peaks(path)
    missing = set(numbers) - {peak.number for peak in kept.entries}
    if missing:
        raise StoreError(f"There is no peak {min(missing)}. Nothing was removed.", reason=Reason.MISSING)
    lines = _lines(path) if numbers else []
    left = [line for line in lines if not _is_one_of(line, numbers)]
    try:
        write_aside_and_rename(path, "".join(f"{line}\n" for line in left).encode())
    except OSError as error:
        raise StoreError(f"{path} can't be written ({error.strerror or error}): nothing was removed.") from error
    return load_peaks(path)


def _lines(path: Path) -> list[str]:
    return read_user_file(path, MOST_BYTES).decode("utf-8", "replace").splitlines()


def _ends_line(path: Path) -> bool:
    with path.open("rb") as file:
        file.seek(-1, os.SEEK_END)
        return file.read(1) == b"\n"


def _is_one_of(line: str, numbers: tuple[int, ...]) -> bool:
    try:
        return _peak(line).number in numbers
    except (ValueError, TypeError, KeyError):
        return False


def _peak(line: str) -> MeasuredPeak:
    """Read one line. ValueError, TypeError or KeyError for what is no peak."""
    row = clean_all(json.loads(line))
    utc = datetime.fromisoformat(row["utc"])
    if utc.tzinfo is None:
        raise ValueError("its time has no zone")
    angles = {name: float(row[name]) for name in _ANGLES}
    if not all(map(math.isfinite, angles.values())) or angles["sigma_deg"] <= 0.0:
        raise ValueError("an angle is no number")
    if row["found"] not in ("hand", "rssi"):
        raise ValueError(f"it was found by {row['found']!r}")
    rise_db = row.get("rise_db")
    return MeasuredPeak(
        utc=utc, target=str(row["target"]), found=row["found"], rise_db=None if rise_db is None else float(rise_db),
        number=int(row["number"]), **angles,
    )  # fmt: skip
