"""A map of the sky as it was heard: every direction with what is known of it, and how the receiver was set."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.skymap.plan import MapFrame, MapPlan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


MEASURED_SETTINGS = ("rf_agc", "if_agc")
"""What a receiver is not set to, but finds by itself: maps of one receiver may differ there."""


def title_words(plan: MapPlan, about: Mapping[str, object]) -> str:
    """Say in a few words what a map is of: its target, or its region."""
    if plan.frame is MapFrame.TARGET:
        return f"around {about.get('target') or 'a moving target'}"
    return f"az {plan.x_low_deg:g}:{plan.x_high_deg:g} el {plan.y_low_deg:g}:{plan.y_high_deg:g}"


def region_words(plan: MapPlan, about: Mapping[str, object]) -> str:
    """Say it with how far the map reaches around its target: ±2°, or right of it (x) and above it (y)."""
    title = title_words(plan, about)
    if plan.frame is not MapFrame.TARGET:
        return title
    if -plan.x_low_deg == plan.x_high_deg == -plan.y_low_deg == plan.y_high_deg:
        return f"{title} ±{plan.x_high_deg:g}°"
    return f"{title} x {plan.x_low_deg:g}:{plan.x_high_deg:g} y {plan.y_low_deg:g}:{plan.y_high_deg:g}"


@dataclass(frozen=True, slots=True)
class MapSample:
    """What was heard in one direction. What is not known is None."""

    cell: int | None
    """Of the map's plan; None for a point of a reference cross."""
    cross_number: int | None
    """The number of the reference cross, from 0; None for a cell."""
    utc: datetime | None
    """The middle of the time of listening."""
    az_deg: float
    """True, as read while the dish rested there."""
    el_deg: float
    aim_az_deg: float | None
    """Where the moving target was at that time, true; None on a map that follows none."""
    aim_el_deg: float | None
    value: float
    """Mean of `n` readings, in the map's unit."""
    scatter: float | None
    """Standard deviation of one of them."""
    n: int
    integration_s: float | None
    """From the first of them to the last, as long as it took."""
    snr_db: float | None
    lock: bool | None
    polarisation: str | None
    settings: int
    """Which of the map's `settings` held."""
    target: str
    """What the dish was pointed at, or the source was read for."""
    state: str
    """What the station was doing."""


@dataclass(frozen=True, slots=True)
class SkyMap:
    """A map, finished or not."""

    number: int | None
    """In the file of recordings; None for one that was read from a file of another program."""
    plan: MapPlan
    begun: datetime | None
    ended: datetime | None
    """When the last direction was heard; None while some are missing."""
    source: str
    """The id of the signal source."""
    unit: str
    decibels: bool
    """Whether equal steps of `value` are equal ratios of power. Counts of a tuner are neither."""
    demo: bool
    """Whether the sky was a simulated one."""
    about: Mapping[str, object] = field(default_factory=dict)
    """What holds for the whole map, as far as it is known:

    `dish`, `firmware`, `feed`, `source_label`, `target`: names. `latitude_deg`, `longitude_deg`, `height_m`: the place.
    `beam_az_deg`, `beam_el_deg`: the beam at half power on the sky. `freq_hz`: the middle of what is heard, at the
    antenna. `az_offset_deg`, `el_offset_deg`, `ca_deg`, `an_deg`, `aw_deg`: the pointing model in use. `file`: where
    it was read from. `mean_of`, `minus`: which maps it was made from. `drift_removed`:
    whether the drift of gain was taken out.
    """
    settings: tuple[Mapping[str, str], ...] = ({},)
    """Each way in which the receiver was set: frequency, transponder, bandwidth, gain, AGC, LNB voltage, by name."""
    samples: tuple[MapSample, ...] = ()
    """The cells that were heard, in the order of time."""
    crosses: tuple[MapSample, ...] = ()
    """The points of its reference crosses, in the order of time."""

    @property
    def is_complete(self) -> bool:
        """Whether every direction was heard."""
        return len(self.samples) >= self.plan.cells

    def grid(self) -> NDArray[np.float64]:
        """Return the values in rows of rising elevation and columns of rising azimuth; NaN where nothing was heard."""
        import numpy as np

        values = np.full(self.plan.cells, np.nan)
        for sample in self.samples:
            if sample.cell is not None:
                values[sample.cell] = sample.value
        return values.reshape(self.plan.rows, self.plan.columns)

    def place(self) -> tuple[float, float] | None:
        """Return latitude and longitude in degrees; None where they are not known."""
        latitude, longitude = self.about.get("latitude_deg"), self.about.get("longitude_deg")
        if isinstance(latitude, int | float) and isinstance(longitude, int | float):
            return float(latitude), float(longitude)
        return None

    @property
    def title(self) -> str:
        """What it is a map of, in a few words."""
        return title_words(self.plan, self.about)

    def with_samples(self, samples: tuple[MapSample, ...]) -> SkyMap:
        """Return it with other cells."""
        return replace(self, samples=samples)
