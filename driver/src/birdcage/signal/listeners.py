"""Who hears what a source tells."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Told = TypeVar("Told")


class Listeners(Generic[Told]):
    """Any thread adds and drops; they are told on the source's own."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._hear: tuple[Callable[[Told], object], ...] = ()

    def add(self, hear: Callable[[Told], object]) -> Callable[[], None]:
        """Tell `hear` everything from now on; the result ends that."""
        with self._lock:
            self._hear += (hear,)
        return lambda: self._drop(hear)

    def tell(self, told: Told) -> None:
        """Tell all of them."""
        for hear in self._hear:
            hear(told)

    def _drop(self, hear: Callable[[Told], object]) -> None:
        with self._lock:
            self._hear = tuple(other for other in self._hear if other is not hear)
