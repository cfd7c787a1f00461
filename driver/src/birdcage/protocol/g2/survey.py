"""What is read of a G2 when it has just been connected."""

from __future__ import annotations

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.g2.features_motors import speeds_of
from birdcage.protocol.g2.features_settings import angle_of
from birdcage.protocol.g2.motors import CEILING, FLOOR
from birdcage.protocol.g2.stepper import Stepper
from birdcage.protocol.g2.system import System, identity_of
from birdcage.protocol.nvs import DISABLE_TRACKER, MAX_ELEVATION, MIN_ELEVATION
from birdcage.protocol.trk.settings import SettingsMemory
from birdcage.protocol.trk.settings_rows import tv_search_of
from birdcage.rotator.own_settings import row_id
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
    limits = [angle_of(rows[index]) if index in rows else None for index in (MIN_ELEVATION, MAX_ELEVATION)]
    features = {**identity_of(identity), **speeds_of(speeds)}
    features |= {name: limit for name, limit in zip((FLOOR, CEILING), limits, strict=True) if limit is not None}
    if DISABLE_TRACKER in rows:
        features |= tv_search_of(rows[DISABLE_TRACKER])
    return Survey(
        identity=identity,
        features=features,
        settings={row_id(index): row.current for index, row in rows.items()},
        el_min_deg=limits[0],
        el_max_deg=limits[1],
        search_disabled=rows[DISABLE_TRACKER].current == "TRUE" if DISABLE_TRACKER in rows else None,
    )
