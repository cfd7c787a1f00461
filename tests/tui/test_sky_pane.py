"""The polar sky: what is up now, Sun and Moon, the horizon; and the passes that come next, beside it."""

import re
from dataclasses import replace

import pytest
import sky_stand_in
import stand_in
from birdcage.base.beam import Beam
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.polar import Polar
from birdcage_tui.drawing.themes import LOOKS
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.panes.sky_up import draw_up
from birdcage_tui.shown.sky_picture import Up
from stage import read, run


def drawn(up, width=70, height=34, **changes):
    """The marks of these satellites alone, and what stands in which cell."""
    view = type("V", (), {"sky": sky_stand_in.picture(up=tuple(up), **changes)})
    cells = Cells(width, height)
    named = draw_up(cells, Polar(width, height), view)
    return ["".join(row) for row in cells._chars], named


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_what_is_up_is_on_the_map_with_sun_and_moon(size):
    text = run(read, "idle", size, sky=sky_stand_in.make())
    sky = "\n".join(line[: size[0] // 2 + 10] for line in text.splitlines()[2:-1])
    for sign in "☼☾":
        assert sky.count(sign) == 1
    assert "METEOR-M2 4" in sky
    assert sky.count("•") >= 10, "satellites and slots"


def test_what_is_below_the_horizon_is_not_drawn():
    rows, named = drawn([], sun=(171.0, -3.0), moon=(77.0, -20.0))
    assert not any(sign in row for row in rows for sign in "☼☾•")
    assert named == {}


def test_names_never_touch_and_a_favourite_is_named_first():
    crowd = [Up(f"SAT {number}", number, 180.0 + number * 3, 45.0) for number in range(30)]
    crowd.append(Up("MINE", 99, 225.0, 45.0, favourite=True))
    rows, named = drawn(crowd, sun=None, moon=None)
    text = "\n".join(rows)
    assert "MINE" in text
    names = re.findall(r"SAT \d+", text)
    assert len(names) == len(set(names)) < 20
    assert not re.search(r"SAT \d+(?![\d\s])|\SSAT|SAT \d+ ?SAT", text)
    assert any("MINE" in name for name in named.values())


def test_in_a_crowd_only_favourites_are_named_but_everything_is_drawn():
    crowd = [Up(f"SAT {number}", number, number * 1.7 % 360, 10.0 + number % 70) for number in range(200)]
    rows, named = drawn([*crowd, Up("MINE", 999, 20.0, 50.0, favourite=True)], sun=None, moon=None)
    text = "\n".join(rows)
    assert "SAT" not in text
    assert "MINE" in text
    assert text.count("•") == len(named) > 90, "one a cell"
    assert sum(len(name.split(", ")) for name in named.values()) == 201, "under the mouse each has its name"


def test_a_satellite_that_stands_on_the_arc_keeps_the_name_of_its_slot():
    rows, _ = drawn([Up("ASTRA 1", 1, 180.0, 45.0, fixed=True)], sun=None, moon=None)
    text = "\n".join(rows)
    assert "•" in text
    assert "ASTRA" not in text


def test_no_dot_stands_in_a_name():
    crowd = tuple(Up(f"SAT {number}", number, 100.0 + number * 0.37 % 160, 25.0 + number % 25) for number in range(430))
    for size in ((80, 24), (120, 36), (160, 48)):
        text = run(read, "idle", size, sky=sky_stand_in.make(up=crowd))
        assert not re.search(r"[A-Za-z0-9°]•[A-Za-z0-9]", text), text


def test_among_thousands_of_passes_favourites_come_first():
    table = [sky_stand_in.changed(sky_stand_in.rows()[0], name=f"DEBRIS {number}", norad_id=number, favourite=False)
             for number in range(200)]  # fmt: skip
    mine = next(row for row in sky_stand_in.rows() if row.name.startswith("NOAA 20"))
    sky = sky_stand_in.make(rows=(*table, replace(mine, favourite=True)))
    text = run(read, "idle", (120, 36), sky=sky)
    assert text.index("NOAA 20") < text.index("DEBRIS"), text


def test_a_satellite_leaves_a_trail():
    def dots(trail):
        async def rows(app, pilot):
            return [str(strip) for strip in app.query_one(SkyPane)._strips]

        up = (Up("SAT", 1, 300.0, 40.0, trail=trail),)
        return run(rows, size=(120, 36), sky=sky_stand_in.make(up=up))

    assert dots(()) != dots(((290.0, 40.0), (293.0, 40.0), (296.0, 40.0)))


def test_a_name_is_read_out_under_the_mouse():
    async def hover(app, pilot):
        pane = app.query_one(SkyPane)
        x, y = next(cell for cell, name in pane._named.items() if name == "METEOR-M2 4")
        await pilot.hover(SkyPane, offset=(x + 1, y + 1))
        return pane.border_subtitle

    assert "METEOR-M2 4" in run(hover, size=(120, 36), sky=sky_stand_in.make())


def test_the_horizon_changes_the_map():
    def sky(mask):
        async def dots(app, pilot):
            return [str(strip) for strip in app.query_one(SkyPane)._strips]

        return run(dots, size=(120, 36), sky=sky_stand_in.make(up=(), mask=mask))

    assert sky(sky_stand_in.MASK) != sky(None)


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_the_dashboard_announces_what_comes_into_reach(size):
    text = run(read, "idle", size, sky=sky_stand_in.make())
    assert re.search(r"leaves in +01:29 +METEOR-M2 4 .*71° +│", text), text
    assert re.search(r"reach in +05:23 +NOAA 20", text)
    assert "TERRA" not in text, "what this dish cannot reach is no news"
    assert "At rest." in text


@pytest.mark.parametrize("state", ["fault", "lost", "silent", "not-homed", "held"])
def test_what_is_wrong_with_the_dish_comes_before_any_pass(state):
    without = run(read, state, (80, 24))
    text = run(read, state, (80, 24), sky=sky_stand_in.make())

    def sentences(screen):
        # Below the lowest dividing row of the right-hand frame.
        return [line[42:78].strip() for line in screen.splitlines()[16:-2] if line[42:78].strip()]

    told = sentences(without)
    assert sentences(text)[: len(told)] == told


def test_a_pass_on_the_dashboard_leads_to_the_page():
    async def click(app, pilot):
        pane = app.query_one("#next")
        region = next(region for region, command in pane.hot if command == "page-passes")
        await pilot.click(pane, offset=(region.x + 5, region.y + pane.gutter.top))
        await pilot.pause()
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    assert "Passes" in run(click, size=(120, 36), sky=sky_stand_in.make())


class Dots(Braille):
    """A canvas that remembers where its dots are."""

    def __init__(self):
        super().__init__(60, 40)
        self.at = []

    def dot(self, x, y, ink):
        self.at.append((x, y))


def test_the_beam_is_drawn_as_wide_each_way_as_it_is():
    def spans(az_deg, el_deg, beam):
        canvas = Dots()
        polar = Polar(60, 40)
        polar.beam(canvas, az_deg, el_deg, beam, "accent", least=4.0)
        if not canvas.at:
            return None
        across, along = zip(*canvas.at, strict=True)
        return [(max(side) - min(side)) / polar.radius * 90.0 for side in (across, along)]

    near_zenith = 88.0
    wide, high = spans(180.0, near_zenith, Beam(14.8, 21.3))
    assert (wide, high) == (pytest.approx(14.8, abs=1.0), pytest.approx(21.3, abs=1.0))
    # To the east the same beam lies on its side: its elevation is left to right there.
    wide, high = spans(90.0, near_zenith, Beam(14.8, 21.3))
    assert (wide, high) == (pytest.approx(21.3, abs=1.0), pytest.approx(14.8, abs=1.0))
    assert spans(180.0, 45.0, Beam(2.0, 2.9)) is None, "it hides under the dish's own mark"


@pytest.mark.parametrize("theme", LOOKS)
@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_what_is_drawn_by_old_elements_is_marked_and_the_sign_explained(size, theme):
    mine = Up("MINE", 1, 250.0, 45.0, favourite=True)

    def shown(*up, glyphs="braille"):
        async def rows(app, _pilot):
            pane = app.query_one(SkyPane)
            inks = pane._cells._inks
            found = ["".join(row) for row in pane._cells._chars]
            signs = [(x, y) for y, row in enumerate(found) for x, char in enumerate(row) if char == "?"]
            return "\n".join(found), [inks[y][x] for x, y in signs], str(pane.border_subtitle)

        return run(rows, "idle", size, theme=theme, glyphs=glyphs, sky=sky_stand_in.make(up=up, sun=None, moon=None))

    text, _, legend = shown(mine)
    assert "?" not in text
    assert "MINE 45.0°" in text
    assert "old" not in legend
    text, inks, legend = shown(replace(mine, old=True))
    assert text.count("?") == 1
    assert inks == ["dim"]
    assert "MINE" in text
    assert "45.0°" not in text, "nothing says that it stands there"
    assert "?" in legend
    assert "old" in legend


def test_the_legend_is_there_again_when_the_mouse_has_gone():
    async def move(app, pilot):
        pane = app.query_one(SkyPane)
        legend = str(pane.border_subtitle)
        await pilot.hover(SkyPane, offset=(20, 10))
        over = str(pane.border_subtitle)
        await pilot.hover("StatusLine")
        return legend, over, str(pane.border_subtitle)

    legend, over, after = run(move, sky=sky_stand_in.make(up=(Up("SAT", 1, 250.0, 45.0, old=True),)))
    assert "AZ" in over
    assert after == legend != ""


def test_no_pass_by_useless_elements_is_announced():
    useless = replace(sky_stand_in.AGE, useless=True)
    rows = [replace(row, age=useless if row.name == "ISS (ZARYA)" else row.age) for row in sky_stand_in.rows()]
    text = run(read, "idle", (160, 48), sky=sky_stand_in.make(rows=tuple(rows)))
    assert "METOP-C" in text
    assert "ISS (ZARYA)" not in text
