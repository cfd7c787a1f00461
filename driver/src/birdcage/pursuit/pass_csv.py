"""A pass as CSV: comments that say what it is, then a line a sample, on disk as soon as it is known."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import BinaryIO

from birdcage.pursuit.pass_record import SAMPLE, PassHead, PassSample, stamp

DEMO = "DEMO: a simulated dish, not a real one"


def head_lines(head: PassHead) -> Iterator[str]:
    """Yield the comments at the head of a file, and the names of its columns."""
    if head.demo:
        yield f"# {DEMO}"
    told = (
        ("target", head.name if head.norad_id is None else f"{head.name} ({head.norad_id})"),
        ("site", head.site),
        ("started", stamp(head.started)),
        ("aos", _time(head.aos)),
        ("reach", _reach(head)),
        ("los", _time(head.los)),
        ("controller", head.controller),
        ("elements of", _time(head.elements_epoch)),
        ("time offset", f"{head.time_offset_s:+g} s" if head.time_offset_s else None),
        ("angles", "true degrees; error_deg: between target and reported direction, on the sky"),
    )
    for name, value in told:
        if value:
            # A name out of a file of elements may hold anything; a line of its own it shall not make.
            yield f"# {name}: {' '.join(value.split())}"
    yield ",".join(SAMPLE)


def sample_line(sample: PassSample) -> str:
    """Return one line, with its end."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(_cell(getattr(sample, name)) for name in SAMPLE)
    return text.getvalue()


def whole_csv(head: PassHead, samples: Iterable[PassSample]) -> str:
    """Return a whole pass as CSV."""
    return "".join(f"{line}\n" for line in head_lines(head)) + "".join(map(sample_line, samples))


class PassCsv:
    """The file of one pass. OSError leaves `write` when the disk is full; nothing half is in the file then."""

    def __init__(self, folder: Path, head: PassHead) -> None:
        """Make the file, with its head. OSError if it can't be made."""
        folder.mkdir(parents=True, exist_ok=True)
        self.path, self._file = _make(folder, f"{head.started:%Y%m%dT%H%M%SZ}_{_plain(head)}")
        self._good = 0
        try:
            self._append("".join(f"{line}\n" for line in head_lines(head)))
        except OSError:
            self._file.close()
            self.path.unlink(missing_ok=True)
            raise

    def write(self, samples: Sequence[PassSample]) -> None:
        """Append samples, each with a flush of its own, so that a crash loses the last one at most."""
        for sample in samples:
            self._append(sample_line(sample))

    def close(self) -> None:
        """Close the file; nothing is held back."""
        self._file.close()

    def _append(self, text: str) -> None:
        try:
            # A line that did not fit whole is taken away by the next one that does.
            self._file.seek(self._good)
            data = text.encode()
            written = 0
            while written < len(data):
                written += self._file.write(data[written:])
            self._file.flush()
        except OSError:
            self._file.truncate(self._good)
            raise
        self._good += len(data)


def _make(folder: Path, name: str) -> tuple[Path, BinaryIO]:
    """Make a file that was not there."""
    for number in range(1, 1000):
        path = folder / (f"{name}.csv" if number == 1 else f"{name}-{number}.csv")
        try:
            # Unbuffered: what is written is with the system, and outlives this program.
            return path, path.open("xb", buffering=0)
        except FileExistsError:
            continue
    raise FileExistsError(f"{folder} has a thousand files named {name}")


def _plain(head: PassHead) -> str:
    """Return a name that every file system takes."""
    words = re.sub(r"[^A-Za-z0-9.+]+", "-", head.name).strip("-.") or head.kind
    return words[:40] if head.norad_id is None else f"{words[:40]}_{head.norad_id}"


def _reach(head: PassHead) -> str | None:
    if head.reach_start is None:
        return None
    return f"{_time(head.reach_start)} {'on' if head.reach_end is None else f'to {_time(head.reach_end)}'}"


def _time(moment: datetime | None) -> str | None:
    return None if moment is None else stamp(moment.astimezone(UTC))


def _cell(value: object) -> object:
    if isinstance(value, datetime):
        return stamp(value)
    return "" if value is None else round(value, 5) if isinstance(value, float) else value
