"""A receiver on a virtual clock: says what it is told to, when it is told to."""

from __future__ import annotations

import math

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.link.link import Link


def sentence(body: str) -> bytes:
    """Return an NMEA sentence with its checksum."""
    check = 0
    for each in body.encode():
        check ^= each
    return f"${body}*{check:02X}\r\n".encode()


def gga(hhmmss: str, *, quality: int = 1, satellites: int = 8, height: str = "545.4,M,46.9,M") -> bytes:
    return sentence(f"GPGGA,{hhmmss}.00,4807.038,N,01131.000,E,{quality},{satellites:02},0.9,{height},,")


def rmc(hhmmss: str, *, status: str = "A", date: str = "200326") -> bytes:
    return sentence(f"GPRMC,{hhmmss}.00,{status},4807.038,N,01131.000,E,000.0,000.0,{date},,,A")


class Receiver:
    """A port. `script` is a list of (seconds after opening, bytes)."""

    demo = False

    def __init__(self, clock: VirtualClock, name: str, script: list[tuple[float, bytes]], *, hangs_up: bool = False):
        self.name, self._clock, self._hangs_up = name, clock, hangs_up
        begin = clock.monotonic()
        self._script = [(begin + at, data) for at, data in script]
        self.written = b""
        self.closed = False

    def fileno(self) -> None:
        return None

    def next_event(self) -> float:
        return self._script[0][0] if self._script else (self._clock.monotonic() if self._hangs_up else math.inf)

    def pending(self) -> bool:
        return self.next_event() <= self._clock.monotonic()

    def read(self) -> bytes:
        data = b""
        while self._script and self._script[0][0] <= self._clock.monotonic():
            data += self._script.pop(0)[1]
        if not data and self._hangs_up:
            raise ConnectionError("closed")
        return data

    def write(self, data: bytes) -> None:
        self.written += data

    def discard(self) -> None:
        raise AssertionError("nothing that a receiver says is thrown away")

    def close(self) -> None:
        self.closed = True


class Bank:
    """Opens receivers by URL and baud rate, and remembers which."""

    def __init__(self, clock: VirtualClock, ports: dict[tuple[str, int], list[tuple[float, bytes]]], **more):
        self._clock, self._ports, self._more = clock, ports, more
        self.opened: list[tuple[str, int]] = []
        self.receivers: list[Receiver] = []

    def __call__(self, url: str, baud: int) -> Link:
        self.opened.append((url, baud))
        if not any(known == url for known, _baud in self._ports):
            raise LinkError(f"{url} is not there.", reason="missing")
        receiver = Receiver(self._clock, url, self._ports.get((url, baud), []), **self._more)
        self.receivers.append(receiver)
        return Link(receiver, self._clock)
