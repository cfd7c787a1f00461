"""The serial ports of this machine, and finding one again that came back under another name."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from birdcage.base.text import clean

BY_ID = Path("/dev/serial/by-id")
_INTERFACE = re.compile(r":[\dx]+\.(\d+)$")


@dataclass(frozen=True, slots=True)
class PortInfo:
    """One port. What the system does not tell is None."""

    device: str
    """What to open: `/dev/ttyUSB0`, `COM4`."""
    by_id: str | None = None
    """A name that stays the same across replugging (Linux)."""
    description: str | None = None
    vid_pid: str | None = None
    """USB vendor and product, `0403:6001`."""
    serial_number: str | None = None
    topology: str | None = None
    """USB bus and socket, `1-1.4`; with configuration and interface, `1-1.4:1.0`, where a device has several."""

    @property
    def interface(self) -> str | None:
        """The USB interface of an adapter that has several: `0`, `1`; None if it has one, or is not on USB."""
        found = _INTERFACE.search(self.topology or "")
        return found.group(1) if found else None

    @property
    def identity(self) -> str | None:
        """Tells this adapter from others: `0403:6001:A50285BI`, or `1a86:7523@1-1.4` where it has no serial number.

        None for what is not on USB.
        """
        if self.vid_pid is None:
            return None
        if self.serial_number:
            return f"{self.vid_pid}:{self.serial_number}"
        return f"{self.vid_pid}@{self.topology or '?'}"


PortLister = Callable[[], list[PortInfo]]


def list_ports() -> list[PortInfo]:
    """Return the ports that there are now, sorted by device; USB ones first."""
    from serial.tools import list_ports as pyserial_ports

    links = _links(BY_ID)
    ports = [
        PortInfo(
            device=each.device,
            by_id=links.get(str(Path(each.device).resolve())),
            description=_known(each.description),
            vid_pid=None if each.vid is None else f"{each.vid:04x}:{each.pid or 0:04x}",
            serial_number=_known(each.serial_number),
            topology=_known(each.location),
        )
        for each in pyserial_ports.comports()
    ]
    return sorted(ports, key=lambda port: (port.vid_pid is None, port.device))


def find_again(identity: str, list_ports: PortLister = list_ports) -> str | None:
    """Return the device that `identity` (a `PortInfo.identity`) has now; None if absent, or if it could be either.

    An adapter without a serial number that moved to another socket is found as long as it is the only one of its
    make.
    """
    ports = list_ports()
    exact = [port.device for port in ports if port.identity == identity]
    if len(exact) == 1:
        return exact[0]
    make, _, socket = identity.partition("@")
    alike = [port.device for port in ports if socket and port.vid_pid == make and not port.serial_number]
    return alike[0] if not exact and len(alike) == 1 else None


def identify(device: str, list_ports: PortLister = list_ports) -> str | None:
    """Return the identity of an open or present device (a link to it counts), None if it is not on USB."""
    port = find_port(device, list_ports)
    return None if port is None else port.identity


def find_port(device: str, list_ports: PortLister = list_ports) -> PortInfo | None:
    """Return what the system tells of a device (a link to it counts); None if it is not among the ports."""
    target = str(Path(device).resolve())
    for port in list_ports():
        if device in (port.device, port.by_id) or port.device == target:
            return port
    return None


def _links(folder: Path) -> dict[str, str]:
    try:
        return {str(link.resolve()): str(link) for link in sorted(folder.iterdir())}
    except OSError:
        return {}


def _known(text: str | None) -> str | None:
    return None if not text or text == "n/a" else clean(text)
