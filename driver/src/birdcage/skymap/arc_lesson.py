"""North and tilt of a base by the arc of satellites in a map, none of which is known by name beforehand.

The search starts from every turn of the base, with beams widened so that a peak reaches its slot from far away. The
best starts are refined by least squares with the true beam (`arc_model`). A map that two ways of standing fit about
equally well is refused. See `docs/decisions/0075-what-a-map-teaches.md`.

Imports numpy; faces import it inside functions.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from birdcage.antenna.alignment import Alignment
from birdcage.base.beam import Beam
from birdcage.base.geometry import separation, shortest_turn, wrap_360
from birdcage.signal.level_scale import LevelScale
from birdcage.signal.slots_heard import SlotSeen
from birdcage.skymap.arc_model import FREE, NORTH, TURN, WEST, WIDTH, ArcModel, ArcSeen, Floats
from birdcage.skymap.horizon_lesson import teach_horizon
from birdcage.skymap.map_levels import LessonRefused, azel_only, beam_of_map, values_of
from birdcage.skymap.sky_map import MapSample, SkyMap

COARSE_DEG = 6.0
"""Beams are widened to this for the search."""
BLOCK_DEG = 3.0
"""For the search, levels are averaged over blocks of this size."""
STRONG_CELLS, OTHER_CELLS = 1500, 1500
"""So many of the strongest directions, and of all others, are fitted in the end."""
COARSE_STEPS, MIDDLE_STEPS, FINE_STEPS = 8, 8, 30
TURN_STEP_DEG = 4.0
FINALISTS, LAST = 8, 4
FAR_WORSE = 6.0
"""What leaves so many times more than the best is not led to its end."""
APART_DEG = 1.0
"""Ways to stand that differ by less are one; or by a third of the beam, where that is more."""
STANDS_OUT, OF_STRONGEST = 5.0, 0.1
"""A slot counts that is so many times stronger than what is left over, and has this part of the strongest."""
LEAST_SLOTS = 3
EQUAL = 1.6
"""Another way to stand that leaves no more than so many times as much is as good."""
BESIDE = 1.0
"""Slots within so many beams of one another are measured together."""
LEAST_SIGMA_DEG = 0.05
MOST_OFF = 5.0
"""Where most slots are off by so many of their uncertainties, other satellites are heard than those known."""
GROUP_SIGMA = 0.04
"""Parts of a beam by which a group may be off: its members' strengths are known together only."""
TREES_BEAMS = 4.0
"""So wide a line of trees is none that a satellite at the edge of the map feigns."""


@dataclass(frozen=True, slots=True)
class SlotMeasured:
    """Where the dish read itself to be when its beam was on a slot; in the dish's own angles, in degrees."""

    seen: SlotSeen
    """Where it truly stands."""
    dish_az_deg: float
    dish_el_deg: float
    sigma_deg: float
    strength: float
    """In the unit that was fitted."""
    utc: datetime | None
    """When the nearest direction was heard."""
    off_deg: float
    """How far that is from where the base, as it was fitted, would see the slot."""
    beside: tuple[str, ...]
    """Slots so near that they were measured together with it."""


@dataclass(frozen=True, slots=True)
class ArcLesson:
    """How the base stands by a map. Offset in elevation and collimation are held: the arc alone hardly tells them."""

    alignment: Alignment
    """Dish and feed together, as the pointing model has it."""
    sigmas_deg: tuple[float, float, float]
    """Standard deviations of turn, lean to the north and lean to the west."""
    slots: tuple[SlotMeasured, ...]
    explained: float
    """Which part of the squares about the mean the arc explains."""
    runner_up: float
    """How many times more the next best way to stand leaves; infinite where there is none."""


def in_use(sky_map: SkyMap) -> Alignment:
    """Return the pointing model with which a map was made; none at all where it does not tell."""
    terms = (sky_map.about.get(name) for name in ("az_offset_deg", "el_offset_deg", "ca_deg", "an_deg", "aw_deg"))
    return Alignment(*(float(each) if isinstance(each, int | float) else 0.0 for each in terms))


def teach_north(
    sky_map: SkyMap, slots: Sequence[SlotSeen], beam: Beam | None = None, scale: LevelScale | None = None,
    within_deg: float = 180.0,
) -> ArcLesson:  # fmt: skip
    """Return how the base stands, by the slots over the place of the map.

    `within_deg`: north is off by no more than this. LessonRefused, with the reason, where the map does not tell it.
    """
    azel_only(sky_map)
    if len(slots) < LEAST_SLOTS:
        raise LessonRefused(f"{len(slots)} known slots stand above the horizon of this place. It takes {LEAST_SLOTS}.")
    widths, held = beam_of_map(sky_map, beam), in_use(sky_map)
    samples = _above_trees(sky_map, widths, beam, scale)
    if len(samples) < 50:
        raise LessonRefused(f"{len(samples)} directions above the trees are too few. Map more of the southern sky.")
    dish = np.array([held.to_dish(sample.az_deg, sample.el_deg) for sample in samples])
    levels = values_of(samples, sky_map.decibels, scale)
    places = [(seen.az_deg, seen.el_deg) for seen in slots]
    coarse = ArcModel(*_blocks(dish, levels), places, widths, held)
    chosen = _chosen(levels)
    fine = ArcModel(dish[chosen], levels[chosen], places, widths, held)
    ways = _ways(coarse, fine, held, widths, within_deg)
    best = ways[0]
    measured = _measured(fine, best, slots, samples, dish)
    if len(measured) < LEAST_SLOTS:
        raise LessonRefused(
            f"{len(measured)} satellites stand out of this map, or groups of them. North and tilt take {LEAST_SLOTS}. "
            "Map more of the arc."
        )
    if float(np.median([each.off_deg / each.sigma_deg for each in measured])) > MOST_OFF:
        raise LessonRefused(
            "The satellites of this map do not stand where known slots do, however the base is turned. "
            "Map more of the arc, or set north with one satellite that you know: `birdcage acquire`."
        )
    runner_up = _runner_up(ways, widths)
    if runner_up < EQUAL:
        raise LessonRefused(
            "The base can stand in two ways that fit this map about equally well. Map more of the arc, or set north "
            "with one satellite that you know: `birdcage acquire`."
        )
    model = fine.alignment(best.stands)
    left = float(best.rest @ best.rest)
    return ArcLesson(model, _sigmas(fine, best), measured, 1.0 - left / fine.spread, runner_up)


def _above_trees(
    sky_map: SkyMap, widths: tuple[float, float], beam: Beam | None, scale: LevelScale | None
) -> tuple[MapSample, ...]:
    """Return the samples that no wide line of trees is in."""
    try:
        edges = teach_horizon(sky_map, (), beam, scale).edges
    except LessonRefused:
        return sky_map.samples
    trees = {_column(edge.az_deg): edge.el_deg for edge in edges if not edge.is_clear}
    wide = TREES_BEAMS * widths[0]
    if len(trees) * sky_map.plan.step_deg * math.cos(math.radians(float(np.median(list(trees.values()))))) < wide:
        return sky_map.samples
    return tuple(
        sample
        for sample in sky_map.samples
        if sample.cell is None or sample.el_deg > trees.get(_column(sky_map.plan.at(sample.cell)[0]), -90.0) + widths[1]
    )


def _column(az_deg: float) -> float:
    """Return what names a column of a map: its azimuth by the plan, as the dish may rest a little beside it."""
    return wrap_360(round(az_deg % 360.0, 3))


def _ways(
    coarse: ArcModel, fine: ArcModel, held: Alignment, widths: tuple[float, float], within_deg: float
) -> list[ArcSeen]:
    """Return the ways to stand that are apart from one another, the best first."""
    factor = max(0.0, math.log(COARSE_DEG / min(widths)))
    turns = np.arange(-within_deg, within_deg + 1e-9, TURN_STEP_DEG)[: math.ceil(360.0 / TURN_STEP_DEG)]
    found = [
        coarse.descend(np.array([held.az_offset_deg + turn, 0.0, 0.0, factor]), COARSE_STEPS, fixed_width=True)
        for turn in turns
    ]
    middle = []
    for each in _distinct(found, widths)[:FINALISTS]:
        begin = each.stands.copy()
        begin[WIDTH] = 0.0
        middle.append(fine.descend(begin, MIDDLE_STEPS))
    left = _distinct(middle, widths)
    last = [each for each in left[:LAST] if each.cost < FAR_WORSE * left[0].cost]
    return _distinct([*(fine.descend(each.stands, FINE_STEPS) for each in last), *left[len(last) :]], widths)


def _blocks(dish: Floats, levels: Floats) -> tuple[Floats, Floats]:
    """Return mean directions and levels of blocks, so that no narrow source is left out of a search."""
    turn = (dish[:, 0] - dish[0, 0] + 180.0) % 360.0
    keys = np.column_stack([turn // BLOCK_DEG, dish[:, 1] // BLOCK_DEG])
    _unique, block, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    block = block.ravel()
    means = [np.bincount(block, each) / count for each in (turn, dish[:, 1], levels)]
    return np.column_stack([means[0] + dish[0, 0] - 180.0, means[1]]), means[2]


def _chosen(levels: Floats) -> NDArray[np.int64]:
    """Return the directions that are fitted in the end, by index: the strongest ones, and some of the others."""
    order = np.argsort(-levels)
    others = np.random.default_rng(1).permutation(order[STRONG_CELLS:])[:OTHER_CELLS]
    return np.concatenate([order[:STRONG_CELLS], others])


def _distinct(ways: list[ArcSeen], widths: tuple[float, float]) -> list[ArcSeen]:
    kept: list[ArcSeen] = []
    for way in sorted(ways, key=lambda each: each.cost):
        if all(_apart_deg(way, other) > _limit(widths) for other in kept):
            kept.append(way)
    return kept


def _limit(widths: tuple[float, float]) -> float:
    return max(APART_DEG, min(widths) / 3.0)


def _apart_deg(one: ArcSeen, other: ArcSeen) -> float:
    turn = shortest_turn(float(one.stands[TURN]), float(other.stands[TURN]))
    lean = one.stands[NORTH:WIDTH] - other.stands[NORTH:WIDTH]
    return math.hypot(turn, float(lean[0]), float(lean[1]))


def _runner_up(ways: list[ArcSeen], widths: tuple[float, float]) -> float:
    """Return how many times more the next best way leaves over."""
    others = [each.cost for each in ways[1:] if _apart_deg(each, ways[0]) > _limit(widths)]
    return min(others, default=math.inf) / max(ways[0].cost, 1e-12)


def _rms(seen: ArcSeen) -> float:
    return math.sqrt(float(seen.rest @ seen.rest) / len(seen.rest))


def _sigmas(model: ArcModel, seen: ArcSeen) -> tuple[float, float, float]:
    """Return how sure turn and lean are: what is left over is alike within a beam, and counts once there."""
    rows = model.slopes(seen)
    wide, tall = model.size(seen.stands)
    azs = np.sort(model.az % 360.0)
    across = 360.0 - float(np.diff(azs, append=azs[0] + 360.0).max())  # all round, without the widest gap
    level = math.cos(math.radians(float(np.mean(model.el))))
    area = float(np.ptp(model.el)) * across * level / len(model.levels)
    within = max(1.0, wide * tall / max(area, 1e-9))
    covariance = np.linalg.pinv(rows.T @ rows) * _rms(seen) ** 2 * within
    turn, north, west = (math.sqrt(float(covariance[index, index])) for index in (TURN, NORTH, WEST))
    return turn, north, west


def _measured(
    model: ArcModel, seen: ArcSeen, slots: Sequence[SlotSeen], samples: Sequence[MapSample], dish: Floats
) -> tuple[SlotMeasured, ...]:
    """Return where each slot that stands out was heard: its shift off the fitted place, all shifts fitted together."""
    places, strengths, rms = model.places(seen.stands), seen.strengths[FREE:], _rms(seen)
    wide, tall = model.size(seen.stands)
    least = max(STANDS_OUT * rms, OF_STRONGEST * float(strengths.max()))
    groups = [
        group for group in _groups(places, strengths, min(wide, tall)) if max(strengths[k] for k in group) > least
    ]
    heard = [*range(FREE), *(FREE + int(k) for k in np.flatnonzero(strengths))]
    columns = [seen.design[:, heard]]
    for group in groups:
        across, upward = np.zeros(len(model.levels)), np.zeros(len(model.levels))
        for slot in group:
            right, up = model.offsets(places[slot])
            beam = seen.design[:, FREE + slot] * strengths[slot] * 8.0 * math.log(2.0)
            across, upward = across + beam * right / wide**2, upward + beam * up / tall**2
        columns.append(np.column_stack([across, upward]))
    shifts = np.linalg.lstsq(np.column_stack(columns), seen.rest, rcond=None)[0][len(heard) :].reshape(-1, 2)
    found = []
    for group, (right_deg, up_deg) in zip(groups, shifts, strict=True):
        lead = max(group, key=lambda k: float(strengths[k]))
        # What is left over leans the top of a beam by about so much.
        sigma = math.hypot(LEAST_SIGMA_DEG, max(wide, tall) / 2.0 * rms / float(strengths[lead]))
        sigma = math.hypot(sigma, GROUP_SIGMA * max(wide, tall) * (len(group) > 1))
        if math.hypot(right_deg, up_deg) > min(wide, tall) / 2.0:
            continue
        az_deg, el_deg = (float(each) for each in places[lead])
        az_deg, el_deg = wrap_360(az_deg + float(right_deg) / math.cos(math.radians(el_deg))), el_deg + float(up_deg)
        beside = tuple(slots[k].slot.label for k in group if k != lead)
        when = _when(samples, dish, az_deg, el_deg)
        off_deg = math.hypot(right_deg, up_deg)
        found.append(SlotMeasured(slots[lead], az_deg, el_deg, sigma, float(strengths[lead]), when, off_deg, beside))
    return tuple(sorted(found, key=lambda each: -each.strength))


def _groups(places: Floats, strengths: Floats, width_deg: float) -> list[list[int]]:
    """Return the slots that are heard, those together that one beam does not tell apart."""
    groups: list[list[int]] = []
    for slot in map(int, np.flatnonzero(strengths)):
        near = [g for g in groups if any(separation(*places[slot], *places[k]) < BESIDE * width_deg for k in g)]
        groups = [g for g in groups if g not in near] + [[slot, *(k for g in near for k in g)]]
    return groups


def _when(samples: Sequence[MapSample], dish: Floats, az_deg: float, el_deg: float) -> datetime | None:
    """Return when the nearest direction was heard."""
    right = ((dish[:, 0] - az_deg + 180.0) % 360.0 - 180.0) * math.cos(math.radians(el_deg))
    return samples[int(np.hypot(right, dish[:, 1] - el_deg).argmin())].utc
