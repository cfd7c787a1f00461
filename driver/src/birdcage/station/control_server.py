"""Lets `birdcage stop`, `status`, `events` and others reach the process that owns the port: only one has it open.

The owner listens on 127.0.0.1, on a TCP port that the system chooses, and leaves a file that only its user may read:
where it listens, and a token. What is said there tells `control_messages`; `control_caller` serves one caller. The
caller's side is `control_client`.
"""

from __future__ import annotations

import contextlib
import json
import logging
import os
import secrets
import select
import socket
import threading
import time
from pathlib import Path

from birdcage.base.wake import Wake
from birdcage.station.attachments import Attachments
from birdcage.station.control_caller import ControlCaller, OutsideWatches
from birdcage.station.control_client import owner_file
from birdcage.station.events import Event, LinkChanged
from birdcage.station.services import Services
from birdcage.station.state import LinkPhase
from birdcage.station.station import Station
from birdcage.station.wire_stream import OnWire

ANSWERED_S = 0.3
"""How long closing waits for answers, and last lines, that are being sent."""

log = logging.getLogger(__name__)
OUTSIDE = "outside"
"""The subject under which the station warns that other programs can't reach this one."""


class ControlServer:
    """Called by other processes of the same user. Never announced for a simulated dish inside this process."""

    def __init__(
        self, station: Station, folder: Path, program: str = "birdcage", on_wire: OnWire | None = None,
        services: Services | None = None,
    ) -> None:  # fmt: skip
        """Listen for `station`; `folder` is where owners leave their files. OSError when that cannot be done.

        `program` is how this one is called by those that are attached; `on_wire` lets them hear the wire
        (`Session.on_wire`). `services` are what they can join beside the station's own requests.
        """
        self._station, self._folder = station, folder
        self._token = secrets.token_hex(16)
        self._file: Path | None = None
        self._lock = threading.Lock()
        self._callers: list[ControlCaller] = []
        self._watches = OutsideWatches()
        self._attachments = Attachments(station, program, on_wire, services or Services())
        self._wake = Wake()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._listener.setblocking(False)
        self._thread = threading.Thread(target=self._listen, name="control server", daemon=True)
        self._thread.start()
        self._unsubscribe = station.subscribe(self._hear, LinkChanged)

    def close(self) -> None:
        """Stop listening, take the file away, and let callers have their answer."""
        self._unsubscribe()
        with self._lock:
            self._withdraw()
        self._wake.set()
        self._thread.join(1.0)
        for caller in self._callers:
            caller.leave()
        until = time.monotonic() + ANSWERED_S
        for caller in self._callers:
            caller.thread.join(max(0.0, until - time.monotonic()))
            caller.hang_up()
        self._attachments.close()

    def _hear(self, event: Event) -> None:
        """Announce the port once it is really ours, which its being open proves: another program may have it."""
        if isinstance(event, LinkChanged) and event.link.state in (LinkPhase.UP, LinkPhase.SILENT):
            state = self._station.state
            if state.demo or not state.port:
                return
            try:
                with self._lock:
                    self._announce(state.port)
            except OSError as error:
                words = f"`birdcage stop` does not reach this program: {error}"
                log.warning("%s", words)
                self._station.warn(OUTSIDE, words)
            else:
                self._station.warn(OUTSIDE, "")

    def _announce(self, port: str) -> None:
        path = owner_file(self._folder, port)
        if self._file not in (None, path):
            self._withdraw()
        told = {
            "pid": os.getpid(),
            "tcp_port": self._listener.getsockname()[1],
            "token": self._token,
            "port": port,
            "asked": self._station.asked_port,
        }
        self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        aside = path.with_suffix(f".{os.getpid()}")
        aside.unlink(missing_ok=True)
        descriptor = os.open(aside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(descriptor, "w", encoding="utf-8") as file:
            json.dump(told, file)
        aside.replace(path)
        self._file = path

    def _withdraw(self) -> None:
        """Remove the file, unless another owner has replaced it."""
        if self._file is None:
            return
        with contextlib.suppress(OSError):
            if self._token in self._file.read_text(encoding="utf-8"):
                self._file.unlink()
        self._file = None

    def _listen(self) -> None:
        while True:
            select.select([self._listener.fileno(), self._wake.fileno()], [], [])
            if self._wake.is_set():
                break
            with contextlib.suppress(OSError):  # the caller has hung up already
                line, _ = self._listener.accept()
                # A thread each: a caller that says nothing must not keep the next one's STOP waiting.
                caller = ControlCaller(self._station, self._token, line, self._watches, self._attachments)
                # Listed first: from its first answer on it can be told that the server ends.
                self._callers = [*(other for other in self._callers if other.thread.is_alive()), caller]
                caller.thread.start()
        self._listener.close()
        self._wake.close()
