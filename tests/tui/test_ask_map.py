"""`m` on F3: what a map is asked by, what is refused with the way out, and how much it is before it begins."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from datetime import UTC, datetime
from types import SimpleNamespace

import pytest
import stand_in
from birdcage.base.beam import Beam
from birdcage.skymap.plan import MapFrame, MapOrder
from birdcage.station.requests import BeginTask
from birdcage_tui.signal.ask_map import estimated, request_of, target_path, told, usual_region
from birdcage_tui.widgets.fields_screen import FieldsScreen
from stage import run
from textual.widgets import Input

NOON = datetime(2026, 3, 20, 12, tzinfo=UTC)
USUAL = ("160:220", "25:50", "1", "coarse", "", "", "", "none", "no", "no")
FIELDS = ("azimuth", "elevation", "step", "order", "around", "start", "until", "reference", "details", "quiet")


def view_of(**state):
    app = stand_in.app_in("idle")
    view = app.view()
    return replace(view, utc=NOON, state=replace(view.state, **state))


def typed(**other):
    return tuple(other.get(name, usual) for name, usual in zip(FIELDS, USUAL, strict=True))


def test_the_arc_is_offered_as_far_as_the_dish_reaches():
    assert usual_region(view_of()) == ("125:220", "18:50")
    assert usual_region(view_of(el_min_deg=30.0, el_max_deg=42.0)) == ("125:220", "30:42")


def test_without_a_place_it_is_what_lies_around_the_dish():
    view = view_of()
    nowhere = replace(view, settings=replace(view.settings, place=None))
    assert usual_region(nowhere) == ("155:220", "18:65")


def test_the_step_is_a_third_of_the_beam():
    async def opened(app, pilot):
        app.station.state = replace(app.station.state, beam=Beam(5.0, 4.6))
        await pilot.press("m")
        await pilot.pause()
        return [field.value for field in app.screen.query(Input)], stand_in.text_of(app)

    values, said = run(opened, key="f3")
    assert values[:4] == ["125:220", "18:50", "1.5", "coarse"]
    assert "directions, about" in said


def test_what_was_typed_is_what_is_asked_for():
    view = view_of()
    request = request_of(view, typed(order="Spiral", start="23:00", until="05:30", details="yes", quiet="y"))
    assert (request.plan.x_low_deg, request.plan.x_high_deg, request.plan.order) == (160.0, 220.0, MapOrder.SPIRAL)
    assert request.start_s == datetime(2026, 3, 20, 23, tzinfo=UTC).timestamp()
    assert request.until_s == datetime(2026, 3, 21, 5, 30, tzinfo=UTC).timestamp()
    assert (request.details, request.quiet, request.reference) == (True, True, None)
    assert request.source == view.heard.id
    assert request_of(view, typed(reference="214.3 38.7")).reference == (214.3, 38.7)


def test_the_reference_may_be_the_peak_that_was_heard():
    view = view_of()
    with pytest.raises(ValueError, match="No peak with a direction"):
        request_of(view, typed(reference="peak"))
    level = SimpleNamespace(fit=None, peak=SimpleNamespace(az_deg=210.0, el_deg=40.0))
    assert request_of(replace(view, level=level), typed(reference="peak")).reference == (210.0, 40.0)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"azimuth": "160-220"}, "Type from:to in degrees, 160:220."),
        ({"azimuth": "nan:220"}, "Type from:to"),
        ({"elevation": "50:25"}, "ends before it begins"),
        ({"azimuth": "5:-5", "elevation": "-5:5", "around": "sun"}, "ends before it begins"),
        ({"azimuth": "0:361"}, "wider than 360°"),
        ({"elevation": "5:15"}, "This dish reaches 18 to 65°."),
        ({"step": "0"}, "Give more than 0"),
        ({"step": "one"}, "Step is 'one'. Type degrees: 0.8."),
        ({"step": "0.01"}, "At most 300000 fit"),
        ({"order": "zigzag"}, "Type coarse, rows, columns or spiral."),
        ({"start": "noon"}, "is not a time"),
        ({"start": "2026-03-21T23:00Z", "until": "2026-03-21T22:00Z"}, "Type an end after the start."),
        ({"reference": "somewhere"}, "Type none, peak, or az el"),
        ({"reference": "214 -3"}, "elevation from 0 to 90"),
        ({"quiet": "perhaps"}, "Quiet is 'perhaps'. Type yes or no."),
        ({"around": "sun"}, "Around a target both spans"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_with_the_way_out(values, words):
    with pytest.raises(ValueError, match=words.replace(".", r"\.").replace("°", ".")):
        request_of(view_of(), typed(**values))
    assert told(view_of(), typed(**values)) == ""


def test_the_estimate_tells_directions_minutes_end_and_what_is_out_of_reach():
    said = told(view_of(), typed())
    assert said.startswith("1586 directions, about ")
    assert "ends 12:" in said
    below = told(view_of(), typed(elevation="5:50"))
    assert "In reach: elevation 18 to 50°." in below
    late = told(view_of(), typed(start="23:00", until="23:05"))
    assert "begins 23:00Z" in late
    assert "At 23:05Z it pauses: " in late


def test_a_large_map_is_estimated_by_a_part_of_it():
    view = view_of()
    small = estimated(view, request_of(view, typed(azimuth="0:100", elevation="20:60")))
    large = estimated(view, request_of(view, typed(azimuth="0:100", elevation="20:60", step="0.25")))
    assert large.directions == 401 * 161
    assert large.directions / small.directions == pytest.approx(large.seconds / small.seconds, rel=0.3)


def test_a_map_around_the_sun_needs_a_place_and_knows_its_way():
    view = view_of()
    values = typed(azimuth="-4:4", elevation="-4:4", around="sun")
    assert request_of(view, values).plan.frame is MapFrame.TARGET
    with pytest.raises(ValueError, match="location"):
        request_of(replace(view, settings=replace(view.settings, place=None)), values)
    name, path = target_path("Sun", stand_in.PLACE, datetime(2026, 3, 20, 18, tzinfo=UTC).timestamp(), 3600.0)
    assert name == "Sun"
    assert path[0][1:] == pytest.approx((170.5, 49.2), abs=2.0)
    assert path[-1][0] - path[0][0] == 3600.0
    with pytest.raises(ValueError, match=r"Sun is below the horizon at 06:00Z\. Type a later start\."):
        target_path("sun", stand_in.PLACE, datetime(2026, 3, 20, 6, tzinfo=UTC).timestamp(), 3600.0)
    with pytest.raises(ValueError, match="nosuch"):
        target_path("nosuch", stand_in.PLACE, 1.8e9, 60.0)


def test_a_region_over_north_may_end_at_a_lesser_azimuth():
    plan = request_of(view_of(), typed(azimuth="350:10")).plan
    assert (plan.x_low_deg, plan.x_high_deg, plan.columns) == (350.0, 370.0, 21)


def test_an_open_dialog_tells_times_of_now():
    async def opened(app, pilot):
        await pilot.press("m")
        await pilot.pause()
        field = app.screen.query(Input)[6]
        field.value = "12:10"
        await pilot.pause()
        before = stand_in.text_of(app)
        app.session.clock.advance(20 * 60.0)
        await pilot.press("enter")
        await pilot.pause()
        return before, app.station.asked_for(BeginTask)

    before, begun = run(opened, key="f3")
    assert "12:10Z it pauses" in " ".join(before.split())
    assert begun[0].values["until_s"] == datetime(2026, 3, 21, 12, 10, tzinfo=UTC).timestamp()
    fresh = []

    async def looked(app, pilot):
        await pilot.press("m")
        await pilot.pause()
        fresh.append(stand_in.text_of(app))
        app.session.clock.advance(3 * 3600.0)
        app.screen.query(Input)[2].value = "2"
        await pilot.pause()
        await pilot.pause()
        fresh.append(stand_in.text_of(app))

    run(looked, key="f3")
    assert "ends 12:" in " ".join(fresh[0].split())
    assert "ends 15:" in " ".join(fresh[1].split())


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_enter_begins_it_and_the_dialog_lies_inside_the_screen(size):
    async def begun(app, pilot):
        await pilot.press("m")
        await pilot.pause()
        fields = list(app.screen.query(Input))
        inside = all(app.screen.region.contains_region(each.region) and each.region.area for each in fields)
        before = list(app.station.asked_for(BeginTask))
        await pilot.press("enter")
        await pilot.pause()
        return inside, before, app.station.asked_for(BeginTask), stand_in.text_of(app)

    inside, before, after, said = run(begun, size=size, key="f3")
    assert inside
    assert before == []
    assert [each.kind for each in after] == ["map"]
    assert (after[0].values["x_low_deg"], after[0].values["y_high_deg"]) == (125.0, 50.0)
    assert "The map begins. Space: STOP. e: pause." in said


@pytest.mark.parametrize("stopped", ["", "held", "released since"])
def test_a_map_around_the_sun_begins_once_its_way_is_known_unless_stop_comes_first(stopped):
    async def body():
        app, waiting = stand_in.app_in("idle"), []
        app.session.clock.step_utc(6 * 3600.0)
        app.maps.beside = waiting.append
        async with app.run_test(size=(120, 36)) as pilot:
            await pilot.press("f3", "m")
            await pilot.pause()
            assert isinstance(app.screen, FieldsScreen)
            for field, value in zip(app.screen.query(Input), typed(azimuth="-4:4", elevation="-4:4", around="sun"),
                                    strict=True):  # fmt: skip
                field.value = value
            await pilot.press("enter")
            await pilot.pause()
            before = list(app.station.asked_for(BeginTask))
            moves = app.view_may_move()
            if stopped:
                stand_in.change_to(app, "held")
            if stopped == "released since":
                app.station.state = replace(app.station.state, held=None)
            for work in waiting:
                work()
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return moves, before, app.station.asked_for(BeginTask), stand_in.text_of(app), bool(app.motions.under_way)

    moves, before, after, said, under_way = asyncio.run(body())
    assert moves, "Space and Esc stop it"
    assert not under_way
    assert before == []
    if stopped:
        assert after == []
        assert ("STOP came first. No map was begun." in said) == (stopped != "held"), "row 2 tells of HELD until then"
        return
    values = after[0].values
    assert (values["frame"], values["target"]) == ("target", "Sun")
    assert values["until_s"] == values["path"][-1][0], "beyond it nothing is known of the Sun"
