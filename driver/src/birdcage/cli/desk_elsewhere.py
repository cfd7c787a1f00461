"""A command that has the pursuit desk of the program with the port: what it orders goes on there."""

from __future__ import annotations

import signal
from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError, LinkError
from birdcage.base.reason import Reason
from birdcage.cli.attached_command import AttachedCommand
from birdcage.pursuit.attached_desk import AttachedDesk
from birdcage.pursuit.desk_setup import HOLDER

if TYPE_CHECKING:
    from birdcage.station.attached import AttachedStation

HEARD_S = 10.0
"""How long the desk may take to tell what was asked of it."""


class DeskElsewhere(AttachedCommand):
    """Ctrl+C is STOP. However else the command ends, what it ordered goes on."""

    holder = HOLDER
    """How the desk there calls itself."""

    def __init__(self, station: AttachedStation, holder: str, *, moves: bool) -> None:
        super().__init__(station, holder, moves=moves)
        self.desk = AttachedDesk(station, lambda _now: None)

    def on_signal(self, number: int) -> None:
        """Stop on Ctrl+C, and end the wait under way."""
        self.number = number
        if number == signal.SIGINT and not self.closing:
            self.call_stop("Ctrl+C")
        else:
            self.leave_moving = True
        self.end_wait(number)

    def meet_desk(self) -> None:
        """Hear the desk. LinkError where that program has none, or is gone."""
        self.desk.start()
        self.await_desk(lambda: self.desk.is_heard)
        self.check_desk()

    def check_desk(self) -> None:
        """LinkError where the desk is gone, and why."""
        if self.desk.now.is_away:
            raise LinkError(self.desk.now.problem, reason=Reason.LOST)

    def await_desk(self, seen: Callable[[], bool]) -> None:
        """Wait until the desk tells something. BirdcageError where it takes too long."""
        until = self.now + HEARD_S
        while not seen():
            if self.now >= until:
                raise BirdcageError(f"{self.station.via} did not answer within {HEARD_S:.0f} s.", reason=Reason.TIMEOUT)
            self.look()
