"""Turns a body into elements, or says why it is none: a web page, an error in plain text, half a file."""

from __future__ import annotations

import json
import re

from birdcage.base.reason import Reason
from birdcage.sky.formats import ParseResult, read_text
from birdcage.sky.update.errors import FetchError
from birdcage.sky.update.fetch import HttpReply

_PAGE = re.compile(rb"\s*(<!doctype html|<html|<head|<body)", re.IGNORECASE)


def take(reply: HttpReply, source: str, host: str) -> ParseResult:
    """Return what a body holds: at least one set of elements, and complaints about damaged ones.

    `source` is what the elements and complaints are marked with. FetchError ``garbage`` or ``truncated`` for a body
    that cannot be the group that was asked for: better the old one than half of a new one.
    """
    body = reply.body.removeprefix(b"\xef\xbb\xbf")
    page = _PAGE.match(body) is not None
    if page or reply.headers.get("content-type", "").lower().startswith("text/html"):
        raise FetchError(
            f"{host} answers with a web page where elements belong: nothing was taken. "
            "Does this network need a log-in first? Or is the address wrong?",
            reason=Reason.GARBAGE,
        )
    text = body.decode("utf-8", "replace")
    _check_whole(text, host)
    harvest = read_text(text, source)
    if not harvest.elements:
        said = " ".join("".join(each if each.isprintable() else " " for each in text[:200]).split())[:80]
        raise FetchError(
            f"{host} sent no elements: nothing was taken. " + (f"It says: {said}" if said else "It sent nothing."),
            reason=Reason.GARBAGE,
        )
    return harvest


def _check_whole(text: str, host: str) -> None:
    """Refuse JSON and XML that end before their end: what is missing is unknown."""
    from xml.parsers import expat

    begins = text.lstrip()[:1]
    try:
        if begins in ("[", "{"):
            json.loads(text)
        elif begins == "<":
            parser = expat.ParserCreate()
            parser.StartDoctypeDeclHandler = _no_doctype
            parser.Parse(text.lstrip(), True)
    except (ValueError, RecursionError, expat.ExpatError) as error:
        raise FetchError(
            f"{host} sent a damaged or unfinished file ({error}): nothing was taken.", reason=Reason.TRUNCATED
        ) from error


def _no_doctype(*_declared: object) -> None:
    # An OMM has none; what one can declare (entities within entities) is only good for filling the memory.
    raise ValueError("it declares a document type")
