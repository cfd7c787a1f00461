"""A number in the JSON that a server gives: asked again and again, stamped in the middle of the exchange."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any

from birdcage.base.clock import Clock
from birdcage.base.reason import Reason
from birdcage.base.text import clean
from birdcage.signal.meter import MeterError, MeterReading, is_level

DEADLINE_S = 3.0
LARGEST = 1_000_000
ANY = "*"


class HttpMeter:
    """`path` is `psk_demod.snr`; `*` stands for any name, `0` for the first of a list."""

    def __init__(self, url: str, path: str, clock: Clock, *, every_s: float, dwell_s: float = 0.0) -> None:
        self._url, self._path, self._clock = url, path, clock
        self._every_s, self._dwell_s = every_s, dwell_s
        self._next_at = -math.inf

    def open(self) -> None:
        """Ask at once."""
        self._next_at = -math.inf

    def read(self, within_s: float) -> MeterReading | None:
        """Ask when it is time."""
        now = self._clock.monotonic()
        if now < self._next_at:
            self._clock.wait(None, min(now + within_s, self._next_at))
            if self._clock.monotonic() < self._next_at:
                return None
        asked_at = self._clock.monotonic()
        self._next_at = asked_at + self._every_s
        value = number_at(self._fetched(), self._path.split("."))
        if value is None:
            raise MeterError(f"The answer of {self._url} has no number at {self._path}. Look at it in a browser.")
        return MeterReading(value, (asked_at + self._clock.monotonic() - self._dwell_s) / 2.0, self._dwell_s)

    def close(self) -> None:
        """Nothing stays open."""

    def _fetched(self) -> object:
        from birdcage.sky.update.errors import FetchError
        from birdcage.sky.update.fetch import fetch

        try:
            reply = fetch(self._url, deadline_s=DEADLINE_S, largest=LARGEST)
        except FetchError as error:
            if error.reason is Reason.OFFLINE:
                raise MeterError(f"Nothing answers at {self._url}. Start the program that serves it.") from error
            raise MeterError(str(error)) from error
        if reply.status != 200:
            raise MeterError(f"{self._url} answers with status {reply.status}.")
        try:
            return json.loads(reply.body)
        except ValueError as error:
            shown = clean(reply.body[:40].decode("utf-8", "replace"))
            raise MeterError(f"{self._url} answers {shown!r}, which is no JSON.") from error


def number_at(data: Any, path: Sequence[str]) -> float | None:  # noqa: ANN401 - whatever JSON holds
    """Return the number at a path; None if there is none that may be a level. With `*` the first one counts."""
    if not path:
        is_number = isinstance(data, int | float) and not isinstance(data, bool) and is_level(data)
        return float(data) if is_number else None
    name, rest = path[0], path[1:]
    if isinstance(data, list):
        named = dict(zip(map(str, range(len(data))), data, strict=True))
    elif isinstance(data, dict):
        named = data
    else:
        return None
    parts = list(named.values()) if name == ANY else [named[name]] if name in named else []
    found = (number_at(part, rest) for part in parts)
    return next((each for each in found if each is not None), None)
