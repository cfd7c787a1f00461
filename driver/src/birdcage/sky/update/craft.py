"""A client for the prediction server that `BIRDCAGE_CRAFT_URL` names.

Its interface is documented only by what an earlier app used of it: GET, JSON, no log-in, the paths and fields below.
Not documented, and assumed nowhere: how it writes times (ISO 8601 is read; without a zone, as UTC), for which place it
computes (none is sent: the server's own), whether its azimuths and elevations are geometric, which values `target_type`
has, and how it tells an error. So its figures are shown as its own, and nothing follows them: birdcage points by
elements that it has itself.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TypeVar
from urllib.parse import urlencode

from birdcage.base.reason import Reason
from birdcage.base.text import clean_all
from birdcage.sky.update.errors import FetchError
from birdcage.sky.update.fetch import check_url, fetch
from birdcage.sky.update.refresh import Fetch

DEADLINE_S = 10.0
"""What the documented client allows."""

Row = Mapping[str, object]
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class CraftTarget:
    """Something that the service knows by a name."""

    name: str
    target_type: str
    target_id: str
    groups: tuple[str, ...] = ()
    elevation_deg: float | None = None
    """Now, above the server's own horizon."""


@dataclass(frozen=True, slots=True)
class CraftLook:
    """Where the service sees something now, from its own place."""

    name: str
    target_type: str
    target_id: str
    azimuth_deg: float | None
    elevation_deg: float | None
    range_km: float | None
    range_rate_km_s: float | None


@dataclass(frozen=True, slots=True)
class CraftPass:
    """A pass over the server's own place."""

    name: str
    norad_id: int | None
    aos: datetime | None
    tca: datetime | None
    los: datetime | None
    aos_azimuth_deg: float | None
    tca_azimuth_deg: float | None
    los_azimuth_deg: float | None
    max_elevation_deg: float | None
    duration_s: float | None


class Craft:
    """The service at one address. Every method asks it once; FetchError for no answer or one that is not understood."""

    def __init__(self, url: str, *, ask: Fetch = fetch) -> None:
        self._url = url.rstrip("/")
        self._host = check_url(url)
        self._ask = ask

    def search(self, text: str, limit: int = 20) -> tuple[CraftTarget, ...]:
        """Return what is called like `text`."""
        return self._rows("/api/search", {"q": text, "limit": limit}, "results", _target)

    def up(self, min_elevation_deg: float = 0.0) -> tuple[CraftLook, ...]:
        """Return what is above an elevation now."""
        return self._rows("/api/sky/up", {"min_alt": min_elevation_deg}, "objects", _look)

    def passes(self, satellite: str, hours: float = 24.0) -> tuple[CraftPass, ...]:
        """Return the passes of a satellite."""
        return self._rows("/api/passes", {"sat": satellite, "hours": hours}, "passes", _pass)

    def next_pass(self, satellite: str) -> CraftPass | None:
        """Return its next pass; None for none."""
        found = self._rows("/api/passes/next", {"sat": satellite}, "passes", _pass)
        return found[0] if found else None

    def _rows(self, path: str, query: Mapping[str, object], key: str, read: Callable[[Row], T]) -> tuple[T, ...]:
        url = f"{self._url}{path}?{urlencode(query)}"
        reply = self._ask(url, headers={"Accept": "application/json"}, deadline_s=DEADLINE_S)
        if reply.status != 200:
            raise FetchError(f"{self._host} answers {reply.status}.", reason=Reason.HTTP, status=reply.status)
        try:
            found = clean_all(json.loads(reply.body))
            rows = found[key]
            if not isinstance(rows, list):
                raise TypeError(f"{key} is no list")
            return tuple(read(row) for row in rows)
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
            raise FetchError(f"{self._host} answers something unreadable ({error}).", reason=Reason.GARBAGE) from error


def _target(row: Row) -> CraftTarget:
    groups = row.get("groups") or ()
    if not isinstance(groups, list | tuple):
        raise TypeError("groups is no list")
    return CraftTarget(
        str(row["name"]), str(row["target_type"]), str(row["target_id"]), tuple(map(str, groups)),
        _number(row, "altitude_deg"),
    )  # fmt: skip


def _look(row: Row) -> CraftLook:
    return CraftLook(
        str(row["name"]), str(row["target_type"]), str(row["target_id"]), _number(row, "azimuth_deg"),
        _number(row, "altitude_deg"), _number(row, "distance_km"), _number(row, "range_rate_km_s"),
    )  # fmt: skip


def _pass(row: Row) -> CraftPass:
    norad_id = _number(row, "norad_id")
    return CraftPass(
        name=str(row["satellite_name"]),
        norad_id=None if norad_id is None else int(norad_id),
        aos=_time(row, "aos_time"),
        tca=_time(row, "tca_time"),
        los=_time(row, "los_time"),
        aos_azimuth_deg=_number(row, "aos_az"),
        tca_azimuth_deg=_number(row, "tca_az"),
        los_azimuth_deg=_number(row, "los_az"),
        max_elevation_deg=_number(row, "max_elevation"),
        duration_s=_number(row, "duration_seconds"),
    )


def _number(row: Row, key: str) -> float | None:
    value = row.get(key)
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int | float | str) or not math.isfinite(float(value)):
        raise ValueError(f"{key} is {value!r}")
    return float(value)


def _time(row: Row, key: str) -> datetime | None:
    value = row.get(key)
    if value is None:
        return None
    moment = datetime.fromisoformat(str(value))
    return moment.replace(tzinfo=UTC) if moment.tzinfo is None else moment.astimezone(UTC)
