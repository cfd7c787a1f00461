"""Takes readings of the position in: those that can be true, and for the gate."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.antenna.gate import MotionGate
from birdcage.antenna.reading_filter import ReadingFilter
from birdcage.base.clock import Clock
from birdcage.base.errors import PositionUnknown
from birdcage.base.reason import Reason
from birdcage.rotator.readings import UnreadablePosition, settled
from birdcage.rotator.values import Position


class Readings:
    """What the gate counts with is read here alone."""

    def __init__(self, gate: MotionGate) -> None:
        self._gate = gate
        self.belief: ReadingFilter | None = None
        """What readings must pass before anything counts with them; None: each is taken as printed."""

    def take(self, once: Callable[[], Position], clock: Clock) -> Position:
        """Return what `once` reads, as often as is needed to believe it.

        PositionUnknown where the dish does not know where it is: not homed, or released since.
        """
        gate, belief = self._gate, self.belief

        def read() -> Position:
            try:
                return once()
            except UnreadablePosition:
                gate.forget(Reason.UNREAD)
                raise

        try:
            position = settled(read if belief is None else lambda: belief.read(read, clock))
        except PositionUnknown as unknown:
            gate.forget(unknown.reason)
            raise
        gate.see(position)
        return position
