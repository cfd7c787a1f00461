"""The part of a pass that would be followed, and how much of it others leave."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta

from birdcage.pursuit.schedule_model import Direction, ScheduleCandidate, Slew

_MARGIN = timedelta(seconds=0.01)
"""Added to the guesses of when the dish is there, more each time: the satellite moves, and guessing must end."""
_GUESSES = 100


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A pass from one moment within reach to another."""

    candidate: ScheduleCandidate
    start: datetime
    end: datetime
    followed: timedelta
    """How much of it is within reach."""
    best_el_deg: float
    """The highest elevation within reach."""
    begun: bool = False
    """Whether it begins now because the pass has begun before."""
    slot: int = 0
    """Which of the gaps between the passes that are settled it lies in."""

    @property
    def order(self) -> tuple[datetime, datetime, int, str]:
        """What pieces are sorted by."""
        return self.start, self.end, self.candidate.passing.norad_id, self.candidate.passing.name

    @property
    def told_start(self) -> datetime:
        """When the stretch begins that comes first, also where that was before now; one that is over counts no more."""
        if not self.begun:
            return self.start
        return next(each.start for each in self.candidate.reach.intervals if each.start <= self.start < each.end)

    @property
    def told(self) -> timedelta:
        """How much is within reach from `told_start` to its end."""
        start = self.told_start
        inside = ((max(each.start, start), min(each.end, self.end)) for each in self.candidate.reach.intervals)
        return sum((high - low for low, high in inside if low < high), timedelta())

    @property
    def late(self) -> bool:
        """Whether something keeps the dish from its beginning."""
        return not self.begun and self.start > self.candidate.reach.intervals[0].start

    @property
    def short(self) -> bool:
        """Whether something keeps the dish from its end."""
        return self.end < self.candidate.reach.intervals[-1].end

    def part(self, start: datetime, end: datetime) -> Piece | None:
        """Return what of it lies between two times; None if nothing within reach does."""
        begun = self.begun and start <= self.start
        inside = [
            (max(each.start, start, self.start), min(each.end, end, self.end))
            for each in self.candidate.reach.intervals
        ]
        inside = [(low, high) for low, high in inside if low < high]
        if not inside:
            return None
        return Piece(
            self.candidate, inside[0][0], inside[-1][1], sum((high - low for low, high in inside), timedelta()),
            _highest(self.candidate, inside), begun, self.slot,
        )  # fmt: skip


def whole(candidate: ScheduleCandidate, now: datetime) -> Piece | None:
    """Return all that can still be followed of a pass; None if it is over, or never comes within reach."""
    stretches = candidate.reach.intervals
    if not stretches or stretches[-1].end <= now:
        return None
    start, end = stretches[0].start, stretches[-1].end
    best = candidate.reach.best_el_deg
    followed = timedelta(seconds=candidate.reach.total_s)
    piece = Piece(candidate, start, end, followed, -90.0 if best is None else best)
    if start >= now:
        return piece
    rest = piece.part(now, end)
    return None if rest is None else replace(rest, begun=True)


def _highest(candidate: ScheduleCandidate, inside: Sequence[tuple[datetime, datetime]]) -> float:
    """Return the highest elevation of some stretches: at the top of the pass, or as near to it as they come."""
    top = max(candidate.where(min(max(candidate.passing.tca, low), high)).el_deg for low, high in inside)
    best = candidate.reach.best_el_deg
    return top if best is None else min(top, best)  # the ceiling of the dish may be lower


class Turning:
    """How long the dish takes from one pass to the next."""

    def __init__(self, slew_s: Slew | float) -> None:
        self._slew_s = slew_s
        self._seen: dict[tuple[int, datetime], Direction] = {}

    def follows(self, before: Piece, after: Piece) -> bool:
        """Return whether there is time enough between two pieces; where a settled pass lies between them, there is."""
        if before.slot != after.slot:
            return before.slot < after.slot
        if before.end > after.start:
            return False
        return before.end + self._time(before.candidate, before.end, after.candidate, after.start) <= after.start

    def start_after(self, before: Piece, piece: Piece) -> datetime | None:
        """Return the first moment of `piece` at which the dish can be on it after `before`; None if there is none."""
        at = max(before.end, piece.start)
        for guess in range(_GUESSES):
            inside = next((max(each.start, at) for each in piece.candidate.reach.intervals if each.end > at), None)
            if inside is None or inside >= piece.end:
                return None
            ready = before.end + self._time(before.candidate, before.end, piece.candidate, inside)
            if ready <= inside:
                return inside
            at = ready + guess * _MARGIN
        return None

    def end_before(self, after: Piece, piece: Piece) -> datetime | None:
        """Return the last moment of `piece` at which the dish can leave it for `after`; None if there is none."""
        at = min(after.start, piece.end)
        for guess in range(_GUESSES):
            stretches = reversed(piece.candidate.reach.intervals)
            inside = next((min(each.end, at) for each in stretches if each.start < at), None)
            if inside is None or inside <= piece.start:
                return None
            leave = after.start - self._time(piece.candidate, inside, after.candidate, after.start)
            if inside <= leave:
                return inside
            at = leave - guess * _MARGIN
        return None

    def _time(self, one: ScheduleCandidate, left: datetime, other: ScheduleCandidate, reached: datetime) -> timedelta:
        if not callable(self._slew_s):
            return timedelta(seconds=self._slew_s)
        return timedelta(seconds=self._slew_s(self._where(one, left), self._where(other, reached)))

    def _where(self, candidate: ScheduleCandidate, at: datetime) -> Direction:
        key = (id(candidate), at)
        if key not in self._seen:
            self._seen[key] = candidate.where(at)
        return self._seen[key]


def pieces_in(piece: Piece, settled: Sequence[Piece], turning: Turning) -> Iterator[Piece]:
    """Yield what settled passes, in order of time, leave of one, in order of time."""
    for slot in range(len(settled) + 1):
        before = settled[slot - 1] if slot else None
        after = settled[slot] if slot < len(settled) else None
        if (before is not None and before.end >= piece.end) or (after is not None and after.start <= piece.start):
            continue
        start = piece.start if before is None else turning.start_after(before, piece)
        end = piece.end if after is None else turning.end_before(after, piece)
        if start is None or end is None or start >= end:
            continue
        whole_piece = start == piece.start and end == piece.end
        part = piece if whole_piece else piece.part(start, end)
        if part is not None:
            yield replace(part, slot=slot)
