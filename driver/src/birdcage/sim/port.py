"""The program's end of a simulated dish: what `sim:g2` opens."""

from __future__ import annotations

import difflib
import math
import threading
from importlib.metadata import entry_points
from typing import Any

from birdcage.base.clock import Clock
from birdcage.sim.device import Device
from birdcage.sim.dish import DishMechanics
from birdcage.sim.firmware import FirmwareKind
from birdcage.sim.rig import RigSettings, SimReceiver
from birdcage.sim.rig_port import RigPort
from birdcage.sim.settings import parse_query
from birdcage.sim.wire import SimWire

TWINS = "birdcage.twins"
"""Packages name simulated firmwares here: name = `module:attribute` of a `FirmwareKind`; ours, too."""

_named: dict[str, Device] = {}
_named_lock = threading.Lock()


class SimPort:
    """Bytes to and from a simulated dish, in memory. Methods may be called from different threads at the same time.

    Once the adapter was pulled out, or the port closed, every call raises `ConnectionError`. `baud` is the rate at
    which the program speaks: any other than the dish's own meets what setting `wrong_baud` says; None always fits.
    """

    demo = True

    def __init__(self, device: Device, name: str, *, baud: int | None = None) -> None:
        self.device = device
        self.name = name
        self._session = device.session
        self._closed = False
        if not device.wire.plugged:
            raise ConnectionError(f"{name}: the adapter is not there")
        self.set_baud(baud)
        self.read()  # what came while the port was closed is lost, as on a real one

    @property
    def dish(self) -> DishMechanics:
        """The simulated dish; `dish.truth()` tells what it really does."""
        return self.device.dish

    @property
    def wire(self) -> SimWire:
        """The faults of the wire."""
        return self.device.wire

    @property
    def received(self) -> list[tuple[float, str]]:
        """Lines that the shell has begun to carry out, with the monotonic time of each."""
        with self.device.lock:
            self.device.machine.run()
            return list(self.device.shell.received)

    def set_baud(self, baud: int | None) -> None:
        """Speak at this rate from now on."""
        with self.device.lock:
            self.device.machine.run()
            self.device.wire.baud = baud

    def fileno(self) -> int | None:
        """Return None: there is no descriptor, but a timetable."""
        return None

    def pending(self) -> bool:
        """Return whether bytes can be read, or the loss of the wire can be seen, at this moment."""
        with self.device.lock:
            if self._gone():
                return True
            self.device.machine.run()
            inbox = self.device.inbox
            return bool(inbox) and inbox[0][0] <= self.device.machine.now

    def next_event(self) -> float | None:
        """Return when something may arrive by itself, in monotonic seconds; inf for never."""
        with self.device.lock:
            if self._gone():
                return -math.inf
            inbox = self.device.inbox
            return min(inbox[0][0] if inbox else math.inf, self.device.machine.next_event())

    def read(self) -> bytes:
        """Return what has arrived; empty when there is nothing."""
        with self.device.lock:
            self._check()
            self.device.machine.run()
            inbox, now = self.device.inbox, self.device.machine.now
            pieces = []
            while inbox and inbox[0][0] <= now:
                pieces.append(inbox.popleft()[1])
            return b"".join(pieces)

    def write(self, data: bytes) -> None:
        """Send bytes to the dish."""
        with self.device.lock:
            self._check()
            self.device.receive(data)

    def discard(self) -> None:
        """Throw away what has arrived and was not read."""
        with self.device.lock:
            if not self._gone():
                self.read()

    def close(self) -> None:
        """Let go of the dish; it goes on by itself. A second time does nothing."""
        self._closed = True

    def _gone(self) -> bool:
        return self._closed or not self.device.wire.plugged or self._session != self.device.session

    def _check(self) -> None:
        if self._gone():
            raise ConnectionError(f"{self.name}: the wire is gone")


def firmware_names() -> tuple[str, ...]:
    """Return the names of all simulated firmwares, in order."""
    return tuple(sorted(each.name for each in entry_points(group=TWINS)))


def kind_of(firmware: str) -> FirmwareKind[Any]:
    """Return a simulated firmware. ValueError, naming those that exist, for any other."""
    for each in entry_points(group=TWINS, name=firmware):
        kind: FirmwareKind[Any] = each.load()
        return kind
    names = firmware_names()
    near = difflib.get_close_matches(firmware, names, n=1, cutoff=0.3)
    hint = f"did you mean {near[0]}?" if near else f"there is {', '.join(names)}"
    raise ValueError(f"no simulated dish is called {firmware!r}: {hint}")


def open_device(address: str, *, clock: Clock) -> Device:
    """Make the dish that `address` describes: `g2`, or `g2?second_move=queue&seed=3`.

    An address with a non-empty `id` finds the dish that was made for this id before, if there is one.

    Raises:
        ValueError: a firmware, option or value that does not exist.

    """
    firmware, _, query = address.partition("?")
    kind = kind_of(firmware)
    settings = parse_query(query, kind.settings)

    def make() -> Device:
        return Device(settings, clock, lambda host: kind.build(settings, host), kind.shell)

    if not settings.id:
        return make()
    with _named_lock:
        if settings.id not in _named:
            _named[settings.id] = make()
        return _named[settings.id]


def find_device(name: str) -> Device | None:
    """Return the dish that was made for this `id`; None if there is none yet."""
    with _named_lock:
        return _named.get(name)


def open_port(address: str, *, clock: Clock, baud: int | None = None) -> SimPort | RigPort:
    """Open a port to what `address` (what follows `sim:`) describes, at a rate that a dish may not share.

    `rig`, or `rig?dish=ID&beacons=FILE`, is a receiver (`birdcage.sim.rig`); all others are dishes.

    Raises:
        ValueError: as `open_device`.
        ConnectionError: the adapter of a dish with an id was pulled out.

    """
    kind, _, query = address.partition("?")
    if kind == "rig":
        settings = parse_query(query, RigSettings)
        return RigPort(SimReceiver(settings, clock, lambda: find_device(settings.dish) if settings.dish else None))
    device = open_device(address, clock=clock)
    return SimPort(device, f"sim:{address.partition('?')[0]}", baud=baud)
