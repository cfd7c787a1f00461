"""NMEA 0183 from a receiver's own port: GGA tells the place, RMC the date.

Both come once a second, in bursts: the fix is whole when place and date name the same second.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, date, datetime, time
from typing import Any

from birdcage.base.clock import Clock
from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.gps.fix import GpsFix, NoFix
from birdcage.gps.wire import Lines, OpenLink, opener

BAUDS = (9600, 4800, 38400, 115200)
"""In the order in which they are tried: most receivers speak 9600, the standard's own speed is 4800."""
LISTEN_S = 2.5
"""How long one speed is listened to for a first sentence: receivers speak once a second."""

MEASURED = (1, 2, 3, 4, 5, 9)
"""Qualities of GGA that are a fix; 6 to 8 are dead reckoning, typed by hand and simulated."""
ALONE = 3
"""So many of one kind in a row, and the receiver does not send the other: half of a fix is taken."""


@dataclass
class NmeaReader:
    """Takes lines, keeps what they tell. Damaged sentences are counted and skipped."""

    source: str
    good: int = 0
    damaged: int = 0
    """Lines that are no sentence or whose checksum is wrong: many of them mean another speed."""
    satellites: int | None = None
    """How many the last sentence with a count used."""
    _place: tuple[time, float, float, float | None, float | None] | None = None
    _place_in_rmc: tuple[float, float] | None = None
    _moment: datetime | None = None
    _alone: int = 0
    """How many places came in a row from one kind of sentence: above 0 from GGA, below from RMC."""

    def take(self, line: bytes, utc: datetime) -> GpsFix | None:
        """Take a line that came when this machine's clock said `utc`; return a fix when one is whole."""
        message = self._parsed(line)
        if message is None:
            return None
        if message.msgID == "GGA":
            self._take_gga(message)
        elif message.msgID == "RMC":
            self._take_rmc(message)
        else:
            return None
        return self._fix(utc)

    def _parsed(self, line: bytes) -> Any:  # noqa: ANN401 - the library makes its attributes as it parses
        from pynmeagps import NMEAReader, exceptions  # type: ignore[import-untyped]

        start = line.find(b"$")
        if start < 0 or b"*" not in line:
            self.damaged += bool(line)
            return None
        try:
            message = NMEAReader.parse(line[start:] + b"\r\n")
        except (
            exceptions.NMEAParseError, exceptions.NMEAMessageError, exceptions.NMEATypeError,
            exceptions.NMEAStreamError, ValueError, TypeError, LookupError, AttributeError,
        ):  # fmt: skip
            self.damaged += 1
            return None
        self.good += message is not None
        return message

    def _take_gga(self, message: object) -> None:
        count = getattr(message, "numSV", None)
        self.satellites, self._place = count if isinstance(count, int) else None, None
        place, moment = _place(message), getattr(message, "time", None)
        if place is None or not isinstance(moment, time) or getattr(message, "quality", 0) not in MEASURED:
            return
        # Above the sea; the geoid's own height, where told, makes it the ellipsoid's.
        height_m = _number(message, "alt")
        if height_m is not None:
            height_m += _number(message, "sep") or 0.0
        self._place = (moment, *place, height_m, _number(message, "HDOP"))
        self._alone = max(self._alone, 0) + 1

    def _take_rmc(self, message: object) -> None:
        self._moment, self._place_in_rmc = None, _place(message)
        if self._place_in_rmc is None or getattr(message, "status", "V") != "A":
            self._place_in_rmc = None
            return
        self._alone = min(self._alone, 0) - 1
        day, moment = getattr(message, "date", None), getattr(message, "time", None)
        if isinstance(day, date) and isinstance(moment, time):
            self._moment = datetime.combine(day, moment, UTC)

    def _fix(self, utc: datetime) -> GpsFix | None:
        if self._place is not None and self._moment is not None and self._place[0] == self._moment.time():
            _time, latitude, longitude, height_m, hdop = self._place
            return GpsFix(latitude, longitude, height_m, self._moment, utc, self.satellites, hdop, self.source)
        if self._place is not None and self._alone >= ALONE:
            _time, latitude, longitude, height_m, hdop = self._place
            return GpsFix(latitude, longitude, height_m, None, utc, self.satellites, hdop, self.source)
        if self._place_in_rmc is not None and self._alone <= -ALONE:
            return GpsFix(*self._place_in_rmc, None, self._moment, utc, self.satellites, None, self.source)
        return None


def read_nmea(
    url: str, clock: Clock, *, baud: int | None = None, timeout_s: float = 30.0, open_link: OpenLink | None = None,
    wake: Wake | None = None,
) -> GpsFix:  # fmt: skip
    """Return the place and time that a receiver on a serial port tells.

    Without a baud rate the usual ones are listened to. NoFix says what was seen within the deadline; LinkError when
    the port can't be opened.
    """
    open_link = open_link or opener(clock)
    until = clock.monotonic() + timeout_s
    seen: list[str] = []
    for each in (baud,) if baud is not None else BAUDS:
        reader = NmeaReader(f"{url} at {each} baud")
        if clock.monotonic() >= until:
            break
        link = open_link(url, each)
        try:
            first_until = until if baud is not None else min(until, clock.monotonic() + LISTEN_S)
            fix = _listen(reader, Lines(link, clock, wake), clock, until, first_until)
        finally:
            link.close()
        if fix is not None:
            return fix
        if reader.good:
            raise NoFix(_no_fix(reader, timeout_s))
        seen.append(f"{each} baud {'no sentence in what came' if reader.damaged else 'nothing'}")
    heard = "noise" if any("sentence" in each for each in seen) else "silent"
    raise NoFix(
        f"No GPS receiver speaks NMEA at {url}: {', '.join(seen)}. Check the port (`birdcage ports`) and its speed.",
        reason=Reason.SILENT if heard == "silent" else Reason.NO_GPS,
    )


def _listen(reader: NmeaReader, coming: Lines, clock: Clock, until: float, first_until: float) -> GpsFix | None:
    """Listen until a fix; only until `first_until` while nothing that came is a sentence."""
    while True:
        for line in coming.until(until if reader.good else first_until):
            fix = reader.take(line, clock.utc())
            if fix is not None:
                return fix
            if reader.good == 1:
                break  # it speaks: go on until the whole deadline
        else:
            return None


def _no_fix(reader: NmeaReader, timeout_s: float) -> str:
    count = "no satellite count" if reader.satellites is None else f"{reader.satellites} satellites"
    return (
        f"The receiver at {reader.source} speaks, but has no fix after {timeout_s:g} s ({count}). Give it a clear "
        "view of the sky; a cold start takes some minutes."
    )


def _place(message: object) -> tuple[float, float] | None:
    """Return latitude and longitude; a short sentence has no such fields, an empty field is text."""
    latitude, longitude = _number(message, "lat"), _number(message, "lon")
    if latitude is None or longitude is None or abs(latitude) > 90.0 or abs(longitude) > 180.0:
        return None
    return latitude, longitude


def _number(message: object, field: str) -> float | None:
    value = getattr(message, field, None)
    return float(value) if isinstance(value, float | int) else None
