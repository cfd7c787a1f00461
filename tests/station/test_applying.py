"""Settings taken over while the station runs: limits, alignment, feed."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.config import Settings
from birdcage.base.config.feeds import STOCK_FEED, FeedProfile, FeedSettings
from birdcage.base.config.sections import AlignmentSettings, MotionSettings
from birdcage.base.config.settings import Problem
from birdcage.base.errors import BelowFloor, BirdcageError, MotionRefused
from birdcage.base.no_go import NoGoSector
from birdcage.station.requests import AcceptLimits, ApplySettings, Goto, Jog
from birdcage.station.settings import StationSettings, rules_from
from birdcage.station.state import LimitSource

from .conftest import Bench

HELIX = FeedProfile(beam_deg=12.0, az_offset_deg=1.0, el_offset_deg=-2.0)


def apply(bench, **sections):
    bench.do(ApplySettings(replace(Settings(), **sections), "you"))


def test_the_limits_of_a_dish_that_was_not_asked_yet_are_its_models():
    state = Bench().state
    assert (state.el_min_deg, state.el_max_deg) == (18.0, 65.0)
    assert (state.cable_min_deg, state.cable_max_deg) == (-423.33, 23.33)
    assert set(state.limit_sources.values()) == {LimitSource.MODEL}


def test_the_limits_read_from_the_dish_say_so():
    bench = Bench()
    bench.device.board.nvram.active[102] = 60.0
    bench.device.board.nvram.ram[102] = 60.0
    bench.watch("position", rate_hz=1.0)
    bench.connect(6.0)
    state = bench.state
    assert state.el_max_deg == 60.0
    assert state.limit_sources["el_max"] is LimitSource.DISH
    assert state.limit_sources["cable_min"] is LimitSource.MODEL
    assert state.readings["nvs.102"].value == "60.00"


def test_limits_count_at_once_and_are_shown(bench):
    sector = NoGoSector(80.0, 100.0, 30.0)
    apply(
        bench,
        motion=MotionSettings(min_elevation_deg=25.0, max_elevation_deg=70.0, cable_min_deg=-350.0,
                              no_go_sectors=(sector,)),
    )  # fmt: skip
    state = bench.state
    assert (state.el_min_deg, state.el_max_deg) == (25.0, 65.0)
    assert (state.cable_min_deg, state.cable_max_deg) == (-350.0, 23.33)
    assert state.no_go_sectors == (sector,)
    assert state.limit_sources["el_min"] is LimitSource.USER
    assert state.limit_sources["el_max"] is not LimitSource.USER, "the dish's own is narrower"
    assert state.limit_sources["cable_min"] is LimitSource.USER
    with pytest.raises(BelowFloor, match=r"20.00° is 5.00° below the floor of 25.00°"):
        bench.do(Goto(180, 20, "you"))
    with pytest.raises(MotionRefused, match="no-go sector from azimuth 80° to 100° below 30°"):
        bench.do(Goto(90, 26, "you"))
    apply(bench)
    assert bench.do(Goto(180, 20, "you")).el_deg == pytest.approx(20, abs=0.1)
    assert bench.state.no_go_sectors == ()


def test_an_alignment_turns_the_position_that_is_shown(bench):
    bench.do(Goto(180, 45, "you"))
    dish = bench.state.position.dish_az_deg
    apply(bench, alignment=AlignmentSettings(az_offset_deg=30.0, el_offset_deg=1.5))
    state = bench.state
    assert state.position.az_deg == pytest.approx(dish + 30.0)
    assert state.position.dish_az_deg == dish
    assert state.position.el_deg == pytest.approx(46.5, abs=0.1)
    assert (state.az_offset_deg, state.el_offset_deg) == (30.0, 1.5)
    assert (state.el_min_deg, state.el_max_deg) == (19.5, 66.5)
    bench.do(Goto(200, 45, "you"))
    assert bench.device.truth().az_deg == pytest.approx(170, abs=0.1)
    assert bench.device.truth().el_deg == pytest.approx(43.5, abs=0.1)


def test_a_step_after_it_is_from_where_the_dish_stands(bench):
    bench.do(Goto(180, 45, "you"))
    apply(bench, alignment=AlignmentSettings(az_offset_deg=30.0))
    bench.do(Jog(1.0, 0.0, "you"))
    assert bench.device.truth().az_deg == pytest.approx(181, abs=0.15)


def test_sectors_are_true_and_turn_with_the_alignment(bench):
    apply(
        bench,
        alignment=AlignmentSettings(az_offset_deg=30.0, el_offset_deg=-1.0),
        motion=MotionSettings(no_go_sectors=(NoGoSector(80.0, 100.0, 50.0, "mast"),)),
    )
    with pytest.raises(MotionRefused, match=r"90.00°/40.00° lies in the no-go sector from .* \(mast\)") as no:
        bench.do(Goto(90, 40, "you"))
    assert (no.value.reason, no.value.limit_deg, no.value.by_deg) == ("sector", 50.0, pytest.approx(10.0))


def test_a_feed_brings_beam_offset_and_whether_it_may_stow(bench):
    feeds = MappingProxyType({"stock-ku": STOCK_FEED, "helix": HELIX})
    apply(bench)
    assert bench.state.stow_allowed is True
    apply(bench, feeds=feeds, feed=FeedSettings(active="helix"))
    state = bench.state
    assert (state.feed_name, state.beam.size, state.stow_allowed) == ("helix", "12.0° x 12.0°", False)
    assert (state.az_offset_deg, state.el_offset_deg) == (1.0, -2.0)


def test_settings_that_cannot_be_read_refuse_motion_until_mended_or_accepted(bench):
    problem = Problem(None, None, "motion.cable_min_deg", "is no number", limits_motion=True)
    apply(bench, problems=(problem,))
    assert bench.state.motion_refused_because is not None
    assert bench.state.stow_allowed is False
    with pytest.raises(MotionRefused):
        bench.do(Goto(180, 45, "you"))
    bench.do(AcceptLimits("you"))
    bench.do(Goto(180, 45, "you"))
    apply(bench, problems=(problem,))
    assert bench.state.motion_refused_because is not None
    apply(bench)
    assert bench.state.motion_refused_because is None


def test_refused_while_the_dish_moves():
    bench = Bench("g2?seed=1&az_speed=10").connect()
    bench.station.submit(Goto(270, 45, "you"))
    bench.step(1)
    with pytest.raises(BirdcageError, match="Settings are not taken over while the dish moves") as refused:
        apply(bench, alignment=AlignmentSettings(az_offset_deg=30.0))
    assert refused.value.reason == "moving"
    assert bench.state.az_offset_deg == 0.0


def test_works_without_a_link():
    bench = Bench()
    bench.device.unplug()
    bench.step(1)
    apply(bench, motion=MotionSettings(min_elevation_deg=30.0))
    assert bench.state.el_min_deg == 30.0


def test_the_start_and_run_time_derive_the_same(bench):
    settings = replace(
        Settings(),
        alignment=AlignmentSettings(az_offset_deg=12.0, el_offset_deg=-1.0, ca_deg=0.1, an_deg=0.5, aw_deg=-0.4),
        motion=MotionSettings(min_elevation_deg=22.0, stop_releases_motors=True),
    )
    rules = rules_from(settings)
    assert rules.alignment == Alignment(12.0, -1.0, 0.1, 0.5, -0.4)
    assert isinstance(StationSettings("p", "g2", lambda *_: None), type(rules))
    started = Bench(options={name: getattr(rules, name) for name in rules.__dataclass_fields__}).connect()
    bench.do(ApplySettings(settings, "you"))
    for field in (
        "el_min_deg",
        "el_max_deg",
        "az_offset_deg",
        "alignment",
        "feed_name",
        "beam",
        "stow_allowed",
        "cable_min_deg",
    ):
        assert getattr(bench.state, field) == getattr(started.state, field), field
    assert bench.station._antenna.stop_consent
    assert started.station._antenna.stop_consent


@pytest.mark.parametrize(
    ("az", "el", "words"),
    [
        (180, 5, "Elevation 5.00° is 12.00° below the floor of 17.00°. Nothing was sent."),
        (180, 70, "Elevation 70.00° is 6.00° above the limit of 64.00°. Nothing was sent."),
    ],
)
def test_a_refusal_speaks_true_degrees(bench, az, el, words):
    apply(bench, alignment=AlignmentSettings(az_offset_deg=30.0, el_offset_deg=-1.0))
    with pytest.raises(MotionRefused) as refused:
        bench.do(Goto(az, el, "you"))
    assert str(refused.value) == words


def test_a_cut_corner_says_how_to_get_there(bench):
    bench.do(Goto(60, 20, "you"))
    apply(bench, motion=MotionSettings(no_go_sectors=(NoGoSector(80.0, 100.0, 30.0),)))
    with pytest.raises(MotionRefused) as refused:
        bench.do(Goto(120, 40, "you"))
    words = str(refused.value)
    assert words.startswith("The way to 120.00°/40.00° passes through the no-go sector from azimuth 80° to 100° below")
    assert words.endswith("Nothing was sent: go up first, then across, then down.")
    assert refused.value.by_deg == pytest.approx(10, abs=0.1)
