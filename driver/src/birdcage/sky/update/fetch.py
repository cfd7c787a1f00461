"""One HTTP request, whole or not at all, and over at its deadline whatever the network does."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from birdcage.base.reason import Reason
from birdcage.sky.update.errors import FetchError
from birdcage.sky.update.unpack import unpack

if TYPE_CHECKING:
    import urllib3

DEADLINE_S = 60.0
"""For a whole answer: the largest group of all is some ten megabytes."""
CONNECT_S = 15.0
QUIET_S = 20.0
"""How long a server may send nothing at all."""
LARGEST_BODY = 64_000_000
"""Bytes, unpacked. Every satellite in orbit is a fifth of this."""
MOST_REDIRECTS = 5
CHUNK = 65_536


@dataclass(frozen=True, slots=True)
class HttpReply:
    """What a server answered, whatever its status."""

    status: int
    body: bytes
    """Unpacked; whole."""
    headers: Mapping[str, str] = field(default_factory=dict)
    """By name in lower case."""


def check_url(url: str) -> str:
    """Return the server's name and port. FetchError ``url`` for what is not an http or https address."""
    try:
        parts = urlsplit(url)
        port = parts.port
    except ValueError:
        parts, port = urlsplit(""), None
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise FetchError(f"{url} is not an http or https address.", reason=Reason.URL)
    return parts.hostname if port is None else f"{parts.hostname}:{port}"


def fetch(
    url: str, *, headers: Mapping[str, str] | None = None, deadline_s: float = DEADLINE_S,
    largest: int = LARGEST_BODY,
) -> HttpReply:  # fmt: skip
    """Ask for `url` once, by GET, and return the answer; nothing is tried a second time.

    Redirects are followed, but never from https to http. FetchError for everything that is
    no answer, a truncated one among them.
    """
    check_url(url)
    request = _Request(url, dict(headers or {}), time.monotonic() + deadline_s, largest)
    # On a thread of its own: neither looking up a name nor a header that trickles in has a deadline otherwise.
    thread = threading.Thread(target=request.run, name="fetch", daemon=True)
    thread.start()
    try:
        request.done.wait(deadline_s)
    finally:
        request.given_up.set()
    if request.error is not None:
        raise request.error
    if request.reply is None:
        raise _too_slow(url)
    return request.reply


class _Request:
    """One request on its thread."""

    def __init__(self, url: str, headers: dict[str, str], deadline: float, largest: int) -> None:
        self._url, self._headers, self._deadline = url, headers, deadline
        self._largest = largest
        self.done, self.given_up = threading.Event(), threading.Event()
        self.reply: HttpReply | None = None
        self.error: BaseException | None = None

    def run(self) -> None:
        """Fetch, and keep the answer or what went wrong."""
        try:
            self.reply = self._fetch()
        except BaseException as error:  # noqa: BLE001 - it is raised again by the thread that waits
            self.error = error
        finally:
            self.done.set()

    def _fetch(self) -> HttpReply:
        import urllib3

        from birdcage.base.version import version

        headers = {"User-Agent": f"birdcage/{version()}", "Accept-Encoding": "gzip", **self._headers}
        timeout = urllib3.Timeout(connect=CONNECT_S, read=QUIET_S)
        try:
            with urllib3.PoolManager(num_pools=1, retries=False, timeout=timeout) as pool:
                return self._follow_to_the_end(pool, headers)
        except urllib3.exceptions.HTTPError as error:
            raise _told(self._url, error) from error

    def _follow_to_the_end(self, pool: urllib3.PoolManager, headers: dict[str, str]) -> HttpReply:
        url = self._url
        for _ in range(MOST_REDIRECTS + 1):
            response = pool.request("GET", url, headers=headers, preload_content=False, redirect=False)
            try:
                location = response.get_redirect_location()
                if not location:
                    return self._read(response)
            finally:
                response.close()
            url = self._next(url, location)
        raise FetchError(
            f"{check_url(self._url)} redirects more than {MOST_REDIRECTS} times: nothing was fetched.",
            reason=Reason.REDIRECTS,
        )

    def _next(self, url: str, location: str) -> str:
        from urllib.parse import urljoin

        further = urljoin(url, location)
        check_url(further)
        if url.startswith("https:") and not further.startswith("https:"):
            raise FetchError(
                f"{check_url(url)} sends to {further}, which is not encrypted: not followed.", reason=Reason.REDIRECTS
            )
        return further

    def _read(self, response: urllib3.BaseHTTPResponse) -> HttpReply:
        parts: list[bytes] = []
        size = 0
        while chunk := response.read1(CHUNK, decode_content=False):
            size += len(chunk)
            parts.append(chunk)
            if self.given_up.is_set() or time.monotonic() > self._deadline:
                raise _too_slow(self._url)
            if size > self._largest:
                raise _too_large(self._url, self._largest)
        headers = {name.lower(): value for name, value in response.headers.items()}
        body = unpack(b"".join(parts), headers.get("content-encoding", ""), self._largest, self._url)
        return HttpReply(response.status, body, headers)


def _told(url: str, error: urllib3.exceptions.HTTPError) -> FetchError:
    """Return the sentence for an error of the library."""
    from urllib3 import exceptions

    host = check_url(url)
    match error:
        case exceptions.NameResolutionError():
            return FetchError(f"Cannot resolve {host}. Are you online?")
        case exceptions.NewConnectionError():
            cause = error.__cause__
            why = f" ({cause.strerror})" if isinstance(cause, OSError) and cause.strerror else ""
            return FetchError(f"{host} cannot be reached{why}. Are you online?")
        case exceptions.TimeoutError():
            return FetchError(f"{host} did not answer in time. Nothing was taken.", reason=Reason.TIMEOUT)
        case exceptions.SSLError():
            return FetchError(
                f"{host} has a certificate that can't be verified ({error}). Is this machine's clock right?",
                reason=Reason.TLS,
            )
        case exceptions.ProtocolError():
            return FetchError(
                f"{host} broke off in the middle of its answer. Nothing was taken.", reason=Reason.TRUNCATED
            )
        case _:
            return FetchError(f"{host} did not answer like a web server ({error}): nothing was taken.")


def _too_slow(url: str) -> FetchError:
    return FetchError(f"{check_url(url)} was too slow. Nothing was taken.", reason=Reason.TIMEOUT)


def _too_large(url: str, largest: int) -> FetchError:
    return FetchError(
        f"{check_url(url)} sends more than {largest / 1e6:.0f} MB: nothing was taken.", reason=Reason.TOO_LARGE
    )
