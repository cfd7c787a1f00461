"""The back door of a simulated dish: what it really does, and what goes wrong. One JSON object a line, both ways.

    {"do": "truth"}                                      what the dish really does
    {"do": "received"}                                   the lines that its shell has carried out
    {"do": "fault", "lane": "to_host", "drop": 0.01}     fields of `Lane`; without "lane" both directions
    {"do": "echo_loss", "on": true}
    {"do": "stall", "axis": 0} {"do": "free", "axis": 0}
    {"do": "wander", "axis": 0, "by_deg": 20}            a motor runs unasked
    {"do": "say", "text": "Hello"}                       the dish prints an unsolicited line
    {"do": "brown_out", "quiet": false}                  the processor restarts, forgets homing and does not home
    {"do": "reboot"} {"do": "power_off"} {"do": "power_on"} {"do": "power_cycle", "off_s": 2}
    {"do": "deadlock"} {"do": "unplug"} {"do": "plug"}

The answer is `{"ok": true, "port": …, …}`, or `{"ok": false, "error": …}`.
"""

from __future__ import annotations

import contextlib
import json
import socket
import tempfile
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from birdcage.sim.device import Device

LANE_FIELDS = {
    "silent": bool,
    "drop": float,
    "double": float,
    "garble": float,
    "delay_min_s": float,
    "delay_max_s": float,
    "pace_baud": int,
}
OTHERS = (
    "brown_out", "echo_loss", "fault", "free", "plug", "power_cycle", "received", "say", "stall", "truth", "unplug",
    "wander",
)  # fmt: skip
AXES = "0 (azimuth)", "1 (elevation)", "2 (skew)"
LONGEST_LINE = 65536


def obey(device: Device, request: dict[str, Any]) -> dict[str, Any]:
    """Carry out one request and return what it yields.

    Raises:
        ValueError: a request, field or value that does not exist.

    """
    what = request.get("do")
    simple: dict[str, Callable[[], None]] = {
        "reboot": device.reboot,
        "power_off": device.power_off,
        "power_on": device.power_on,
        "deadlock": device.deadlock,
    }
    if what == "truth":
        return {"truth": asdict(device.truth())}
    if what == "received":
        with device.lock:
            device.machine.run()
            return {"received": list(device.shell.received)}
    if what == "fault":
        _fault(device, request)
    elif what == "echo_loss":
        device.wire.echo_loss = bool(request.get("on", True))
    elif what in ("stall", "free"):
        device.stall(_axis(device, request.get("axis")), blocked=what == "stall")
    elif what == "wander":
        device.wander(_axis(device, request.get("axis", 0)), float(request.get("by_deg", 20.0)))
    elif what == "brown_out":
        device.brown_out(quiet=bool(request.get("quiet", False)))
    elif what == "say":
        device.say(f"{request.get('text', '')}\n")
    elif what == "power_cycle":
        device.power_cycle(float(request.get("off_s", 2.0)))
    elif what in simple:
        simple[what]()
    else:
        raise ValueError(f"unknown request {what!r}: there are {', '.join(sorted([*simple, *OTHERS]))}")
    return {}


def _axis(device: Device, axis: object) -> int:
    there = range(len(device.dish.axes))
    if not isinstance(axis, int) or axis not in there:
        raise ValueError(f"axis is {' or '.join(AXES[: len(there)])}")
    return axis


def _fault(device: Device, request: dict[str, Any]) -> None:
    lanes = {"to_dish": (device.wire.to_dish,), "to_host": (device.wire.to_host,), None: device.wire.lanes}
    if request.get("lane") not in lanes:
        raise ValueError("lane is to_dish or to_host, or left out for both")
    wanted = {key: value for key, value in request.items() if key not in ("do", "lane")}
    for key, value in wanted.items():
        if key not in LANE_FIELDS:
            raise ValueError(f"unknown fault {key!r}: there are {', '.join(LANE_FIELDS)}")
        if not isinstance(value, (bool, int, float)):
            raise ValueError(f"{key} is a number or true or false")
    with device.lock:
        for lane in lanes[request.get("lane")]:
            for key, value in wanted.items():
                setattr(lane, key, LANE_FIELDS[key](value))


class ControlSocket:
    """A Unix socket where there are such, else TCP on 127.0.0.1. Any number of clients, served between other work."""

    def __init__(self, answer: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
        self._answer = answer
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._clients: dict[int, tuple[socket.socket, bytearray]] = {}
        if hasattr(socket, "AF_UNIX"):
            self._folder = tempfile.TemporaryDirectory(prefix="birdcage-sim-")
            self.path = str(Path(self._folder.name) / "control")
            self._listener = socket.socket(socket.AF_UNIX)
            self._listener.bind(self.path)
            self._listener.listen()
        else:
            self._listener = socket.create_server(("127.0.0.1", 0))
            self.path = f"127.0.0.1:{self._listener.getsockname()[1]}"
        self._listener.setblocking(False)

    def descriptors(self) -> list[int]:
        """Return what to select for reading."""
        return [self._listener.fileno(), *self._clients]

    def handle(self, descriptor: int) -> None:
        """Do what became possible when `descriptor` became readable."""
        if descriptor == self._listener.fileno():
            with contextlib.suppress(BlockingIOError):
                client = self._listener.accept()[0]
                client.settimeout(1.0)
                self._clients[client.fileno()] = client, bytearray()
        elif descriptor in self._clients:
            self._read(descriptor)

    def close(self) -> None:
        """Close everything and remove the socket."""
        for client, _ in self._clients.values():
            client.close()
        self._clients.clear()
        self._listener.close()
        if self._folder is not None:
            self._folder.cleanup()

    def _read(self, descriptor: int) -> None:
        client, buffer = self._clients[descriptor]
        try:
            data = client.recv(4096)
            buffer += data
            while data and b"\n" in buffer:
                line, _, rest = bytes(buffer).partition(b"\n")
                buffer[:] = rest
                client.sendall(json.dumps(self._reply(line)).encode() + b"\n")
        except OSError:  # the client went away, or does not read its answers
            data = b""
        if not data or len(buffer) > LONGEST_LINE:
            client.close()
            del self._clients[descriptor]

    def _reply(self, line: bytes) -> dict[str, Any]:
        try:
            request = json.loads(line)
            if not isinstance(request, dict):
                raise ValueError("a request is a JSON object")
            return {"ok": True, **self._answer(request)}
        except (ValueError, OSError) as error:
            return {"ok": False, "error": str(error)}
