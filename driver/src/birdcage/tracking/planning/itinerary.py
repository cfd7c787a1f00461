"""The order of events: what is followed when and at which turn of the cable, and by which ways the dish gets there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from birdcage.sky.reach_model import LossReason
from birdcage.tracking.curve import Curve
from birdcage.tracking.planning.cable_turns import CableRun, runs
from birdcage.tracking.planning.routes import Route, route
from birdcage.tracking.planning.target_track import TargetTrack

_SHORTEST_S = 0.5
"""What is shorter is not worth a leg."""
_PASSES = 6
_HAIR_S = 1e-3
_START_S = 0.5
"""For the first command to go out, where the target is up already."""


@dataclass(frozen=True, slots=True)
class TrackSegment:
    """A time during which the target is followed, and how the dish comes to its beginning."""

    start_s: float
    end_s: float
    turn: int
    route: Route | None = None
    """From where the stretch before ended; None if the dish goes on along the path, and for the first."""
    rewinds: bool = False
    """Whether that way turns the cable back."""


@dataclass(frozen=True, slots=True)
class Itinerary:
    """What is to be done, as far as that is a matter of times and turns."""

    stretches: tuple[TrackSegment, ...]
    cuts: tuple[tuple[float, float, LossReason], ...]
    """What the limits would allow, but is lost to the cable being turned back, or to the way round a no-go sector.
    """


def itinerary(track: TargetTrack, now_s: float, later: Sequence[Curve] = ()) -> Itinerary:
    """Return the stretches from now on."""
    spans, cable_losses = track.spans()
    spans = [(max(start, now_s), end) for start, end in spans if end - max(start, now_s) > _SHORTEST_S]
    standing = track.mount.standing
    found: list[TrackSegment] = []
    pieces = _pieces(track, spans, runs(track, spans, standing, later))
    cuts = _without(spans, pieces)
    for piece in pieces:
        rewinds = False
        if found:
            before = found[-1]
            rewinds = piece.turn != before.turn or any(
                before.end_s - 1e-3 <= start < piece.start_s for start, _ in cable_losses
            )
            if not rewinds and _free(track, before, piece):
                found.append(piece)
                continue
            begin, ready_s = track.at(before.end_s, before.turn), before.end_s
        elif standing is not None:
            begin, ready_s = (standing.az_deg, standing.el_deg), now_s + _START_S
        else:
            found.append(piece)
            continue
        # What comes after a stretch that is followed is announced, and must be over in time.
        arrived = _arrive(
            track, begin, ready_s, piece, either_way=rewinds and not track.bounds.turn_known, surely=bool(found)
        )
        if arrived is None:
            cuts.append((piece.start_s, piece.end_s, LossReason.NO_GO))
            continue
        taken, start_s = arrived
        if found and start_s > piece.start_s:
            cuts.append((piece.start_s, start_s, LossReason.CABLE if rewinds else LossReason.NO_GO))
        if piece.end_s - start_s <= _SHORTEST_S:
            continue
        found.append(TrackSegment(start_s, piece.end_s, piece.turn, taken if found else None, rewinds))
    return Itinerary(tuple(found), tuple(sorted(cuts)))


def _pieces(track: TargetTrack, spans: Sequence[tuple[float, float]], taken: Sequence[CableRun]) -> list[TrackSegment]:
    """Return the spans, cut where the turn changes and where the cable does not let the dish follow.

    After a rewind a span may begin as soon as the run before has ended: how long the rewind takes is seen to later.
    """
    found = []
    free_s = float("-inf")
    for run in taken:
        for start, end in spans:
            found += _fitting(track, max(start, min(free_s, run.start_s)), min(end, run.end_s), run.turn)
        free_s = run.end_s
    return found


def _fitting(track: TargetTrack, start: float, end: float, turn: int) -> list[TrackSegment]:
    if end - start <= _SHORTEST_S:
        return []
    cable = track.bounds.cable
    if cable is None or not track.bounds.turn_known:
        return [TrackSegment(start, end, turn)]
    t = track.sky.t_s
    times = np.concatenate(([start], t[(t > start) & (t < end)], [end]))
    az = np.interp(times, t, track.az_deg) + 360.0 * turn
    fits = np.concatenate(([False], (az >= cable[0]) & (az <= cable[1]), [False]))
    edges = np.flatnonzero(np.diff(fits.astype(np.int8)))
    return [
        TrackSegment(float(times[first]), float(times[after - 1]), turn)
        for first, after in zip(edges[::2], edges[1::2], strict=True)
        if times[after - 1] - times[first] > _SHORTEST_S
    ]


def _without(
    spans: Sequence[tuple[float, float]], pieces: Sequence[TrackSegment]
) -> list[tuple[float, float, LossReason]]:
    """Return what of the spans is in no piece: the cable does not let the dish follow there."""
    left = list(spans)
    for piece in pieces:
        cut: list[tuple[float, float]] = []
        for start, end in left:
            cut += [(start, min(end, piece.start_s)), (max(start, piece.end_s), end)]
        left = [(start, end) for start, end in cut if end > start]
    return [(start, end, LossReason.CABLE) for start, end in left]


def _free(track: TargetTrack, before: TrackSegment, after: TrackSegment) -> bool:
    """Return whether the dish may go on along the path between two stretches, though nothing is heard there."""
    t, cable = track.sky.t_s, track.bounds.cable
    part = (t >= before.end_s) & (t <= after.start_s)
    az = track.az_deg[part] + 360.0 * after.turn
    if cable is not None and track.bounds.turn_known and ((az < cable[0]) | (az > cable[1])).any():
        return False
    return not track.bounds.blocked(az, track.pointed_el_deg[part]).any()


def _arrive(
    track: TargetTrack, begin: tuple[float, float], ready_s: float, piece: TrackSegment, *, either_way: bool,
    surely: bool,
) -> tuple[Route, float] | None:  # fmt: skip
    """Return the way to a piece and when it is followed from: as soon as the dish can be where the target is then.

    `surely`: also where the way takes as long as it may at the most.
    """

    def there(at_s: float) -> tuple[Route, float] | None:
        """Return the way to where the target is at a time, and how much too late the dish would come."""
        taken = route(track.bounds, track.mount.model, begin, track.at(at_s, piece.turn), either_way=either_way)
        return None if taken is None else (taken, ready_s + (taken.worst_s if surely else taken.seconds) - at_s)

    late_s, start_s = piece.start_s, piece.start_s
    for _ in range(_PASSES):
        found = there(start_s)
        if found is None:
            return None
        if found[1] <= _HAIR_S:
            break
        late_s, start_s = start_s, min(start_s + found[1], piece.end_s)
    # A way that is the shorter the later it ends has been given too much time: the least lies between.
    while start_s - late_s > _HAIR_S:
        middle_s = (late_s + start_s) / 2.0
        found = there(middle_s)
        if found is None or found[1] > 0.0:
            late_s = middle_s
        else:
            start_s = middle_s
    # What is left of it is a hair: the route must end where the target is then, and may take that hair less.
    found = there(start_s)
    return None if found is None else (found[0], start_s)
