"""Several maps of one region: their mean, and one less another. Maps that were made in different ways refuse."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from birdcage.base.errors import BirdcageError
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.skymap.place_blur import made_from
from birdcage.skymap.sky_map import MEASURED_SETTINGS, MapSample, SkyMap

HELD = ("dish", "feed", "target", "freq_hz", "drift_removed")
"""What is known about a map, and has to be the same."""
VOLTS, VOLTS_OFF = " V", 2.0
"""A supply of 13 V is never exactly that: what is measured of it may differ by so much. 18 V is another one."""


class MapsDiffer(BirdcageError):
    """Maps that were not made alike; the message names what differs, with both values."""


def mean_of(maps: Sequence[SkyMap]) -> SkyMap:
    """Return the mean of maps, cell by cell, each weighted by its number of readings. MapsDiffer for unlike ones.

    Mean and scatter are those of all readings together: N = sum n, m = sum n x / N and
    (N - 1) s^2 = sum (n - 1) s^2 + n (x - m)^2. Values are averaged in their unit, decibels too. A cell that only some
    maps have is of those. It has no time: RA and declination differ from map to map. Around a moving target it has no
    azimuth and elevation for files either (`place_blur.tells_directions`).
    """
    first, *others = maps
    if not others:
        raise MapsDiffer("A mean needs two maps or more.")
    for other in others:
        _check(first, other)
    settings = _settings_of(maps)
    by_cell: dict[int | None, list[MapSample]] = {}
    for each in maps:
        for sample in each.samples:
            by_cell.setdefault(sample.cell, []).append(sample)
    samples = tuple(_pooled(by_cell[cell]) for cell in first.plan.sequence if cell in by_cell)
    about = {**_common(maps), "mean_of": [name_of(each) for each in maps]}
    return _combined(maps, samples, settings, about)


def minus(one: SkyMap, other: SkyMap) -> SkyMap:
    """Return one map less another, in the cells that both have. MapsDiffer for unlike ones.

    The scatter is that of the difference of the two means, sqrt(s1^2 / n1 + s2^2 / n2), and n is 1.
    """
    _check(one, other)
    settings = _settings_of((one, other))
    taken = {sample.cell: sample for sample in other.samples}
    samples = tuple(_less(sample, taken[sample.cell]) for sample in one.samples if sample.cell in taken)
    if not samples:
        raise MapsDiffer(f"{_called(one)} and {_called(other)} have no direction in common.")
    about = {**_common((one, other)), "mean_of": _parts(one), "minus": _parts(other)}
    return _combined((one, other), samples, settings, about)


def name_of(sky_map: SkyMap) -> int | str:
    """Return its number, or the name of the file that it was read from."""
    return sky_map.number if sky_map.number is not None else str(sky_map.about.get("file") or "")


def _parts(sky_map: SkyMap) -> list[object]:
    return made_from(sky_map, "mean_of") or [name_of(sky_map)]


def _called(sky_map: SkyMap) -> str:
    name = name_of(sky_map)
    return f"Map {name}" if isinstance(name, int) else name or "A mean"


def _check(one: SkyMap, other: SkyMap) -> None:
    for what, left, right in _compared(one, other):
        if left != right:
            raise MapsDiffer(f"{what} differs: {_said(left)} on {_called(one)}, {_said(right)} on {_called(other)}.")


def _compared(one: SkyMap, other: SkyMap) -> Iterator[tuple[str, object, object]]:
    yield "The frame", one.plan.frame.value, other.plan.frame.value
    for axis, names in (("azimuth", "x"), ("elevation", "y")):
        for end in ("low", "high"):
            name = f"{names}_{end}_deg"
            yield f"The {'lowest' if end == 'low' else 'highest'} {axis}", _grid(one, name), _grid(other, name)
    yield "The step between columns", _grid(one, "step_deg"), _grid(other, "step_deg")
    yield "The step between rows", _grid(one, "row_step_deg"), _grid(other, "row_step_deg")
    yield "The source", one.source, other.source
    yield "The unit", one.unit, other.unit
    yield "The scale", _scale(one), _scale(other)
    yield "The sky", _sky(one), _sky(other)
    for name in HELD:
        yield f"`{name}`", one.about.get(name), other.about.get(name)


def _grid(sky_map: SkyMap, name: str) -> str:
    return f"{getattr(sky_map.plan, name):.6g}°"


def _scale(sky_map: SkyMap) -> str:
    return "decibels" if sky_map.decibels else "no decibels"


def _sky(sky_map: SkyMap) -> str:
    return "simulated" if sky_map.demo else "real"


def _said(value: object) -> str:
    return "nothing" if value in (None, "") else str(value)


def _settings_of(maps: Iterable[SkyMap]) -> Mapping[str, str]:
    """Return the settings that hold for all samples. MapsDiffer, with the setting, where there are several."""
    first: tuple[SkyMap, Mapping[str, str]] | None = None
    for each in maps:
        for number in sorted({sample.settings for sample in each.samples}):
            told = each.settings[number]
            if first is None:
                first = each, told
            for name in sorted({*first[1], *told}):
                left, right = first[1].get(name), told.get(name)
                if name not in MEASURED_SETTINGS and not _alike(left, right):
                    raise MapsDiffer(
                        f"The receiver's `{name}` differs: {_said(left)} on {_called(first[0])}, "
                        f"{_said(right)} on {_called(each)}."
                    )
    return {} if first is None else first[1]


def _alike(left: str | None, right: str | None) -> bool:
    if left is None or right is None or not left.endswith(VOLTS) or not right.endswith(VOLTS):
        return left == right
    try:
        return abs(float(left.removesuffix(VOLTS)) - float(right.removesuffix(VOLTS))) < VOLTS_OFF
    except ValueError:
        return left == right


def _pooled(samples: Sequence[MapSample]) -> MapSample:
    n = sum(each.n for each in samples)

    def mean(values: Iterable[float]) -> float:
        return sum(each.n * value for each, value in zip(samples, values, strict=True)) / n

    value, first_az = mean(each.value for each in samples), samples[0].az_deg
    spread = [each.n * (each.value - value) ** 2 for each in samples]
    within = [0.0 if each.n == 1 else each.scatter and (each.n - 1) * each.scatter**2 for each in samples]
    known = [each for each in within if each is not None]
    scatter = math.sqrt((sum(known) + sum(spread)) / (n - 1)) if n > 1 and len(known) == len(samples) else None
    times = [each.integration_s for each in samples if each.integration_s is not None]
    return _timeless(
        samples, value=value, scatter=scatter, n=n,
        az_deg=wrap_360(first_az + mean(shortest_turn(first_az, each.az_deg) for each in samples)),
        el_deg=mean(each.el_deg for each in samples),
        integration_s=sum(times) if len(times) == len(samples) else None,
    )  # fmt: skip


def _less(one: MapSample, other: MapSample) -> MapSample:
    known = one.scatter is not None and other.scatter is not None
    scatter = math.sqrt(sum((each.scatter or 0.0) ** 2 / each.n for each in (one, other))) if known else None
    return _timeless(
        (one, other), value=one.value - other.value, scatter=scatter, n=1, az_deg=one.az_deg, el_deg=one.el_deg,
        integration_s=None,
    )  # fmt: skip


def _timeless(
    samples: Sequence[MapSample], *, value: float, scatter: float | None, n: int, az_deg: float, el_deg: float,
    integration_s: float | None,
) -> MapSample:  # fmt: skip
    """Return a sample with what all of them have alike, and nothing of what holds for one time only."""
    first = samples[0]

    def alike(name: str, otherwise: str | None = None) -> str | None:
        told = {getattr(each, name) for each in samples}
        return told.pop() if len(told) == 1 else otherwise

    return MapSample(
        first.cell, None, None, az_deg, el_deg, None, None, value, scatter, n, integration_s, None, None,
        alike("polarisation"), 0, alike("target", "") or "", alike("state", "") or "",
    )  # fmt: skip


def _common(maps: Sequence[SkyMap]) -> dict[str, object]:
    """Return what is known about all of them and is the same."""
    first, *others = maps
    return {name: value for name, value in first.about.items() if all(each.about.get(name) == value for each in others)}


def _combined(
    maps: Sequence[SkyMap], samples: tuple[MapSample, ...], settings: Mapping[str, str], about: dict[str, object]
) -> SkyMap:
    begun = [each.begun for each in maps if each.begun is not None]
    ended = [each.ended for each in maps if each.ended is not None]
    return replace(
        maps[0], number=None, begun=min(begun, default=None), ended=max(ended, default=None), about=about,
        settings=(settings,), samples=samples, crosses=(),
    )  # fmt: skip
