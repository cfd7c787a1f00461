"""Where a receiver listens, as people write it."""

from __future__ import annotations

from birdcage.base.errors import ConfigError

PORT = 4532
"""rigctld's and SDR++'s own; gqrx listens at 7356."""


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
