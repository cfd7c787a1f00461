"""The geostationary arc as a map shows it: beams of free strength where the known slots stand, over a clear sky.

    level = cold + warm / sin(el) + sum of strength_k exp(-4 ln 2 ((x - x_k)^2 / wx^2 + (y - y_k)^2 / wy^2))

All in the dish's own angles. Where slot k is seen (x_k, y_k) follows from how the dish stands: its turn, and the lean
of its axis to north and west (`birdcage.antenna.pointing_model`). The strengths solve a linear problem, and none is
negative (C. L. Lawson and R. J. Hanson, "Solving Least Squares Problems", chapter 23); turn, lean and one factor of
both widths are led to the least by damped Gauss-Newton steps, strengths held within a step (variable projection).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.antenna.alignment import Alignment

Floats = NDArray[np.float64]

FREE = 2
"""The first unknowns, cold and warm, may be negative."""
TURN, NORTH, WEST, WIDTH = range(4)
NUDGE = np.array([0.05, 0.05, 0.05, 0.01])
MOST_STEP = np.array([3.0, 2.0, 2.0, 0.2])
MOST_LEAN_DEG = 6.0
LEAN_SIGMA_DEG = 3.0
"""A base is put up by eye: what leans more is believed less."""
WIDTH_SIGMA = 0.2
MOST_WIDTH = 0.7
"""Of the logarithm of the factor: half to twice of what is known."""
BELIEF = 0.001
"""What that belief weighs: a lean of one sigma costs this part of all that there is to explain."""
MOST_DAMPING = 1e4


@dataclass(frozen=True, slots=True)
class ArcSeen:
    """Where, how strong, and what is left. Angles in the dish's own frame, in degrees."""

    stands: Floats
    """Turn, lean to the north and to the west, logarithm of the factor of both widths."""
    cost: float
    """Sum of squares that is left, with what the belief costs."""
    strengths: Floats
    """Cold, warm, and each slot."""
    rest: Floats
    design: Floats


class ArcModel:
    """Of the levels in some directions."""

    def __init__(
        self, dish: Floats, levels: Floats, slots: Sequence[tuple[float, float]], widths: tuple[float, float],
        held: Alignment,
    ) -> None:  # fmt: skip
        """`dish`: azimuth and elevation in rows, `slots` true directions; of `held` count el offset and collimation."""
        self.az, self.el = dish[:, 0], dish[:, 1]
        self.levels, self.slots, self.widths, self._held = levels, slots, widths, held
        air = 1.0 / np.sin(np.radians(np.maximum(self.el, 3.0)))
        self._sky = np.column_stack([np.ones_like(air), air])
        self.spread = float(np.var(levels)) * len(levels)
        """What there is to explain: the sum of squares about the mean."""

    def alignment(self, stands: Floats) -> Alignment:
        """Return how the dish then stands."""
        turn, north, west = (float(each) for each in stands[:WIDTH])
        return Alignment(turn, self._held.el_offset_deg, self._held.ca_deg, north, west)

    def places(self, stands: Floats) -> Floats:
        """Return where each slot is seen, in the dish's own angles."""
        alignment = self.alignment(stands)
        return np.array([alignment.to_dish(*slot) for slot in self.slots])

    def offsets(self, place: Floats) -> tuple[Floats, Floats]:
        """Return how far right of a place each direction lies, and above it, in degrees on the sky."""
        level = np.cos(np.radians((self.el + place[1]) / 2.0))
        return ((self.az - place[0] + 180.0) % 360.0 - 180.0) * level, self.el - place[1]

    def size(self, stands: Floats) -> tuple[float, float]:
        """Return both widths."""
        factor = math.exp(float(stands[WIDTH]))
        return self.widths[0] * factor, self.widths[1] * factor

    def design(self, stands: Floats) -> Floats:
        """Return what each unknown strength adds to each level."""
        wide, tall = self.size(stands)
        columns = []
        for place in self.places(stands):
            right, up = self.offsets(place)
            columns.append(np.exp(-4.0 * math.log(2.0) * ((right / wide) ** 2 + (up / tall) ** 2)))
        return np.column_stack([self._sky, *columns])

    def seen(self, stands: Floats, believed_width: float = 0.0) -> ArcSeen:
        """Return what is heard where, with the dish standing so."""
        design = self.design(stands)
        strengths = not_negative(design, self.levels)
        rest = self.levels - design @ strengths
        lean = float(stands[NORTH] ** 2 + stands[WEST] ** 2) / LEAN_SIGMA_DEG**2
        width = ((float(stands[WIDTH]) - believed_width) / WIDTH_SIGMA) ** 2
        return ArcSeen(stands, float(rest @ rest) + BELIEF * self.spread * (lean + width), strengths, rest, design)

    def slopes(self, seen: ArcSeen, fixed_width: bool = False) -> Floats:
        """Return what a degree of turn and lean, and the logarithm of the width, add to each level."""
        rows = []
        for index, nudge in enumerate(NUDGE[: WIDTH if fixed_width else None]):
            moved = seen.stands.copy()
            moved[index] += nudge
            rows.append((self.design(moved) - seen.design) @ seen.strengths / nudge)
        return np.column_stack(rows)

    def descend(self, stands: Floats, steps: int, *, fixed_width: bool = False) -> ArcSeen:
        """Return the nearest least."""
        believed = float(stands[WIDTH]) if fixed_width else 0.0
        best, damping = self.seen(stands, believed), 1e-2
        for _ in range(steps):
            rows = self.slopes(best, fixed_width)
            normal, right = rows.T @ rows, rows.T @ best.rest
            free = len(right)
            weight = BELIEF * self.spread
            lean = weight / LEAN_SIGMA_DEG**2
            pull = np.array([0.0, lean, lean, weight / WIDTH_SIGMA**2])
            normal += np.diag(pull[:free])
            right -= pull[:free] * best.stands[:free]
            while True:
                damped = normal + np.diag(damping * np.diag(normal) + 1e-12)
                step = np.clip(np.linalg.solve(damped, right), -MOST_STEP[:free], MOST_STEP[:free])
                tried = best.stands.copy()
                tried[:free] += step
                tried[NORTH:WIDTH] = np.clip(tried[NORTH:WIDTH], -MOST_LEAN_DEG, MOST_LEAN_DEG)
                if not fixed_width:
                    tried[WIDTH] = min(max(float(tried[WIDTH]), -MOST_WIDTH), MOST_WIDTH)
                after = self.seen(tried, believed)
                if after.cost < best.cost:
                    break
                damping *= 5.0
                if damping > MOST_DAMPING:
                    return best
            done = best.cost - after.cost < 1e-5 * best.cost
            best, damping = after, damping / 5.0
            if done:
                break
        return best


def not_negative(design: Floats, levels: Floats) -> Floats:
    """Return the strengths that leave the least squares, none of them but the first `FREE` negative."""
    normal, right = design.T @ design, design.T @ levels
    normal += np.diag(1e-9 * np.diag(normal) + 1e-12)
    active = np.ones(len(right), dtype=bool)
    strengths = _solved(normal, right, active)
    for _ in range(3 * len(right)):
        below = active & (strengths < 0.0)
        below[:FREE] = False
        if below.any():
            active &= ~below
            strengths = _solved(normal, right, active)
            continue
        gain = np.where(active, -np.inf, (right - normal @ strengths) / np.sqrt(np.diag(normal)))
        best = int(gain.argmax())
        if gain[best] <= 1e-6 * float(np.abs(right).max()):
            break
        tried = active.copy()
        tried[best] = True
        after = _solved(normal, right, tried)
        if after[best] <= 0.0:
            break
        active, strengths = tried, after
    return np.where(np.arange(len(strengths)) < FREE, strengths, np.maximum(strengths, 0.0))


def _solved(normal: Floats, right: Floats, active: NDArray[np.bool_]) -> Floats:
    strengths = np.zeros(len(right))
    index = np.flatnonzero(active)
    strengths[index] = np.linalg.solve(normal[np.ix_(index, index)], right[index])
    return strengths
