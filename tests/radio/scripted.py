"""A receiver that answers as it is told to: over TCP, or on a virtual clock."""

from __future__ import annotations

import socket
import threading
import time

from birdcage.base.clock import VirtualClock
from birdcage.radio.errors import RadioLost

SILENCE = b""
HANG_UP = None


def sdr(knows_recording=True, strength="-41.5"):
    """Return a function that answers as SDR++ and gqrx do: `RPRT 1` to whatever they do not know."""
    tuned = [100_000_000]

    def answer(line):
        words = line.split()
        if words[0] == "F":
            tuned[0] = int(words[1])
            return b"RPRT 0\n"
        if words[0] == "f":
            return b"%d\n" % tuned[0]
        if line == "l STRENGTH" and strength is not None:
            return f"{strength}\n".encode()
        if line in {"AOS", "LOS"} and knows_recording:
            return b"RPRT 0\n"
        return b"RPRT 1\n"

    return answer


class Server:
    """Listens on a port of the system's choice; `answer(line)` gives bytes, chunks with pauses, or hangs up (None)."""

    def __init__(self, answer):
        self.answer = answer
        self.heard: list[str] = []
        self.accepted = 0
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        self.address = f"127.0.0.1:{self.port}"
        self._open: list[socket.socket] = []
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        while True:
            try:
                client, _ = self._socket.accept()
            except OSError:
                return
            self.accepted += 1
            self._open.append(client)
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client):
        with client, client.makefile("rb") as lines:
            try:
                for raw in lines:
                    line = raw.decode().strip()
                    self.heard.append(line)
                    reply = self.answer(line)
                    if reply is HANG_UP:
                        client.shutdown(socket.SHUT_RDWR)
                        return
                    for each in [reply] if isinstance(reply, bytes) else reply:
                        if isinstance(each, float):
                            time.sleep(each)
                        elif each is HANG_UP:
                            client.shutdown(socket.SHUT_RDWR)
                            return
                        else:
                            client.sendall(each)
            except OSError:
                return

    def close(self):
        if self._socket.fileno() < 0:
            return
        # A thread that waits in `accept` is not woken by `close` alone.
        self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        for each in self._open:
            each.close()


class Desk:
    """A receiver on a virtual clock. `heard` has the time of each line."""

    def __init__(self, clock: VirtualClock, answer):
        self.clock, self.answer = clock, answer
        self.heard: list[tuple[float, str]] = []
        self.open = 0
        self.connected = 0
        self.there = True
        self.latency_s = 0.005

    def __call__(self, host, port, timeout_s):
        if not self.there:
            raise RadioLost(f"Nothing listens at {host}:{port}.", reason="missing")
        self.open += 1
        self.connected += 1
        return _VirtualWire(self)

    def lines(self, word):
        return [(at, line) for at, line in self.heard if line.split()[0] == word]


class _VirtualWire:
    def __init__(self, desk):
        self._desk, self._waiting = desk, b""

    def send(self, data):
        if not self._desk.there:
            raise RadioLost("It closed the connection.", reason="closed")
        line = data.decode().strip()
        self._desk.heard.append((self._desk.clock.monotonic(), line))
        reply = self._desk.answer(line)
        if reply is HANG_UP:
            raise RadioLost("It closed the connection.", reason="closed")
        self._waiting += reply

    def receive(self, timeout_s):
        if not self._desk.there:
            raise RadioLost("It closed the connection.", reason="closed")
        data, self._waiting = self._waiting, b""
        self._desk.clock.advance((self._desk.latency_s if data else timeout_s) if timeout_s > 0 else 0)
        return data

    def close(self):
        self._desk.open -= 1
