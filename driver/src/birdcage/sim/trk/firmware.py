"""What the firmware of a G2 does about a blocked motor, and that of its kin."""

from __future__ import annotations

from functools import partial

from birdcage.sim.axis import STALL_DWELL_S, AxisMechanics
from birdcage.sim.firmware import FirmwareHost
from birdcage.sim.trk.knobs import TrkSettings
from birdcage.sim.trk.mechanics import TrkDish


class TrkFirmware:
    """A subclass has a `dish`, and calls this when it is built."""

    baud = 115200
    """Source: docs/reference/consoles.md, *Line*."""
    dish: TrkDish

    def __init__(self, settings: TrkSettings, host: FirmwareHost) -> None:
        self._host = host
        for axis in self.dish.axes:
            axis.slips_at_stop = settings.stall == "slip"
            axis.on_strike = partial(self._strikes, axis)
            axis.on_blocked = partial(self._pushes, axis)

    def stalled(self, axis: AxisMechanics) -> None:
        """Say so (noted of another dish of this maker: docs/reference/consoles.md, *Stalls*)."""
        self._host.say(f"{axis.data.name} MOTOR STALLED\n")

    def _strikes(self, axis: AxisMechanics, end_s: float) -> None:
        """Foresee that a motion will end at a stop: the firmware says so then, unless it ended otherwise."""

        def struck() -> None:
            if axis.end_s() == end_s:
                self.stalled(axis)

        self._host.machine.at_dish(end_s, struck)

    def _pushes(self, axis: AxisMechanics) -> None:
        """Find out that an axis does not turn, as at a stop; not when it was freed meanwhile."""
        machine = self._host.machine
        machine.at_dish(machine.dish_s + STALL_DWELL_S, lambda: self.stalled(axis) if axis.stalled else None)
