"""Talks with the dish in another menu than the motors', and comes back: STOP has to otherwise, and look."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.rotator.feature_table import ends_reading
from birdcage.station.parts import Parts

T = TypeVar("T")


class MenuVisit:
    """One at a time, on the station's thread. Raises what the dish raises."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._rotator, self._reader = parts, parts.antenna.rotator, parts.reader

    def talk(self, call: Callable[[], T]) -> T:
        """Return what `call` returns, in the motors' menu again. After a silence or a lost link it can't come back."""
        self._reader.elsewhere = True
        try:
            result = call()
        except (CommandRefused, NoReply) as error:
            if isinstance(error, CommandRefused) or not ends_reading(error):
                self._come_back()
            raise
        self._come_back()
        return result

    def make_free_for(self, holder: str) -> None:
        """Raise what forbids `holder` to have the dish do something; the lease stays where it is."""
        self._parts.control.may_take(holder)
        self._parts.control.refuse(holder)
        self._parts.free_wire()

    def _come_back(self) -> None:
        self._rotator.make_ready()
        self._reader.elsewhere = False
