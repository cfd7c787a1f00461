"""Whether a file is an earlier state of the one that is about to be written: a map grows, and its files with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

OWN_PNG, OWN_FITS = b"Software\0birdcage ", b"ORIGIN  = 'birdcage'"
HEAD = 10_000
"""So far from the beginning stands what tells that birdcage wrote a file."""
UNREAD = b" -1"


def is_earlier(old: bytes, new: bytes, name: str, *, one_map: bool = True) -> bool:
    """Whether a file of this name is of the same map, as it was before.

    `one_map`: its name has number and begin of the map, so no other map has it. Then it is enough for a picture or FITS
    that birdcage wrote it; otherwise it may be of another map. In tables and raw text everything that the old one tells
    must be in the new one: somebody may have written into them.
    """
    if name.endswith(".png"):
        return one_map and OWN_PNG in old[:HEAD]
    if name.endswith(".fits"):
        return one_map and OWN_FITS in old[:HEAD]
    if name.startswith("raw-data-"):
        return _fills_up(old, new)
    told = {line for line in _lines(old) if not line.endswith(UNREAD)}
    return bool(told) and told <= _lines(new)


def _lines(data: bytes) -> set[bytes]:
    return {line for line in data.splitlines() if line and not line.startswith(b"#")}


def _fills_up(old: bytes, new: bytes) -> bool:
    """Whether a matrix has what the old one has, and more only where that has 0."""
    before, after = _matrix(old), _matrix(new)
    if before is None or after is None or before.shape != after.shape:
        return False
    return bool(((before == after) | (before == 0.0)).all())


def _matrix(data: bytes) -> NDArray[np.float64] | None:
    import numpy as np

    try:
        return np.array([[float(word) for word in line.split()] for line in data.splitlines() if line[:1] != b"#"])
    except ValueError:
        return None
