"""stdout is data, stderr is narration."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from threading import RLock
from typing import TYPE_CHECKING, TextIO

from birdcage.cli.exits import SIGPIPE, EndedBySignal

if TYPE_CHECKING:
    from birdcage.station.state import Pointing

_PRINTS = RLock()
"""Held while a line is printed; a signal may come in the middle of one, and have another one printed."""


BAR_CELLS = 20


def say(sentence: str) -> None:
    """Tell a person something. The terminal may be gone (SIGHUP): what follows must happen all the same."""
    with contextlib.suppress(OSError):
        _print(sentence, sys.stderr)


def tell(line: str) -> None:
    """Print a line of data. `EndedBySignal` (SIGPIPE) where whoever read it is gone, as `head` is after ten lines."""
    try:
        _print(line, sys.stdout)
    except BrokenPipeError:
        raise EndedBySignal(SIGPIPE) from None


def _print(line: str, stream: TextIO) -> None:
    """Print a line whole. `print` writes its end apart, and a line of another thread may come between."""
    with _PRINTS:
        stream.write(f"{line}\n")
        stream.flush()


def drop_stdout() -> None:
    """Let what is not printed yet go nowhere: Python would try it again at its end, and complain."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)


def tell_json(value: Mapping[str, object] | Sequence[object]) -> None:
    """Print data as one line of JSON, escaped where stdout has no letters for it."""
    utf8 = (sys.stdout.encoding or "").lower().replace("-", "") == "utf8"
    tell(json.dumps(value, ensure_ascii=not utf8))


def iso(moment: datetime | None) -> str | None:
    """Return a time for JSON, UTC to the millisecond; None stays None."""
    return None if moment is None else f"{moment.astimezone(UTC):%Y-%m-%dT%H:%M:%S}.{moment.microsecond // 1000:03}Z"


def position_lines(position: Pointing) -> str:
    """Return a position as the API document shows it: at least one decimal, at most two; `SK:` if it has a skew."""
    lines = f"AZ: {round(position.az_deg, 2) % 360.0 + 0.0}\nEL: {round(position.el_deg, 2) + 0.0}"
    return lines if position.skew_deg is None else f"{lines}\nSK: {round(position.skew_deg, 2) + 0.0}"


def position_values(position: Pointing) -> dict[str, object]:
    """Return the same for JSON; `skew_deg` is null on a dish without that axis."""
    skew_deg = position.skew_deg
    return {
        "azimuth_deg": round(position.az_deg, 3),
        "elevation_deg": round(position.el_deg, 3),
        "skew_deg": None if skew_deg is None else round(skew_deg, 3),
        "modelled": position.modelled,
        "uncertainty_deg": None if position.uncertainty_deg is None else round(position.uncertainty_deg, 3),
    }


def bar(done: int, of: int) -> str:
    """Return how much of something is done, as a bar of fixed width."""
    full = min(max(round(BAR_CELLS * done / of), 0), BAR_CELLS)
    return "█" * full + "░" * (BAR_CELLS - full)


class Progress:
    """One line on a terminal, written over and over; nothing elsewhere."""

    def __init__(self) -> None:
        self._shown = False
        self._on = sys.stderr.isatty()

    def show(self, text: str) -> None:
        """Replace the line."""
        if self._on:
            self._shown = True
            self._write(f"\r\033[K{text}")

    def clear(self) -> None:
        """Take the line away, before something else is said."""
        if self._shown:
            self._shown = False
            self._write("\r\033[K")

    @staticmethod
    def _write(text: str) -> None:
        with contextlib.suppress(OSError):
            sys.stderr.write(text)
            sys.stderr.flush()
