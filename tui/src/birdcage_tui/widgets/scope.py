"""Whose commands hold: what has the focus, what it lies in, the page or what lies over it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, runtime_checkable

from textual.widget import Widget


@runtime_checkable
class Scope(Protocol):
    """A widget with commands of its own: those with its `scope` in their `where`."""

    @property
    def scope(self) -> str:
        """The name that its commands have in `where`."""

    def do(self, command: str) -> bool:
        """Carry out one of them; return False for one that it does not know."""


def scopes_of(focused: Widget | None, outermost: Iterable[Widget | None]) -> tuple[Scope, ...]:
    """Return the scopes from the focused widget outward, then those of `outermost` that were not met on the way."""
    met: list[Scope] = []
    chain = [] if focused is None else [focused, *focused.ancestors]
    for node in (*chain, *outermost):
        if isinstance(node, Widget) and isinstance(node, Scope) and node not in met:
            met.append(node)
    return tuple(met)
