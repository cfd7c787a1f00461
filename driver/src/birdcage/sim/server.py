"""Serves a simulated dish to other programs, in the foreground, until it is told to stop."""

from __future__ import annotations

import math
import select
import time
from typing import Any

from birdcage.base.wake import Wake
from birdcage.sim.channel import ClientChannel
from birdcage.sim.control import ControlSocket, obey
from birdcage.sim.device import Device
from birdcage.sim.port import SimPort
from birdcage.sim.rig_server import RigServer

LONGEST_WAIT_S = 3600.0
ATTEND_S = 0.2
"""How often a channel in exclusive use is looked at: its program may have been killed."""


class Server:
    """Carries bytes between a channel and a dish, and answers the control socket. One thread, one `select`."""

    def __init__(self, device: Device, channel: ClientChannel, name: str, rig: RigServer | None = None) -> None:
        self.device = device
        self.channel = channel
        self.rig = rig
        """The receiver beside the dish, where there is one; `close` ends it."""
        self._name = name
        channel.open()
        self.control = ControlSocket(self._obey)
        self._port: SimPort | None = SimPort(device, name)

    def serve(self, stop: Wake) -> None:
        """Work until `stop` is set."""
        while not stop.is_set():
            self._tune()
            self._forward()
            readable = [stop.fileno(), *self.control.descriptors(), *self.channel.descriptors(), *self._rig_asks()]
            ready, writable, _ = select.select(readable, self.channel.backlog(), [], self._wait_s())
            if writable:
                self.channel.send(b"")
            for descriptor in ready:
                if descriptor in self.channel.descriptors():
                    data = self.channel.receive(descriptor)
                    if data and self._port is not None:
                        self._tune()
                        self._port.write(data)
                elif self.rig is not None and descriptor in self.rig.descriptors():
                    self.rig.handle(descriptor)
                elif descriptor != stop.fileno():
                    self.control.handle(descriptor)

    def close(self) -> None:
        """Close the channel, the control socket, and the receiver's port."""
        self.channel.close()
        self.control.close()
        if self.rig is not None:
            self.rig.close()

    def _rig_asks(self) -> list[int]:
        return [] if self.rig is None else self.rig.descriptors()

    def _tune(self) -> None:
        """Take over the rate that the client has set: nothing tells when it does."""
        if self._port is not None:
            self._port.set_baud(self.channel.baud())

    def _forward(self) -> None:
        if self._port is not None and self._port.pending():
            self.channel.send(self._port.read())

    def _wait_s(self) -> float:
        longest_s = ATTEND_S if self.channel.attend() else LONGEST_WAIT_S
        event = self._port.next_event() if self._port is not None else None
        if event is None or math.isinf(event):
            return longest_s
        return min(max(event - time.monotonic(), 0.0), longest_s)

    def _obey(self, request: dict[str, Any]) -> dict[str, Any]:
        if request.get("do") == "unplug":
            self._unplug()
        elif request.get("do") == "plug":
            self._plug()
        else:
            return obey(self.device, request) | {"port": self.channel.path}
        return {"port": self.channel.path}

    def _unplug(self) -> None:
        if self._port is not None:
            self._port = None
            self.device.unplug()
            self.channel.close()

    def _plug(self) -> None:
        if self._port is None:
            self.channel.open()
            self.device.plug()
            self._port = SimPort(self.device, self._name)
