"""Notices that the dish is another one, or has started anew: what was read of it before holds no longer."""

from __future__ import annotations

from birdcage.station.state import StationState


class DishSeen:
    """What was seen last."""

    def __init__(self) -> None:
        self._dish: tuple[str, str, bool] | None = None
        self._boot: object = None
        self.epoch = 0
        """Counts the changes: what was asked for in an earlier one is of no use, and nothing is done that was meant
        for it."""

    def is_another(self, state: StationState) -> bool:
        """Return whether it changed since the last call that knew a dish; a dish that is not known yet is no other."""
        if state.dish is None:
            return False
        dish = (state.dish.firmware, state.port, state.demo)
        boot = None if state.boot_log is None else state.boot_log.utc
        before, self._dish = self._dish, dish
        booted, self._boot = self._boot != boot, boot
        another = before is not None and (before != dish or booted)
        self.epoch += another
        return another
