"""Which machines there are: found by entry point, ours and those of other packages.

`birdcage.dialects` names classes of `FirmwareProtocol`; `birdcage.machines` whole `Rotator` classes. The name is what
`--firmware` takes. Each class tells its facts: as `model`, or as `facts`.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from birdcage.base import machine_port
from birdcage.base.entry_points import entry_points, load
from birdcage.rotator.adapting import as_rotator
from birdcage.rotator.facts import Facts
from birdcage.rotator.rotator import Rotator

DIALECTS, MACHINES = "birdcage.dialects", machine_port.MACHINES


@lru_cache(maxsize=1)
def _found() -> dict[str, tuple[str, str]]:
    """Return the group of each, and where its class is, by name in order."""
    found = {name: (group, target) for group in (DIALECTS, MACHINES) for name, target in entry_points(group).items()}
    return dict(sorted(found.items()))


def look_anew() -> None:
    """Look for machines once more: a package was added to, or taken from, the running program."""
    _found.cache_clear()
    machine_port.look_anew()


def names() -> tuple[str, ...]:
    """Return the short names of all machines, in order."""
    return tuple(_found())


def names_in(group: str) -> tuple[str, ...]:
    """Return those of one group."""
    return tuple(name for name, (of, _target) in _found().items() if of == group)


def kin_of(name: str) -> tuple[str, ...]:
    """Return the machines that have a console of the same make, itself included; a machine of its own has no kin."""
    consoles = names_in(DIALECTS)
    return consoles if name in consoles else (name,)


def class_of(name: str) -> Any:  # noqa: ANN401 - a `FirmwareProtocol` or a `Rotator`
    """Return the class of a machine. Raises KeyError, naming those that exist, for any other."""
    if name not in _found():
        raise KeyError(f"no firmware {name!r} here; known: {', '.join(names())}")
    return load(_found()[name][1])


def facts_of(name: str) -> Facts:
    """Return what is known of such machines. KeyError as `class_of`."""
    kind = class_of(name)
    facts: Facts = kind.model if hasattr(kind, "model") else kind.facts
    return facts


def make(name: str) -> Rotator:
    """Return a new one. KeyError as `class_of`."""
    return as_rotator(class_of(name)())
