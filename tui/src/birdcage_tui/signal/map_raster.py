"""The picture of a map before it has colours: a level for each half of a cell, and whether it was heard there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.skymap.plan import STRIDES, MapOrder, MapPlan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

LEVELS = 64
"""So many levels a measured direction may have. The same number above it: levels that are its neighbour's."""
UNKNOWN = -1
"""Nothing was heard here, nor near it."""


def filled(plan: MapPlan, grid: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the values with a neighbour's where a pass from coarse to fine has not come yet; NaN where none is near.

    A pass goes through every `stride`-th column and row. Each direction takes the value of the nearest of those, of
    the finest pass that has heard it.
    """
    import numpy as np

    if plan.order is not MapOrder.COARSE:
        return grid
    shown = np.full_like(grid, np.nan)
    for stride in STRIDES:
        coarse = grid[::stride, ::stride]
        rows = np.minimum((np.arange(plan.rows) + stride // 2) // stride, coarse.shape[0] - 1)
        columns = np.minimum((np.arange(plan.columns) + stride // 2) // stride, coarse.shape[1] - 1)
        near = coarse[rows[:, None], columns[None, :]]
        shown = np.where(np.isnan(near), shown, near)
    return shown


def raster(
    plan: MapPlan, grid: NDArray[np.float64], size: tuple[int, int], span: tuple[float, float]
) -> NDArray[np.int16]:  # fmt: skip
    """Return levels by row from the top and column, for so many columns and rows of pixels.

    `span`: the values of the lowest and the highest level. Where a pixel holds several directions, the loudest counts.
    """
    import numpy as np

    heard = _scaled(_scaled(grid, size[0], 1), size[1], 0)
    near = _scaled(_scaled(filled(plan, grid), size[0], 1), size[1], 0)
    wide = max(span[1] - span[0], 1e-12)

    def level(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.clip((values - span[0]) / wide * LEVELS, 0, LEVELS - 1)

    with np.errstate(invalid="ignore"):
        shown = np.where(np.isnan(heard), level(near) // 1 + LEVELS, level(heard) // 1)
    return np.where(np.isnan(shown), UNKNOWN, shown).astype(np.int16)[::-1]


def _scaled(values: NDArray[np.float64], length: int, axis: int) -> NDArray[np.float64]:
    """Return as many along an axis: repeated, or the loudest of those that fall together; NaN counts as none."""
    import numpy as np

    count = values.shape[axis]
    if count <= length:
        near: NDArray[np.float64] = np.take(values, (2 * np.arange(length) + 1) * count // (2 * length), axis=axis)
        return near
    loudest: NDArray[np.float64] = np.fmax.reduceat(values, np.arange(length) * count // length, axis=axis)
    return loudest
