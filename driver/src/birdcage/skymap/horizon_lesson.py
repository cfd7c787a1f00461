"""The line of trees and roofs by a map: they radiate as the ground does, and the sky above them does not.

A clear direction has the level C + G (1 - exp(-t X)): C the cold of the receiver and the sky, G how much warmer the
ground is, X = 1 / sin(el) the thickness of the air, t its opacity (Recommendation ITU-R P.372, equation for a medium of
one temperature). A beam with the share F of its power on trees has C + G (F + (1 - F) (1 - exp(-t X))). The line is
where F passes one half, on the way up from the lowest direction of a column. See
`docs/decisions/0075-what-a-map-teaches.md`.

A level that is high near a satellite, or far above G, says nothing of trees; nor does what was not heard.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from birdcage.base.geometry import wrap_360
from birdcage.skymap.map_levels import LessonRefused, azel_only, beam_of_map, noise_of_map, values_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from birdcage.base.beam import Beam
    from birdcage.signal.level_scale import LevelScale
    from birdcage.skymap.plan import MapPlan
    from birdcage.skymap.sky_map import SkyMap

    Floats = NDArray[np.float64]

COLD_SHARE = 0.2
"""At least so much of a map is taken to be clear sky."""
RISE_SHARES = (70.0, 85.0, 95.0)
"""Percentiles of the lowest directions that may be as warm as trees, in the order in which they are tried."""
SEEN_SIGMAS = 8.0
LEAST_RISE = 0.25
"""The ground is 280 K warmer than the sky: no receiver in use is so noisy that this were less than 1 dB."""
MOST_OPACITY = 0.04
"""Of the air overhead at 12 GHz in rain; clear air has 0.01 to 0.02 (Recommendation ITU-R P.676)."""
BARE = 0.5
SOURCE = 1.5
"""What is so many times warmer than the ground is a source."""
BESIDE_BEAMS = 1.2
"""A source raises the level so many widths of the beam around it."""
CLEARLY = 1.5
"""A line of trees leaves so many times less unexplained than thick air, or the column says nothing."""
MOST_GAP_STEPS = 3.0
COUNTS_BEAMS = 0.12
"""Half of a level in counts is not half of the power: that moves the line by so much of a beam."""
THIN_DEG = 0.5
"""Points that lie so near to a line between their neighbours are left out."""


@dataclass(frozen=True, slots=True)
class HorizonEdge:
    """What one azimuth tells. True degrees."""

    az_deg: float
    el_deg: float
    """Up to where trees stand; of a clear azimuth, the lowest elevation that was heard."""
    sigma_deg: float
    """Standard deviation of that elevation."""
    is_clear: bool
    """Whether no trees stand as low as it was heard."""


@dataclass(frozen=True, slots=True)
class HorizonProposal:
    """A line of trees as a map tells it."""

    points: tuple[HorizonEdge, ...]
    """What is proposed, by rising azimuth: as few points as give the line."""
    edges: tuple[HorizonEdge, ...]
    """Every azimuth that says something."""
    rise: float
    """How much warmer the trees are than the sky, in the map's unit; a ratio of powers where decibels are known."""
    in_powers: bool
    unknown: int
    """Azimuths that say nothing."""


def teach_horizon(
    sky_map: SkyMap, sources: Sequence[tuple[float, float]] = (), beam: Beam | None = None,
    scale: LevelScale | None = None,
) -> HorizonProposal:  # fmt: skip
    """Return the line of trees that a map shows.

    `sources`: true directions of satellites and of the Sun, beside which a high level is no tree. `beam` is used where
    the map does not tell its own, `scale` makes decibels of counts. LessonRefused where nothing stands out as trees do.
    """
    import numpy as np

    azel_only(sky_map)
    plan = sky_map.plan
    if not sky_map.samples:
        raise LessonRefused("Nothing was heard on this map.")
    widths = beam_of_map(sky_map, beam)
    flat = np.full(plan.cells, np.nan)
    flat[np.array([sample.cell for sample in sky_map.samples])] = values_of(sky_map.samples, sky_map.decibels, scale)
    grid = flat.reshape(plan.rows, plan.columns)
    in_powers = sky_map.decibels or scale is not None
    noise = noise_of_map(sky_map, grid)
    els = plan.y_low_deg + plan.row_step_deg * np.arange(plan.rows, dtype=np.float64)
    azs = plan.x_low_deg + plan.step_deg * np.arange(plan.columns, dtype=np.float64)
    near = _near(azs, els, sources, widths)
    cold, rises = _levels(grid, near, noise, in_powers)
    grain = widths[1] * COUNTS_BEAMS * (not in_powers)
    # Where few columns have trees, what is a little warm at the lower edge is air: then the warmer ones are tried.
    for rise in rises:
        edges, airy = _edges((azs, els), (grid - cold) / rise, near, widths, noise / rise, grain, plan)
        if sum(not edge.is_clear for edge in edges) > airy:
            break
    else:
        raise LessonRefused("No trees stand out: thick air explains what is warm at the lower edge of the map.")
    ratio = rise / cold if in_powers else rise
    return HorizonProposal(_thinned(edges), edges, float(ratio), in_powers, plan.columns - _meets(azs) - len(edges))


def _edges(
    axes: tuple[Floats, Floats], part: Floats, near: NDArray[np.bool_], widths: tuple[float, float], noise: float,
    grain_deg: float, plan: MapPlan,
) -> tuple[tuple[HorizonEdge, ...], int]:  # fmt: skip
    """Return what each azimuth tells, and at how many of them it is air that is warm.

    `part`: levels over the cold sky, in parts of how much warmer the ground is; `noise` likewise.
    """
    import numpy as np

    azs, els = axes
    air = 1.0 / np.sin(np.radians(np.maximum(els, 3.0)))
    clear = 1.0 - np.exp(-_opacity(part, near, air) * air)
    warm = (part - clear[:, None]) / (1.0 - clear[:, None])
    hidden = near | _beside_sources(warm, widths, (plan.step_deg, plan.row_step_deg), els)
    edges, airy = [], 0
    for column, az_deg in enumerate(azs):
        edge = _edge(float(az_deg), els, warm[:, column], hidden[:, column], noise, grain_deg)
        if edge is None:
            continue
        if not edge.is_clear and _is_air(edge.el_deg, els, air, warm[:, column], hidden[:, column], widths[1]):
            airy += 1
        else:
            edges.append(edge)
    if _meets(azs) and len(edges) > 1 and edges[0].az_deg == edges[-1].az_deg:
        # Heard twice, at both ends: trees count before a clear direction, then the surer one.
        surer = max(edges[0], edges[-1], key=lambda edge: (not edge.is_clear, -edge.sigma_deg))
        edges = [surer, *edges[1:-1]]
    return tuple(edges), airy


def _meets(azs: Floats) -> bool:
    """Return whether the last column has the azimuth of the first one, a whole turn on."""
    return abs(float(azs[-1] - azs[0]) - 360.0) < 1e-6


def _levels(grid: Floats, near: NDArray[np.bool_], noise: float, in_powers: bool) -> tuple[float, list[float]]:
    """Return the level of the cold sky, and how much warmer trees may be, by the lowest directions, least first."""
    import numpy as np

    heard = np.sort(grid[np.isfinite(grid)])
    cold = float(np.median(heard[: max(1, int(COLD_SHARE * len(heard)))]))
    lowest = np.array([value for column in range(grid.shape[1]) if (value := _lowest(grid, near, column)) is not None])
    least = max(SEEN_SIGMAS * noise, LEAST_RISE * cold if in_powers else 0.0, 1e-9)
    warm = lowest[lowest - cold > least]
    if not len(warm):
        raise LessonRefused(
            "No trees stand out: nothing at the lower edge of the map is as warm as the ground. "
            "Map down to the lowest elevation that the dish reaches."
        )
    # Those that look at the edge alone are less warm; a source that is not known is warmer.
    rises = []
    for share in RISE_SHARES:
        rise = float(np.percentile(warm, share)) - cold
        full = warm[np.abs(warm - cold - rise) < 0.2 * rise]
        rises.append(float(np.median(full)) - cold if len(full) else rise)
    return cold, rises


def _lowest(grid: Floats, near: NDArray[np.bool_], column: int) -> float | None:
    """Return the lowest level of a column that is not near a source."""
    import numpy as np

    rows = np.flatnonzero(np.isfinite(grid[:, column]))
    return float(grid[rows[0], column]) if len(rows) and not near[rows[0], column] else None


def _opacity(part: Floats, near: NDArray[np.bool_], air: Floats) -> float:
    """Return the opacity of the air overhead: from how clear directions grow warmer toward the horizon."""
    import numpy as np

    # Whatever is warmer than the thickest air would be is no clear direction.
    most = 1.0 - np.exp(-MOST_OPACITY * air)
    clear = np.isfinite(part) & ~near & (part < most[:, None] + 0.05)
    x, y = np.broadcast_to(air[:, None], part.shape)[clear], part[clear]
    if len(x) < 3 or float(np.ptp(x)) < 0.3:
        return 0.0
    slope = float(np.polyfit(x, y, 1)[0])
    return min(max(slope, 0.0), MOST_OPACITY)


def _near(
    azs: Floats, els: Floats, sources: Sequence[tuple[float, float]], widths: tuple[float, float]
) -> NDArray[np.bool_]:
    """Return which directions lie beside a source."""
    import numpy as np

    near = np.zeros((len(els), len(azs)), dtype=bool)
    for az_deg, el_deg in sources:
        turn = (azs[None, :] - az_deg + 180.0) % 360.0 - 180.0
        right, up = turn * np.cos(np.radians(els))[:, None], (els - el_deg)[:, None]
        near |= np.hypot(right / widths[0], up / widths[1]) < BESIDE_BEAMS
    return near


def _beside_sources(
    warm: Floats, widths: tuple[float, float], steps_deg: tuple[float, float], els: Floats
) -> NDArray[np.bool_]:
    """Return what lies beside a direction that is too warm for trees."""
    import numpy as np

    beside = np.zeros(warm.shape, dtype=bool)
    up = math.ceil(BESIDE_BEAMS * widths[1] / steps_deg[1])
    for row, column in np.argwhere(np.nan_to_num(warm) > SOURCE):
        along = BESIDE_BEAMS * widths[0] / steps_deg[0] / max(0.1, math.cos(math.radians(float(els[row]))))
        right = math.ceil(along)
        beside[max(0, row - up) : row + up + 1, max(0, column - right) : column + right + 1] = True
    return beside


def _edge(
    az_deg: float, els: Floats, warm: Floats, near: NDArray[np.bool_], noise: float, grain_deg: float
) -> HorizonEdge | None:
    """Return where a column passes from trees to sky; None where it does not tell."""
    import numpy as np

    # A high level near a source is no tree for sure; a low one is sky, wherever it is.
    told = np.isfinite(warm) & ~(near & (warm >= BARE))
    rows = np.flatnonzero(told)
    if not len(rows):
        return None
    step = float(els[1] - els[0]) if len(els) > 1 else 1.0
    low = rows[0]
    if warm[low] < BARE:
        if low != np.flatnonzero(np.isfinite(warm))[0]:
            return None  # what lies below it may be a tree, or a satellite
        return HorizonEdge(wrap_360(round(az_deg % 360.0, 6)), float(els[low]), step / math.sqrt(12.0), is_clear=True)
    for below, above in pairwise(rows):
        if warm[above] >= BARE:
            continue
        gap = float(els[above] - els[below])
        if gap > MOST_GAP_STEPS * step:
            return None
        fall = float(warm[below] - warm[above])
        at = float(els[below]) + gap * float(warm[below] - BARE) / fall
        known = above - below == 1
        sigma = math.hypot(noise * gap / fall, (0.1 if known else 0.3) * gap, grain_deg)
        return HorizonEdge(wrap_360(round(az_deg % 360.0, 6)), at, sigma, is_clear=False)
    return None


def _is_air(el_deg: float, els: Floats, air: Floats, warm: Floats, near: NDArray[np.bool_], width_deg: float) -> bool:
    """Return whether thick air alone explains the levels of a column nearly as well as a line of trees."""
    import numpy as np

    told = np.isfinite(warm) & ~near
    x, y = air[told], warm[told]
    if len(x) < 3:
        return True
    by_air = y - np.polyval(np.polyfit(x, y, 1), x)
    spread = width_deg / math.sqrt(8.0 * math.log(2.0))
    by_trees = y - np.array([0.5 + 0.5 * math.erf((el_deg - float(el)) / spread / math.sqrt(2.0)) for el in els[told]])
    return float(by_air @ by_air) < CLEARLY * float(by_trees @ by_trees)


def _thinned(edges: tuple[HorizonEdge, ...]) -> tuple[HorizonEdge, ...]:
    """Return as few as give the line (Douglas and Peucker): an azimuth that is clear keeps its neighbours."""
    if len(edges) <= 2:
        return edges
    first, last = edges[0], edges[-1]
    along = max((last.az_deg - first.az_deg) % 360.0, 1e-9)

    def off(edge: HorizonEdge) -> float:
        share = ((edge.az_deg - first.az_deg) % 360.0) / along
        return abs(edge.el_deg - first.el_deg - share * (last.el_deg - first.el_deg)) - edge.sigma_deg / 2.0

    far = max(range(1, len(edges) - 1), key=lambda index: off(edges[index]))
    if off(edges[far]) <= THIN_DEG and len({edge.is_clear for edge in edges}) == 1:
        return first, last
    if off(edges[far]) <= THIN_DEG:  # where trees begin or end
        far = next(index for index in range(1, len(edges)) if edges[index].is_clear is not edges[index - 1].is_clear)
        far = min(max(far, 1), len(edges) - 2)
    left, right = _thinned(edges[: far + 1]), _thinned(edges[far:])
    return (*left[:-1], *right)
