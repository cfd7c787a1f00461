"""`open_link`: from what a person typed to an open port."""

from __future__ import annotations

import re
import stat
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from birdcage.base.clock import Clock
from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.link.link import Link
from birdcage.link.port import Port
from birdcage.link.transcript import Transcript

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

ENTRY_POINTS = "birdcage.link"
"""Packages register further kinds of port here: name = scheme, value = callable(address, *, clock, baud) -> Port."""

PYSERIAL_SCHEMES = ("loop", "rfc2217")

CDC_NAMES = ("ttyACM", "cu.usbmodem", "tty.usbmodem")
"""What a device is called on Linux and macOS whose USB speaks CDC ACM. Windows does not tell."""

_SCHEME = re.compile(r"([A-Za-z][A-Za-z0-9+._-]+):(.+|)")


def open_link(url: str, *, baud: int, clock: Clock, transcript: Transcript | None = None) -> Link:
    """Open a port and return it, ready to read and write.

    `url` is a device (`/dev/ttyUSB0`, `COM4`, a pseudo terminal, a link to one), `socket://host:port`,
    `rfc2217://host:port`, `loop://`, or a scheme that a package registered (`sim:g2`). `baud` counts for
    serial ports and simulated dishes. The transcript starts with the first byte.

    Raises LinkError with a sentence that says what to do. Reasons: missing, busy, permission, unsupported, failed.
    Opening `socket://` or `rfc2217://` may take 3 s: call it on a thread that may wait.
    """
    port, remark = _open_port(url, baud, clock)
    link = Link(port, clock, transcript)
    if remark is not None:
        link.remark(remark)
    return link


def _open_port(url: str, baud: int, clock: Clock) -> tuple[Port, str | None]:
    """Return the open port, and what is worth a remark about it."""
    if not url:
        raise LinkError("No port given. Name one with --port; `birdcage ports` lists them.", reason=Reason.MISSING)
    scheme = _scheme(url)
    if scheme == "socket":
        return _open_socket(url), None
    if scheme is None or scheme in PYSERIAL_SCHEMES:
        return _open_serial(url, baud, clock, is_device=scheme is None)
    return _open_registered(url, scheme, baud, clock), None


def has_speed(url: str) -> bool:
    """Return whether the baud rate of this port is ours to set: on TCP it is the server's, a loop has none."""
    return _is_serial(url)


def keeps_order(url: str) -> bool:
    """Return whether bytes written to this port come after all that an earlier program wrote to it.

    They do where both go through one queue of this machine, not where a server takes in connections.
    """
    return _is_serial(url) and _scheme(url) != "rfc2217"


def _is_serial(url: str) -> bool:
    """Return whether a serial line, or what stands for one, is behind it: not a loop, nor a network of any scheme."""
    scheme = _scheme(url)
    return scheme is None or scheme == "rfc2217" or (scheme not in ("socket", "loop") and is_registered(url))


def is_registered(url: str) -> bool:
    """Return whether a package has registered this kind of port: `sim:g2`, not `localhost:4532`."""
    scheme = _scheme(url)
    return scheme is not None and scheme in _registered()


def _scheme(url: str) -> str | None:
    """Return the scheme of a URL, None for a device (`/dev/serial/by-path/pci-0:1` and `COM4:` are devices)."""
    found = _SCHEME.fullmatch(url)
    if found is None or re.fullmatch(r"(?i)com\d+:", url) or Path(url).exists():
        return None
    return found.group(1).lower()


def _registered() -> dict[str, EntryPoint]:
    from importlib.metadata import entry_points

    return {each.name: each for each in entry_points(group=ENTRY_POINTS)}


def _open_registered(url: str, scheme: str, baud: int, clock: Clock) -> Port:
    registered = _registered()
    if scheme not in registered:
        kinds = ["a device (/dev/ttyUSB0, COM4)", "socket://host:port", "rfc2217://host:port", "loop://"]
        kinds += [f"{name}:NAME" for name in sorted(registered)]
        raise LinkError(
            f"{url}: unknown kind of port {scheme!r}. Use one of {', '.join(kinds)}.", reason=Reason.UNSUPPORTED
        )
    address = url.split(":", 1)[1]
    try:
        port: Port = registered[scheme].load()(address, clock=clock, baud=baud)
    except LinkError:
        raise
    except (ValueError, LookupError) as error:
        raise LinkError(f"{url} cannot be opened: {_sentence(error)}", reason=Reason.UNSUPPORTED) from error
    except (ConnectionError, FileNotFoundError) as error:
        raise LinkError(f"{url} is not there: {_sentence(error)}", reason=Reason.MISSING) from error
    except (OSError, ImportError) as error:
        raise LinkError(f"{url} cannot be opened: {_sentence(error)}", reason=Reason.FAILED) from error
    return port


def _open_socket(url: str) -> Port:
    from birdcage.link import socket_port

    try:
        parts = urlsplit(url)
        host, port = parts.hostname, parts.port
    except ValueError:
        host = port = None
    if not host or not port:
        raise LinkError(f"{url}: write it as socket://host:port, the port from 1 to 65535.", reason=Reason.UNSUPPORTED)
    try:
        return socket_port.connect(host, port, url)
    except TimeoutError as error:
        raise LinkError(
            f"{url} did not answer within {socket_port.CONNECT_TIMEOUT_S:.0f} s. "
            "Check the address, and that the serial server is on.",
            reason=Reason.MISSING,
        ) from error
    except OSError as error:
        raise LinkError(
            f"{url}: no connection ({error.strerror or error}). Check the address, and that the serial server listens.",
            reason=Reason.MISSING,
        ) from error


def _open_serial(url: str, baud: int, clock: Clock, *, is_device: bool) -> tuple[Port, str | None]:
    import serial

    from birdcage.link import trouble
    from birdcage.link.exclusive import shut_others_out
    from birdcage.link.latency import lower_latency
    from birdcage.link.serial_port import WRITE_TIMEOUT_S, SerialPort, leave_up, stay_up

    if is_device:
        _check_device(url, baud)
    try:
        opened = serial.serial_for_url(
            url,
            do_not_open=True,
            baudrate=baud,
            timeout=0,
            write_timeout=WRITE_TIMEOUT_S,
            exclusive=True if is_device else None,
        )
        leave_up(opened)
        opened.open()
    except (OSError, ValueError) as error:
        raise trouble.explain(url, baud, error, is_device=is_device) from error
    remarks = [f"{baud} baud 8N1"]
    if is_device:
        stay_up(opened)
        remarks += filter(None, [shut_others_out(opened), lower_latency(opened, url)])
    return SerialPort(opened, url, clock), "; ".join(remarks)


def _check_device(url: str, baud: int) -> None:
    try:
        path = Path(url).resolve()
        mode = path.stat().st_mode
    except OSError:
        return  # Opening it says what is wrong; Windows names (COM4) are no paths at all.
    if not stat.S_ISCHR(mode):
        raise LinkError(
            f"{url} is not a serial port but {_kind(mode)}; `birdcage ports` lists the ports.",
            reason=Reason.UNSUPPORTED,
        )
    if baud == 1200 and path.name.startswith(CDC_NAMES):
        raise LinkError(
            f"{url} is a USB CDC port: opening it at 1200 baud restarts many boards into their loader, "
            "so it is not done; give another --baud.",
            reason=Reason.UNSUPPORTED,
        )


def _kind(mode: int) -> str:
    return "a folder" if stat.S_ISDIR(mode) else "a file"


def _sentence(error: Exception) -> str:
    # A KeyError's own text is the quoted key.
    text = str(error.args[0]) if isinstance(error, LookupError) and error.args else str(error)
    return text if text.endswith((".", "?")) else f"{text}."
