"""Remembers of each dish whether it takes the command of a move while a motor runs (decision 0023)."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.paths import write_aside_and_rename
from birdcage.link.identity import dish_folder
from birdcage.rotator.facts import SecondMove
from birdcage.station.board import Board
from birdcage.station.stop_ways import stop_way
from birdcage.station.stopper import Stopper

FILE = "moves.json"
LONGEST = 1024
"""Bytes that are read of it: ours has some fifty."""


class MoveMemory:
    """`moves.json` in the folder of the dish; a dish without an identity is remembered while the program runs."""

    def __init__(
        self, board: Board, antenna: BirdcageAntenna, stopper: Stopper, state_folder: Path | None,
        identify: Callable[[str], str | None],
    ) -> None:  # fmt: skip
        self._board, self._antenna, self._stopper = board, antenna, stopper
        self._state_folder, self._identify = state_folder, identify
        self._key: str | None = None
        self._file: Path | None = None
        self._told = {"firmware": antenna.rotator.facts.firmware, "second_move": SecondMove.BLOCK.value}
        self.on_learnt: Callable[[], None] = lambda: None
        """Told when the dish was seen to wait."""
        antenna.commands.on_blocking = self._learn

    def meet(self, port: str) -> None:
        """Take in that the dish is at `port` from now on: count it among those that wait if it was seen to."""
        identity = self._identify(port)
        key = identity or port
        if key == self._key:
            return
        self._key, self._file = key, None
        if identity is not None and self._state_folder is not None:
            self._file = dish_folder(self._state_folder, identity) / FILE
        self._antenna.remember_blocking(blocks=self._was_seen())
        self._use()

    def _was_seen(self) -> bool:
        if self._file is None:
            return False
        try:
            with self._file.open("rb") as file:
                return bool(json.loads(file.read(LONGEST)) == self._told)
        except (OSError, ValueError, RecursionError):
            return False

    def _learn(self) -> None:
        self._use()
        self.on_learnt()
        if self._file is not None:
            with suppress(OSError):  # then the next program learns it anew
                write_aside_and_rename(self._file, json.dumps(self._told).encode())

    def _use(self) -> None:
        """Stop it accordingly, and show it, from now on."""
        self._stopper.way = stop_way(self._board, self._antenna)
        self._board.change(dish=self._antenna.kind)
