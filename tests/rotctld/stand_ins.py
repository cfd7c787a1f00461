"""Programs that drive rotators, as they were seen to talk on the wire, step by step on the bench's clock."""

from __future__ import annotations

import socket
import time

MOST_ERRORS = 5
"""Gpredict disengages at the error after these, in a row."""


class _OneReceive:
    """A client that takes what one `recv` gives for the whole answer."""

    def __init__(self, bench):
        self.bench = bench
        self.line = socket.create_connection(bench.service.address, timeout=5.0)
        self.line.setblocking(False)
        bench.turn()

    def ask(self, command):
        self.line.sendall(command)
        end = time.monotonic() + 5.0
        while time.monotonic() < end:
            self.bench.turn(1)
            try:
                return self.line.recv(128)
            except BlockingIOError:
                self.bench.run(0.01)
        raise TimeoutError(command)


class Gpredict(_OneReceive):
    """Gpredict 2.3 from Engage on: `P` if the target has moved beyond its threshold, 0.1 s, `p`, 0.7 s."""

    def __init__(self, bench, threshold_deg=5.0):
        super().__init__(bench)
        self.threshold_deg = threshold_deg
        self.position = (0.0, 0.0)
        self.errors, self.engaged = 0, True
        self.heard = []

    def cycle(self, az_deg, el_deg):
        """One round; the first is only `p`, as nothing is known of the rotator yet."""
        if not self.engaged:
            return
        wrong = False
        far = max(abs(az_deg - self.position[0]), abs(el_deg - self.position[1])) > self.threshold_deg
        if self.heard and far:
            wrong = self.ask(f"P {az_deg:.2f} {el_deg:.2f}\n".encode()) != b"RPRT 0\n"
        self.bench.run(0.1)
        reply = self.ask(b"p\n")
        self.heard.append(reply)
        values = reply.split()
        if len(values) == 2 and not reply.startswith(b"RPRT"):
            self.position = (float(values[0]), float(values[1]))
        else:
            wrong = True
        self.errors = self.errors + 1 if wrong else 0
        if self.errors > MOST_ERRORS:
            self.ask(b"S\n")
            self.line.sendall(b"q\n")
            self.engaged = False
        self.bench.run(0.7)


class SatDump(_OneReceive):
    """SatDump's tracker: `p`, and at once `P`; after four bad answers it drops the connection."""

    def cycle(self, az_deg, el_deg):
        """One round; returns what `p` gave."""
        said = self.ask(b"p\n")
        assert self.ask(f"P {az_deg:.2f} {el_deg:.2f}\n".encode()) == b"RPRT 0\n"
        self.bench.run(1.0)
        return said


class SatnogsClient:
    """satnogs-client over Hamlib: `\\dump_state`, then `p` every 3 s, and `P` beyond its threshold.

    Hamlib reads line by line, refuses what lies outside the range that it was told, and throws away what was not read.
    """

    def __init__(self, bench, threshold_deg=4.0):
        self.bench, self.threshold_deg = bench, threshold_deg
        self.line = socket.create_connection(bench.service.address, timeout=5.0)
        self.line.setblocking(False)
        self._unread = b""
        self.sent = []
        self._send(b"\\dump_state\n")
        state = {}
        while (row := self._row()) != "done":
            key, _, value = row.partition("=")
            state[key] = value
        self.az = (float(state["min_az"]), float(state["max_az"]))
        self.el = (float(state["min_el"]), float(state["max_el"]))

    def _send(self, data):
        self._unread = b""
        self.line.sendall(data)
        self.sent.append(data)

    def _row(self):
        end = time.monotonic() + 5.0
        while b"\n" not in self._unread:
            assert time.monotonic() < end
            self.bench.turn(1)
            try:
                self._unread += self.line.recv(64)
            except BlockingIOError:
                self.bench.run(0.01)
        row, _, self._unread = self._unread.partition(b"\n")
        return row.decode()

    def cycle(self, az_deg, el_deg):
        """One round: look, and send it on where it is too far off. Returns what it read, None for an error."""
        self._send(b"p\n")
        first = self._row()
        here = None if first.startswith("RPRT") else (float(first), float(self._row()))
        if here is None or max(abs(az_deg - here[0] % 360.0), abs(el_deg - here[1])) > self.threshold_deg:
            assert self.az[0] <= az_deg <= self.az[1]
            assert self.el[0] <= el_deg <= self.el[1]
            self._send(f"P {az_deg:f} {el_deg:f}\n".encode())
            assert self._row() == "RPRT 0"
        self.bench.run(3.0)
        return here

    def close(self):
        """End of the observation: it always hangs up, and stops or parks nothing."""
        self._send(b"q\n")
        self.line.close()
