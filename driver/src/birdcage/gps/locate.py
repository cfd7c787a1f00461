"""`locate`: from what a person calls the receiver to a place."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import urlsplit

from birdcage.base.clock import Clock
from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.gps.fix import GpsFix, NoFix
from birdcage.gps.gpsd import HOST, PORT, read_gpsd
from birdcage.gps.nmea import read_nmea
from birdcage.gps.wire import OpenLink


def locate(
    receiver: str, clock: Clock, *, baud: int | None = None, timeout_s: float = 20.0, dish_port: str | None = None,
    open_link: OpenLink | None = None, wake: Wake | None = None,
) -> GpsFix:  # fmt: skip
    """Return where a receiver says it is: `gpsd`, `gpsd://host:port`, or a port with NMEA, for example `/dev/ttyACM0`.

    `dish_port` is never opened, whatever it is called. NoFix, LinkError: the sentence says what to do.
    """
    receiver = receiver.strip() or "gpsd"
    if receiver == "gpsd" or receiver.startswith("gpsd://"):
        host, port = _address(receiver)
        return read_gpsd(clock, host, port, timeout_s=timeout_s, open_link=open_link, wake=wake)
    if dish_port is not None and _same_port(receiver, dish_port):
        raise NoFix(f"{receiver} is where the dish is: a receiver has a port of its own.", reason=Reason.BUSY)
    return read_nmea(receiver, clock, baud=baud, timeout_s=timeout_s, open_link=open_link, wake=wake)


def _address(receiver: str) -> tuple[str, int]:
    if receiver == "gpsd":
        return HOST, PORT
    try:
        parts = urlsplit(receiver)
        return parts.hostname or HOST, parts.port or PORT
    except ValueError:
        raise NoFix(
            f"{receiver}: write it as gpsd://host:port, the port from 1 to 65535.", reason=Reason.NO_GPS
        ) from None


def _same_port(one: str, other: str) -> bool:
    return one == other or Path(one).resolve() == Path(other).resolve()
