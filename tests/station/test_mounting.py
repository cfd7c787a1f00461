"""What a plan is told of the dish."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.config import Settings
from birdcage.base.config.feeds import FeedProfile, FeedSettings
from birdcage.base.errors import BirdcageError
from birdcage.station.mounting import mount_of
from birdcage.station.requests import ApplySettings, Goto, Home, SetSpeed
from birdcage.station.state import StationState

from .conftest import Bench


def test_without_a_dish_there_is_no_mount():
    with pytest.raises(BirdcageError, match="not known yet"):
        mount_of(StationState(), Settings())


def test_limits_are_the_dish_s_own_degrees_and_its_speed_is_the_one_in_force():
    bench = Bench(
        options={"alignment": Alignment(5.0, 2.0), "min_elevation_deg": 25.0, "feed": FeedProfile(beam_deg=3.0)}
    ).connect()
    bench.do(Goto(180, 45, "you"))
    bench.step(8)
    bench.do(SetSpeed(0, 30.0, "you"))
    mount = mount_of(bench.state, Settings())
    assert mount.el_min_deg == pytest.approx(25.0)
    assert mount.limits.el_floor_deg == pytest.approx(27.0)
    assert mount.model.azimuth.speed_deg_s == pytest.approx(30.0, abs=0.02)
    assert mount.alignment == Alignment(5.0, 2.0)
    assert (mount.standing.az_deg, mount.standing.el_deg) == pytest.approx((175.0, 43.0), abs=0.1)
    assert mount.beam.size == "3.0° x 3.0°"


def test_the_beam_is_as_wide_as_the_band_of_its_feed_says():
    settings = Settings(feeds={"ku": FeedProfile(freq_min_hz=11.0e9, freq_max_hz=13.0e9, beam_deg=3.0)})
    settings = replace(settings, feed=FeedSettings(active="ku"))
    bench = Bench().connect()
    bench.do(ApplySettings(settings, "you"))
    mount = mount_of(bench.state, settings)
    assert mount.beam_at(None).el_deg == 3.0
    assert mount.beam_at(10.0e9).az_deg == pytest.approx(3.6)
    assert mount.beam_at(137.1e6).az_deg == 3.0, "no law tells how wide it is so far off its band"


def test_it_stands_on_a_turn_of_the_cable_where_that_was_counted():
    bench = Bench().connect()
    bench.do(Home("you"), 60)
    bench.do(Goto(300, 45, "you"))
    assert mount_of(bench.state, Settings()).standing.az_deg == pytest.approx(-60.0, abs=0.1)


def test_where_it_stands_is_unknown_after_the_link_was_lost():
    bench = Bench().connect()
    bench.device.unplug()
    bench.step(3)
    assert mount_of(bench.state, Settings()).standing is None
