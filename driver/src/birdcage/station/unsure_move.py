"""A lost answer in a stream, on a dish whose moves queue: nothing may follow until that move must be over."""

from __future__ import annotations

from birdcage.antenna.motion import AxisMotion
from birdcage.base.errors import Stopped
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.station.mover import ARRIVED_DEG
from birdcage.station.parts import Parts
from birdcage.station.queued_mover import ASTRAY_S
from birdcage.station.state import Pointing

MOST_UNSURE = 3
"""So many answers in a row that tell nothing make one look whether the dish moves."""


class UnsureMove:
    """The dish may have taken it or not: two readings that agree tell that it rests, wherever that is."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._store, self._antenna = parts, parts.store, parts.antenna
        self._since: float | None = None
        """When it must be over; None if the last answer tells what the dish does."""
        self._seen: Pointing | None = None
        """The last reading since then."""
        self._stood: Pointing | None = None
        """Where the dish was at the last reading of a stream."""

    def forget(self) -> None:
        """Another task begins, or goes on."""
        self._since = self._seen = self._stood = None

    def see_it_follow(self, here: Pointing, unsure: int) -> None:
        """Raise Stopped (`not_taken`) where the dish tells nothing of the commands that it gets, and does not move.

        `unsure`: how many commands in a row were answered with nothing known.
        """
        before, self._stood = self._stood, here
        motion = self._antenna.motion
        if before is None or motion is None or unsure < MOST_UNSURE or not self._parts.reader.is_still(here, before):
            return
        az_deg, el_deg = motion.rest
        if max(abs(shortest_turn(az_deg, here.dish_az_deg)), abs(el_deg - here.dish_el_deg)) > ARRIVED_DEG:
            said = " / ".join(sorted({answer.said for answer in self._antenna.commands.answers.values()}))
            raise Stopped(f"The dish answers {said!r} to its commands, and does not move.", reason=Reason.NOT_TAKEN)

    @property
    def is_open(self) -> bool:
        """Whether it is not known yet what became of one."""
        return self._since is not None

    def begin(self) -> float:
        """An answer was lost: return when the move must be over, in monotonic seconds."""
        motion, clock = self._antenna.motion, self._store.clock
        axes = () if motion is None else (motion.azimuth, motion.elevation)
        self._since = max((over_at(axis, clock.rate) for axis in axes), default=clock.monotonic())
        self._since, self._seen = max(clock.monotonic(), self._since), None
        return self._since

    def rests(self) -> bool:
        """Take in the position that was just read; return whether the dish rests."""
        before, here, now = self._seen, self._store.state.position, self._store.clock.monotonic()
        if here is None:
            return False
        self._seen = here
        if before is not None and self._parts.reader.is_still(before, here):
            self._since = None
            self._antenna.moving.end()
            return True
        if before is not None and self._since is not None and now > self._since + ASTRAY_S:
            self._parts.signals.astray()
        return False


def over_at(axis: AxisMotion, rate: float) -> float:
    """Return when an axis rests, by its model alone; monotonic seconds."""
    return axis.started + axis.slew.duration_s / rate
