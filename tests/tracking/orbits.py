"""Passes laid over one place, and mounts to plan them for."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from functools import cache

from birdcage.base.beam import Beam
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.sky import demo_orbits
from birdcage.sky.demo_plan import Low
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.targets.model import Satellite
from birdcage.tracking.mount import Mount, Standing
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.planning.rates import mean_rate_deg_s

PLACE = Observer(40.0, -105.0, 1650.0)
NOW = datetime(2026, 11, 21, 12, tzinfo=UTC)
NOW_S = NOW.timestamp()


@cache
def overhead(aside_deg, *, height_km=820.0, inclination_deg=98.7, northbound=True, minutes=12.0):
    """A satellite and its pass, which goes by `aside_deg` (at the Earth's centre) beside the place."""
    greenwich = (280.46061837 + 360.98564736629 * (NOW - demo_orbits._J2000).total_seconds() / 86400.0) % 360.0
    orbit = demo_orbits._low(
        Low("made up", height_km, inclination_deg, minutes, aside_deg, northbound), 1, PLACE, greenwich
    )
    elements = ElementSet(
        name="MADE UP", norad_id=999, epoch=NOW, inclination_deg=orbit.inclination_deg,
        raan_deg=orbit.raan_deg % 360.0, eccentricity=orbit.eccentricity, argument_of_perigee_deg=0.0,
        mean_anomaly_deg=orbit.mean_anomaly_deg % 360.0, mean_motion_rev_day=orbit.mean_motion_rev_day,
    )  # fmt: skip
    passes = search(Fleet([elements]), PLACE, NOW, minutes / 60.0 + 0.5)
    return Satellite(elements), max(passes, key=lambda one: one.max_elevation_deg)


def travler(speed_deg_s):
    """A Trav'ler by a speed, as plans assume one, instead of by its measured times."""
    azimuth, elevation = (
        replace(axis, times=None, speed_deg_s=speed_deg_s) for axis in (TRAVLER.azimuth, TRAVLER.elevation)
    )
    return TRAVLER.with_axes(azimuth, elevation)


def g2(ceiling_deg=65.0):
    return CARRYOUT_G2.with_axes(replace(CARRYOUT_G2.elevation, max_deg=ceiling_deg))


def mount(model=CARRYOUT_G2, *, at=(10.0, 30.0), known=True, beam_deg=2.75, alignment=None, **limits):
    given = {
        "el_floor_deg": model.elevation.min_deg, "el_ceiling_deg": model.elevation.max_deg,
        "cable_min_deg": model.cable.min_deg, "cable_max_deg": model.cable.max_deg, "turn_known": known,
        "az_rate_deg_s": mean_rate_deg_s(model.azimuth), "el_rate_deg_s": mean_rate_deg_s(model.elevation),
    }  # fmt: skip
    options = {} if alignment is None else {"alignment": alignment}
    return Mount(
        model, ReachLimits(**{**given, **limits}), standing=None if at is None else Standing(*at),
        beam=None if beam_deg is None else Beam(beam_deg, beam_deg),
        **options,
    )  # fmt: skip


def plan_of(aside_deg=2.0, on=None, *, orbit=None, **options):
    """The plan of such a pass."""
    target, passing = overhead(aside_deg, **(orbit or {}))
    return plan_pass(target, PLACE, mount() if on is None else on, NOW, passing=passing, **options)
