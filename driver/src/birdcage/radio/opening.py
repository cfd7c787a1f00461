"""From what a person typed to a receiver that can be called: over TCP, or one that a package registered (`sim:rig`)."""

from __future__ import annotations

from birdcage.base.clock import Clock, WaitOutcome
from birdcage.base.errors import ConfigError, LinkError
from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.link.link import Link
from birdcage.link.opening import is_registered, open_link
from birdcage.radio.errors import RadioLost
from birdcage.radio.wire import HURRY_S, Call, Connect, RadioWire, connector

PORT = 4532
"""rigctld's and SDR++'s own; gqrx listens at 7356."""
NO_BAUD = 0
"""What is registered and simulated has no rate."""


def parse_address(text: str) -> tuple[str, int]:
    """Return host and port of `localhost:4532`, `radio.lan`, `:7356` (this machine) or `[::1]:4532`.

    ConfigError says what is wrong with it.
    """
    words = text.strip()
    bracketed = words.startswith("[")
    host, colon, port = words.removeprefix("[").rpartition("]" if bracketed else ":")
    if bracketed:
        if not colon or (port and not port.startswith(":")):
            raise _wrong(text)
        port = port.removeprefix(":")
    elif not colon:
        host, port = words, ""
    elif ":" in host:
        raise _wrong(text)  # an IPv6 address without brackets: where its port begins is a guess
    if port and not (port.isascii() and port.isdigit() and 0 < int(port) < 65536):
        raise _wrong(text)
    if not words or any(each.isspace() or each == "/" for each in host):
        raise _wrong(text)
    return host or "localhost", int(port) if port else PORT


def _wrong(text: str) -> ConfigError:
    return ConfigError(f"radio.rigctld is {text!r}, not an address. Write localhost:4532.")


def caller(address: str, clock: Clock, hurry: Wake | None = None, connect: Connect | None = None) -> tuple[str, Call]:
    """Return what to call the receiver in a sentence, and what connects to it; once `hurry` is set nothing waits long.

    `connect` opens TCP in place of sockets. ConfigError where `address` is none.
    """
    if is_registered(address):
        return address.partition("?")[0], lambda _timeout_s: _open(address, clock, hurry)
    host, port = parse_address(address)
    chosen = connect or connector(hurry)
    return f"{host}:{port}", lambda timeout_s: chosen(host, port, timeout_s)


def _open(address: str, clock: Clock, hurry: Wake | None) -> RadioWire:
    try:
        return LinkWire(open_link(address, baud=NO_BAUD, clock=clock), clock, hurry)
    except LinkError as error:
        raise RadioLost(str(error), reason=Reason.MISSING) from error


class LinkWire:
    """A registered port."""

    def __init__(self, link: Link, clock: Clock, hurry: Wake | None) -> None:
        self._link, self._clock, self._hurry = link, clock, hurry

    def send(self, data: bytes) -> None:
        """Send all of it."""
        try:
            self._link.write(data)
        except LinkError as error:
            raise RadioLost(str(error), reason=Reason.CLOSED) from error

    def receive(self, timeout_s: float) -> bytes:
        """Return what has come within the time, or less when the program is ending."""
        hurried = self._hurry is not None and self._hurry.is_set()
        wake = None if hurried else self._hurry
        until = self._clock.monotonic() + (min(timeout_s, HURRY_S) if hurried else timeout_s)
        try:
            outcome = self._clock.wait(self._link, until, wake)
            if outcome is WaitOutcome.INTERRUPTED:
                return self.receive(timeout_s)
            return self._link.read() if outcome is WaitOutcome.READY else b""
        except LinkError as error:
            raise RadioLost(str(error), reason=Reason.CLOSED) from error

    def close(self) -> None:
        """Hang up."""
        self._link.close()
