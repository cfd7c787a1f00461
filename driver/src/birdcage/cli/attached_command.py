"""The dish for the length of one command: over the program that has its port, or on a port of its own."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING

import click

from birdcage.base.errors import BirdcageError
from birdcage.cli.dish import LEAVE_S, leave_dish, open_dish, take_signals
from birdcage.cli.exits import EndedBySignal
from birdcage.cli.station_command import StationCommand
from birdcage.rotator.feature import POSITION
from birdcage.station.attached import AttachedStation
from birdcage.station.control_client import find_owner, owners_folder
from birdcage.station.network_state import NetworkState
from birdcage.station.requests import BeginTask, EndMotion, Goto, Home, Run, Stow, Watch
from birdcage.station.session import farewell
from birdcage.station.state import LinkPhase

if TYPE_CHECKING:
    from birdcage.base.clock import Clock
    from birdcage.cli.options import Wanted

ATTACH_S = 10.0
"""How long a program that has the port may take to answer: as long as `birdcage status` waits for it."""
LOOK_S = 3.0
"""How long the next reading of the position is waited for."""
SETS_IN_MOTION = (Goto, Home, Stow, BeginTask, Run)
"""Asked for, and not answered: the dish may move already, though this program has not heard so yet."""


class AttachedCommand(StationCommand):
    """Over the station of another program. What moves because of this command is its to stop, and nothing else."""

    station: AttachedStation
    outlives_terminal = True
    """Whether its motion goes on when the terminal is closed."""

    def __init__(self, station: AttachedStation, holder: str, *, moves: bool) -> None:
        super().__init__(station, moves=moves)
        self._holder = holder

    @property
    def in_motion(self) -> bool:
        """Whether the dish moves because of this command, and shall not outlive it."""
        heard = super().in_motion and self.state.holder == self._holder
        return (heard or isinstance(self.unanswered, SETS_IN_MOTION)) and not self.leave_moving

    def on_signal(self, number: int) -> None:
        """Ctrl+C is a person's STOP. A terminal that is closed stops nothing that may outlive it."""
        self.number = number  # first of all: the motion that ends now ends by this
        if self.outlives_terminal and number == getattr(signal, "SIGHUP", None):
            self.leave_moving = True
        if self.moves and not self.closing and not self.leave_moving:
            person = number == signal.SIGINT and self.in_motion
            self.call_stop("Ctrl+C" if person else signal.Signals(number).name, leaving=not person)
        self.end_wait(number)

    def call_stop(self, by: str, *, leaving: bool = False) -> None:
        """STOP; where the command only ends, its own motion does, and the dish is not held."""
        if leaving:
            self.station.submit(EndMotion(self._holder))
        else:
            self.station.stop(by)
            self.stop_called = True

    def look_anew(self) -> None:
        """Have the position read again, and wait for that. Where that takes too long, the last one stands."""
        since = self.now
        self.station.submit(Watch(self._holder, frozenset({POSITION}), 5.0))
        while self.now < since + LOOK_S and self.state.dish is not None and self.state.dish.tells_at_rest:
            position = self.state.position
            if position is not None and position.told_at >= since:
                return
            self.look()

    def show_network(self, network: NetworkState | None) -> None:
        """Show a server for network clients in the station."""
        self.station.show_network(network)

    def let_go(self) -> str:
        """Detach, and return where the dish was seen last."""
        state = self.state
        self.station.close()
        return farewell(state.position, state.position_lost, None)


@contextmanager
def reach_dish(
    wanted: Wanted, holder: str, *, moves: bool = False, survey: bool = True, clock: Clock | None = None,
    attached: type[AttachedCommand] = AttachedCommand,
) -> Iterator[StationCommand]:  # fmt: skip
    """Reach the dish as `open_dish` does; over the birdcage program that has its port, where one has and answers.

    `holder` is how this command calls itself in its requests. The other program knows it by user and terminal, too.
    `attached` is what it is to be there.
    """
    station = attach_to_owner(wanted, holder)
    if station is None:
        with open_dish(wanted, moves=moves, survey=survey, clock=clock) as own:
            yield own
        return
    dish = attached(station, holder, moves=moves)
    with ExitStack() as stack:
        stack.callback(station.close)
        signals = take_signals(stack, dish)
        begun = dish.now
        try:
            try:
                yield dish
            finally:
                if signals is not None:
                    signals.leave(LEAVE_S)
        except (BirdcageError, EndedBySignal, click.ClickException) as error:
            leave_dish(dish, begun, error, wanted)
            raise
        dish.close()


def attach_to_owner(wanted: Wanted, holder: str) -> AttachedStation | None:
    """Attach to the program that has the port; None if there is none that answers. Close it in the end."""
    if find_owner(owners_folder(wanted.paths), wanted.port) is None:
        return None
    station = AttachedStation(wanted.paths, wanted.port, own=holder, by=holder)
    until = station.clock.monotonic() + ATTACH_S
    while not station.wait_attached(0.05):
        if station.state.link.state is LinkPhase.LOST or station.clock.monotonic() > until:
            station.close()
            return None
    return station
