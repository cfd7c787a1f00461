"""What the keys of a map do on F3, and the map on a phone."""

from __future__ import annotations

from dataclasses import replace

import map_stand_in
import pytest
import stage
import stand_in
from birdcage.skymap.plan import MapPlan
from birdcage.station.requests import BeginTask, EndMotion, Jog
from birdcage_tui.pocket.map import PocketMap
from birdcage_tui.signal.map_pane import MapPane
from birdcage_tui.widgets.choice_screen import ChoiceScreen
from birdcage_tui.widgets.dialogs import TAKEN_IN_S, QuestionScreen
from map_stand_in import on_map, settle

SIZES = [(80, 24), (120, 36), (160, 48)]


async def read(app, _pilot):
    return stand_in.text_of(app)


def heard(count=None, plan=map_stand_in.PLAN, **other):
    return map_stand_in.made(plan, count, **other)


def task(sky, **more):
    return map_stand_in.task(sky, **more)


def test_e_pauses_the_map_by_ending_its_task():
    sky = heard(40)

    async def pressed(app, pilot):
        await pilot.press("e")
        await settle(app, pilot)
        return app.station.asked_for(EndMotion), stand_in.text_of(app)

    ended, said = on_map(pressed, sky, task(sky))
    assert ended == [EndMotion("you")]
    assert "Map paused. u resumes it, even after a restart." in said
    assert on_map(pressed, sky)[0] == []


def test_u_asks_and_goes_on_with_what_is_left(tmp_path):
    sky = heard(3990)
    path = map_stand_in.keep(tmp_path / "signal.sqlite", sky)

    async def pressed(app, pilot):
        app.maps.beside = lambda work: work()
        await pilot.press("u")
        await settle(app, pilot)
        question = stand_in.text_of(app)
        assert isinstance(app.screen, QuestionScreen)
        before = app.station.asked_for(BeginTask)
        app.session.clock.advance(TAKEN_IN_S)
        await pilot.press("y")
        await settle(app, pilot)
        return question, before, app.station.asked_for(BeginTask)

    question, before, begun = on_map(pressed, sky, recordings_file=path)
    assert "3 directions, about" in " ".join(question.split())
    assert before == []
    assert [(each.kind, each.values["key"], each.values["step_deg"]) for each in begun] == [
        ("map", map_stand_in.KEY, 1.0)
    ]


def test_a_finished_map_is_not_resumed():
    async def pressed(app, pilot):
        await pilot.press("u")
        await settle(app, pilot)
        return stand_in.text_of(app)

    assert "This map is finished. m begins another one." in on_map(pressed, heard())


def test_maps_that_are_kept_are_opened_from_a_list(tmp_path):
    path = map_stand_in.keep(tmp_path / "signal.sqlite", heard(40))
    map_stand_in.keep(path, heard(None, MapPlan(170.0, 180.0, 30.0, 40.0, 2.0)), key="small")

    async def pressed(app, pilot):
        app.maps.beside = lambda work: work()
        await pilot.press("M")
        await settle(app, pilot)
        assert isinstance(app.screen, ChoiceScreen)
        listed = stand_in.text_of(app)
        await pilot.press("home", "enter")
        await settle(app, pilot)
        await settle(app, pilot)
        return listed, stand_in.text_of(app)

    listed, shown = on_map(pressed, heard(40), recordings_file=path)
    assert "unfinished, 40 of 3993 directions" in listed
    assert "finished, 36 directions" in listed
    assert listed.index("az 170:180") < listed.index("  1  2026"), "the newest first"
    assert "az 170:180 el 30:40, every 2°" in shown


def test_there_is_no_list_of_no_maps():
    async def pressed(app, pilot):
        app.maps.beside = lambda work: work()
        app.maps.book.shown = None
        await pilot.press("M")
        await settle(app, pilot)
        return stand_in.text_of(app)

    said = on_map(pressed, heard(3))
    assert "No maps are kept yet. m begins one." in said
    assert "No map yet. m maps the sky, M lists the maps that are kept." in said


@pytest.mark.parametrize(("size", "cuts"), [((80, 24), 0), ((120, 36), 6), ((160, 48), 6)], ids=str)
def test_cuts_are_drawn_where_there_is_room_and_by_key(size, cuts):
    async def pressed(app, pilot):
        before = app.query_one(MapPane)._layout.cut_rows
        await pilot.press("d")
        await settle(app, pilot)
        pane = app.query_one(MapPane)
        return before, pane._layout.cut_rows, stand_in.text_of(app), app.screen.region.contains_region(pane.region)

    before, after, said, inside = on_map(pressed, heard(), size=size)
    assert before == cuts
    assert bool(after) != bool(before)
    assert inside
    assert ("●" in said[said.rindex("240°") :]) == bool(after)


@pytest.mark.parametrize("theme", ["dusk", "night"])
def test_the_colours_that_are_picked_are_kept(theme):
    kept = []

    async def pressed(app, pilot):
        await pilot.press("c")
        await settle(app, pilot)
        return stand_in.text_of(app), app.query_one(MapPane).colours

    said, colours = on_map(pressed, heard(40), theme=theme, map_colours="grey", keep_map_colours=kept.append)
    assert kept == [colours] == ["blue-yellow"]
    assert "Colours of the map: blue-yellow." in said
    assert ("The night theme shows red" in said) == (theme == "night")


def test_the_horizon_and_the_sun_are_lines_on_it_and_lost_steps_are_told():
    sky = heard(1500)
    drift = {"gain": 0.97, "right_deg": 0.4, "up_deg": 0.0, "lost_steps": True}
    said = on_map(read, sky, task(sky, **drift), size=(160, 48))
    assert "LOST STEPS, drift: gain ×0.97, +0.40° right, +0.00° up" in said


def test_v_comes_by_the_map_between_sweep_and_strip():
    async def pressed(app, pilot):
        shown = []
        for _ in range(3):
            await pilot.press("v")
            await settle(app, pilot)
            shown.append(app.page._view.__name__)
        return shown

    assert on_map(pressed, heard(3), view=False) == ["SweepPane", "MapPane", "StripPane"]


def test_nothing_but_glyphs_tells_levels_on_a_poor_terminal():
    said = on_map(read, heard(), glyphs="ascii")
    picture = [row for row in said.splitlines() if row.count("#") + row.count("=") + row.count("-") > 40]
    assert picture
    assert "▀" not in said


def test_a_phone_shows_the_map_until_something_is_wrong():
    sky = heard(1900)

    async def pressed(app, pilot):
        texts = [stand_in.text_of(app)]
        await pilot.press("m")
        await settle(app, pilot)
        texts.append(stand_in.text_of(app))
        region = app.page.query_one(PocketMap).region
        stand_in.change_to(app, "fault")
        await settle(app, pilot)
        texts.append(stand_in.text_of(app))
        stand_in.change_to(app, "idle")
        await pilot.press("m")
        await settle(app, pilot)
        return *texts, stand_in.text_of(app), region, app.screen.region

    before, shown, wrong, after, region, screen = on_map(pressed, sky, task(sky, left_s=4320.0), size=(40, 12), keys=())
    for words in ("1900 of 3993, 1 h 12 min left", "loudest 134.0°/32.0°  553", "S T O P", "101W", "m map"):
        assert words in shown, words
    assert screen.contains_region(region)
    assert "Azimuth stalled at 203.1°." in " ".join(wrong.split())
    assert "1900 of 3993" not in wrong
    assert "101W" not in before + after


def test_a_phone_without_a_map_says_where_one_begins():
    async def pressed(app, pilot):
        await pilot.press("m")
        await settle(app, pilot)
        return stand_in.text_of(app)

    assert "No map is open." in stage.run(pressed, size=(40, 12))


def test_a_map_that_takes_the_page_takes_the_arrows_too():
    sky = heard(40)

    async def pressed(app, pilot):
        page = app.page
        before = app.query_one(MapPane).has_focus
        running = task(sky, number=2)
        app.station.state = replace(app.station.state, tasks=(running,))
        app.maps.book.take(running)
        await settle(app, pilot)
        await settle(app, pilot)
        await pilot.press("right")
        await settle(app, pilot)
        return before, page.shows_map, app.query_one(MapPane).has_focus, app.station.asked_for(Jog)

    assert on_map(pressed, sky, view=False) == (False, True, True, [])


def test_without_the_focus_a_running_map_says_that_arrows_end_it():
    sky = heard(40)

    async def pressed(app, pilot):
        app.screen.set_focus(None)
        await settle(app, pilot)
        return stand_in.text_of(app)

    assert "arrows step the dish and end the map, i: cursor" in on_map(pressed, sky, task(sky), size=(160, 48))
    assert "arrows step the dish" not in on_map(pressed, sky, size=(160, 48))


def test_g_says_why_it_offers_nothing():
    async def pressed(app, pilot):
        await pilot.press("i", "g")
        await settle(app, pilot)
        return stand_in.text_of(app)

    assert "Nothing is heard yet, so the cursor is nowhere." in on_map(pressed, heard(0))


def test_a_list_that_comes_late_does_not_lie_over_another_page(tmp_path):
    path, waiting = map_stand_in.keep(tmp_path / "signal.sqlite", heard(40)), []

    async def pressed(app, pilot):
        app.maps.beside = waiting.append
        await pilot.press("M", "u", "f2")
        await settle(app, pilot)
        for work in waiting:
            work()
        await settle(app, pilot)
        return isinstance(app.screen, ChoiceScreen | QuestionScreen), stand_in.text_of(app)

    is_open, said = on_map(pressed, heard(40), recordings_file=path)
    assert not is_open
    assert "The map is ready to resume. u on F3 asks." in said


def test_a_file_that_cannot_be_read_is_told_beside_the_map():
    async def pressed(app, pilot):
        app.maps.problem = "The file is damaged."
        await settle(app, pilot)
        return stand_in.text_of(app)

    assert "The file is damaged." in on_map(pressed, heard(40), size=(160, 48))


def test_a_search_during_a_map_is_refused_by_what_is_under_way():
    async def pressed(app, pilot):
        await pilot.press("f")
        await settle(app, pilot)
        return stand_in.text_of(app)

    sky = heard(40)
    assert "Mapping the sky is under way. Space stops it." in on_map(pressed, sky, task(sky))
