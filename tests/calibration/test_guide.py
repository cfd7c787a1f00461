"""From the first object to a dish that points true: a person, a leaning dish, and the guide."""

from __future__ import annotations

import math
from datetime import UTC, datetime

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.alignments import load_sets
from birdcage.base.config import load
from birdcage.base.errors import ConfigError
from birdcage.base.geometry import separation
from birdcage.calibration.guide import NoPeak
from birdcage.calibration.peaks_file import load_peaks, peaks_file
from birdcage.sky.targets.model import Fixed
from birdcage.station.requests import Goto

STANDS = Alignment(25.0, 0.0, 0.3, 1.2, 0.7)
"""As the garden's dish does: its `tilt_east` of -0.7 is a lean of 0.7 to the west."""


def calibrate(garden, count):
    """Peak on what the guide proposes, time after time."""
    for _ in range(count):
        proposals = garden.guide.refresh()
        garden.guide.go(proposals[0].candidate)
        garden.rest()
        garden.peak_up()
        garden.guide.take()


def test_a_leaning_dish_is_calibrated_and_points_true(garden):
    calibrate(garden, 7)
    view = garden.guide.view()
    fit = view.fit
    assert fit.rms_before_deg > 15.0
    assert fit.rms_deg < 0.06
    assert fit.leave_one_out_rms_deg < 0.3
    found = fit.alignment
    assert found.an_deg == pytest.approx(STANDS.an_deg, abs=0.15)
    assert found.aw_deg == pytest.approx(STANDS.aw_deg, abs=0.15)
    garden.guide.apply("Garden")
    garden.rest()
    assert garden.guide.view().active == "Garden"
    garden.guide.close()
    for az, el in ((200.0, 40.0), (120.0, 30.0), (300.0, 55.0), (30.0, 25.0)):
        # A station that is asked for a direction now turns the beam there, all over the sky.
        future = garden.session.station.submit(Goto(az, el, "test"))
        garden.run(20.0)
        future.result(0)
        truth = garden.device.truth()
        assert separation(truth.beam_az_deg, truth.beam_el_deg, az, el) < 0.2


def test_the_first_peak_takes_the_rest_near(garden):
    proposals = garden.guide.refresh()
    garden.guide.go(proposals[0].candidate)
    garden.rest()
    assert garden.off_deg() > 10.0
    garden.peak_up()
    garden.guide.take()
    near = next(each for each in garden.guide.refresh() if each.candidate.target.kind == "slot")
    garden.guide.go(near.candidate)
    garden.rest()
    # Aimed by the peak just taken, though no alignment is in force yet.
    assert garden.off_deg() < 3.0
    assert abs(garden.guide.view().nudged[0]) < 0.05


def test_proposals_say_what_they_are_worth_and_leave_out_what_was_done(garden):
    first = garden.guide.refresh()
    assert [each.error_then_deg for each in first] == sorted(each.error_then_deg for each in first)
    assert all(each.gain_deg > 0.0 and each.candidate.el_deg > 18.0 for each in first)
    assert "the expected error over the sky falls from" in first[0].words()
    names = [each.candidate.name for each in first]
    assert "Moon" not in names or names[-1] == "Moon"  # a faint one is worth least
    assert not any("formerly" in name or "GOES" in name for name in names)
    garden.guide.go(first[0].candidate)
    garden.rest()
    garden.peak_up()
    garden.guide.take()
    assert first[0].candidate.name not in [each.candidate.name for each in garden.guide.refresh()]


def test_a_peak_is_on_the_disk_when_it_is_taken(garden):
    calibrate(garden, 2)
    kept = load_peaks(peaks_file(garden.paths)).entries
    assert kept == garden.guide.peaks
    assert [peak.number for peak in kept] == [1, 2]
    garden.guide.remove(1)
    assert [peak.number for peak in garden.guide.peaks] == [2]
    garden.guide.remove()
    assert garden.guide.peaks == ()
    assert garden.guide.fit is None


def test_no_peak_while_it_moves_or_without_an_object(garden):
    with pytest.raises(NoPeak, match="No object is chosen"):
        garden.guide.take()
    garden.guide.go(garden.guide.refresh()[0].candidate)
    garden.run(0.5)
    assert "moving" in garden.guide.view().may_not_take
    with pytest.raises(NoPeak, match="moving"):
        garden.guide.take()
    assert garden.guide.peaks == ()


def test_stop_ends_the_way_and_is_told(garden):
    garden.guide.go(garden.guide.refresh()[0].candidate)
    garden.run(0.5)
    garden.session.station.stop("test")
    garden.run(5.0)
    assert garden.guide.view().busy == ""
    assert garden.guide.view().failure
    garden.guide.go()
    garden.run(3.0)
    assert "HELD" in garden.guide.view().failure  # held until it is released


def test_limits_hold(garden):
    garden.guide.go(Fixed("low", 180.0, 5.0))
    garden.run(2.0)
    assert "below the floor" in garden.guide.view().failure


def test_apply_keeps_the_set_without_what_the_feed_adds(build):
    garden = build(
        config="[place]\nlatitude_deg = 39.1\nlongitude_deg = -95.7\n[feed.stock-ku]\naz_offset_deg = 2.0\n"
        "el_offset_deg = -1.0\n[alignment]\npitch_deg = 0.0\nroll_deg = 0.0\n"
    )
    with pytest.raises(NoPeak, match="nothing to apply"):
        garden.guide.apply("x")
    calibrate(garden, 3)
    total = garden.guide.fit.alignment
    garden.guide.apply("with dish")
    garden.rest()
    kept = load_sets(garden.paths.alignments_file).named("With Dish")
    assert kept.az_offset_deg == pytest.approx(total.az_offset_deg - 2.0, abs=1e-3)
    assert kept.el_offset_deg == pytest.approx(total.el_offset_deg + 1.0, abs=1e-3)
    settings = load(garden.paths.config_file, {})
    assert settings.alignment.active == "with dish"
    assert settings.alignment.an_deg == kept.an_deg
    assert settings.alignment.pitch_deg == 0.0
    garden.guide.apply("with dish")  # once more: it replaces the set of that name
    assert len(load_sets(garden.paths.alignments_file).entries) == 1


def test_without_a_place_it_says_so(build):
    with pytest.raises(ConfigError, match="No place is set"):
        build(config="").guide.refresh()


def test_control_is_given_back(garden):
    garden.guide.go(garden.guide.refresh()[0].candidate)
    garden.rest()
    assert garden.session.station.state.holder == "calibration"
    garden.guide.close()
    garden.run(1.0)
    assert garden.session.station.state.holder is None


def test_a_peak_by_the_signal_compares_with_where_the_sun_was_while_it_was_heard(build):
    """It moves a beam's hundredth while the dish goes through the grid, and further until it is kept."""
    garden = build(when=datetime(2026, 6, 20, 21, 30, tzinfo=UTC))  # far above the arc then
    sun = next(each.candidate for each in garden.guide.refresh() if each.candidate.name == "Sun")
    garden.guide.go(sun)
    garden.rest()
    garden.peak_up()
    began = garden.clock.utc()
    garden.guide.find_peak()
    garden.rest(200.0)
    ended = garden.clock.utc()
    (peak,) = garden.guide.peaks
    assert peak.found == "rssi"
    assert (began + (ended - began) / 2 - peak.utc).total_seconds() == pytest.approx(0.0, abs=8.0)
    assert (ended - began).total_seconds() > 20.0
    assert garden.guide.take_found().number == peak.number
    assert garden.guide.take_found() is None, "told once"
    garden.peak_up()
    by_eye = garden.guide.take()
    assert peak.true_az_deg < by_eye.true_az_deg - 0.05, "the Sun has moved on"
    right, up = (
        (one[0] - one[1] - other[0] + other[1])
        for one, other in (
            ((by_eye.dish_az_deg, by_eye.true_az_deg), (peak.dish_az_deg, peak.true_az_deg)),
            ((by_eye.dish_el_deg, by_eye.true_el_deg), (peak.dish_el_deg, peak.true_el_deg)),
        )
    )
    assert math.hypot(right * math.cos(math.radians(peak.true_el_deg)), up) < 0.12


def test_no_search_without_an_object_or_a_task(garden):
    with pytest.raises(NoPeak, match="No object is chosen"):
        garden.guide.find_peak()
    assert garden.session.station.state.tasks == ()
