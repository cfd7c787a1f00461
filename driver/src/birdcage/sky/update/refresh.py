"""`birdcage elements update`: fetches groups into the catalogue, politely, each for itself.

A group that cannot be had costs neither its old elements nor the other groups. No server is asked more often than they
want: not within two hours of the last answer (`--force` does), and not during a pause that a server has asked for by
403 or 429 (nothing does).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta
from enum import StrEnum
from typing import Protocol

from birdcage.base.reason import Reason
from birdcage.sky.ahead import ahead_words, is_ahead
from birdcage.sky.catalogue import AddedElements, Catalogue, CatalogueGroup
from birdcage.sky.catalogue.words import at, span
from birdcage.sky.formats import Complaint
from birdcage.sky.update.errors import FetchError
from birdcage.sky.update.fetch import DEADLINE_S, HttpReply, check_url, fetch
from birdcage.sky.update.server_pause import LONGEST_PAUSE, pause_of
from birdcage.sky.update.sources import Source
from birdcage.sky.update.take import take


class Status(StrEnum):
    """What came of asking for a group."""

    UPDATED = "updated"
    UNCHANGED = "unchanged"
    """The server was asked, and has nothing newer."""
    FRESH = "fresh"
    """Not asked: it was not long ago."""
    PAUSED = "paused"
    """The server does not want to be asked now."""
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class RefreshOutcome:
    """What came of one group."""

    name: str
    status: Status
    sentence: str
    added: AddedElements | None = None
    complaints: tuple[Complaint, ...] = ()
    next_at: datetime | None = None
    """From when on it may be asked again, UTC; None for now."""

    @property
    def good(self) -> bool:
        """Whether the catalogue has now what the server has, or had a short while ago."""
        return self.status in (Status.UPDATED, Status.UNCHANGED, Status.FRESH)


class Fetch(Protocol):
    """What `fetch` does."""

    def __call__(self, url: str, *, headers: Mapping[str, str], deadline_s: float) -> HttpReply:
        """Ask once."""


def refresh(
    catalogue: Catalogue, sources: Iterable[Source], *, force: bool = False, deadline_s: float = DEADLINE_S,
    ask: Fetch = fetch, now: Callable[[], datetime] = lambda: datetime.now(UTC),
    begin: Callable[[Source], None] = lambda _source: None,
) -> Iterator[RefreshOutcome]:  # fmt: skip
    """Fetch groups one after the other; yield what came of each as soon as it is known.

    A server that could not be reached is not tried again for the groups that follow. `begin` is called before each.
    Raises StoreError where the catalogue cannot be written, and nothing else.
    """
    gone: dict[str, str] = {}
    for source in sources:
        begin(source)
        yield _Refresh(catalogue, source, deadline_s, ask, now, gone).run(force=force)


class _Refresh:
    """One group."""

    def __init__(
        self, catalogue: Catalogue, source: Source, deadline_s: float, ask: Fetch, now: Callable[[], datetime],
        gone: dict[str, str],
    ) -> None:  # fmt: skip
        self._catalogue, self._source, self._deadline_s, self._ask, self._now = catalogue, source, deadline_s, ask, now
        self._gone = gone
        group = catalogue.groups.get(source.name)
        # Another address is another server: what the old one said counts for nothing there.
        self._group = group if group.url == source.url else CatalogueGroup(source.name, group.count, source.url)

    def run(self, *, force: bool) -> RefreshOutcome:
        try:
            host = check_url(self._source.url)
            if host in self._gone:
                raise FetchError(self._gone[host])
            return self._too_early(host, force=force) or self._answered(host, self._fetch(host))
        except FetchError as error:
            self._catalogue.groups.keep(replace(self._group, problem=str(error)))
            return self._outcome(Status.FAILED, str(error) + self._old())

    def _fetch(self, host: str) -> HttpReply:
        try:
            return self._ask(self._source.url, headers=self._headers(), deadline_s=self._deadline_s)
        except FetchError as error:
            if error.reason in (Reason.OFFLINE, Reason.TIMEOUT, Reason.TLS):
                self._gone[host] = str(error)
            raise

    def _too_early(self, host: str, *, force: bool) -> RefreshOutcome | None:
        now = self._now()
        pause = self._catalogue.groups.host_pause(host, now)
        if pause is None and self._group.paused_until is not None and self._group.paused_until > now:
            pause = self._group.paused_until, self._group.problem or f"{host} asked for a pause."
        # A pause of years was kept under a clock that was wrong.
        if pause is not None and pause[0] - now <= LONGEST_PAUSE:
            until, why = pause
            return self._outcome(Status.PAUSED, f"{why} Not asked before {at(until, now)}.{self._old()}", next_at=until)
        if force or self._group.checked is None or not self._source.polite_s:
            return None
        next_at = self._group.checked + timedelta(seconds=self._source.polite_s)
        if not self._group.checked <= now < next_at:
            return None
        ago = span((now - self._group.checked).total_seconds())
        every = span(self._source.polite_s)
        sentence = f"asked {ago} ago, and {host} has new ones every {every} at most: next from {at(next_at, now)}."
        return self._outcome(Status.FRESH, sentence, next_at=next_at)

    def _headers(self) -> dict[str, str]:
        headers = {"Accept": "application/json, text/plain;q=0.9, */*;q=0.5"}
        now = self._now()
        if any(is_ahead(each.epoch, now) for each in self._catalogue.all(self._source.name)):
            return headers  # whichever date or clock is wrong: what the server has now mends it
        if self._group.count and self._group.etag:
            headers["If-None-Match"] = self._group.etag
        if self._group.count and self._group.last_modified:
            headers["If-Modified-Since"] = self._group.last_modified
        return headers

    def _answered(self, host: str, reply: HttpReply) -> RefreshOutcome:
        now = self._now()
        if reply.status == 200:
            return self._take(host, reply, now)
        if reply.status == 304 and self._group.count:
            self._catalogue.groups.keep(replace(self._group, checked=now, paused_until=None, problem=None))
            return self._outcome(Status.UNCHANGED, f"{host} has nothing newer.", next_at=self._next(now))
        pause = pause_of(reply, host, now)
        if pause is None:
            raise FetchError(
                f"{host} answers {reply.status}: nothing was taken.", reason=Reason.HTTP, status=reply.status
            )
        if pause.whole_host:
            self._catalogue.groups.pause_host(host, pause.until, pause.why)
        self._catalogue.groups.keep(replace(self._group, paused_until=pause.until, problem=pause.why))
        sentence = f"{pause.why} Not asked again before {at(pause.until, now)}.{self._old()}"
        return self._outcome(Status.PAUSED, sentence, next_at=pause.until)

    def _take(self, host: str, reply: HttpReply, now: datetime) -> RefreshOutcome:
        harvest = take(reply, self._source.name, host)
        came = len({each.norad_id or each.name for each in harvest.elements})
        # Half a group may be a file that was cut where it does not show; who is missing then keeps its membership.
        shrunk = came * 2 < self._group.count
        added = self._catalogue.add(
            harvest.elements, group=self._source.name, whole_group=not (shrunk or harvest.complaints), fetched=now
        )
        words = ahead_words(harvest.elements, now)
        # What gave way may be right once the clock is: the next request fetches all of it.
        versions = {} if words else reply.headers
        self._catalogue.groups.keep(
            CatalogueGroup(
                self._source.name, url=self._source.url, etag=versions.get("etag"),
                last_modified=versions.get("last-modified"), checked=now, fetched=now,
            )
        )  # fmt: skip
        sentence = f"{came} satellites: {added.new} new, {added.newer} with newer elements."
        sentence += f" {words}" if words else ""
        if shrunk:
            sentence += f" There were {self._group.count}: those that are missing now stay in the group."
        if harvest.complaints:
            sentence += f" {len(harvest.complaints)} damaged and skipped."
        return self._outcome(
            Status.UPDATED, sentence, added=added, complaints=harvest.complaints, next_at=self._next(now)
        )

    def _next(self, now: datetime) -> datetime | None:
        return now + timedelta(seconds=self._source.polite_s) if self._source.polite_s else None

    def _old(self) -> str:
        count, fetched = self._group.count, self._group.fetched
        if not count:
            return " No cached copy."
        age = f" of {span((self._now() - fetched).total_seconds())} ago" if fetched is not None else ""
        return f" The {count} satellites{age} stay."

    def _outcome(
        self, status: Status, sentence: str, *, added: AddedElements | None = None,
        complaints: tuple[Complaint, ...] = (), next_at: datetime | None = None,
    ) -> RefreshOutcome:  # fmt: skip
        return RefreshOutcome(self._source.name, status, sentence, added, complaints, next_at)
