"""Which machine a port names by its scheme: `NAME://…`, where a whole machine is called so (`birdcage.machines`)."""

from __future__ import annotations

from functools import lru_cache

from birdcage.base.entry_points import entry_points

MACHINES = "birdcage.machines"
"""The group of entry points that name whole machines."""


@lru_cache(maxsize=1)
def _schemes() -> frozenset[str]:
    return frozenset(entry_points(MACHINES))


def look_anew() -> None:
    """Look for machines once more: a package was added to, or taken from, the running program."""
    _schemes.cache_clear()


def machine_at(port: str | None) -> str | None:
    """Return the machine that is reached at a port of its own scheme; None of any other port."""
    scheme, address, _ = (port or "").partition("://")
    scheme = scheme.lower()
    return scheme if address and scheme in _schemes() else None


def port_of(firmware: str, given: str | None, kept: str | None) -> str | None:
    """Return where a machine is: at the port that was `given`, which goes before the one that is `kept`.

    One that names a machine is the port of that machine alone.
    """
    names_another = machine_at(given) not in (None, firmware)
    return kept if names_another or machine_at(kept) == firmware else given
