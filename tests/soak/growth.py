"""What a program holds: memory, threads, open files."""

from __future__ import annotations

import gc
import threading
import tracemalloc
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Holdings:
    """At one moment, with nothing left over for the collector."""

    bytes: int
    """As `tracemalloc` counts them, if it runs."""
    blocks: tuple[tuple[str, int], ...]
    """The places that hold most of them, for the message of a test that fails."""
    objects: int
    threads: tuple[str, ...]
    files: int

    @classmethod
    def now(cls) -> Holdings:
        """Count."""
        gc.collect()
        places: tuple[tuple[str, int], ...] = ()
        if tracemalloc.is_tracing():
            found = tracemalloc.take_snapshot().statistics("lineno")[:8]
            places = tuple((str(each.traceback), each.size) for each in found)
            del found
        names = tuple(sorted(thread.name for thread in threading.enumerate()))
        return cls(
            tracemalloc.get_traced_memory()[0],
            places,
            len(gc.get_objects()),
            names,
            len(list(Path("/dev/fd").iterdir())),
        )
