"""Requests as log records: who asked for what, and why it was refused or given up."""

from __future__ import annotations

import logging
from concurrent.futures import Future
from dataclasses import fields

from birdcage.station.requests import Request, Unwatch, Watch

log = logging.getLogger("birdcage.station")


def log_request(request: Request, future: Future[object]) -> None:
    """Log a request as INFO (what pages watch as DEBUG), and later what came of it."""
    level = logging.DEBUG if isinstance(request, Watch | Unwatch) else logging.INFO
    if not log.isEnabledFor(level):
        return
    words = _words(request)
    log.log(level, "asked: %s", words)
    future.add_done_callback(lambda done: _came(level, words, done))


def _words(request: Request) -> str:
    """Return the request's name and its plain values; what is large is left out."""
    plain = ((each.name, getattr(request, each.name)) for each in fields(request))
    told = (f"{name}={value}" for name, value in plain if isinstance(value, str | int | float | bool))
    return f"{type(request).__name__} {' '.join(told)}".rstrip()


def _came(level: int, words: str, done: Future[object]) -> None:
    if done.cancelled():
        log.log(level, "cancelled: %s", words)
    elif (error := done.exception()) is not None:
        log.log(level, "not done: %s: %s: %s", words, type(error).__name__, error)
    else:
        log.log(level, "done: %s", words)
