"""Remembers of each dish what this program learns of it: whether it waits for its motors, how far it overshoots."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.gear import overshoot_name
from birdcage.antenna.overshoot import OvershootWatch
from birdcage.link.identity import dish_folder
from birdcage.rotator.origin import Origin
from birdcage.rotator.own import OwnFact, OwnFacts
from birdcage.station.events import Event, PositionRead
from birdcage.station.facts_file import FILE, FactsFile
from birdcage.station.signals import Signals
from birdcage.station.state_store import StateStore

TELLING_DEG = 0.005
"""An overshoot that was learnt is replaced where it has changed by more."""


class FactsMemory:
    """Over `facts.json` of the dish; of a dish without an identity it lasts as long as the program."""

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, signals: Signals, state_folder: Path | None,
        identify: Callable[[str], str | None],
    ) -> None:  # fmt: skip
        self._store, self._antenna, self._signals = store, antenna, signals
        signals.port_found.connect(self.meet)
        self._state_folder, self._identify = state_folder, identify
        self._key: str | None = None
        self._file: FactsFile | None = None
        antenna.commands.on_blocking = self._see_it_wait
        store.subscribe(self._hear, PositionRead)

    def meet(self, port: str) -> None:
        """Take in that the dish is at `port` from now on."""
        identity = self._identify(port)
        if (identity or port) == self._key:
            return
        self._key, self._file = identity or port, None
        if identity is not None and self._state_folder is not None:
            path = dish_folder(self._state_folder, identity) / FILE
            self._file = FactsFile(path, self._antenna.rotator.facts.firmware)
        self._antenna.commands.overshoots = OvershootWatch()
        self._antenna.know(OwnFacts() if self._file is None else self._file.read())
        self._antenna.strategy.forget_learnt()
        self._show()

    def _see_it_wait(self) -> None:
        self._show()
        self._signals.waits()
        if not self._antenna.strategy.one_at_a_time:
            self._store.warn(
                "facts",
                "This dish was seen to wait for its motors, but birdcage.toml (dish.facts) says that it does not. "
                "STOP may come late. Check second_same and second_other.",
            )
        self._keep()

    def _hear(self, event: Event) -> None:
        """See whether the readings tell how far past its target the dish comes to rest."""
        if not isinstance(event, PositionRead):
            return
        before = own = self._antenna.own
        for (axis, up), tally in self._antenna.commands.overshoots.tallies.items():
            name = overshoot_name(axis, up=up)
            known = own.facts.get(name)
            if tally.is_sure and (known is None or abs(float(known.value) - tally.mean_deg) > TELLING_DEG):
                own = own.with_fact(name, OwnFact(tally.mean_deg, Origin.LEARNT, event.utc, tally.count))
        if own is not before:
            self._antenna.know(own)
            self._keep()
            self._show()

    def _keep(self) -> None:
        if self._file is None:
            return
        # What `birdcage gear` has set or forgotten meanwhile is not undone.
        set_facts = {name: fact for name, fact in self._file.read().facts.items() if fact.origin is Origin.USER}
        own = self._antenna.own
        for name, fact in own.facts.items():
            if fact.origin is Origin.USER:
                own = own.with_fact(name, None)
        for name, fact in set_facts.items():
            own = own.with_fact(name, fact)
        self._antenna.know(own)
        with suppress(OSError):  # then the next program learns it anew
            self._file.write(own)

    def _show(self) -> None:
        antenna = self._antenna
        self._store.change(dish=antenna.kind, own=antenna.own, unplanned_stop=antenna.strategy.unplanned)
