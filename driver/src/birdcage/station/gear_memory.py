"""Keeps what is known of a dish's own gear in its folder: what was learnt of it, and what its owner has set."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.gear import AXES, MOST_DEG, Gear, GearFact, GearKind, GearOrigin
from birdcage.antenna.overshoot import OvershootWatch
from birdcage.base.errors import ConfigError
from birdcage.base.paths import write_aside_and_rename
from birdcage.link.identity import dish_folder, dish_identity
from birdcage.rotator.facts import SecondMove
from birdcage.station.board import Board
from birdcage.station.events import Event, PositionRead

FILE = "gear.json"
LONGEST = 4096
"""Bytes that are read of it: ours has some nine hundred."""
TELLING_DEG = 0.005
"""What was learnt is replaced where it has changed by more."""
KINDS = {True: GearKind.OVERSHOOT_UP, False: GearKind.OVERSHOOT_DOWN}


class GearMemory:
    """`gear.json` in the folder of the dish; of a dish without an identity it lasts as long as the program."""

    def __init__(
        self, board: Board, antenna: BirdcageAntenna, state_folder: Path | None, identify: Callable[[str], str | None]
    ) -> None:
        self._board, self._antenna = board, antenna
        self._state_folder, self._identify = state_folder, identify
        self._key: str | None = None
        self._file: GearFile | None = None
        board.subscribe(self._hear)

    def meet(self, port: str) -> None:
        """Take in that the dish is at `port` from now on."""
        identity = self._identify(port)
        if (identity or port) == self._key:
            return
        self._key, self._file = identity or port, None
        if identity is not None and self._state_folder is not None:
            self._file = GearFile(
                dish_folder(self._state_folder, identity) / FILE, self._antenna.rotator.facts.firmware
            )
        self._antenna.commands.overshoots = OvershootWatch()
        self._use(Gear() if self._file is None else self._file.read())

    def _hear(self, event: Event) -> None:
        """See whether the readings tell how far past its target the dish comes to rest."""
        if not isinstance(event, PositionRead):
            return
        before = gear = self._antenna.gear
        for (axis, up), tally in self._antenna.commands.overshoots.tallies.items():
            known = gear.facts.get((axis, KINDS[up]))
            if tally.is_sure and (known is None or abs(known.deg - tally.mean_deg) > TELLING_DEG):
                fact = GearFact(tally.mean_deg, GearOrigin.READINGS, event.utc, tally.count)
                gear = gear.with_fact(axis, KINDS[up], fact)
        if gear is before:
            return
        if self._file is not None:
            # What `birdcage gear` has set or forgotten meanwhile is not undone.
            stored = self._file.read()
            for axis in AXES:
                gear = gear.with_fact(axis, GearKind.PLAY, stored.facts.get((axis, GearKind.PLAY)))
        self._use(gear)
        if self._file is not None:
            with suppress(OSError):  # then the next program learns it anew
                self._file.write(gear)

    def _use(self, gear: Gear) -> None:
        """Plan and steer accordingly, and show it, from now on."""
        self._antenna.gear = gear
        self._antenna.remember_blocking(blocks=self._antenna.kind.second_same is SecondMove.BLOCK)
        self._board.change(dish=self._antenna.kind, gear=gear)


@dataclass(frozen=True, slots=True)
class GearFile:
    """`gear.json` of one dish that speaks a firmware; None while its firmware is unknown."""

    path: Path
    firmware: str | None

    @classmethod
    def of(cls, state_folder: Path, port: str, firmware: str | None) -> GearFile | None:
        """Return that of the dish at a port, of the firmware that is kept there where none is named.

        None if the port has no identity.
        """
        identity = dish_identity(port)
        if identity is None:
            return None
        path = dish_folder(state_folder, identity) / FILE
        kept = _told_in(path).get("firmware")
        return cls(path, firmware or (kept if isinstance(kept, str) else None))

    def read(self) -> Gear:
        """Return what is known; nothing where that cannot be read or believed, or is of another firmware."""
        gear, told = Gear(), _told_in(self.path)
        try:
            for each in told["facts"] if told.get("firmware") == self.firmware else ():
                gear = gear.with_fact(*_fact_of(each))
        except (ValueError, KeyError, TypeError, OverflowError, ConfigError):
            return Gear()
        return gear

    def write(self, gear: Gear) -> None:
        """Keep it for the programs that come after. OSError."""
        facts = [
            {
                "axis": axis, "kind": kind.value, "deg": round(fact.deg, 4), "origin": fact.origin.value,
                "utc": fact.utc.isoformat(timespec="seconds"), "readings": fact.readings,
            }
            for (axis, kind), fact in gear.facts.items()
        ]  # fmt: skip
        write_aside_and_rename(self.path, json.dumps({"firmware": self.firmware, "facts": facts}).encode())

    def set_play(self, az_deg: float | None, el_deg: float | None, utc: datetime) -> None:
        """Keep the play that the owner has measured; None leaves that of an axis. ConfigError for no play. OSError."""
        gear = self.read()
        for axis, deg in zip(AXES, (az_deg, el_deg), strict=True):
            if deg is not None:
                fact = GearFact(checked_deg(GearKind.PLAY, deg), GearOrigin.USER, utc)
                gear = gear.with_fact(axis, GearKind.PLAY, fact)
        self.write(gear)

    def forget(self) -> None:
        """Know nothing of the dish any more. OSError."""
        self.path.unlink(missing_ok=True)


def _told_in(path: Path) -> dict[str, Any]:
    try:
        with path.open("rb") as opened:
            told = json.loads(opened.read(LONGEST))
    except (OSError, ValueError, RecursionError):
        return {}
    return told if isinstance(told, dict) else {}


def _fact_of(told: dict[str, Any]) -> tuple[str, GearKind, GearFact]:
    axis, kind = told["axis"], GearKind(told["kind"])
    fact = GearFact(
        checked_deg(kind, float(told["deg"])), GearOrigin(told["origin"]), datetime.fromisoformat(told["utc"]),
        int(told["readings"]),
    )  # fmt: skip
    if axis not in AXES or fact.utc.tzinfo is None:
        raise ValueError(axis)
    return axis, kind, fact


def checked_deg(kind: GearKind, deg: float) -> float:
    """Return a figure that can be one. ConfigError where it cannot."""
    least = 0.0 if kind is GearKind.PLAY else -MOST_DEG[kind]
    if not least <= deg <= MOST_DEG[kind]:
        raise ConfigError(f"A play of {deg:g}° can't be right: type 0 to {MOST_DEG[kind]:g}.")
    return deg
