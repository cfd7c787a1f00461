"""The levels of a map as powers, and how much they scatter: what each of its lessons begins with."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.skymap.plan import MapFrame

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from birdcage.base.beam import Beam
    from birdcage.signal.level_scale import LevelScale
    from birdcage.skymap.sky_map import MapSample, SkyMap

GAUSS = 1.4826
"""Standard deviation by median deviation of a normal distribution."""


class LessonRefused(BirdcageError):
    """A map that does not teach what was asked; the message says why, and what map does."""

    reason = Reason.UNSUPPORTED


def azel_only(sky_map: SkyMap) -> None:
    """Raise LessonRefused for a map around a moving target."""
    if sky_map.plan.frame is not MapFrame.AZEL:
        raise LessonRefused(f"This map is {sky_map.title}. This needs a map in azimuth and elevation.")


def values_of(samples: tuple[MapSample, ...], decibels: bool, scale: LevelScale | None) -> NDArray[np.float64]:
    """Return levels that rise with power: powers where decibels are known, else as the source tells them.

    Decibels come from the source, or from two known levels of it. Powers are parts of the strongest level.
    """
    import numpy as np

    values = np.array([sample.value for sample in samples], dtype=np.float64)
    if not decibels and scale is None:
        return values
    if scale is not None and not decibels:
        values = np.array([scale.db(float(value)) for value in values])
    return np.asarray(10.0 ** ((values - values.max()) / 10.0))


def noise_of_map(sky_map: SkyMap, grid: NDArray[np.float64]) -> float:
    """Return the standard deviation of a level on `grid`, by how neighbours in a row differ from their mean.

    Each difference 2 b - a - c of three in a row has six times the variance of one; the median leaves out edges.
    """
    import numpy as np

    rows = grid if grid.shape[1] >= grid.shape[0] else grid.T
    bends = 2.0 * rows[:, 1:-1] - rows[:, :-2] - rows[:, 2:]
    bends = np.abs(bends[np.isfinite(bends)])
    if not len(bends):
        raise LessonRefused(f"The map has {len(sky_map.samples)} directions. It takes three side by side.")
    return float(GAUSS * np.median(bends)) / math.sqrt(6.0)


def beam_of_map(sky_map: SkyMap, beam: Beam | None) -> tuple[float, float]:
    """Return the widths of the beam, az and el, as the map tells them, else of `beam`. LessonRefused without any."""
    told = sky_map.about.get("beam_az_deg"), sky_map.about.get("beam_el_deg")
    if isinstance(told[0], int | float) and isinstance(told[1], int | float):
        return float(told[0]), float(told[1])
    if beam is None:
        raise LessonRefused("The width of the beam is not known. Name the dish and its feed in the settings.")
    return beam.az_deg, beam.el_deg
