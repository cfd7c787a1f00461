"""Who stands for a fact about a machine."""

from __future__ import annotations

from enum import Enum


class Origin(Enum):
    """Where a fact comes from. The owner's word lies over what was learnt, and that over all else."""

    INFERRED = "inferred"
    """Assumed: no source has it."""
    DOCUMENTED = "documented"
    """Papers, an owner's log or a program that works have it."""
    MEASURED = "measured"
    """Somebody has measured it at such a machine."""
    LEARNT = "learnt"
    """This program has seen it of this machine."""
    USER = "user"
    """The owner of this machine says so."""


def by_origin(**names: str) -> dict[str, Origin]:
    """Return origins by the name of the fact, from names that are written in a row: `documented="baud homing_s"`."""
    return {name: Origin(origin) for origin, row in names.items() for name in row.split()}
