"""Remembers a sync between programs: while the machine stands as it was left, and has power.

`docs/decisions/0082-told-zero.md`.
"""

from __future__ import annotations

import contextlib
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import BirdcageError, PositionUnknown
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.base.paths import write_aside_and_rename
from birdcage.base.reason import Reason
from birdcage.link.identity import dish_folder, made_at
from birdcage.rotator.facts import CableTurn, Facts
from birdcage.rotator.ladder import StopMeans
from birdcage.rotator.readings import UnreadablePosition
from birdcage.station.dish_reader import DishReader
from birdcage.station.events import ActivityChanged, Event, PositionRead
from birdcage.station.signals import Signals
from birdcage.station.silent_zero import BESIDE_DEG, SAME_DEG, SilentZero, WayWatch
from birdcage.station.state import Activity, Pointing
from birdcage.station.state_store import StateStore

FILE = "zero.json"
LONGEST = 4096
START_DEG = 2.0
"""So near to its zeros a machine may stand because it was switched on there just now."""
START_S = 3600.0
"""How long it is taken for one that was left there."""
CLOSE_S = 1.0


@dataclass(frozen=True, slots=True)
class ZeroAsLeft:
    """Where a person has synced it to, and how the machine was left."""

    zero_deg: Mapping[str, float]
    counted_deg: Mapping[str, float]
    """Where it counted its axes to stand."""
    made: str
    """When the system has made the port (`made_at`): a machine on USB that was without power has another one."""
    utc: datetime


class ZeroMemory:
    """`zero.json` in the folder of the dish. For the station's thread; a thread of its own writes."""

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, reader: DishReader, signals: Signals,
        state_folder: Path | None, identify: Callable[[str], str | None],
    ) -> None:  # fmt: skip
        self._store, self._antenna, self._reader = store, antenna, reader
        self._state_folder, self._identify = state_folder, identify
        self._file: Path | None = None
        self._made = ""
        self._left: ZeroAsLeft | None = None
        """What the first reading must agree with; None once it was compared."""
        self._kept: ZeroAsLeft | None = None
        """What is on disk, or on its way there."""
        self._way = WayWatch()
        self._silent: SilentZero | None = None
        """How it was left as it fell silent; None while it is not, or was told nothing."""
        self._unheard_since = math.inf
        """Since when no byte came, in monotonic seconds."""
        self._contradicted = False
        """Whether one reading since has said that it lost its power."""
        self._writer: BackgroundWriter[tuple[Path, bytes | None]] | None = None
        reader.recall_zero = self.recall
        store.subscribe(self._hear, PositionRead, ActivityChanged)
        signals.port_found.connect(self.meet)
        signals.silent.connect(self.doubt)
        signals.restarted.connect(self.drop)

    def meet(self, port: str) -> None:
        """Take in that the machine is at `port` from now on. What was told counts if it stands as it was left."""
        self._forget()
        self._believe()
        identity = self._identify(port)
        self._file = self._kept = None
        self._made = made_at(port)
        if identity is not None and self._state_folder is not None:
            self._file = dish_folder(self._state_folder, identity) / FILE
            self._kept = read_zero(self._file, self._antenna.rotator.facts)
        self._left = self._kept

    def doubt(self, reason: Reason | None) -> None:
        """The machine does not answer. Where no byte comes it may be without power: the next reading tells.

        A damaged answer is one: whoever talks has power.
        """
        rotator, now = self._antenna.rotator, self._store.clock.monotonic()
        if reason is not Reason.SILENT:
            self._note_silence(now)
            self._unheard_since = math.inf
            return
        heard = rotator.line.last_reply
        since = self._way.seen_at if heard is None else heard
        if since > self._unheard_since:
            self._note_silence(since)
        self._unheard_since = since
        if self._silent is None and rotator.facts.zero_deg and self._way.seen:
            self._look_ahead(taken=False)
            turns = rotator.facts.turn is CableTurn.REPORTED
            self._silent = SilentZero(rotator.facts.zero_deg, self._way.may_be_deg, turns, 0.0, rotator.facts.boot_s)
            self._contradicted = False

    def _note_silence(self, now: float) -> None:
        if self._silent is not None and now - self._unheard_since > self._silent.silent_s:
            self._silent = replace(self._silent, silent_s=now - self._unheard_since)

    def _check(self, counted: Mapping[str, float]) -> None:
        """See by a reading whether the machine had power since the last one. See `AzEl.check_zero`."""
        if self._had_power(counted):
            self._believe()
            return
        if not self._contradicted:
            self._contradicted = True  # a digit may be lost on the wire: two readings must agree
            raise UnreadablePosition("The machine counts otherwise than before.", [str(dict(counted))])
        self._believe()
        self._way.forget()
        self._forget()
        self._keep(None)  # nor does a later program believe it
        raise PositionUnknown(
            "The position is unknown: the machine may have lost its power. "
            f"{self._antenna.rotator.facts.must_be_synced}", reason=Reason.UNSYNCED,
        )  # fmt: skip

    def _had_power(self, counted: Mapping[str, float]) -> bool:
        state, seen = self._store.state, self._way.seen
        if self._silent is not None:
            self._note_silence(self._store.clock.monotonic())
            stop = state.last_stop
            # Such a STOP may have brought one that has started to the very count where it was left.
            aimed = stop is not None and stop.means is StopMeans.RETARGET and stop.at > self._way.seen_at
            return not aimed and self._silent.holds_at(counted)
        if state.activity is not Activity.IDLE or state.motion is not None or self._antenna.motion is not None:
            return True
        return not seen or not self._has_jumped_to_start(seen, counted)

    def _has_jumped_to_start(self, seen: Mapping[str, float], counted: Mapping[str, float]) -> bool:
        """Return whether one that rested elsewhere, and was sent nowhere, counts what it does after a start."""
        told = self._antenna.rotator.facts.zero_deg
        rested = max((abs(seen[name]) for name in told), default=0.0)
        return rested > BESIDE_DEG and all(abs(counted[name]) <= SAME_DEG for name in told)

    def _believe(self) -> None:
        self._silent, self._unheard_since, self._contradicted = None, math.inf, False

    def _look_ahead(self, *, taken: bool) -> None:
        """Take in where the machine is on its way to, as it counts."""
        motion, facts = self._antenna.motion, self._antenna.rotator.facts
        az, el = facts.azimuth.name, facts.elevation.name
        if motion is not None:
            turn = motion.azimuth
            stood = self._way.seen[az]
            ahead = shortest_turn(stood + facts.zero_deg[az], turn.read_deg) + turn.slew.end_deg - turn.read_deg
            el_deg = motion.elevation.slew.end_deg - facts.zero_deg.get(el, 0.0)
            self._way.send({az: stood + ahead, el: el_deg}, taken=taken)
        elif self._antenna.moving.motor_runs:
            for way in (-math.inf, math.inf):
                self._way.send({az: way, el: way}, taken=False)

    def _forget(self) -> None:
        if self._antenna.rotator.facts.zero_deg:
            self._reader.tell_zero(None)

    def recall(self) -> bool:
        """Take up what was told earlier, if the machine stands where it was left, and had power since."""
        left, self._left = self._left, None
        if left is None or left.made != self._made:
            return False
        try:
            counted = self._antenna.rotator.counted()
        except BirdcageError:
            self._left = left  # nothing was read: the next reading tells
            return False
        turns = self._antenna.rotator.facts.turn is CableTurn.REPORTED
        apart = (_apart(left.counted_deg[name], counted.get(name, math.inf), turns) for name in left.counted_deg)
        at_start = all(abs(counted.get(name, 0.0)) <= START_DEG for name in left.zero_deg)
        aged = self._store.clock.utc() - left.utc > timedelta(seconds=START_S)
        if max(apart) > SAME_DEG or (at_start and (aged or not left.made)):
            return False
        self._reader.tell_zero(left.zero_deg)
        return True

    def drop(self) -> None:
        """The machine has restarted: its zeros are elsewhere."""
        self._left = None
        self._believe()
        self._way.forget()
        self._forget()
        self._keep(None)

    def close(self) -> None:
        """Let what is on its way reach the disk."""
        if self._writer is not None:
            self._writer.close(CLOSE_S)

    def _hear(self, _event: Event) -> None:
        """Keep how it stands, whenever it is seen at rest."""
        state, zero_deg = self._store.state, self._antenna.rotator.facts.zero_deg
        resting = state.activity is Activity.IDLE and state.motion is None
        if state.position is None or state.position_lost is not None or not zero_deg:
            return
        counted = counted_at(state.position, self._antenna.rotator.facts)
        self._way.see(counted, state.position.at, rests=resting)
        self._antenna.rotator.check_zero = self._check
        self._look_ahead(taken=True)
        if resting:
            self._keep(ZeroAsLeft(zero_deg, counted, self._made, self._store.clock.utc()))

    def _keep(self, left: ZeroAsLeft | None) -> None:
        if self._file is None or _is_same(left, self._kept):
            return
        self._kept = left
        if self._writer is None:
            self._writer = BackgroundWriter("keep the zero", _write)
        self._writer.offer((self._file, None if left is None else _text(left)))


def counted_at(position: Pointing, facts: Facts) -> Mapping[str, float]:
    """Return where a machine counts its axes to stand that points there."""
    az, el = facts.azimuth.name, facts.elevation.name
    az_deg = position.dish_az_deg if position.cable_deg is None else position.cable_deg
    az_deg -= facts.zero_deg.get(az, 0.0)
    turns = position.cable_deg is not None
    return {az: az_deg if turns else wrap_360(az_deg), el: position.dish_el_deg - facts.zero_deg.get(el, 0.0)}


def read_zero(file: Path, facts: Facts) -> ZeroAsLeft | None:
    """Return what was told of a machine, and how it was left; None if nothing tells, or not what can be believed."""
    names = {facts.azimuth.name, facts.elevation.name}
    try:
        with file.open("rb") as opened:
            told = json.loads(opened.read(LONGEST))
        zero_deg, counted_deg = ({str(n): float(deg) for n, deg in told[key].items()} for key in ("zero", "counted"))
        left = ZeroAsLeft(zero_deg, counted_deg, str(told["made"]), datetime.fromisoformat(told["utc"]))
        angles = (*zero_deg.values(), *counted_deg.values())
        known = set(zero_deg) <= names and set(counted_deg) == names and all(map(math.isfinite, angles))
        sure = known and bool(zero_deg) and left.utc.tzinfo is not None
    except (OSError, ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError):
        return None
    return left if sure else None


def _text(left: ZeroAsLeft) -> bytes:
    told = {"zero": left.zero_deg, "counted": left.counted_deg, "made": left.made, "utc": left.utc.isoformat()}
    return json.dumps(
        {key: dict(value) if isinstance(value, Mapping) else value for key, value in told.items()}
    ).encode()


def _apart(one_deg: float, other_deg: float, turns: bool) -> float:
    return abs(other_deg - one_deg) if turns or not math.isfinite(other_deg) else abs(shortest_turn(one_deg, other_deg))


def _is_same(one: ZeroAsLeft | None, other: ZeroAsLeft | None) -> bool:
    """Return whether a note need not be written anew: it is also to say within minutes when that was."""
    if one is None or other is None:
        return one is other
    if (one.zero_deg, one.made) != (other.zero_deg, other.made) or abs(one.utc - other.utc) > timedelta(minutes=5):
        return False
    return all(abs(one.counted_deg[name] - deg) <= SAME_DEG / 5 for name, deg in other.counted_deg.items())


def _write(wishes: list[tuple[Path, bytes | None]], _dropped: int) -> None:
    for file, text in dict(wishes).items():
        with contextlib.suppress(OSError):  # then the next program has to be told anew
            if text is None:
                file.unlink(missing_ok=True)
            else:
                write_aside_and_rename(file, text)
