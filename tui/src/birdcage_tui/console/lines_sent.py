"""What was sent to the dish and is not answered yet, and how its answer comes back to the app's thread."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import cast

from birdcage.station.raw import CONSOLE, Grade, MenuCommand, Verdict
from birdcage.station.requests import AcquireLease, ListCommands, Raw, ReleaseLease, Request

Submit = Callable[[Request], "Future[object]"]
Later = Callable[[Callable[[], None]], None]
"""Runs something soon on the app's thread. May be called from any thread."""


@dataclass(slots=True, eq=False)
class Sent:
    """One line under way."""

    line: str
    verdict: Verdict
    at: float
    """Monotonic seconds."""


class LinesSent:
    """Speaks to the station as `console`, and tells how it went."""

    def __init__(self, submit: Submit, later: Later, failed: Callable[[str, BaseException], None]) -> None:
        self._submit, self._later, self._failed = submit, later, failed
        self.under_way: list[Sent] = []
        self.last = 0.0
        """When a line was last sent or answered, in monotonic seconds: idle time counts from here."""

    def send(self, line: str, verdict: Verdict, now: float) -> None:
        """Send a line of which a person was told `verdict`. What fails is told with it: nothing typed is lost."""
        sent = Sent(line, verdict, now)
        self.under_way.append(sent)
        self.last = now
        self._submit(Raw(line, CONSOLE, verdict.grade)).add_done_callback(
            lambda future: self._later(lambda: self._done(sent, future))
        )

    def end_line(self, now: float) -> None:
        """Press Enter for the dish: ends what still prints."""
        self.send("", Verdict(Grade.HARMLESS, ""), now)

    def keep(self, now: float) -> None:
        """Somebody types: do not give control back yet."""
        self.last = now
        self._submit(AcquireLease(CONSOLE))

    def take_control(self, line: str, now: float, *, take_over: bool, then: Callable[[], None]) -> None:
        """Take the lease for a line: polling pauses, and then goes on with it."""
        self.last = now
        self._request(AcquireLease(CONSOLE, take_over), line, lambda _result: then())

    def ask_list(self, told: Callable[[tuple[MenuCommand, ...]], None]) -> None:
        """Ask the dish for the commands of its menu."""

        def done(found: object) -> None:
            told(cast("tuple[MenuCommand, ...]", found))

        self._request(ListCommands(CONSOLE), "", done)

    def _request(self, request: Request, line: str, then: Callable[[object], None]) -> None:
        def done(future: Future[object]) -> None:
            if future.cancelled():
                return
            error = future.exception()
            if error is not None:
                self._failed(line, error)
            else:
                then(future.result())

        self._submit(request).add_done_callback(lambda future: self._later(lambda: done(future)))

    def leave(self, now: float) -> None:
        """End what still prints, and give control back: the station looks where the dish is."""
        if self.under_way:
            self.end_line(now)
        self._submit(ReleaseLease(CONSOLE))

    def heard(self, now: float) -> None:
        """An answer came: idle time begins anew."""
        self.last = max(self.last, now)

    def _done(self, sent: Sent, future: Future[object]) -> None:
        self.under_way.remove(sent)
        error = None if future.cancelled() else future.exception()
        if error is not None:
            self._failed(sent.line, error)
