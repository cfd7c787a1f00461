"""Lets `birdcage stop`, `hold`, `release` and `status` reach the process that owns the port: only one has it open.

The owner listens on 127.0.0.1, on a TCP port that the system chooses, and leaves a file that only its user may read:
where it listens, and a token. One JSON line in, one out:

    {"token": "…", "do": "stop", "by": "birdcage stop"}  ->  {"ok": true, "stop": {…}}     (`report.stop_report`)
    {"token": "…", "do": "hold", "by": "anna"}           ->  {"ok": true, "hold": {…}}     the same, in other words
    {"token": "…", "do": "release", "by": "anna"}        ->  {"ok": true, "release": {…}}  (`report.release_report`)
    {"token": "…", "do": "status"}                       ->  {"ok": true, "status": {…}}   (`report.status_report`)
    {"token": "…", "do": "features"}                     ->  {"ok": true, "features": {…}} (`feature_report`)
    {"token": "…", "do": "get", "ids": ["rssi"]}         ->  {"ok": true, "get": {"readings": {…}}}, or {"error": {…}}
    {"token": "…", "do": "set", "id": "…", "value": 1, "agreed": true, "by": "anna"}        the same, as `set`

The caller's side is `control_client`.
"""

from __future__ import annotations

import contextlib
import hmac
import json
import logging
import os
import secrets
import select
import socket
import threading
from collections.abc import Mapping
from pathlib import Path

from birdcage.base.errors import BirdcageError, NoReply
from birdcage.base.wake import Wake
from birdcage.rotator.feature import Reading
from birdcage.station.control_client import LONGEST_LINE, WRONG_TOKEN, owner_file
from birdcage.station.events import Event, LinkChanged, StopConfirmed
from birdcage.station.feature_report import error_values, feature_values, may_be_set, reading_values
from birdcage.station.report import release_report, status_report, stop_report
from birdcage.station.requests import Read, Release, Set
from birdcage.station.state import LinkPhase
from birdcage.station.station import Station

LINE_S = 2.0
"""How long a caller may take to say what it wants."""
CONFIRM_S = 6.0
"""How long the answer to a stop waits for the dish to confirm: five repeats, and the time to come to rest."""
RELEASE_S = 5.0
"""How long the answer to a release waits for the station."""
FEATURE_S = 8.0
"""How long the answer to a question for features waits: less than the caller does (`control_client.ANSWER_S`)."""
ANSWERED_S = 0.3
"""How long closing waits for an answer that is being sent."""

log = logging.getLogger(__name__)
OUTSIDE = "outside"
"""The subject under which the station warns that other programs can't reach this one."""


class ControlServer:
    """Called by other processes of the same user. Never announced for a simulated dish inside this process."""

    def __init__(self, station: Station, folder: Path) -> None:
        """Listen for `station`; `folder` is where owners leave their files. OSError when that cannot be done."""
        self._station, self._folder = station, folder
        self._token = secrets.token_hex(16)
        self._file: Path | None = None
        self._lock = threading.Lock()
        self._callers: list[threading.Thread] = []
        self._wake = Wake()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._listener.setblocking(False)
        self._thread = threading.Thread(target=self._listen, name="control server", daemon=True)
        self._thread.start()
        self._unsubscribe = station.subscribe(self._hear)

    def close(self) -> None:
        """Stop listening, take the file away, and let callers have their answer."""
        self._unsubscribe()
        with self._lock:
            self._withdraw()
        self._wake.set()
        self._thread.join(1.0)
        for caller in self._callers:
            caller.join(ANSWERED_S)

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
                caller, _ = self._listener.accept()
                # A thread each: a caller that says nothing must not keep the next one's STOP waiting.
                thread = threading.Thread(target=self._answer, args=(caller,), name="control caller", daemon=True)
                self._callers = [*(other for other in self._callers if other.is_alive()), thread]
                thread.start()
        self._listener.close()
        self._wake.close()

    def _answer(self, caller: socket.socket) -> None:
        with caller, contextlib.suppress(OSError):
            caller.setblocking(True)
            caller.settimeout(LINE_S)
            with caller.makefile("rb") as lines:
                reply = self._serve(lines.readline(LONGEST_LINE))
            caller.sendall(json.dumps(reply).encode() + b"\n")

    def _serve(self, line: bytes) -> dict[str, object]:
        try:
            asked = json.loads(line)
        except ValueError:
            return {"ok": False, "error": "not a JSON line"}
        if not isinstance(asked, dict) or not hmac.compare_digest(str(asked.get("token")), self._token):
            return {"ok": False, "error": WRONG_TOKEN}
        by = "".join(filter(str.isprintable, str(asked.get("by") or "another program")))
        match asked.get("do"):
            case "stop" | "hold" as do:
                return {"ok": True, do: self._stop(by)}
            case "release":
                return {"ok": True, "release": self._release(by)}
            case "status":
                station = self._station
                return {"ok": True, "status": status_report(station.state, station.clock.monotonic())}
            case "features":
                dish = self._station.state.dish
                told = [] if dish is None else list(map(feature_values, dish.features.values()))
                return {"ok": True, "features": {"firmware": dish.firmware if dish else None, "features": told}}
            case "get":
                ids = tuple(map(str, asked.get("ids") or ()))
                return {"ok": True, "get": self._feature(Read(ids), ids)}
            case "set":
                name, value = str(asked.get("id")), asked.get("value")
                if not isinstance(value, bool | int | float | str):
                    return {"ok": False, "error": f"no value: {value!r}"}
                setting = Set(name, value, by, agreed=asked.get("agreed") is True)
                return {"ok": True, "set": self._feature(setting, (name,))}
            case other:
                return {"ok": False, "error": f"cannot do {other!r}"}

    def _stop(self, by: str) -> dict[str, object]:
        called = self._station.clock.monotonic()
        confirmed = threading.Event()

        def hear(event: Event) -> None:
            if isinstance(event, StopConfirmed) and event.report.confirmed is not None and event.at >= called:
                confirmed.set()

        unsubscribe = self._station.subscribe(hear)
        try:
            self._station.stop(by)
            confirmed.wait(CONFIRM_S)
        finally:
            unsubscribe()
        last = self._station.state.last_stop
        if last is None or last.at < called:
            return {"by": by, "means": "sent", "confirmed": None, "sentence": "STOP was called, without effect."}
        return dict(stop_report(last))

    def _feature(self, request: Read | Set, ids: tuple[str, ...]) -> dict[str, object]:
        """Read or set features, and return what was read, or why not."""
        future = self._station.submit(request)
        try:
            told = future.result(FEATURE_S)
        except TimeoutError:
            late = f"The program that has the port did not answer within {FEATURE_S:.0f} s."
            if future.cancel():
                late += " Nothing was sent."
            elif isinstance(request, Set):
                late += f" {may_be_set(request.feature)}"
            return {"error": error_values(NoReply(late))}
        except BirdcageError as error:
            return {"error": error_values(error)}
        readings = {ids[0]: told} if isinstance(told, Reading) else told
        dish = self._station.state.dish
        assert isinstance(readings, Mapping)
        return {"readings": reading_values(ids, {} if dish is None else dish.features, readings)}

    def _release(self, by: str) -> dict[str, object]:
        before = self._station.state.held
        try:
            self._station.submit(Release(by)).result(RELEASE_S)
        except TimeoutError:
            problem = f"The program did not respond within {RELEASE_S:.0f} s."
        except BirdcageError as error:
            problem = str(error)
        else:
            problem = ""
        return dict(release_report(before, self._station.state, problem))
