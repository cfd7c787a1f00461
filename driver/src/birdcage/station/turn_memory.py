"""Remembers the turn of a dish's cable between programs: counted when it was last left, at the same place.

`docs/decisions/0027-remembered-turn.md`.
"""

from __future__ import annotations

import contextlib
import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from birdcage.antenna.gate import MotionGate
from birdcage.base.background import BackgroundWriter
from birdcage.base.geometry import shortest_turn
from birdcage.base.paths import write_aside_and_rename
from birdcage.link.identity import dish_folder
from birdcage.station.events import ActivityChanged, Event, PositionRead
from birdcage.station.signals import Signals
from birdcage.station.state import Activity
from birdcage.station.state_store import StateStore

FILE = "turn.json"
LONGEST = 1024
SAME_DEG = 0.05
"""A dish that was not moved prints the same angles again, to a hundredth or two."""
HOME_DEG = 2.0
"""So near to its reference a dish may stand because it has homed meanwhile, which unwinds its cable."""
CLOSE_S = 0.2


@dataclass(frozen=True, slots=True)
class DishAsLeft:
    """How a dish was left, in its own degrees."""

    cable_deg: float
    az_deg: float
    el_deg: float


class TurnMemory:
    """`turn.json` in the folder of the dish. For the station's thread; a thread of its own writes."""

    def __init__(
        self, store: StateStore, gate: MotionGate, signals: Signals, firmware: str, state_folder: Path | None,
        identify: Callable[[str], str | None],
    ) -> None:  # fmt: skip
        self._store, self._gate, self._firmware = store, gate, firmware
        self._state_folder, self._identify = state_folder, identify
        self._file: Path | None = None
        self._left: DishAsLeft | None = None
        """What is on disk, or on its way there."""
        self._expected: DishAsLeft | None = None
        """What the first reading must agree with."""
        self._writer: BackgroundWriter[tuple[Path, bytes | None]] | None = None
        store.subscribe(self._hear, PositionRead, ActivityChanged)
        signals.port_found.connect(self.meet)
        signals.position_read.connect(self.recall)
        signals.restarted.connect(self.drop)

    def meet(self, port: str) -> None:
        """Take in that the dish is at `port` from now on: its turn counts if the first reading is as it was left."""
        identity = self._identify(port)
        if identity is None or self._state_folder is None:
            self._file = self._left = self._expected = None
            return
        file = dish_folder(self._state_folder, identity) / FILE
        if file != self._file:
            self._file, self._left = file, read_left(file, self._firmware)
        self._expected = self._left

    def recall(self) -> None:
        """Take in that the position was just read: the first time, it may tell the turn of the cable."""
        left, self._expected = self._expected, None
        gate = self._gate
        here, limits = gate.position, gate.cable_limits
        if left is None or here is None or limits is None or gate.cable_deg is not None:
            return
        turn_deg = shortest_turn(left.az_deg, here.azimuth)
        is_there = max(abs(turn_deg), abs(left.el_deg - here.elevation)) <= SAME_DEG
        may_have_homed = abs(shortest_turn(0.0, here.azimuth)) <= HOME_DEG < abs(left.cable_deg)
        if is_there and not may_have_homed and limits[0] <= left.cable_deg + turn_deg <= limits[1]:
            gate.remember_cable(left.cable_deg + turn_deg)

    def drop(self) -> None:
        """The dish has restarted: what was counted before no longer holds."""
        self._expected = None
        self._keep(None)

    def close(self) -> None:
        """Let what is on its way reach the disk."""
        if self._writer is not None:
            self._writer.close(CLOSE_S)

    def _hear(self, _event: Event) -> None:
        """Keep how it stands, whenever it is seen at rest."""
        state = self._store.state
        resting = state.activity is Activity.IDLE and state.motion is None and state.position_lost is None
        if not resting or state.position is None:
            return
        here, cable_deg = state.position, self._gate.cable_deg
        self._keep(None if cable_deg is None else DishAsLeft(cable_deg, here.dish_az_deg, here.dish_el_deg))

    def _keep(self, left: DishAsLeft | None) -> None:
        if self._file is None or _is_same(left, self._left):
            return
        self._left = left
        if self._writer is None:
            self._writer = BackgroundWriter("keep the turn", _write)
        self._writer.offer((self._file, None if left is None else _text(left, self._firmware)))


def read_left(file: Path, firmware: str) -> DishAsLeft | None:
    """Return how a dish that speaks `firmware` was left; None if nothing tells, or not what can be believed."""
    try:
        with file.open("rb") as opened:
            told = json.loads(opened.read(LONGEST))
        left = DishAsLeft(*(float(told[name]) for name in ("cable_deg", "az_deg", "el_deg")))
        known = told["firmware"] == firmware and all(map(math.isfinite, (left.cable_deg, left.az_deg, left.el_deg)))
    except (OSError, ValueError, KeyError, TypeError, OverflowError, RecursionError):
        return None
    return left if known else None


def leave(state_folder: Path, identity: str, firmware: str, left: DishAsLeft) -> None:
    """Leave a note as if a program had counted until now: for a dish that is made to stand somewhere. OSError."""
    write_aside_and_rename(dish_folder(state_folder, identity) / FILE, _text(left, firmware))


def _text(left: DishAsLeft, firmware: str) -> bytes:
    told = {"firmware": firmware, "cable_deg": left.cable_deg, "az_deg": left.az_deg, "el_deg": left.el_deg}
    return json.dumps(told).encode()


def _is_same(one: DishAsLeft | None, other: DishAsLeft | None) -> bool:
    if one is None or other is None:
        return one is other
    pairs = ((one.cable_deg, other.cable_deg), (one.az_deg, other.az_deg), (one.el_deg, other.el_deg))
    return all(abs(a - b) <= SAME_DEG / 5 for a, b in pairs)


def _write(wishes: list[tuple[Path, bytes | None]], _dropped: int) -> None:
    for file, text in dict(wishes).items():
        with contextlib.suppress(OSError):  # then the next program does not know the turn
            if text is None:
                file.unlink(missing_ok=True)
            else:
                write_aside_and_rename(file, text)
