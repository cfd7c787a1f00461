"""Servers that say no: how long to leave them alone."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from email.utils import parsedate_to_datetime

from birdcage.sky.update.fetch import HttpReply

LONGEST_PAUSE = timedelta(days=1)
FORBIDDEN_PAUSE = timedelta(hours=2)
BUSY_PAUSE = timedelta(hours=1)


@dataclass(frozen=True, slots=True)
class ServerPause:
    """A server's wish to be left alone."""

    until: datetime
    why: str
    whole_host: bool
    """False where only this one group is meant."""


def pause_of(reply: HttpReply, host: str, now: datetime) -> ServerPause | None:
    """Return the pause that an answer asks for; None if it asks for none."""
    asked = _retry_after(reply.headers.get("retry-after", ""), now)
    if reply.status == 403 and b"has not updated since" in reply.body:
        # CelesTrak: "GP data has not updated since your last successful download of GROUP=..."
        why = f"{host} has nothing newer than what it last sent to this address."
        return ServerPause(asked or now + FORBIDDEN_PAUSE, why, whole_host=False)
    if reply.status == 403:
        return ServerPause(asked or now + FORBIDDEN_PAUSE, f"{host} refuses (403){_said(reply.body)}.", whole_host=True)
    if reply.status == 429:
        return ServerPause(asked or now + BUSY_PAUSE, f"{host} was asked too often (429).", whole_host=True)
    if reply.status == 503 and asked is not None:
        return ServerPause(asked, f"{host} is too busy (503).", whole_host=True)
    return None


def _retry_after(text: str, now: datetime) -> datetime | None:
    """Return until when, from seconds or a date (RFC 9110, 10.2.3); None for nothing sensible."""
    if text.strip().isdigit():
        until = now + min(timedelta(seconds=min(int(text), 10**9)), LONGEST_PAUSE)
        return until if until > now else None
    try:
        until = parsedate_to_datetime(text)
    except ValueError:
        return None
    until = until if until.tzinfo is not None else until.replace(tzinfo=UTC)
    return min(until, now + LONGEST_PAUSE) if until > now else None


def _said(body: bytes) -> str:
    """Return what a server says in plain words, if it does."""
    text = body[:400].decode("utf-8", "replace").strip()
    if not text or text.startswith("<"):
        return ""
    return f": {' '.join(''.join(each if each.isprintable() else ' ' for each in text).split())[:120].rstrip('.')}"
