"""What is told to the sky of a dish's limits: from settings and model, and from a station's state."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from birdcage.base.beam import Beam
from birdcage.base.config.feeds import FeedProfile
from birdcage.base.config.sections import AlignmentSettings, HorizonPoint, MotionSettings, PlaceSettings
from birdcage.base.config.settings import Settings
from birdcage.base.no_go import NoGoSector
from birdcage.rotator.axis import Axis, Role
from birdcage.rotator.mapping import Arc
from birdcage.sky.reach import reach
from birdcage.sky.reach_limits import ReachLimits
from birdcage.station.known import list_models
from birdcage.station.reach_limits import reach_limits, reach_limits_of
from birdcage.station.state import CableTurn as StateTurn
from birdcage.station.state import StationState

MODELS = {model.firmware: model for model in list_models()}


def test_without_a_dish_and_settings_nothing_is_limited_but_by_the_horizon():
    assert reach_limits(Settings(), None) == replace(ReachLimits(), turn_known=True, tolerance_deg=1.0)


def test_the_model_limits_what_settings_leave_open():
    limits = reach_limits(Settings(), MODELS["g2"])
    assert (limits.el_floor_deg, limits.el_ceiling_deg) == (18.0, 65.0)
    assert limits.cable == (-423.33, 23.33)
    assert (limits.az_rate_deg_s, limits.el_rate_deg_s) == (65.0, 45.0)
    slow = reach_limits(Settings(), MODELS["hal205"])
    assert slow.az_rate_deg_s == pytest.approx(90.0 / 13.5, rel=0.02)  # the measured times, not the greatest speed


def test_a_machine_that_follows_nothing_has_no_pass_in_reach():
    hour = Axis("hour", Role.ARC, -60.0, 60.0, 2.0, 8.0, 0.1)
    point = Arc("hour", -60.0, 60.0, lambda deg: (180.0 + deg, 30.0)).point
    bare = replace(MODELS["g2"], axes=(hour,), mapping_lacks="Say where it stands.")
    for model in (bare, replace(bare, mapping=Arc("hour", -60.0, 60.0, point))):
        for limits in (reach_limits(Settings(), model), reach_limits_of(StationState(dish=model), Settings())):
            track = SimpleNamespace(
                t_s=1.8e9 + np.arange(0.0, 600.0, 10.0), az_deg=np.linspace(120.0, 240.0, 60), el_deg=np.full(60, 30.0)
            )
            found = reach(track, limits)
            assert (found.intervals, found.reasons) == ((), ("no tracking",))


def test_settings_narrow_the_model_and_never_widen_it():
    wide = Settings(
        motion=MotionSettings(
            min_elevation_deg=5.0, max_elevation_deg=90.0, cable_min_deg=-1000.0, cable_max_deg=1000.0
        )
    )
    assert reach_limits(wide, MODELS["g2"]) == reach_limits(Settings(), MODELS["g2"])
    narrow = Settings(motion=MotionSettings(min_elevation_deg=25.0, cable_min_deg=-300.0))
    assert reach_limits(narrow, MODELS["g2"]).el_floor_deg == 25.0
    assert reach_limits(narrow, MODELS["g2"]).cable == (-300.0, 23.33)


def test_limits_are_true_and_the_cable_is_the_dishes_own():
    leaning = Settings(
        alignment=AlignmentSettings(az_offset_deg=100.0, el_offset_deg=2.0),
        feeds={"stock-ku": FeedProfile(az_offset_deg=3.0, el_offset_deg=0.5)},
        motion=MotionSettings(no_go_sectors=(NoGoSector(10.0, 20.0, 40.0, "mast"),)),
    )
    limits = reach_limits(leaning, MODELS["g2"])
    assert (limits.el_floor_deg, limits.el_ceiling_deg, limits.az_offset_deg) == (20.5, 67.5, 103.0)
    assert limits.cable == (-423.33, 23.33)
    assert limits.no_go == (NoGoSector(10.0, 20.0, 40.0, "mast"),)
    assert limits.tolerance_deg == 1.0  # that feed's beam is not known


def test_the_horizon_of_the_place_counts():
    points = HorizonPoint(0.0, 12.0), HorizonPoint(180.0, 12.0)
    limits = reach_limits(Settings(place=PlaceSettings(horizon=points)), None)
    assert limits.horizon is not None
    assert limits.horizon.at(123.0) == 12.0
    assert reach_limits(Settings(place=PlaceSettings(horizon=points[:1])), None).horizon is None


def test_a_live_dish_counts_as_the_station_knows_it():
    state = StationState(
        dish=MODELS["g2"], el_min_deg=21.0, el_max_deg=66.0, cable_min_deg=-400.0, cable_max_deg=20.0,
        az_offset_deg=7.0, beam=Beam(4.0, 6.0), turn=StateTurn.COUNTED,
    )  # fmt: skip
    limits = reach_limits_of(state, Settings())
    assert (limits.el_floor_deg, limits.el_ceiling_deg, limits.cable) == (21.0, 66.0, (-400.0, 20.0))
    assert (limits.az_offset_deg, limits.tolerance_deg, limits.turn_known) == (7.0, 2.0, True)
    assert not reach_limits_of(replace(state, turn=StateTurn.UNKNOWN), Settings()).turn_known
    unknown = reach_limits_of(StationState(), Settings())
    assert (unknown.el_floor_deg, unknown.el_ceiling_deg, unknown.cable, unknown.az_rate_deg_s) == (0, 90, None, None)
