"""What goes on while somebody holds a key: a terminal tells of each repeat, and nothing of the release."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.clock import Clock
from birdcage.station.task import Task

HOLD_S = 0.6
"""So long it goes on after it was last asked for; real seconds."""


class HeldKeyTask(Task):
    """Ends by itself when it is asked for no more. Nothing begins it but a person, who keeps control."""

    goes_on = False
    is_unattended = False
    gives_back = False
    done_words = "No longer held."

    def __init__(self, antenna: BirdcageAntenna, clock: Clock, holder: str, first_s: float = HOLD_S) -> None:
        """`first_s`: so long it goes on after the first time; real seconds."""
        self._antenna, self._clock, self.holder = antenna, clock, holder
        self._until = clock.monotonic() + first_s

    def renew(self) -> None:
        """It is asked for once more."""
        self._until = max(self._until, self._clock.monotonic() + HOLD_S)

    @property
    def is_held(self) -> bool:
        """Whether it is still asked for."""
        return self._clock.monotonic() < self._until

    @property
    def streams(self) -> bool:
        """It does as long as it lasts."""
        return True
