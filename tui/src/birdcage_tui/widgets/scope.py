"""Whose commands hold: what has the focus, what it lies in, the page or what lies over it."""

from __future__ import annotations

from typing import Protocol, runtime_checkable


@runtime_checkable
class Scope(Protocol):
    """A widget with commands of its own: those with its `scope` in their `where`."""

    @property
    def scope(self) -> str:
        """The name that its commands have in `where`."""

    def do(self, command: str) -> bool:
        """Carry out one of them; return False for one that it does not know."""
