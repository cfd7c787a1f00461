"""What those who drive the dish share: the parts of one station below them."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.errors import LinkError, Stopped
from birdcage.base.reason import Reason
from birdcage.station.control import Control
from birdcage.station.dish_mover import DishMover
from birdcage.station.dish_reader import DishReader
from birdcage.station.events import End
from birdcage.station.settings import StationSettings
from birdcage.station.settings_backup import SettingsBackup
from birdcage.station.signals import Signals
from birdcage.station.state import LinkPhase
from birdcage.station.state_store import StateStore
from birdcage.station.stopper import Stopper
from birdcage.station.unattended import UnattendedGuard
from birdcage.station.watches import Watches


@dataclass(frozen=True, slots=True)
class Parts:
    """Of one station; only for its thread."""

    store: StateStore
    antenna: BirdcageAntenna
    settings: StationSettings
    signals: Signals
    control: Control
    reader: DishReader
    mover: DishMover
    stopper: Stopper
    watches: Watches
    guard: UnattendedGuard
    backup: SettingsBackup

    def require_link(self, so: str) -> None:
        """Raise LinkError unless the dish answers; `so` is what is not done: `nothing is sent`."""
        link = self.store.state.link
        if link.state is not LinkPhase.UP:
            raise LinkError(f"No link to the dish, so {so} ({link.detail}).", reason=Reason(link.state.value))

    def come_to_rest(self, why: str) -> None:
        """Stop what moves, as far as it can be stopped, and hold nothing. Not while HELD: STOP sees to it."""
        if self.control.latched or self.store.state.link.state is not LinkPhase.UP:
            return
        strategy, clock = self.antenna.strategy, self.store.clock
        if not strategy.ends_soon(clock):
            self.mover.fail(End.STOPPED, why, Stopped(why))
            strategy.end_motion(clock)
        self.mover.await_stream_end()

    def free_wire(self) -> None:
        """End what is read in other menus: the next exchange goes to its own. LinkError unless the dish answers."""
        self.require_link("nothing is sent")
        if self.watches.excursion is not None:
            self.watches.end_excursion()
