"""Passes as CSV (RFC 4180), one a line."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from datetime import datetime

from birdcage.sky.export.fields import Heard, values_of
from birdcage.sky.pass_row import PassRow


def passes_csv(
    rows: Iterable[PassRow], freq_hz: float | None = None, heard: Heard | None = None, now: datetime | None = None
) -> str:  # fmt: skip
    """Return a table with a line of names. Reach is written `start/end`, more than one with spaces between."""
    out = io.StringIO()
    writer: csv.DictWriter[str] | None = None
    for row in rows:
        values = values_of(row, freq_hz, heard, now)
        spans = (f"{one.start:%Y-%m-%dT%H:%M:%SZ}/{one.end:%H:%M:%SZ}" for one in row.reach.intervals)
        always = row.passing.always_up and row.reach.intervals and not row.reach.lost
        values["reach"] = "always" if always else " ".join(spans)
        values["not_reached_because"] = ", ".join(row.reach.words())
        values = {name: str(value).lower() if isinstance(value, bool) else value for name, value in values.items()}
        if writer is None:
            writer = csv.DictWriter(out, list(values))
            writer.writeheader()
        writer.writerow(values)
    return out.getvalue()
