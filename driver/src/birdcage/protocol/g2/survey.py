"""What is read of a G2 when it has just been connected."""

from __future__ import annotations

import math

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.g2.settings import SettingsMemory
from birdcage.protocol.g2.stepper import Stepper
from birdcage.protocol.g2.system import System
from birdcage.protocol.motors import by_name
from birdcage.protocol.nvs import DISABLE_TRACKER, MAX_ELEVATION, MIN_ELEVATION, NvsRow, row_id
from birdcage.rotator.values import Survey


def survey(system: System, nvs: SettingsMemory, stepper: Stepper) -> Survey:
    """Read TV search and limits (NVS 20, 101, 102), speeds (`step`), and identity (`os`, `id`)."""
    rows = {}
    for index in (DISABLE_TRACKER, MIN_ELEVATION, MAX_ELEVATION):
        try:
            rows[index] = nvs.read(index)
        except NoReply as missing:
            if missing.reason != Reason.NO_ROW:
                raise
    try:
        speeds = stepper.max_speeds_deg_s()
    except CommandRefused:
        speeds = {}  # a G2 with another stepper menu: the model's speeds hold
    identity = system.fields()
    limits = [_degrees(rows.get(index)) for index in (MIN_ELEVATION, MAX_ELEVATION)]
    return Survey(
        identity=identity,
        version=identity.get("Software"),
        settings={row_id(index): row.current for index, row in rows.items()},
        el_min_deg=limits[0],
        el_max_deg=limits[1],
        speeds=by_name(speeds),
        search_disabled=rows[DISABLE_TRACKER].current == "TRUE" if DISABLE_TRACKER in rows else None,
    )


def _degrees(row: NvsRow | None) -> float | None:
    """Return the angle in force of a setting; None when there is no such row. NoReply when it is not a number."""
    if row is None:
        return None
    try:
        value = float(row.current)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise NoReply(
            f"The dish showed {row.current!r} in NVS row {row.index}, which is no angle.", reason=Reason.GARBAGE
        )
    return value
