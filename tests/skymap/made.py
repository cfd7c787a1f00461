"""Maps as a dish would have heard them, made for tests."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta

from birdcage.skymap.plan import MapPlan
from birdcage.skymap.sky_map import MapSample, SkyMap

BEGUN = datetime(2026, 3, 20, 6, tzinfo=UTC)


def sample(cell, az_deg, el_deg, value, **other):
    told = {
        "cross_number": None, "utc": BEGUN + timedelta(seconds=1.5 * (cell or 0)), "aim_az_deg": None,
        "aim_el_deg": None, "scatter": 0.7, "n": 10, "integration_s": 0.5, "snr_db": None, "lock": None,
        "polarisation": None, "settings": 0, "target": "", "state": "slewing", **other,
    }  # fmt: skip
    return MapSample(cell=cell, az_deg=az_deg, el_deg=el_deg, value=value, **told)


def made_map(plan: MapPlan, level: Callable[[float, float], float], *, heard: int | None = None, **other) -> SkyMap:
    """Return a map whose level at azimuth and elevation is `level`, with its first `heard` directions."""
    told = {"number": 1, "begun": BEGUN, "ended": None, "source": "tuner", "unit": "counts", "decibels": False,
            "demo": True, "settings": ({"transponder": "1"},), **other}  # fmt: skip
    cells = plan.sequence[:heard]
    samples = tuple(sample(cell, *plan.at(cell), level(*plan.at(cell))) for cell in cells)
    return SkyMap(plan=plan, samples=samples, **told)
