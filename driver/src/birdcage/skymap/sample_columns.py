"""What files tell of each direction of a map: the columns, their units, and what they mean."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.skymap.place_blur import tells_directions
from birdcage.skymap.plan import MapFrame
from birdcage.skymap.sky_map import MapSample, SkyMap


@dataclass(frozen=True, slots=True)
class SampleColumn:
    """One column of a table of samples."""

    name: str
    unit: str
    """Empty for what has none; `value` for that of the map."""
    of: Callable[[MapSample], object]
    meaning: str = ""


def columns_of(sky_map: SkyMap) -> tuple[SampleColumn, ...]:
    """Return the columns of a map, in order. Around a target a blurred or combined one has no azimuth and elevation."""

    def told(name: str, unit: str = "", meaning: str = "") -> SampleColumn:
        return SampleColumn(name, unit, lambda sample: getattr(sample, name), meaning)

    plan = sky_map.plan

    def along(axis: int) -> Callable[[MapSample], object]:
        return lambda sample: None if sample.cell is None else plan.at(sample.cell)[axis]

    around = plan.frame is MapFrame.TARGET
    directions = (
        told("az_deg", "deg", "true azimuth as read at rest"), told("el_deg", "deg", "true elevation as read at rest"),
        told("aim_az_deg", "deg", "of the moving target"), told("aim_el_deg", "deg", "of the moving target"),
    )  # fmt: skip
    return (
        told("cell", "", "number in the grid: 0 is lowest and leftmost; empty in a reference cross"),
        told("cross_number", "", "number of the reference cross, from 0; empty for a cell"),
        told("utc", "", "middle of listening"),
        SampleColumn("x_deg", "deg", along(0), f"of the cell: {'right of the target' if around else 'azimuth'}"),
        SampleColumn("y_deg", "deg", along(1), f"of the cell: {'above the target' if around else 'elevation'}"),
        *(directions if tells_directions(sky_map) else ()),
        told("value", "value", "mean of n readings"),
        told("scatter", "value", "standard deviation of one of them"),
        told("n"),
        told("integration_s", "s", "from the first to the last of them"),
        told("snr_db", "dB"),
        told("lock"),
        told("polarisation"),
        told("settings", "", "number of the receiver's settings, from 0"),
        told("target"),
        told("state"),
    )  # fmt: skip
