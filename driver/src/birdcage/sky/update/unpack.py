"""Unpacks gzip as strictly as a file: a stream that ends too soon, or grows without end, is refused."""

from __future__ import annotations

import zlib

from birdcage.base.reason import Reason
from birdcage.sky.update.errors import FetchError

_MAGIC = b"\x1f\x8b"
_GZIP = 16 + zlib.MAX_WBITS
MOST_MEMBERS = 64
"""Streams in one file (RFC 1952, 2.2). Servers send one; millions of empty ones would keep a core busy for hours."""


def unpack(body: bytes, encoding: str, largest: int, url: str) -> bytes:
    """Return the body unpacked: by its Content-Encoding, or because it is a `.gz` file.

    FetchError ``truncated``, ``garbage`` or ``too_large``.
    """
    named = encoding.strip().lower()
    if named not in ("", "identity", "gzip", "x-gzip"):
        raise FetchError(f"{url} answers in an unexpected encoding ({named}).", reason=Reason.GARBAGE)
    if not body.startswith(_MAGIC):
        return body  # a server that says gzip and sends it plain is common enough
    whole = bytearray()
    for _ in range(MOST_MEMBERS):
        if not body:
            return bytes(whole)
        unpacker = zlib.decompressobj(_GZIP)
        try:
            whole += unpacker.decompress(body, largest + 1 - len(whole))
        except zlib.error as error:
            raise FetchError(f"{url} sent damaged data ({error}): nothing was taken.", reason=Reason.GARBAGE) from error
        if len(whole) > largest:
            raise FetchError(
                f"{url} sends more than {largest / 1e6:.0f} MB: nothing was taken.", reason=Reason.TOO_LARGE
            )
        if not unpacker.eof:
            raise FetchError(
                f"{url} broke off in the middle of its answer. Nothing was taken.", reason=Reason.TRUNCATED
            )
        body = unpacker.unused_data
    raise FetchError(
        f"{url} sent damaged data (more than {MOST_MEMBERS} parts): nothing was taken.", reason=Reason.GARBAGE
    )
