"""Reach: when during a pass *this* dish can point at the satellite, and why not at the other times.

Floor, ceiling, horizon mask and no-go sectors come first, in this order; what they allow is divided among turns of the
cable; of the rest, a dish that turns too slowly loses the keyhole. A few hundred samples of a pass take about a
millisecond; edges are placed to a tenth of a second or better between them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_cable import Bools, SampleRun, runs_of
from birdcage.sky.reach_checks import CABLE, Floats, LimitCheck, SampledTrack, SkyPath, cable_check, checks_of, crossing
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.reach_model import LossCause, LossReason, Lost, PassReach, Stretch
from birdcage.sky.reach_speed import azimuth_room, too_fast

_FINE_S = 0.05
"""The grid on which the keyhole is looked for."""
_SHORTEST_S = 1e-3
"""What is shorter is no stretch but an edge."""


def reach(track: SampledTrack, limits: ReachLimits) -> PassReach:
    """Return when the dish can point along a track of one pass, from its first sample to its last.

    `sample_times` says when to sample. ValueError for a track of fewer than two samples.
    """
    if len(track.t_s) < 2:
        raise ValueError("a track of fewer than two samples")
    return _Work(SkyPath(track), limits).reach()


def sample_times(passing: Pass) -> Floats:
    """Return at which times (POSIX seconds) to sample a pass for `reach`: 100 to 400 of them.

    Every 2 to 120 s, TCA among them; closer about a high culmination, where the azimuth sweeps.
    """
    begin, top, end = passing.aos.timestamp(), passing.tca.timestamp(), passing.los.timestamp()
    count = int(np.clip((end - begin) / 2.0, 8, 100)) if end - begin < 12_000.0 else int((end - begin) / 120.0)
    times = [np.linspace(begin, end, count + 1), np.array([top])]
    if passing.max_elevation_deg > 70.0:
        about = top + np.linspace(-60.0, 60.0, 241)
        times.append(about[(about > begin) & (about < end)])
    return np.unique(np.concatenate(times))


@dataclass(slots=True)
class _Span:
    """A stretch or a loss while it is being made; `cause` is None for a stretch."""

    start: float
    end: float
    cause: LossCause | None
    turn: int | None = None


class _Work:
    """One track and its limits."""

    def __init__(self, path: SkyPath, limits: ReachLimits) -> None:
        self._path, self._limits = path, limits
        self._checks = checks_of(limits)
        self._failing: Bools = np.array([check.of_samples(path.az, path.el) < 0.0 for check in self._checks])
        self._allowed: Bools = np.logical_not(np.any(self._failing, axis=0))

    def reach(self) -> PassReach:
        """Find the stretches, cut the keyhole out of them, and name what lies between."""
        runs = runs_of(self._path.t, self._path.az, self._allowed, self._limits)
        stretches = [span for run in runs for span in self._stretches(run)]
        spans = self._cut(self._with_losses(stretches), self._keyholes(stretches))
        followed = [span for span in spans if span.cause is None]
        return PassReach(
            tuple(Stretch(self._utc(span.start), self._utc(span.end), span.turn) for span in followed),
            tuple(Lost(self._utc(span.start), self._utc(span.end), *span.cause) for span in spans if span.cause),
            self._highest(followed),
        )

    def _utc(self, after_s: float) -> datetime:
        return datetime.fromtimestamp(self._path.begin + after_s, UTC)

    def _stretches(self, run: SampleRun) -> Iterator[_Span]:
        """Yield the stretches of one run, with their edges where a limit is crossed."""
        path, cable = self._path, self._limits.cable
        checks, failing = self._checks, self._failing
        if cable is not None:
            check = cable_check(*cable, run.turns, self._limits.az_offset_deg)
            checks = [*checks, check]
            failing = np.vstack([failing, check.of_samples(path.az, path.el) < 0.0])
        turn = run.turns[0] if cable is not None and self._limits.turn_known else None
        inside = np.zeros(len(path), dtype=np.bool_)
        part = slice(run.first, run.last + 1)
        inside[part] = ~failing[:, part].any(axis=0)
        for first, last in _blocks(inside):
            start, end = float(path.t[first]), float(path.t[last])
            if first > 0 and (entered := self._crossings(checks, failing[:, first - 1], first - 1)):
                start = max(entered)
            if last < len(path) - 1 and (left := self._crossings(checks, failing[:, last + 1], last)):
                end = min(left)
            if end - start > _SHORTEST_S:
                yield _Span(start, end, None, turn)

    def _crossings(self, checks: list[LimitCheck], failing: Bools, index: int) -> list[float]:
        """Return when the limits that fail at one end of an interval are crossed in it."""
        return [crossing(self._path, check, index) for check, fails in zip(checks, failing, strict=True) if fails]

    def _with_losses(self, stretches: list[_Span]) -> list[_Span]:
        """Return the stretches with what is lost between them."""
        spans: list[_Span] = []
        at = float(self._path.t[0])
        for stretch in stretches:
            spans.extend(self._losses(at, stretch.start))
            spans.append(stretch)
            at = stretch.end
        spans.extend(self._losses(at, float(self._path.t[-1])))
        return spans

    def _losses(self, start: float, end: float) -> Iterator[_Span]:
        """Yield why a part is lost: the first limit that fails there, or the cable if none does."""
        if end - start <= _SHORTEST_S:
            return
        path = self._path
        # A sample at the very edge may lie a hair on the other side of it.
        within = np.flatnonzero((path.t > start + _SHORTEST_S) & (path.t < end - _SHORTEST_S))
        codes = np.where(self._allowed, len(self._checks), self._failing.argmax(axis=0))[within]
        at = start
        for change in np.flatnonzero(np.diff(codes)):
            index, before, after = int(within[change]), int(codes[change]), int(codes[change + 1])
            edge = crossing(path, self._checks[min(before, after)], index)
            yield _Span(at, edge, self._cause(before))
            at = edge
        yield _Span(at, end, self._cause(int(codes[-1])) if len(codes) else self._cause_at((start + end) / 2.0))

    def _cause(self, code: int) -> LossCause:
        return self._checks[code].cause if code < len(self._checks) else CABLE

    def _cause_at(self, t: float) -> LossCause:
        """Return why a part is lost that lies between two samples, by its middle."""
        index = int(np.clip(np.searchsorted(self._path.t, t) - 1, 0, len(self._path) - 2))
        az, el = self._path.between(index)(t)
        inside = [check.of_point(az, el) for check in self._checks]
        code = next((code for code, by in enumerate(inside) if by < 0.0), len(inside))
        if code == len(inside) and self._limits.cable is None:  # the curve and the samples differ by a hair
            code = inside.index(min(inside))
        return self._cause(code)

    def _keyholes(self, stretches: list[_Span]) -> list[tuple[float, float]]:
        """Return when the dish cannot keep up, looked at closely only if the samples say that it may not."""
        limits, path = self._limits, self._path
        if not stretches or (limits.az_rate_deg_s is None and limits.el_rate_deg_s is None):
            return []
        if not self._behind(path.t, stretches):
            return []
        grid = path.t
        edges = [(span.start, span.end) for span in stretches]
        begin, end = edges[0][0], edges[-1][1]
        if (end - begin) / _FINE_S < 40_000:
            grid = np.unique(np.concatenate([np.arange(begin, end, _FINE_S), np.ravel(edges)]))
        return self._behind(grid, stretches)

    def _behind(self, t: Floats, stretches: list[_Span]) -> list[tuple[float, float]]:
        """Return when one of the axes cannot keep up, judged at some times."""
        limits = self._limits
        az, el = np.interp(t, self._path.t, self._path.az), np.interp(t, self._path.t, self._path.el)
        room = azimuth_room(el, limits.tolerance_deg, limits.el_ceiling_deg)
        low, high = np.full(len(t), -np.inf), np.full(len(t), np.inf)
        el_low, el_high = low.copy(), high.copy()
        for span in stretches:
            part = slice(*np.searchsorted(t, [span.start, span.end + 1e-9]))
            wound = az[part] - limits.az_offset_deg + 360.0 * (span.turn or 0)
            low[part], high[part] = wound - room[part], wound + room[part]
            el_low[part], el_high[part] = el[part] - limits.tolerance_deg, el[part] + limits.tolerance_deg
        if limits.cable is not None and limits.turn_known:
            # Nearly any azimuth will do at the zenith, but none beyond the stop.
            low, high = (
                np.where(np.isfinite(low), np.maximum(low, limits.cable[0]), low),
                np.where(np.isfinite(high), np.minimum(high, limits.cable[1]), high),
            )
        spans = too_fast(t, low, high, limits.az_rate_deg_s) if limits.az_rate_deg_s else []
        if limits.el_rate_deg_s:
            spans += too_fast(t, el_low, el_high, limits.el_rate_deg_s)
        return sorted(spans)

    @staticmethod
    def _cut(spans: list[_Span], holes: list[tuple[float, float]]) -> list[_Span]:
        """Take the keyholes out of the stretches."""
        for begin, end in holes:
            cut: list[_Span] = []
            for span in spans:
                if span.cause or span.end <= begin or span.start >= end:
                    cut.append(span)
                    continue
                left, right = max(span.start, begin), min(span.end, end)
                parts = (
                    _Span(span.start, left, None, span.turn),
                    _Span(left, right, LossCause(LossReason.KEYHOLE)),
                    _Span(right, span.end, None, span.turn),
                )
                cut.extend(part for part in parts if part.end - part.start > _SHORTEST_S)
            spans = cut
        return spans

    def _highest(self, followed: list[_Span]) -> float | None:
        """Return the highest elevation in the stretches."""
        path = self._path
        tops = []
        for span in followed:
            part = path.el[(path.t >= span.start) & (path.t <= span.end)]
            ends = np.interp([span.start, span.end], path.t, path.el)
            tops.append(max(float(ends.max()), float(part.max()) if len(part) else -90.0))
        return min(max(tops), self._limits.el_ceiling_deg) if tops else None


def _blocks(inside: Bools) -> Iterator[tuple[int, int]]:
    """Yield first and last index of every run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], inside, [False])).astype(np.int8)))
    for first, after in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        yield first, after - 1
