"""Speeds that a pursuit has changed: they are put back on every way out of it."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.errors import CommandRefused
from birdcage.station.dish_reader import DishReader
from birdcage.station.saved_speeds import SavedSpeeds
from birdcage.station.state_store import StateStore

TRIES = 3
"""How often a dish is told its own speed before it counts as one that does not take it."""


class SpeedRestorer:
    """Remembers what each axis was set to before."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna, reader: DishReader) -> None:
        self._store, self._antenna, self._reader = store, antenna, reader
        self._before: dict[int, float] = {}
        self.are_changed = False
        """Whether any is still to be put back."""
        self._saved: SavedSpeeds | None = None

    def remember(self, saved: SavedSpeeds) -> None:
        """Remember on disk from now on; what the program before this one did not put back is to be put back."""
        self._saved = saved
        self._before = saved.read()
        self._show()

    def set(self, speeds_deg_s: Mapping[int, float]) -> None:
        """Set the greatest speed of axes, by motor number. Raises as `Rotator.write`."""
        known, model = self._antenna.speeds_deg_s, self._antenna.rotator.facts
        before = {motor: known.get(motor, model.numbered[motor].speed_deg_s) for motor in speeds_deg_s}
        if not before.keys() <= self._before.keys():
            if self._saved is not None:
                self._saved.write(before | self._before)
            self._before = before | self._before
            self._show()
        self._send(speeds_deg_s)

    def restore(self) -> None:
        """Put every speed back. What fails is raised, and stays to be done.

        CommandRefused only where the dish shows another speed again and again: one answer may be damaged.
        """
        for tries_left in range(TRIES - 1, -1, -1):
            try:
                self._send(self._before)
                break
            except CommandRefused:
                if not tries_left:
                    raise
        self.forget()

    def forget(self) -> None:
        """The dish has restarted, and goes at its own speeds again."""
        self._before.clear()
        if self._saved is not None:
            self._saved.clear()
        self._show()

    def _show(self) -> None:
        self.are_changed = bool(self._before)
        self._store.change(speeds_lent=MappingProxyType(dict(self._before)))

    def _send(self, speeds_deg_s: Mapping[int, float]) -> None:
        rotator = self._antenna.rotator
        self._reader.elsewhere = True  # STOP has to come back to the motor menu first
        for motor, speed_deg_s in speeds_deg_s.items():
            self._reader.set_speed(motor, speed_deg_s)
        rotator.make_ready()
        self._reader.elsewhere = False
