"""What is remembered of a dish between programs: its own facts, the turn of its cable, what it was told."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.station.dish_reader import DishReader
from birdcage.station.facts_memory import FactsMemory
from birdcage.station.settings import StationSettings
from birdcage.station.signals import Signals
from birdcage.station.state_store import StateStore
from birdcage.station.turn_memory import TurnMemory
from birdcage.station.zero_memory import ZeroMemory


class Memories:
    """All of one station. For its thread."""

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, reader: DishReader, signals: Signals,
        settings: StationSettings,
    ) -> None:  # fmt: skip
        folder, identify = settings.state_folder, settings.identify
        FactsMemory(store, antenna, signals, folder, identify)
        self._turns = TurnMemory(store, antenna.gate, signals, settings.firmware, folder, identify)
        self._zeros = ZeroMemory(store, antenna, reader, signals, folder, identify)

    def close(self) -> None:
        """Let what is on its way reach the disk."""
        self._turns.close()
        self._zeros.close()
