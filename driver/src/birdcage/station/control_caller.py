"""One caller of the control channel: takes its line, has it done, answers, and sends events if it asked for them."""

from __future__ import annotations

import contextlib
import hmac
import logging
import socket
import threading
import time
from collections.abc import Mapping
from dataclasses import replace

from birdcage.base.errors import BadMessage, BirdcageError, NoReply
from birdcage.base.reason import Reason
from birdcage.station import control_messages as messages
from birdcage.station.attach_messages import Attach
from birdcage.station.attached_caller import AttachedCaller
from birdcage.station.attachments import Attachments
from birdcage.station.control_messages import ControlCall, EndOfEvents, HoldDish, ListFeatures, TellStatus
from birdcage.station.event_stream import EventStream
from birdcage.station.events import Event, StopConfirmed
from birdcage.station.feature_report import feature_values, may_be_set
from birdcage.station.json_form import parse
from birdcage.station.json_lines import CHUNK, LineReader
from birdcage.station.report import release_report, status_report, stop_report
from birdcage.station.requests import (
    Read,
    ReadSettings,
    Release,
    SaveSettings,
    Set,
    Stop,
    Unwatch,
    Watch,
    WriteSettings,
)
from birdcage.station.station import Station

LINE_S = 2.0
"""How long a caller may take to say what it wants."""
CONFIRM_S = 6.0
"""How long the answer to a stop waits for the dish to confirm: five repeats, and the time to come to rest."""
RELEASE_S = 5.0
"""How long the answer to a release waits for the station."""
REQUEST_S = 8.0
"""How long the answer to any other request waits: less than the caller does (`control_client.ANSWER_S`)."""
ANSWER_S = 5.0
"""How long a caller may take to read its answer."""
DRAIN_BYTES = 2**21
"""How much of a line that is too long is read and dropped, for its caller to reach the answer."""


log = logging.getLogger(__name__)


class OutsideWatches:
    """Which caller has each watch, by the name that it gave: a watch ends with its caller. Any thread."""

    def __init__(self) -> None:
        self._callers: dict[str, ControlCaller] = {}
        self._lock = threading.Lock()

    def add(self, watcher: str, caller: ControlCaller) -> None:
        """Note a watch; a second one by this name replaces the first, as in the station."""
        with self._lock:
            self._callers[watcher] = caller

    def end_of(self, caller: ControlCaller) -> list[str]:
        """Forget what a caller watches, and return the names."""
        with self._lock:
            names = [watcher for watcher, other in self._callers.items() if other is caller]
            for each in names:
                del self._callers[each]
        return names


class ControlCaller:
    """Serves one connection on a thread of its own. STOP waits for no other caller, and for no request."""

    def __init__(
        self, station: Station, token: str, line: socket.socket, watches: OutsideWatches, attachments: Attachments
    ) -> None:
        self._station, self._token, self._line = station, token, line
        self._watches, self._attachments = watches, attachments
        self._lines = LineReader(line)
        self._stream: EventStream | AttachedCaller | None = None
        self.thread = threading.Thread(target=self._run, name="control caller", daemon=True)

    def leave(self) -> None:
        """Take leave of a caller that listens to events. Any thread; waits for nothing."""
        stream = self._stream
        if stream is not None:
            stream.end(EndOfEvents.CLOSING)

    def hang_up(self) -> None:
        """End it now, whatever it is at."""
        with contextlib.suppress(OSError):
            self._line.shutdown(socket.SHUT_RDWR)

    def _run(self) -> None:
        with self._line, contextlib.suppress(OSError):  # the caller has hung up already
            told = None
            try:
                told = self._heard()
                call = self._understood(told)
            except BadMessage as error:
                self._say(messages.refused(error, told))
                self._drain()
            else:
                self._serve(call)

    def _heard(self) -> object:
        """Return what the caller's line holds."""
        try:
            return parse(self._lines.read(messages.LONGEST_LINE, LINE_S))
        except ValueError:
            raise BadMessage(f"The line is longer than {messages.LONGEST_LINE} bytes. Ask for less.") from None

    def _understood(self, told: object) -> ControlCall:
        if not isinstance(told, dict):
            raise BadMessage("The line holds no object of JSON.")
        token = str(told.get("token")).encode(errors="replace")
        if not hmac.compare_digest(token, self._token.encode()):
            raise BadMessage("The token is wrong.", reason=Reason.WRONG_TOKEN)
        return messages.call_from_json(told)

    def _serve(self, call: ControlCall) -> None:
        log.debug("%s asks: %s", call.by, type(call.request).__name__)
        if isinstance(call.request, Attach):
            self._stream = attached = AttachedCaller(self._station, call.request, self._attachments)
            attached.serve(self._line, self._lines.ahead)
            return
        if not call.events:
            self._say(self._answer(call))
            return
        with EventStream(self._station) as stream:
            self._stream = stream
            try:
                answer = self._answer(call)
                self._say(answer)
                if answer["ok"]:
                    stream.send(self._line)
            finally:
                for watcher in self._watches.end_of(self):
                    self._station.submit(Unwatch(watcher))

    def _answer(self, call: ControlCall) -> dict[str, object]:
        request, station = call.request, self._station
        match request:
            case Stop(by) | HoldDish(by):
                return messages.done(request, self._stop(by or call.by))
            case Release():
                return messages.done(request, self._release(request))
            case TellStatus():
                return messages.done(request, status_report(station.state, station.clock.monotonic()))
            case ListFeatures():
                dish = station.state.dish
                rows = [] if dish is None else list(map(feature_values, dish.features.values()))
                return messages.done(request, {"firmware": dish.firmware if dish else None, "features": rows})
            case Watch(watcher) | Unwatch(watcher):
                # The app's own watchers go by other names.
                outside = replace(request, watcher=f"{watcher} (outside)")
                if isinstance(outside, Watch):
                    self._watches.add(outside.watcher, self)
                return self._submit(outside)
            case Read() | Set() | ReadSettings() | WriteSettings() | SaveSettings():
                return self._submit(request)
            case Attach():
                raise AssertionError("served by AttachedCaller")

    def _stop(self, by: str) -> dict[str, object]:
        called = self._station.clock.monotonic()
        confirmed = threading.Event()

        def hear(event: Event) -> None:
            if isinstance(event, StopConfirmed) and event.report.confirmed is not None and event.at >= called:
                confirmed.set()

        unsubscribe = self._station.subscribe(hear, StopConfirmed)
        try:
            self._station.stop(by)
            confirmed.wait(CONFIRM_S)
        finally:
            unsubscribe()
        last = self._station.state.last_stop
        if last is None or last.at < called:
            return {"by": by, "means": "sent", "confirmed": None, "sentence": "STOP was called, without effect."}
        return dict(stop_report(last))

    def _release(self, request: Release) -> dict[str, object]:
        before = self._station.state.held
        try:
            self._station.submit(request).result(RELEASE_S)
        except TimeoutError:
            problem = f"The program did not respond within {RELEASE_S:.0f} s."
        except BirdcageError as error:
            problem = str(error)
        else:
            problem = ""
        return dict(release_report(before, self._station.state, problem))

    def _submit(
        self, request: Read | Set | ReadSettings | WriteSettings | SaveSettings | Watch | Unwatch
    ) -> dict[str, object]:
        future, within_s = self._station.submit(request), REQUEST_S + messages.more_s(request)
        try:
            return messages.done(request, future.result(within_s))
        except TimeoutError:
            late = f"The program that has the port did not answer within {within_s:.0f} s."
            if future.cancel():
                late += " Nothing was sent."
            elif isinstance(request, Set):
                late += f" {may_be_set(request.feature)}"
            elif isinstance(request, WriteSettings | SaveSettings):
                late += " It goes on. `birdcage nvs dump` tells what became of it."
            return messages.refused(NoReply(late))
        except BirdcageError as error:
            return messages.refused(error)

    def _say(self, told: Mapping[str, object]) -> None:
        self._line.settimeout(ANSWER_S)
        self._line.sendall(messages.as_line(told))

    def _drain(self) -> None:
        """Drop what the caller still sends: closing before it is read would take the answer back."""
        self._line.shutdown(socket.SHUT_WR)
        until, left = time.monotonic() + LINE_S, DRAIN_BYTES
        while left > 0 and time.monotonic() < until:
            self._line.settimeout(LINE_S)
            chunk = self._line.recv(CHUNK)
            if not chunk:
                return
            left -= len(chunk)
