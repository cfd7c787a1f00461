"""`birdcage sim`: a simulated dish in the foreground."""

from __future__ import annotations

import json as json_format
import signal
import sys
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from types import FrameType
from typing import TextIO
from urllib.parse import urlencode

from birdcage.base.clock import Clock, RealClock, ScaledClock
from birdcage.base.wake import Wake
from birdcage.sim.beacons import read_beacons
from birdcage.sim.channel import ClientChannel
from birdcage.sim.device import Device
from birdcage.sim.port import kind_of, open_device
from birdcage.sim.rig import RigSettings, SimReceiver
from birdcage.sim.rig_server import RigServer
from birdcage.sim.server import Server

USB_BAUD = 115200
"""What the pty of a dish with a USB port begins with; it takes any rate."""
ENDING_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")


def run_simulator(
    firmware: str,
    *,
    speed: float = 1.0,
    seed: int = 1,
    unhomed: bool = False,
    boot: bool = False,
    pace_baud: int = 0,
    link: Path | None = None,
    tcp: bool = False,
    json: bool = False,
    options: Mapping[str, str] | None = None,
    rig: int | None = None,
    beacons: Path | None = None,
    out: TextIO | None = None,
    stop: Wake | None = None,
) -> int:
    """Serve a dish until SIGINT, SIGTERM or SIGHUP, and return the exit status, 0.

    Args:
        firmware: a name of `birdcage.sim.port.firmware_names`.
        speed: how many times faster than real time its mechanics and its UTC run.
        seed: of every random figure.
        unhomed: start with no axis homed.
        boot: start at power-on.
        pace_baud: bytes cross the wire at this rate; 0 for at once.
        link: a symbolic link that points at the pty while there is one.
        tcp: serve on 127.0.0.1 instead of a pty; a server always is (`FirmwareKind.scheme`).
        json: print one line `{"port": …, "firmware": …, "control": …}` instead of sentences; with a receiver `"rig"`.
        options: further settings by name (`birdcage.sim.settings` and the firmware's own); they go before the
            arguments above.
        rig: serve a receiver beside the dish, too, at this port of 127.0.0.1; 0: one that the system chooses.
        beacons: what that hears (`birdcage.sim.beacons`); noise alone when left out.
        out: where to print; standard output when left out.
        stop: ends it instead of signals (for a caller that is not the main thread).

    Raises:
        ValueError: a firmware, option or value that does not exist, or a file that holds no beacons.
        OSError: the pty, port or link cannot be made, or the file not be read; the message says why.

    """
    chosen = {"seed": str(seed), "unhomed": str(int(unhomed)), "boot": str(int(boot)), "pace_baud": str(pace_baud)}
    chosen |= dict(options or {})
    clock = RealClock() if speed == 1.0 else ScaledClock(speed)
    device = open_device(f"{firmware}?{urlencode(chosen)}", clock=clock)
    with ExitStack() as stack:
        if stop is None:
            stop = _stopped_by_signals(stack)
        scheme = kind_of(firmware).scheme or ("socket" if tcp else "")
        receiver = _receiver(device, clock, rig, beacons, seed)
        server = Server(device, _channel(link, device.firmware.baud or USB_BAUD, scheme), f"sim:{firmware}", receiver)
        stack.callback(server.close)
        _announce(server, firmware, link, json=json, out=out or sys.stdout)
        server.serve(stop)
    return 0


def _receiver(device: Device, clock: Clock, port: int | None, beacons: Path | None, seed: int) -> RigServer | None:
    if port is None:
        if beacons is not None:
            raise ValueError("--beacons is what a receiver hears: --rig PORT serves one")
        return None
    if beacons is not None:
        read_beacons(beacons)  # one that is wrong is better told now
    settings = RigSettings(beacons="" if beacons is None else str(beacons), seed=seed)
    return RigServer(SimReceiver(settings, clock, lambda: device), port)


def _channel(link: Path | None, baud: int, scheme: str) -> ClientChannel:
    if scheme:
        if link is not None:
            raise ValueError("--link names a pty, and this is served over TCP: leave it out")
        from birdcage.sim.tcp import TcpChannel

        return TcpChannel(scheme)
    if sys.platform == "win32":
        raise ValueError("Windows has no pseudo-terminals: use --tcp and open socket://127.0.0.1:PORT")
    from birdcage.sim.pty import PtyChannel

    return PtyChannel(link, baud)


def _announce(server: Server, firmware: str, link: Path | None, *, json: bool, out: TextIO) -> None:
    port = str(link) if link is not None else server.channel.path
    if json:
        told = {"port": port, "firmware": firmware, "control": server.control.path}
        if server.rig is not None:
            told["rig"] = server.rig.path
        print(json_format.dumps(told), file=out, flush=True)
        return
    print(f"{port}\nA simulated {firmware} listens there; Ctrl+C ends it. Control: {server.control.path}", file=out)
    if server.rig is not None:
        print(f"A simulated receiver for whatever speaks to rigctld: {server.rig.path}", file=out)
    out.flush()


def _stopped_by_signals(stack: ExitStack) -> Wake:
    stop = Wake()
    stack.callback(stop.close)

    def ended(_number: int, _frame: FrameType | None) -> None:
        stop.set()

    for name in ENDING_SIGNALS:
        number = getattr(signal, name, None)
        if number is not None and not (name == "SIGHUP" and signal.getsignal(number) is signal.SIG_IGN):  # nohup
            stack.callback(signal.signal, number, signal.signal(number, ended))
    return stop
