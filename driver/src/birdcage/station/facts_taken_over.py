"""What earlier versions kept of a dish in two files: `gear.json` and `moves.json`. It is taken over once."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

GEAR, MOVES = "gear.json", "moves.json"
LONGEST = 4096
"""Bytes that are read of a file: ours has some nine hundred."""
_KINDS = {"play": "play_deg", "overshoot up": "mean_overshoot_up_deg", "overshoot down": "mean_overshoot_down_deg"}
_ORIGINS = {"set by the user": "user", "learnt from readings at rest": "learnt"}


def told_in(path: Path) -> dict[str, Any]:
    """Return what a file says; nothing where that cannot be read."""
    try:
        with path.open("rb") as opened:
            told = json.loads(opened.read(LONGEST))
    except (OSError, ValueError, RecursionError):
        return {}
    return told if isinstance(told, dict) else {}


def earlier_firmware(folder: Path) -> object:
    """Return the firmware that the files name; None if none does."""
    return told_in(folder / GEAR).get("firmware") or told_in(folder / MOVES).get("firmware")


def earlier_told(folder: Path, firmware: str | None) -> Iterator[list[dict[str, Any]]]:
    """Yield what each file says of a dish of this firmware, in today's form; what is in no such form is left out."""
    gear, moves = told_in(folder / GEAR), told_in(folder / MOVES)
    if gear.get("firmware") == firmware:
        with suppress(KeyError, TypeError):
            yield [
                {
                    "name": f"{each['axis']}.{_KINDS[each['kind']]}", "value": each["deg"],
                    "origin": _ORIGINS[each["origin"]], "utc": each["utc"], "readings": each["readings"],
                }
                for each in gear["facts"]
            ]  # fmt: skip
    if moves == {"firmware": firmware, "second_move": "block"}:
        utc = datetime.fromtimestamp((folder / MOVES).stat().st_mtime, UTC).isoformat(timespec="seconds")
        yield [
            {"name": name, "value": "block", "origin": "learnt", "utc": utc, "readings": 1}
            for name in ("second_same", "second_other")
        ]


def remove_earlier(folder: Path) -> None:
    """Remove both. OSError."""
    for name in (GEAR, MOVES):
        (folder / name).unlink(missing_ok=True)
