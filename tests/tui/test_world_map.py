"""The map of the world: what a person sees on it, in every glyph set and size, and when it is asked for."""

import math
import re
from dataclasses import replace
from datetime import UTC, datetime
from types import SimpleNamespace

import pytest
import sky_stand_in
from birdcage.sky.elements import ElementSet
from birdcage.sky.footprint import footprint
from birdcage.sky.observer import Observer
from birdcage.sky.terminator import SubSolar
from birdcage.sky.world import SubPoint, WorldView
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.feeds.world_ask import Ask, world_of
from birdcage_tui.passes.listing import PassList
from birdcage_tui.passes.world_map import WorldMapPane, place_text
from birdcage_tui.passes.world_map_ask import PassWorld, seen_text
from birdcage_tui.passes.world_map_chart import Chart, Layers
from stage import run
from stand_in import text_of

NOON = datetime(2026, 3, 20, 12, tzinfo=UTC)
HERE = Observer(52.1, 5.2, name="Utrecht")
JUNE = SubSolar(23.4, 0.0)
BARE = WorldView(NOON, JUNE)
BRAILLE = range(0x2801, 0x2900)
VIEW = SimpleNamespace(settings=SimpleNamespace(glyphs="braille"), pointer="◉", state=SimpleNamespace(pursuit=None))


def drawn(world, width=120, height=31, view=VIEW):
    """The cells of the pane, without an app."""
    pane = WorldMapPane()
    pane.world = world
    cells = Cells(width, height)
    pane.draw(cells, view)
    return pane, cells


def rows_of(cells):
    return ["".join(row) for row in cells._chars]


def ink_at(cells, x, y):
    return cells._inks[y][x]


def spot_of(pane, cells, latitude_deg, longitude_deg):
    chart, left, top = pane.chart(cells.width, cells.height)
    x, y = chart.cell(latitude_deg, longitude_deg)
    return left + x, top + y


def followed(latitude_deg=0.0, longitude_deg=0.0, altitude_km=800.0, **more):
    chosen = SubPoint("METEOR", 1, latitude_deg, longitude_deg, altitude_km)
    return replace(
        BARE, chosen=chosen, footprint=footprint(latitude_deg, longitude_deg, altitude_km), **more
    )  # fmt: skip


@pytest.mark.parametrize("size", [(78, 17), (118, 29), (158, 41), (60, 41), (200, 20)], ids=str)
def test_the_map_fills_its_pane_and_is_nearly_true(size):
    chart = Chart.within(*size)
    assert chart.width <= size[0]
    assert chart.height <= size[1]
    assert size[0] - chart.width < 1 or size[1] - chart.height < 1
    assert 1 / 1.4 <= chart.width / chart.height / 4 <= 1.4


def test_every_place_lies_on_the_map():
    chart = Chart(40, 10)
    for latitude in (-90.0, -89.9, 0.0, 90.0):
        for longitude in (-180.0, -179.99, 0.0, 179.99, 180.0, 190.0):
            x, y = chart.cell(latitude, longitude)
            assert 0 <= x < 40
            assert 0 <= y < 10
    assert chart.cell(80.0, -170.0) == (1, 0)
    assert chart.place(0, 0) == (81.0, -175.5)
    assert chart.place(40, 0) is None


def test_a_line_over_the_date_line_goes_round_and_not_across():
    chart = Chart(90, 22)
    xs = [x for x, _ in chart.along([(0.0, 175.0), (0.0, -175.0)], 1.0)]
    assert len(xs) >= 5
    assert all(x > 176.0 or x < 4.0 for x in xs)


def test_land_is_where_land_is():
    _, cells = drawn(BARE)
    pane, still = drawn(BARE)
    assert rows_of(cells) == rows_of(still)
    for latitude, longitude in ((43.5, -8.0), (-34.4, 19.0), (8.1, 77.5), (-39.0, 143.5), (60.0, -43.0)):
        x, y = spot_of(pane, cells, latitude, longitude)
        near = [(x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        assert any(ord(cells._chars[b][a]) in BRAILLE and ink_at(cells, a, b) == "line" for a, b in near)
    x, y = spot_of(pane, cells, 20.0, 10.0)
    assert cells._chars[y][x] == " "  # the Sahara, by day


@pytest.mark.parametrize(("sun", "dark", "light"), [
    (JUNE, [(-50.0, 150.0), (0.0, 170.0), (-40.0, 120.0)], [(80.0, 170.0), (30.0, 20.0), (0.0, -30.0)]),
    (SubSolar(-23.4, 120.0), [(80.0, 120.0), (0.0, -60.0)], [(-80.0, -60.0), (-25.0, 105.0)]),
    (SubSolar(0.0, 90.0), [(50.0, -90.0), (-50.0, -150.0)], [(30.0, 90.0), (-40.0, 80.0)]),
])  # fmt: skip
def test_night_is_where_the_sun_is_down(sun, dark, light):
    bare = Braille(116, 29)
    canvas = Layers().draw(Chart(116, 29), sun)
    chart = Chart(116, 29)

    def faint(latitude, longitude):
        x, y = chart.cell(latitude, longitude)
        return any(canvas._inks[b * 116 + a] == "faint" for a in (x, x + 1) for b in (y, y - 1) if 0 <= a < 116)

    assert not any(bare._bits)
    assert all(sun.elevation_deg(*place) < 0 and faint(*place) for place in dark)
    assert all(sun.elevation_deg(*place) > 0 and not faint(*place) for place in light)


def test_the_night_is_drawn_again_when_the_sun_has_moved_and_not_before():
    layers, chart = Layers(), Chart(80, 20)
    first = layers.draw(chart, JUNE)
    kept, coast = layers._dark, layers._still
    layers.draw(chart, SubSolar(23.4, 0.05))
    assert layers._dark is kept
    later = layers.draw(chart, SubSolar(23.4, -45.0))
    assert layers._dark is not kept
    assert layers._still is coast
    assert later._bits != first._bits
    first.dot(3, 3, "fault")  # what is given out may be drawn on
    assert layers.draw(chart, JUNE)._inks != first._inks


def test_the_chosen_satellite_has_its_name_ring_and_way():
    world = followed(
        10.0, -40.0, observer=HERE,
        behind=((-60.0, -20.0), (10.0, -40.0)), ahead=((10.0, -40.0), (70.0, -60.0)),
    )  # fmt: skip
    pane, cells = drawn(world)
    x, y = spot_of(pane, cells, 10.0, -40.0)
    assert cells._chars[y][x] == "•"
    assert ink_at(cells, x, y) == "target-strong"
    text = "\n".join(rows_of(cells))
    assert "METEOR" in text
    assert "10.0°N 40.0°W  800 km up" in text
    assert "12:00:00Z" in text
    assert "footprint radius 3," in text

    def dots(ink, rows):
        return sum(
            (ord(cells._chars[row][column]) - 0x2800).bit_count()
            for row in rows for column in range(cells.width)
            if ink_at(cells, column, row) == ink and ord(cells._chars[row][column]) in BRAILLE
        )  # fmt: skip

    ahead, behind = dots("target", range(y)), dots("target", range(y + 1, cells.height))
    assert ahead > 2 * behind > 0  # solid, dotted
    assert dots("dim", range(cells.height - 1)) > 40


def test_the_ring_of_a_polar_satellite_closes_over_the_pole_and_leaves_no_line_across():
    pane, cells = drawn(followed(85.0, 30.0))
    chart, left, _ = pane.chart(cells.width, cells.height)
    rows = range(cells.height - 1)
    ring = [column for row in rows for column in range(cells.width) if ink_at(cells, column, row) == "dim"]
    assert len(set(ring)) > 0.9 * chart.width  # once around
    assert min(ring) <= left + 1
    _, beside = drawn(followed(0.0, 179.0))
    rows = [row for row in range(30) for column in (20, 60, 100) if ink_at(beside, column, row) == "dim"]
    assert rows == []  # half at either side, nothing between


def test_the_observer_and_the_sun_are_marked_and_others_named_where_there_is_room():
    others = (SubPoint("ALPHA", 2, -30.0, -120.0, 500.0), SubPoint("BETA", 3, -30.0, -25.0, 500.0, favourite=True))
    pane, cells = drawn(followed(0.0, -140.0, observer=HERE, satellites=others))
    for (latitude, longitude), glyph, ink in (
        ((52.1, 5.2), "◉", "accent-strong"),
        ((23.4, 0.0), "☼", "strong"),
        ((-30.0, -120.0), "•", "text"),
        ((-30.0, -25.0), "•", "strong"),
    ):
        x, y = spot_of(pane, cells, latitude, longitude)
        assert cells._chars[y][x] == glyph
        assert ink_at(cells, x, y) == ink
    text = "\n".join(rows_of(cells))
    assert "ALPHA" in text
    assert "BETA" in text


def test_places_are_told_with_their_hemispheres():
    assert place_text(52.14, 5.2) == "52.1°N 5.2°E"
    assert place_text(-33.9, -70.6, digits=0) == "34°S 71°W"


def test_without_a_world_or_room_it_says_so():
    assert "Loading the map …" in rows_of(drawn(None)[1])[0]
    assert "Too small" in rows_of(drawn(BARE, 24, 4)[1])[0]
    assert "No pass selected" in rows_of(drawn(BARE)[1])[-1]


def on_map(test, size=(80, 24), *, sky=None, **options):
    """On the page, after the key of the map."""

    async def there(app, pilot):
        await pilot.press("w")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return await test(app, pilot)

    return run(there, "idle", size, key="f7", sky=sky or sky_stand_in.make(), **options)


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48), (200, 60)], ids=str)
@pytest.mark.parametrize("glyphs", ["braille", "block", "ascii"])
def test_the_map_takes_the_page_and_names_the_chosen_satellite(size, glyphs):
    async def look(app, _pilot):
        panes = {pane.id: pane.region for pane in app.query("PassesPage Pane") if pane.display and pane.region.area}
        return panes, app.screen.region, text_of(app), app.query_one(PassWorld).has_focus

    panes, screen, text, focused = on_map(look, size, glyphs=glyphs)
    assert set(panes) == {"pass-head", "pass-world"}
    assert screen.contains_region(panes["pass-world"])
    assert panes["pass-world"].width == size[0]
    assert "METEOR-M2 4" in text
    assert focused
    if glyphs == "ascii":
        assert text.isascii()
    assert not (glyphs == "block" and any(chr(code) in text for code in BRAILLE))


def test_keys_choose_another_pass_on_the_map_and_go_back():
    async def do(app, pilot):
        source = sky_stand_in.Source.made[-1]
        before = source.looked[-1].chosen.name
        await pilot.press("down")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        after = text_of(app)
        named = source.looked[-1].chosen.name
        await pilot.press("right_square_bracket")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        later = source.looked[-1].t_s - source.looked[0].t_s
        asked = len(source.looked)
        app.paint()
        app.paint()
        await pilot.pause()
        again = len(source.looked) - asked
        await pilot.press("v")
        await pilot.pause()
        app.paint()
        listed = app.query_one(PassList)
        return before, named, after, later, again, listed.display and listed.has_focus, text_of(app)

    before, named, after, later, again, back, text = on_map(do)
    assert before != named
    assert named in after
    assert later == pytest.approx(60, abs=1)
    assert again == 0  # nothing has changed
    assert back
    assert "Passes" in text


def test_a_frame_in_which_the_world_is_the_same_costs_nothing():
    async def look(app, pilot):
        pane, drawn = app.query_one(PassWorld), []
        draw = pane.draw
        pane.draw = lambda cells, view: (drawn.append(cells), draw(cells, view))
        for _ in range(5):
            app.paint()
            await pilot.pause()
        same = len(drawn)
        await pilot.resize_terminal(120, 36)
        await pilot.pause()
        resized = len(drawn)
        await pilot.press("right_square_bracket")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return same, resized, len(drawn), drawn[-1].width

    same, resized, later, width = on_map(look)
    assert same == 0
    assert later > resized > same
    assert width > 100


def test_hidden_it_asks_for_nothing():
    async def look(app, pilot):
        app.paint()
        await pilot.pause()
        return len(sky_stand_in.Source.made[-1].looked)

    assert run(look, "idle", (80, 24), key="f7", sky=sky_stand_in.make()) == 0


def test_the_world_is_worked_out_from_the_elements_of_the_passes():
    elements = ElementSet("DEMO LEO", 7, NOON, 98.6, 40.0, 0.001, 0.0, 0.0, 14.2)
    row = sky_stand_in.shown_pass("DEMO LEO", 7, (0.0, 1.0, 2.0), (0.0, 0.0, 0.0), 10.0, elements=elements)
    other = sky_stand_in.changed(row, name="OTHER", time_offset_s=60.0)
    seen = world_of(Ask(int(NOON.timestamp()), row, (other,)), HERE)
    assert seen.utc == NOON
    assert seen.chosen is not None
    assert (seen.chosen.name, [one.name for one in seen.satellites]) == ("LEO", ["OTHER"])
    apart = math.dist(
        (seen.chosen.latitude_deg, seen.chosen.longitude_deg),
        (seen.satellites[0].latitude_deg, seen.satellites[0].longitude_deg),
    )
    assert 2.0 < apart < 6.0  # a minute of its way


@pytest.mark.parametrize("size", [(80, 24), (160, 48)], ids=str)
def test_the_map_says_until_when_the_satellite_is_in_view_and_names_the_dish(size):
    async def look(app, pilot):
        first = text_of(app)
        await pilot.press("down")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return first, text_of(app)

    first, second = on_map(look, size)
    assert re.search(r"METEOR-M2 4  in reach to 12:\d\d  in view here to 12:10 ", first), first
    # Reach goes first: where both have no room, it is what a person who would follow needs.
    view = "  in view here 12:03 to 12:16" if size[0] > 80 else ""
    assert re.search(r"NOAA 20 \(JPSS-1\)  in reach 12:\d\d-12:\d\d" + view, second), second
    assert "EN10" in first.split("World", 1)[1]
    assert "○ footprint" in first
    assert "sort:" not in first


@pytest.mark.parametrize(("minutes", "words"), [
    (-5, "in view here 12:00 to 12:10"), (5, "in view here to 12:10"), (15, "")
])  # fmt: skip
def test_when_it_is_in_view_is_told_from_the_pass(minutes, words):
    noon_s = sky_stand_in.NOON
    row = sky_stand_in.shown_pass("A", 1, (noon_s, noon_s + 300, noon_s + 600), (0.0, 0.0, 0.0), 40.0)
    t_s = noon_s + minutes * 60
    assert seen_text(row, t_s) == words
    always = sky_stand_in.changed(row, already_up=True, still_up=True)
    assert seen_text(always, t_s) == "always in view here"


def test_on_the_largest_screen_the_list_stands_beside_the_map():
    async def look(app, pilot):
        panes = {pane.id: pane.region for pane in app.query("PassesPage Pane") if pane.display and pane.region.area}
        text = text_of(app)
        await pilot.press("w")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        back = {pane.id for pane in app.query("PassesPage Pane") if pane.display and pane.region.area}
        return panes, app.screen.region, text, back

    panes, screen, text, back = on_map(look, (240, 70))
    assert set(panes) == {"pass-head", "pass-list", "pass-world"}
    assert all(screen.contains_region(region) for region in panes.values())
    assert not panes["pass-list"].overlaps(panes["pass-world"])
    assert re.search(r"out +01:29 METEOR-M2 4 +7m28", text)
    assert "sort: next event" in text
    assert back == {"pass-head", "pass-list", "pass-sky", "pass-strip", "pass-timeline"}


def test_a_satellite_over_a_coast_has_its_name_on_it():
    others = (SubPoint("OVER THE BALTIC", 2, 57.0, 19.0, 500.0), SubPoint("OVER SUMATRA", 3, 0.0, 102.0, 500.0))
    _, cells = drawn(followed(0.0, -140.0, satellites=others))
    text = "\n".join(rows_of(cells))
    assert "OVER THE BALTIC" in text
    assert "OVER SUMATRA" in text


def test_the_dish_keeps_its_name_where_the_ring_runs_close_around_it():
    _, cells = drawn(followed(46.0, 5.2, 250.0, observer=HERE))
    text = "\n".join(rows_of(cells))
    assert "Utrecht" in text
    assert "METEOR" in text.rsplit("\n", 1)[0]
