"""gpsd, the daemon that shares a receiver: JSON lines over TCP (gpsd_json: VERSION, ?WATCH, TPV, SKY)."""

from __future__ import annotations

import json
import math
from datetime import UTC, datetime
from typing import Any

from birdcage.base.clock import Clock
from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.base.text import clean
from birdcage.base.wake import Wake
from birdcage.gps.fix import GpsFix, NoFix
from birdcage.gps.wire import Lines, OpenLink, opener

HOST, PORT = "localhost", 2947
WATCH = b'?WATCH={"enable":true,"json":true};\n'


class GpsdReader:
    """Takes reports, keeps what they tell."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.version: str | None = None
        """The daemon's release; None until it has introduced itself."""
        self.devices: int | None = None
        """How many receivers it has; None before it said so."""
        self.mode: int | None = None
        """0 or 1: no fix, 2: place, 3: place and height."""
        self.damaged = 0
        self.satellites: int | None = None
        self.hdop: float | None = None

    def take(self, line: bytes, utc: datetime) -> GpsFix | None:
        """Take a line that came when this machine's clock said `utc`; return a fix when it is one."""
        try:
            report = json.loads(line)
        except (ValueError, RecursionError):
            self.damaged += bool(line)
            return None
        if not isinstance(report, dict):
            self.damaged += 1
            return None
        match report.get("class"):
            case "VERSION":
                self.version = clean(str(report.get("release", "?")))
            case "DEVICES":
                devices = report.get("devices")
                self.devices = len(devices) if isinstance(devices, list) else None
            case "SKY":
                self._take_sky(report)
            case "TPV":
                return self._take_tpv(report, utc)
        return None

    def _take_sky(self, report: dict[str, Any]) -> None:
        used = report.get("uSat")
        satellites = report.get("satellites")
        if not isinstance(used, int) and isinstance(satellites, list):
            used = sum(1 for each in satellites if isinstance(each, dict) and each.get("used") is True)
        if isinstance(used, int):
            self.satellites = used
        self.hdop = _number(report, "hdop") or self.hdop

    def _take_tpv(self, report: dict[str, Any], utc: datetime) -> GpsFix | None:
        mode = report.get("mode")
        self.mode = mode if isinstance(mode, int) else None
        latitude, longitude = _number(report, "lat"), _number(report, "lon")
        if self.mode is None or self.mode < 2 or latitude is None or longitude is None:
            return None
        if abs(latitude) > 90.0 or abs(longitude) > 180.0:
            self.damaged += 1
            return None
        height_m = None
        if self.mode >= 3:
            # Releases before 3.20 know `alt` alone, above the sea; the geoid's height is then not told either.
            height_m = next((v for v in (_number(report, key) for key in ("altHAE", "altMSL", "alt")) if v is not None),
                            None)  # fmt: skip
        moment = _moment(report.get("time"))
        return GpsFix(latitude, longitude, height_m, moment, utc, self.satellites, self.hdop, self.source)


def read_gpsd(
    clock: Clock, host: str = HOST, port: int = PORT, *, timeout_s: float = 10.0, open_link: OpenLink | None = None,
    wake: Wake | None = None,
) -> GpsFix:  # fmt: skip
    """Return the place and time that a gpsd tells. NoFix says what was seen within the deadline, or that none runs.

    Connecting may take 3 s of it, so call it on a thread that may wait.
    """
    source = f"gpsd at {host}:{port}"
    url = f"socket://[{host}]:{port}" if ":" in host else f"socket://{host}:{port}"
    until = clock.monotonic() + timeout_s
    try:
        link = (open_link or opener(clock))(url, 9600)
    except LinkError as error:
        raise NoFix(f"No {source}: start it, or name the receiver's own port.", reason=Reason.NO_GPS) from error
    reader = GpsdReader(source)
    first: GpsFix | None = None
    try:
        link.write(WATCH)
        for line in Lines(link, clock, wake).until(until):
            fix = reader.take(line, clock.utc())
            if fix is not None and fix.satellites is not None:
                return fix
            if fix is not None and first is not None:
                return fix  # a second without a word of its satellites: it does not tell them
            first = first or fix
    except LinkError as error:
        raise NoFix(f"{source} closed the connection.", reason=Reason.SILENT) from error
    finally:
        link.close()
    if first is not None:
        return first
    raise NoFix(_why(reader, timeout_s), reason=Reason.NO_GPS if reader.version is None else Reason.NO_FIX)


def _why(reader: GpsdReader, timeout_s: float) -> str:
    if reader.version is None:
        heard = f"{reader.damaged} lines that are not JSON" if reader.damaged else "silence"
        return f"What answers as {reader.source} is not gpsd: {heard} for {timeout_s:g} s."
    if reader.devices == 0:
        return f"{reader.source} (release {reader.version}) has no receiver: plug one in, or start gpsd with its port."
    sees = "" if reader.satellites is None else f", {reader.satellites} satellites used"
    return (
        f"{reader.source} has no fix after {timeout_s:g} s (mode {'unknown' if reader.mode is None else reader.mode}"
        f"{sees}). Give the receiver a clear view of the sky; a cold start takes some minutes."
    )


def _number(report: dict[str, Any], key: str) -> float | None:
    value = report.get(key)
    if isinstance(value, bool) or not isinstance(value, float | int) or not math.isfinite(value):
        return None
    return float(value)


def _moment(value: object) -> datetime | None:
    if not isinstance(value, str):
        return None
    try:
        moment = datetime.fromisoformat(value)
    except ValueError:
        return None
    return moment.astimezone(UTC) if moment.tzinfo is not None else None
