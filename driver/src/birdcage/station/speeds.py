"""Speeds that a pursuit has changed: they are put back on every way out of it."""

from __future__ import annotations

from types import MappingProxyType

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.station.board import Board
from birdcage.station.lent import LentSpeeds
from birdcage.station.look import Look


class Speeds:
    """Remembers what each axis was set to before."""

    def __init__(self, board: Board, antenna: BirdcageAntenna, look: Look) -> None:
        self._board, self._antenna, self._look = board, antenna, look
        self._before: dict[int, float] = {}
        self._lent: LentSpeeds | None = None

    def remember(self, lent: LentSpeeds) -> None:
        """Remember on disk from now on; what the program before this one did not put back is to be put back."""
        self._lent = lent
        self._before = lent.read()
        self._show()

    @property
    def are_changed(self) -> bool:
        """Whether any is still to be put back."""
        return bool(self._before)

    def set(self, motor: int, speed_deg_s: float) -> None:
        """Set the greatest speed of one axis. Raises as `FirmwareProtocol.set_speed`."""
        axis = self._antenna.protocol.model.axis(motor)
        before = self._antenna.speeds_deg_s.get(motor, axis.speed_deg_s)
        if motor not in self._before:
            if self._lent is not None:
                self._lent.write({**self._before, motor: before})
            self._before[motor] = before
            self._show()
        self._send(motor, speed_deg_s)

    def restore(self) -> None:
        """Put every speed back. What fails is raised, and stays to be done."""
        for motor, speed_deg_s in tuple(self._before.items()):
            self._send(motor, speed_deg_s)
            del self._before[motor]
        self.forget()

    def forget(self) -> None:
        """The dish has restarted, and goes at its own speeds again."""
        self._before.clear()
        if self._lent is not None:
            self._lent.clear()
        self._show()

    def _show(self) -> None:
        self._board.change(speeds_lent=MappingProxyType(dict(self._before)))

    def _send(self, motor: int, speed_deg_s: float) -> None:
        protocol = self._antenna.protocol
        self._look.elsewhere = True  # STOP has to come back to the motor menu first
        speeds = protocol.set_speed(motor, speed_deg_s)
        self._look.note_speeds(speeds)
        protocol.enter_motor_menu()
        self._look.elsewhere = False
