"""The Calibrate tab of F8 over a stand-in guide: what is seen at every size."""

from __future__ import annotations

import asyncio
import re
from dataclasses import replace

import calibrate_stand_in
import pytest
import stand_in
from birdcage.signal.source import SignalReading
from birdcage.signal.tuner import TUNER_FACTS
from birdcage_tui.calibrate.aim import AimPane
from birdcage_tui.calibrate.figures import FiguresPane
from birdcage_tui.calibrate.lists import ObjectsPane, PeaksPane, SetsPane
from birdcage_tui.calibrate.over_sky import OverSkyPane
from birdcage_tui.calibrate.scatter import ScatterPane, reach_of
from birdcage_tui.calibrate.tabs import SetupTabs
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.status import BadDayRow, StatusLine, StopButton
from calibrate_tab import SIZES, flat, pane_text, press, read, run, settle

OWN = (SetupTabs, ScatterPane, AimPane, ObjectsPane, FiguresPane, PeaksPane, SetsPane, OverSkyPane)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("scene", calibrate_stand_in.SCENES)
def test_what_a_person_needs_is_inside_the_screen_and_over_nothing_else(scene, size):
    async def look(app, _pilot, _source):
        kinds = [StatusLine, StopButton, BadDayRow, KeyBar, SetupTabs, ScatterPane, AimPane, ObjectsPane]
        if scene in ("one", "five", "odd"):
            kinds.append(FiguresPane)
        if size[0] >= 100:
            kinds += [PeaksPane, SetsPane]
        if size[0] >= 150:
            kinds.append(OverSkyPane)
        parts = {kind.__name__: app.page.query_one(kind) if kind in OWN else app.query_one(kind) for kind in kinds}
        for name, part in parts.items():
            assert part.region.area > 0, name
            assert app.screen.region.contains_region(part.region), f"{name} {part.region}"
            assert part.content_size.area > 0, name
        found = list(parts.items())
        for index, (name, part) in enumerate(found):
            for other, second in found[index + 1 :]:
                assert not part.region.overlaps(second.region), f"{name} lies over {other}"
        aim = parts["AimPane"]
        for spot, command in aim.hot:
            inside = aim.content_region
            assert spot.right <= inside.width, command
            assert spot.bottom <= inside.height, command

    run(look, scene, size)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_first_question_and_its_controls_at_every_size(size):
    first = run(read, "first", size)
    for words in (
        "Measure the alignment of the dish",
        "Next best: 82°W Nimiq 4",
        "n next object",
        "▼ Calibrate",
        "8 Setup",
    ):
        assert words in first
    on_it = run(read, "five", size)
    for words in ("82°W Nimiq 4", "159.00° 43.00°", "0.42° right, 0.10° down", "Enter save peak", "n next object"):
        assert words in on_it


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_figures_are_told_and_the_warning_too(size):
    view = calibrate_stand_in.SCENES["odd"].guide
    text = run(read, "odd", size)
    for value in (view.fit.rms_before_deg, view.fit.rms_deg, view.fit.leave_one_out_rms_deg, view.sky_error_deg):
        assert f"{value:.2f}°" in text
    assert f"{view.fit.condition:.0f} " in text
    assert "Peak 3" in text
    assert "▲" in text


@pytest.mark.parametrize("size", SIZES[:2], ids=str)
def test_what_is_wrong_with_the_fit_and_what_to_do_next_are_told_whole(size):
    async def look(app, _pilot, _source):
        return [pane_text(app.page.query_one(kind)) for kind in (FiguresPane, AimPane)]

    below, aim = run(look, "odd", size)
    assert calibrate_stand_in.SCENES["odd"].guide.fit.warning in below
    assert "f finds the peak by the signal, and saves it." in aim


def test_the_picture_holds_each_peak_by_its_number_and_its_ring():
    async def look(app, _pilot, _source):
        pane = app.screen.query_one(ScatterPane)
        return "\n".join("".join(part.text for part in strip) for strip in pane._strips)

    text = run(look, "five", (160, 48))
    assert all(str(number) in text for number in range(1, 6))
    assert text.count("○") >= 3, "rings may fall on each other, and on numbers"
    assert f"{reach_of(calibrate_stand_in.SCENES['five'].guide.fit):g}° up" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_no_peak_hides_behind_another_one(size):
    async def look(app, _pilot, _source):
        return pane_text(app.page.query_one(ScatterPane))

    text = run(look, "odd", size).replace("2° up", "").replace("2° right", "")
    assert [number for number in "12345" if text.count(number) != 1] == []
    assert not re.search(r"\d\d", text), "two of them would read as one number"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_columns_and_counts_say_what_they_are(size):
    async def look(app, _pilot, _source):
        panes = {kind: app.page.query_one(kind) for kind in (ObjectsPane, PeaksPane, SetsPane)}
        return {kind: (pane_text(pane), pane.border_subtitle) for kind, pane in panes.items() if pane.display}

    heads = {ObjectsPane: ("az el error", "4 objects"), PeaksPane: ("error left out", "5 peaks"),
             SetsPane: ("RMS", "2 sets")}  # fmt: skip
    for kind, (text, count) in run(look, "five", size).items():
        assert heads[kind][0] in text
        assert count == heads[kind][1]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_one_peak_fits_itself_and_is_not_called_good(size):
    async def look(app, _pilot, _source):
        return pane_text(app.page.query_one(FiguresPane)), pane_text(app.page.query_one(AimPane))

    figures, aim = run(look, "one", size)
    assert "one peak nothing to judge yet" in figures
    assert "spread" not in figures
    assert "after" not in figures
    assert "→" not in figures
    assert "signal waiting" in aim, "nothing was heard on this object yet"


def test_a_peak_lies_where_its_residual_says():
    """Right of the middle and above it, as far as the scale says."""
    fit = calibrate_stand_in.SCENES["five"].guide.fit
    reach = reach_of(fit)
    one = max(fit.residuals, key=lambda each: each.off_deg)

    async def look(app, _pilot, _source):
        pane = app.screen.query_one(ScatterPane)
        return ["".join(part.text for part in strip) for strip in pane._strips]

    rows = run(look, "five", (160, 48))
    radius = min(len(rows[0]) - 1, len(rows) * 2 - 2)
    wanted_x = len(rows[0]) // 2 + one.right_deg / reach * radius / 2
    wanted_y = len(rows) // 2 - one.up_deg / reach * radius / 4
    spots = [
        (x, y) for y, row in enumerate(rows) for x, char in enumerate(row)
        if char == str(one.peak.number) and "°" not in row[x : x + 6]
    ]  # fmt: skip
    assert any(abs(x - wanted_x) <= 1.5 and abs(y - wanted_y) <= 1.5 for x, y in spots), (spots, wanted_x, wanted_y)


def test_without_a_guide_the_tab_says_so():
    async def play(app, pilot, _source):
        await press(app, pilot, "f8")
        await press(app, pilot, "C")
        await press(app, pilot, "n")
        return stand_in.text_of(app)

    async def body():
        app = stand_in.app_in("idle")
        async with app.run_test(size=(80, 24)) as pilot:
            await settle(app, pilot)
            return await play(app, pilot, None)

    assert "This app has no file for calibrations." in flat(asyncio.run(body()))


def test_the_highest_signal_is_told_with_its_place():
    """A person who went over the middle reads how far back it is."""

    async def play(app, pilot, _source):
        clock, here = app.session.clock, app.station.state.position
        app.signals.book.of(TUNER_FACTS).clear()

        def hear(ago_s, counts):
            reading = SignalReading(counts, "counts", clock.monotonic() - ago_s, clock.utc(), "tuner")
            app.signals.book.hear(reading, TUNER_FACTS, app.station.state)

        hear(1.0, 900.0)  # before this object: it counts for nothing
        clock.advance(5.0)
        for at, az, value in ((3.0, here.az_deg + 1.0, 640.0), (1.0, here.az_deg, 590.0)):
            where = replace(here, az_deg=az)
            app.station.state = replace(app.station.state, position=where)
            hear(at, value)
        await settle(app, pilot)
        return stand_in.text_of(app)

    text = run(play, size=(120, 36))
    assert "590 counts, max 640, 0.73° right of here" in text, "a degree of azimuth at 43° up"


def test_no_place_is_told_and_what_to_do():
    text = " ".join(run(read, "no-place").replace("│", " ").split())
    assert "▲ No location set. L sets it." in text
    assert "can hear nothing" not in text, "why nothing was found is told, not that nothing is up"
