"""The app, a real station and a dish that leans: from the first key to a dish that points true, on a virtual clock."""

from __future__ import annotations

import asyncio
import functools
import re

import pytest
from birdcage.base.alignments import load_sets
from birdcage.base.config import load
from birdcage.calibration.peaks_file import load_peaks, peaks_file
from birdcage.station.requests import Goto
from birdcage.station.state import Activity
from calibrate_house import House

SIZE = (120, 36)


def played(play):
    """Make a plain test of a coroutine that has a house."""

    @functools.wraps(play)
    def test(tmp_path):
        async def body():
            house = House(tmp_path)
            async with house.app.run_test(size=SIZE) as house.pilot:
                await house.open()
                await play(house)

        asyncio.run(body())

    del test.__wrapped__  # else pytest looks for a fixture called `house`
    return test


@played
async def test_a_leaning_dish_is_calibrated_by_keys_and_points_true(house):
    assert "Measure the alignment of the dish" in house.text()
    best = house.guide.proposals[0].candidate.name
    assert f"Next best: {best}" in house.text()
    await house.take_one()
    assert "Peak 1 saved" in house.text()
    assert "nothing to judge yet" in house.text()
    assert best not in [each.candidate.name for each in house.guide.proposals], "another one is proposed"
    for _ in range(4):
        await house.take_one()
    fit = house.guide.fit
    assert fit.rms_before_deg > 3.0
    assert fit.rms_deg < 0.1
    assert fit.alignment.an_deg == pytest.approx(1.2, abs=0.3)
    assert fit.alignment.aw_deg == pytest.approx(0.7, abs=0.3)
    text = house.text()
    for value in (fit.rms_before_deg, fit.rms_deg, fit.leave_one_out_rms_deg, house.guide.sky_error_deg):
        assert f"{value:.2f}°" in text
    assert [peak.number for peak in load_peaks(peaks_file(house.paths)).entries] == [1, 2, 3, 4, 5]
    await house.press("a", *"Roof", "enter")
    await house.rest()
    assert load(house.paths.config_file, {}).alignment.active == "Roof"
    assert "● Roof" in house.text()
    for az, el in ((200.0, 40.0), (120.0, 30.0), (300.0, 50.0)):
        future = house.station.submit(Goto(az, el, "you"))
        await house.step(20.0)
        future.result(0)
        assert house.beam_error(az, el) < 0.35, "every page points by it now"


@played
async def test_stop_in_mid_way_holds_and_nothing_goes_on_after_it(house):
    await house.press("n", "enter")
    await house.step(0.3)
    assert house.device.truth().moving
    await house.pilot.press("escape")
    await house.step(3.0)
    assert not house.device.truth().moving
    assert house.station.state.held is not None
    assert not house.app.motions.under_way
    where = house.device.truth()
    await house.press("right")
    await house.step(3.0)
    assert house.device.truth() == where
    assert house.guide.peaks == ()
    await house.press("enter")
    await house.step(1.0)
    assert house.station.state.held is None, "Enter releases, and takes no peak"
    assert house.guide.peaks == ()
    await house.press("n", "enter")
    await house.rest()
    assert house.station.state.activity is Activity.IDLE
    assert house.guide.nudged is not None


@played
async def test_stop_before_the_order_reaches_the_guide_counts_for_it(house):
    """Space comes while the guide computes: what it then asks for is refused."""
    where = house.device.truth()
    await house.pilot.press("n", "enter")
    assert house.app.view_may_move()
    await house.pilot.press("space")
    await house.step(5.0)
    assert house.device.truth().az_deg == where.az_deg
    assert not house.app.motions.under_way
    assert "HELD" in house.now.wrong


@played
async def test_a_peak_is_taken_once_and_only_at_rest(house):
    await house.press("n", "enter")
    await house.step(0.3)
    await house.press("enter")
    assert house.guide.peaks == ()
    await house.rest()
    await house.press("enter")
    await house.step(1.0)
    await house.press("enter")
    await house.step(1.0)
    assert len(house.guide.peaks) == 1
    assert "Already saved as peak 1" in house.text()


@played
async def test_a_letter_selects_an_object_and_enter_goes_there(house):
    """`n` the next best one, `m` the present one, which is no longer proposed once it is peaked."""
    where = house.device.truth()
    await house.press("n")
    await house.step(5.0)
    assert house.device.truth() == where
    best = house.guide.proposals[0].candidate.name
    assert re.search(rf"▶ {best}", house.text())
    assert re.search(r"Enter\s+go there", house.text().splitlines()[-1])
    await house.press("enter")
    await house.rest()
    assert house.guide.target == best
    await house.peak_up()
    await house.press("enter")
    await house.step(1.0)
    stands = house.device.truth()
    house.station.submit(Goto(stands.az_deg + 30.0, 30.0, "you"))
    await house.step(20.0)
    assert best not in [each.candidate.name for each in house.guide.proposals]
    await house.press("m")
    await house.step(5.0)
    assert house.beam_error(*house.guide.expected) > 20.0, "nothing moves before Enter"
    assert re.search(rf"▶ {best}", house.text())
    await house.press("enter")
    await house.rest()
    assert house.beam_error(*house.guide.expected) < 1.0
    assert house.guide.target == best
    assert len(house.guide.peaks) == 1


@played
async def test_what_was_forgotten_is_brought_back(house):
    await house.take_one()
    taken = house.guide.peaks
    await house.press("p", "d")
    assert house.guide.peaks == ()
    assert house.guide.fit is None
    assert load_peaks(peaks_file(house.paths)).entries == ()
    assert "Measure the alignment of the dish" in house.text()
    await house.press("u")
    assert house.guide.peaks == taken
    await house.press("X", "y")
    assert house.guide.peaks == ()
    await house.press("u")
    assert house.guide.peaks == taken


@played
async def test_a_set_of_before_is_put_into_force_again(house):
    for name in ("First", "Second"):
        await house.take_one()
        await house.press("a", *["backspace"] * 8, *name, "enter")
        await house.rest()
    assert [each.name for each in load_sets(house.paths.alignments_file).entries] == ["First", "Second"]
    assert [each.in_force for each in house.now.sets] == [False, True]
    await house.press("s", "up", "up", "enter")
    await house.rest()
    assert [each.in_force for each in house.now.sets] == [True, False]
    assert load(house.paths.config_file, {}).alignment.active == "First"


@played
async def test_what_the_setup_changed_meanwhile_counts_on_return(house):
    await house.press("8")
    await house.step(5.0)
    config = house.paths.config_file
    config.write_text(config.read_text().replace("39.1", "48.1"))
    before = house.guide.proposals[0].candidate.el_deg
    await house.press("C")
    await house.step(2.0)
    assert house.guide.proposals[0].candidate.el_deg != pytest.approx(before, abs=1.0)


@played
async def test_nothing_is_computed_for_nobody(house):
    await house.press("8")
    await house.step(5.0)
    shown = house.app.calibrate.source._shown_at
    await house.step(10.0)
    assert house.app.calibrate.source._shown_at == shown
    await house.press("C")
    await house.step(1.0)
    assert house.app.calibrate.source._shown_at > shown


def test_without_a_place_it_says_what_to_do(tmp_path):
    async def body():
        house = House(tmp_path, config="")
        async with house.app.run_test(size=SIZE) as house.pilot:
            await house.open()
            await house.press("n")
            return house.text()

    text = asyncio.run(body())
    assert "▲ No location set. L sets it." in text
    assert "can hear nothing" not in text


def test_a_location_that_is_set_from_here_counts_here_at_once(tmp_path):
    async def body():
        def keep(latitude_deg, longitude_deg, _height_m, _name):
            lines = ["[place]", f"latitude_deg = {latitude_deg}", f"longitude_deg = {longitude_deg}", ""]
            house.paths.config_file.write_text("\n".join(lines))

        house = House(tmp_path, config="", keep_place=keep)
        async with house.app.run_test(size=SIZE) as house.pilot:
            await house.open()
            assert not house.guide.proposals
            await house.press("L", *"39.1", "comma", "minus", *"95.7", "enter")
            return house.text()

    text = asyncio.run(body())
    assert "Next best: " in text
    assert "No location set" not in text
