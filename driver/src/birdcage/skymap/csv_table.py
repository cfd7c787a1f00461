"""A map as CSV: comments that say what it is, then a line a sample."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from datetime import UTC, datetime

from birdcage.signal.recordings import DEMO
from birdcage.skymap.place_blur import TOLD, is_blurred
from birdcage.skymap.sample_columns import columns_of
from birdcage.skymap.sky_map import SkyMap


def csv_lines(sky_map: SkyMap) -> Iterator[str]:
    """Yield it line by line. Lines that begin with # are comments; what is not known is empty."""
    yield from (f"# {line}" for line in _head(sky_map))
    columns = columns_of(sky_map)
    for each in columns:
        unit = sky_map.unit if each.unit == "value" else each.unit
        if words := ", ".join(part for part in (unit, each.meaning) if part):
            yield f"# {each.name}: {words}"
    yield ",".join(each.name for each in columns)
    for sample in (*sky_map.samples, *sky_map.crosses):
        text = io.StringIO()
        csv.writer(text, lineterminator="").writerow(_cell(each.of(sample)) for each in columns)
        yield text.getvalue()


def _head(sky_map: SkyMap) -> Iterator[str]:
    plan = sky_map.plan
    if sky_map.demo:
        yield DEMO
    yield f"map: {_cell(sky_map.number) or '-'}, {sky_map.title}"
    steps = f"{plan.step_deg:g}" if plan.y_step_deg is None else f"{plan.step_deg:g} x {plan.y_step_deg:g}"
    yield f"step: {steps} deg, directions heard: {len(sky_map.samples)} of {plan.cells}"
    yield f"source: {sky_map.source}, unit: {sky_map.unit}"
    yield f"begun: {_cell(sky_map.begun)}, ended: {_cell(sky_map.ended)}"
    for name in TOLD:
        if sky_map.about.get(name) not in (None, ""):
            yield f"{name}: {sky_map.about[name]}"
    if is_blurred(sky_map):
        yield "the place is rounded to whole degrees; what would tell it better is left out"
    for number, settings in enumerate(sky_map.settings):
        if settings:
            yield f"settings {number}: {', '.join(f'{name} {value}' for name, value in settings.items())}"


def _cell(value: object) -> object:
    if isinstance(value, datetime):
        return value.astimezone(UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
    if isinstance(value, bool):
        return int(value)
    return "" if value is None else value
