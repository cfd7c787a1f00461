"""A simulated receiver behind a TCP port of this machine, for any program that speaks to `rigctld`."""

from __future__ import annotations

import contextlib
import socket

from birdcage.sim.rig import SimReceiver
from birdcage.sim.rig_port import RigLines


class RigServer:
    """Any number of clients, served between other work; they share the one receiver."""

    def __init__(self, rig: SimReceiver, port: int) -> None:
        """Listen on 127.0.0.1, at a port that the system chooses where `port` is 0. OSError where it is taken."""
        self._rig = rig
        self._listener = socket.create_server(("127.0.0.1", port))
        self._listener.setblocking(False)
        self._clients: dict[int, tuple[socket.socket, RigLines]] = {}
        self.path = f"127.0.0.1:{self._listener.getsockname()[1]}"
        """What a client connects to."""

    def descriptors(self) -> list[int]:
        """Return what to select for reading."""
        return [self._listener.fileno(), *self._clients]

    def handle(self, descriptor: int) -> None:
        """Do what became possible when `descriptor` became readable."""
        if descriptor == self._listener.fileno():
            with contextlib.suppress(BlockingIOError):
                client = self._listener.accept()[0]
                client.settimeout(1.0)
                self._clients[client.fileno()] = client, RigLines(self._rig)
        elif descriptor in self._clients:
            self._read(descriptor)

    def close(self) -> None:
        """Drop all clients and stop listening."""
        for client, _ in self._clients.values():
            client.close()
        self._clients.clear()
        self._listener.close()

    def _read(self, descriptor: int) -> None:
        client, lines = self._clients[descriptor]
        try:
            data = client.recv(4096)
            if data:
                client.sendall(lines.take(data))
        except OSError:  # the client went away, or does not read its answers
            data = b""
        if not data or lines.over:
            client.close()
            del self._clients[descriptor]
