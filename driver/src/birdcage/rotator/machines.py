"""Which machines there are: found by entry point, ours as well as anybody's.

`birdcage.dialects` names classes of `FirmwareProtocol` by their firmware; `birdcage.machines` whole `Rotator` classes,
by the scheme of their addresses. Each class tells its facts: as `model`, or as `facts`.
"""

from __future__ import annotations

from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from birdcage.rotator.adapting import as_rotator
from birdcage.rotator.facts import Facts
from birdcage.rotator.rotator import Rotator

DIALECTS, MACHINES = "birdcage.dialects", "birdcage.machines"


@lru_cache(maxsize=1)
def _found() -> dict[str, EntryPoint]:
    points = [each for group in (DIALECTS, MACHINES) for each in entry_points(group=group)]
    return {each.name: each for each in sorted(points, key=lambda each: each.name)}


def names() -> tuple[str, ...]:
    """Return the short names of all machines, in order."""
    return tuple(_found())


def names_in(group: str) -> tuple[str, ...]:
    """Return those of one group."""
    return tuple(name for name, point in _found().items() if point.group == group)


def class_of(name: str) -> Any:  # noqa: ANN401 - a `FirmwareProtocol` or a `Rotator`
    """Return the class of a machine. Raises KeyError, naming those that exist, for any other."""
    if name not in _found():
        raise KeyError(f"no firmware {name!r} here; known: {', '.join(names())}")
    return _found()[name].load()


def facts_of(name: str) -> Facts:
    """Return what is known of such machines. KeyError as `class_of`."""
    kind = class_of(name)
    facts: Facts = kind.model if hasattr(kind, "model") else kind.facts
    return facts


def make(name: str) -> Rotator:
    """Return a new one. KeyError as `class_of`."""
    return as_rotator(class_of(name)())
