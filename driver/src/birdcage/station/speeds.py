"""Speeds that a pursuit has changed: they are put back on every way out of it."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.station.look import Look


class Speeds:
    """Remembers what each axis was set to before."""

    def __init__(self, antenna: BirdcageAntenna, look: Look) -> None:
        self._antenna, self._look = antenna, look
        self._before: dict[int, float] = {}

    @property
    def are_changed(self) -> bool:
        """Whether any is still to be put back."""
        return bool(self._before)

    def set(self, motor: int, speed_deg_s: float) -> None:
        """Set the greatest speed of one axis. Raises as `FirmwareProtocol.set_speed`."""
        axis = self._antenna.protocol.model.axis(motor)
        before = self._antenna.speeds_deg_s.get(motor, axis.speed_deg_s)
        self._before.setdefault(motor, before)
        self._send(motor, speed_deg_s)

    def restore(self) -> None:
        """Put every speed back. What fails is raised, and stays to be done."""
        for motor, speed_deg_s in tuple(self._before.items()):
            self._send(motor, speed_deg_s)
            del self._before[motor]

    def forget(self) -> None:
        """The dish has restarted, and goes at its own speeds again."""
        self._before.clear()

    def _send(self, motor: int, speed_deg_s: float) -> None:
        protocol = self._antenna.protocol
        self._look.elsewhere = True  # STOP has to come back to the motor menu first
        speeds = protocol.set_speed(motor, speed_deg_s)
        self._look.note_speeds(speeds)
        protocol.enter_motor_menu()
        self._look.elsewhere = False
