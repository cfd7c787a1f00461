"""Reads the raw text of other sky-scan programs as maps. Formats: `docs/reference/sky-scans.md`."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from birdcage.base.errors import StoreError
from birdcage.base.text import clean
from birdcage.skymap.plan import MapOrder, MapPlan
from birdcage.skymap.raw_layout import MatrixLayout, layout_of
from birdcage.skymap.raw_numbers import NumberFile
from birdcage.skymap.raw_text import UNREAD
from birdcage.skymap.sky_map import MapSample, SkyMap

SOURCE = "file"
COUNTS = "counts"
_MATRIX = re.compile(r"raw-data-(.+)\.txt")
_SETTINGS = re.compile(r"scan[-_]settings[-_].+\.txt")
SETTINGS_NAMES = ("scan-settings-{}.txt", "scan_settings_{}.txt")
SETTINGS_BYTES = 4096
MOST = 1e9
"""No tuner and no receiver tells a level beyond that."""
OFF_GRID = 0.01
"""A direction may be so many steps beside the grid, as it was written with few decimals."""


def read_raw_text(path: Path) -> tuple[SkyMap, list[str]]:
    """Return the map in a file, and what to know of it in sentences. StoreError, which says what is wrong with it.

    A matrix named `raw-data-STAMP.txt` needs its settings beside it. The stamps are local times, so no time is known.
    """
    if _SETTINGS.fullmatch(path.name):
        raise StoreError(f"{clean(path.name)} holds the settings of a scan. Give the raw-data file beside it.")
    lines = NumberFile(path)
    named = _MATRIX.fullmatch(path.name)
    return _matrix(path, lines, named[1]) if named else _triples(lines)


def _triples(lines: NumberFile) -> tuple[SkyMap, list[str]]:
    rows: list[tuple[float, float, float]] = []
    seen: dict[tuple[float, float], int] = {}
    told, notes = list(lines.fields()), []
    if lines.cut and told:
        told.pop()
        notes.append("The last line has no end, so it is left out.")
    for number, words in told:
        if len(words) != 3:
            raise lines.wrong(
                number, f"{len(words)} words, where azimuth, elevation and value belong. "
                "A matrix has to be called raw-data-STAMP.txt, with scan-settings-STAMP.txt beside it.",
            )  # fmt: skip
        az, el = (lines.finite(number, word) for word in words[:2])
        if (az, el) in seen:
            raise lines.wrong(number, f"line {seen[az, el]} has the same direction.")
        seen[az, el] = number
        rows.append((az, el, lines.number(number, words[2])))
    if not rows:
        raise StoreError(f"{lines.name} holds no direction.")
    x, y = _axis(lines, "azimuth", (az for az, _el, _value in rows)), _axis(lines, "elevation", (r[1] for r in rows))
    plan = _plan(lines, x, y)
    values = [
        (round((az - x[0]) / plan.step_deg) + plan.columns * round((el - y[0]) / plan.row_step_deg), value)
        for az, el, value in rows
    ]
    return _made(lines, plan, values, label="winegard-sky-scan", notes=notes)


def _axis(lines: NumberFile, name: str, angles: Iterable[float]) -> tuple[float, float, float]:
    """Return the lowest and the highest angle, and the step between: 0 where there is only one."""
    told = sorted(set(angles))
    steps = [round(high - low, 9) for low, high in itertools.pairwise(told)]
    step = min(steps, default=0.0)
    for angle in told:
        steps_off = (angle - told[0]) / step if step else 0.0
        if abs(steps_off - round(steps_off)) > OFF_GRID:
            raise StoreError(f"{lines.name}: {name} {angle:g} lies on no grid from {told[0]:g} in steps of {step:g}°.")
    return told[0], told[-1], step


def _plan(lines: NumberFile, x: Sequence[float], y: Sequence[float]) -> MapPlan:
    x_step, y_step = x[2] or y[2] or 1.0, y[2] or x[2] or 1.0
    try:
        return MapPlan(
            x[0], x[1], y[0], y[1], x_step, MapOrder.COLUMNS, y_step_deg=None if y_step == x_step else y_step
        )
    except ValueError as error:
        raise StoreError(f"{lines.name} is no map of the sky: {error}") from None


def _matrix(path: Path, lines: NumberFile, stamp: str) -> tuple[SkyMap, list[str]]:
    beside = [path.with_name(name.format(stamp)) for name in SETTINGS_NAMES]
    found = next((each for each in beside if each.exists()), None)
    if found is None:
        names = " or ".join(each.name for each in beside)
        raise StoreError(f"{lines.name} needs its settings beside it: {clean(names)}.")
    told = NumberFile(found, SETTINGS_BYTES)
    numbers = [told.finite(number, word) for number, words in told.fields() for word in words]
    values = lines.matrix()
    try:
        layout = layout_of(numbers, values)
    except ValueError as error:
        raise StoreError(f"{lines.name} and {told.name} do not belong together: {error}") from None
    plan = _plan(lines, layout.x, layout.y)
    columns, rows = layout.columns, layout.rows
    cells = [
        (row * plan.columns + column, float(values[line, place]))
        for row, line in enumerate(rows)
        for column, place in enumerate(columns)
        if values[line, place] != 0.0
    ]
    return _made(lines, plan, cells, label=layout.label, notes=list(layout.notes), layout=layout)


def _made(
    lines: NumberFile, plan: MapPlan, values: list[tuple[int, float]], *, label: str, notes: list[str],
    layout: MatrixLayout | None = None,
) -> tuple[SkyMap, list[str]]:  # fmt: skip
    decibels = layout is not None and layout.decibels
    unread = [value for _cell, value in values if value == UNREAD and not decibels]
    odd = sum(not abs(value) < MOST for _cell, value in values)
    if odd:
        notes.append(f"{odd} of its values are no levels, as inf and nan: those directions count as not measured.")
    heard = [
        MapSample(cell, None, None, *plan.at(cell), None, None, value, None, 1, None, None, None, None, 0, "", "")
        for cell, value in values
        if abs(value) < MOST and (decibels or value != UNREAD)
    ]
    if not heard:
        why = "each of them is marked as unread" if unread else "there is no value in it"
        raise StoreError(f"{lines.name} holds no direction that was measured: {why}.")
    about = {"file": lines.name, "source_label": label}
    return SkyMap(
        None, plan, None, None, SOURCE, "dB" if decibels else COUNTS, decibels, lines.demo, about,
        ({} if layout is None else layout.settings,), tuple(heard),
    ), notes  # fmt: skip
