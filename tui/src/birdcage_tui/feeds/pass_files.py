"""Passes as files: a calendar, a table and JSON, side by side under one name."""

from __future__ import annotations

import json
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.paths import write_aside_and_rename

if TYPE_CHECKING:
    from birdcage.sky.export.fields import Heard
    from birdcage.sky.observer import Observer
    from birdcage.sky.pass_row import PassRow


def home_short(path: Path) -> str:
    """Return a path as a person types it: `~/passes` for what lies in the home folder."""
    try:
        return f"~/{path.relative_to(Path.home())}"
    except ValueError:
        return str(path)


def write_passes(
    rows: Sequence[PassRow], observer: Observer, now: datetime, folder: Path, note: str, heard: Heard | None = None
) -> str:  # fmt: skip
    """Write them, and return a sentence that says where. OSError if that can't be done.

    `note` is what is doubtful of them: it goes into every event of the calendar; the table and JSON name the source.
    `heard` says which downlink of a satellite is listened to.
    """
    from birdcage.sky.export.as_csv import passes_csv
    from birdcage.sky.export.as_ics import passes_ics
    from birdcage.sky.export.fields import values_of

    stem = folder / f"passes-{now:%Y%m%d-%H%M%S}"
    write_aside_and_rename(stem.with_suffix(".ics"), passes_ics(rows, observer, now, note))
    write_aside_and_rename(stem.with_suffix(".csv"), passes_csv(rows, None, heard, now).encode())
    values = json.dumps([values_of(row, None, heard, now) for row in rows], indent=1, ensure_ascii=False)
    write_aside_and_rename(stem.with_suffix(".json"), f"{values}\n".encode())
    # The path first: a narrow screen has no room for more.
    return f"{home_short(stem)}.ics, .csv, .json: {len(rows)} passes"
