"""The server with real sockets on 127.0.0.1, a station and a simulated dish: one thread, a virtual clock."""

from __future__ import annotations

import select
import socket
from dataclasses import replace

from birdcage.base.config import RotctldSettings
from birdcage.rotctld.listening import listen
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.server import RotctldService

from tests.station.conftest import Bench


class NetBench(Bench):
    """A bench with a server on it; `join` makes clients."""

    def __init__(self, firmware="g2", settings=None, options=None, recorder=None, **more):
        super().__init__(f"{firmware}?seed=1", more, firmware)
        self.news, self.clients = [], []
        self.service = RotctldService(
            self.station, listen("127.0.0.1", 0), replace(RotctldSettings(), **(settings or {})),
            options or RotctldOptions(), show=self.station.show_network, tell=self.news.append,
            recorder=recorder,
        )  # fmt: skip

    def join(self, **more):
        client = NetClient(self, **more)
        self.clients.append(client)
        self.turn()
        return client

    def turn(self, times=3):
        """Let the server do all that is ready; no virtual time passes."""
        for _ in range(times):
            self.service.step(0.0)

    def run(self, seconds):
        """Let time pass, with the server's turns in between."""
        for _ in range(max(1, round(seconds / 0.1))):
            self.step(0.1)
            self.turn(1)

    @property
    def network(self):
        self.run(0.3)  # what clients do is shown a little later
        return self.state.network

    def close(self):
        for client in self.clients:
            client.line.close()
        self.service.shutdown()


class NetClient:
    """A client that sends when it is told to, and reads what is there."""

    def __init__(self, bench, takes_bytes=None):
        self.bench = bench
        self.line = socket.socket()
        if takes_bytes is not None:
            self.line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, takes_bytes)
        self.line.connect(bench.service.address)
        self.line.setblocking(False)

    def send(self, data):
        self.line.sendall(data)
        self.bench.turn()

    def read(self):
        """Return what has come; None once the server has hung up."""
        data = b""
        while select.select([self.line], [], [], 0.002 if data else 0.05)[0]:
            try:
                piece = self.line.recv(65_536)
            except ConnectionResetError:
                piece = b""
            if not piece:
                return data or None
            data += piece
        return data

    def ask(self, data):
        self.send(data)
        return self.read()
