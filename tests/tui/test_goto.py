"""The go-to line: what may be typed, what it means, and what is said before Enter."""

import re
import textwrap
from dataclasses import replace

import pytest
import stand_in
import track_stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.no_go import NoGoSector
from birdcage.base.presets import Preset
from birdcage.pursuit.now import Located
from birdcage.rotator.facts import CableTurn
from birdcage.sky.targets.direction import AxisWish, Wish, read_direction
from birdcage.station.requests import Goto
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.goto.goto_line import GotoLine, foretell
from birdcage_tui.goto.goto_target import aim_of
from birdcage_tui.goto.goto_text import GotoAim, resolve
from birdcage_tui.shown.unready import NO_LOCATION
from birdcage_tui.shown.view import View
from stage import run
from textual.widgets import Input

PRESETS = (Preset("Wall", 10.0, 20.0), Preset("Astra 28.2E", 151.3, 27.2), Preset("Astra 19.2E", 160.0, 30.0))


@pytest.mark.parametrize(
    ("typed", "az", "el"),
    [
        ("180 45", AxisWish(180), AxisWish(45)),
        ("180,45", AxisWish(180), AxisWish(45)),
        ("180, 45", AxisWish(180), AxisWish(45)),
        ("180/45", AxisWish(180), AxisWish(45)),
        ("180;45", AxisWish(180), AxisWish(45)),
        ("231.4,44", AxisWish(231.4), AxisWish(44)),
        ("231.4 44.25", AxisWish(231.4), AxisWish(44.25)),
        (" 180°  45° ", AxisWish(180), AxisWish(45)),
        ("180°/45°", AxisWish(180), AxisWish(45)),
        ("180,5 45", AxisWish(180.5), AxisWish(45)),
        ("180,5 45,25", AxisWish(180.5), AxisWish(45.25)),
        ("180,5/45", AxisWish(180.5), AxisWish(45)),
        ("az=180", AxisWish(180), None),
        ("AZ = 180", AxisWish(180), None),
        ("az 180", AxisWish(180), None),
        ("azimuth: 180", AxisWish(180), None),
        ("el=40", None, AxisWish(40)),
        ("el=+3", None, AxisWish(3, True)),
        ("el=-3", None, AxisWish(-3, True)),
        ("az=180 el=40", AxisWish(180), AxisWish(40)),
        ("el=40 az=180", AxisWish(180), AxisWish(40)),
        ("az=180,el=40", AxisWish(180), AxisWish(40)),
        ("az=180 el=40,5", AxisWish(180), AxisWish(40.5)),
        ("az=+5 el=-2", AxisWish(5, True), AxisWish(-2, True)),
        ("S", AxisWish(180), None),
        ("ssw", AxisWish(202.5), None),
        ("NNW", AxisWish(337.5), None),
        ("S 40", AxisWish(180), AxisWish(40)),
        ("S,40", AxisWish(180), AxisWish(40)),
        ("S +3", AxisWish(180), AxisWish(3, True)),
        ("az=180 +3", AxisWish(180), AxisWish(3, True)),
        ("+5", AxisWish(5, True), None),
        ("-5", AxisWish(-5, True), None),
        ("−5", AxisWish(-5, True), None),
        ("+5 -2", AxisWish(5, True), AxisWish(-2, True)),
        ("+5,-2", AxisWish(5, True), AxisWish(-2, True)),
        ("+.5", AxisWish(0.5, True), None),
        ("0 90", AxisWish(0), AxisWish(90)),
        ("360 45", AxisWish(360), AxisWish(45)),
    ],
)
def test_what_may_be_typed(typed, az, el):
    assert read_direction(typed) == Wish(az, el)


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("", "Type where to: 180 45"),
        ("   ", "Type where to: 180 45"),
        ("231", "Type two numbers, 231 45; or az=231"),
        ("north up", "north up is not a direction or preset. Type 180 45"),
        ("1 2 3", "only azimuth and elevation"),
        ("S N", "is not a direction"),
        ("E 40", "E 40 may be a direction or a place on the arc: type az 90 el 40, or 40E."),
        ("nan 5", "nan 5 is not a direction"),
        ("inf 5", "inf 5 is not a direction"),
        ("1e3 5", "1e3 5 is not a direction"),
        ("400 45", "more than a full turn. Type 0 to 360."),
        ("+200", "more than half a turn"),
        ("180 999", "Elevation 999 is out of range"),
        ("231,4,44", "has two meanings. Type 180.5 45"),
        ("231,4,44,5", "has two meanings"),
        ("az=180,5", "has two meanings"),
        ("1.180,5 40", "has two meanings"),
        ("az=180 az=190", "Azimuth appears twice"),
        ("az=", "is not a direction"),
        ("Astra", "Astra is not a direction or preset"),
        ("5 --2", "--2 is not a direction"),
    ],
)
def test_what_is_refused_says_what_to_type(typed, says):
    with pytest.raises(ValueError, match=re.escape(says)) as wrong:
        aim_of(typed, view_of())
    assert len(str(wrong.value)) <= 100, "it fits into a line"


@pytest.mark.parametrize(("typed", "name"), [("wall", "Wall"), ("WALL", "Wall"), ("astra 28", "Astra 28.2E")])
def test_a_presets_name_or_the_only_one_that_begins_so(typed, name):
    assert aim_of(typed, view_of()).name == name


def test_a_wind_is_never_a_preset():
    view = replace(view_of(), presets=(Preset("S", 1.0, 2.0),))
    assert aim_of("S", view).az_deg == 180.0


def test_relative_ones_count_from_the_last_commanded_target():
    state = stand_in.slewing(VirtualClock())
    assert resolve(read_direction("+5 -2"), state) == GotoAim(pytest.approx(165.7), pytest.approx(38.21))
    assert resolve(read_direction("az=20"), state) == GotoAim(20.0, 40.21)


def test_without_a_target_they_count_from_the_position():
    state = replace(stand_in.at_rest(VirtualClock()), target_az_deg=None, target_el_deg=None)
    assert resolve(read_direction("+180"), state) == GotoAim(pytest.approx(9.16), 42.87)
    assert resolve(read_direction("el=+1"), state) == GotoAim(189.16, 43.87)


def test_with_neither_they_are_refused_and_whole_ones_are_not():
    state = stand_in.not_homed(VirtualClock())
    with pytest.raises(ValueError, match="unknown"):
        resolve(read_direction("S"), state)
    assert resolve(read_direction("180 45"), state) == GotoAim(180.0, 45.0)


def view_of(state_of=stand_in.at_rest, **changes):
    clock = VirtualClock()
    state = replace(state_of(clock), **changes)
    return View(state, clock.monotonic(), clock.utc(), AppOptions(), presets=PRESETS)


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("231.4 44", ("az 231.40° SW", "el 44.00°", "42.24° clockwise", "1.13° up", " s")),
        ("-5", ("az 184.16°", "5.00° counterclockwise", "elevation stays")),
        ("el=40", ("azimuth stays", "2.87° down")),
        ("wall", ("Wall: az 10.00° N", "el 20.00°")),
    ],
)
def test_while_typing_it_says_where_how_far_and_how_long(typed, words):
    ink, said = foretell(typed, view_of())
    assert ink == "text"
    assert said.startswith("Enter: "), "no sign that reads as a failure"
    for word in words:
        assert word in said, said


def test_how_long_follows_the_dishs_own_speed():
    seconds = [float(re.search(r"([\d.]+) s$", foretell(f"+{way}", view_of())[1]).group(1)) for way in (1, 20, 100)]
    assert seconds == sorted(seconds)
    assert 0.0 < seconds[0] < seconds[2] < 10.0


@pytest.mark.parametrize(
    ("typed", "changes", "says"),
    [
        ("180 10", {}, "Elevation 10.00° is 8.00° below the floor of 18.00°. Type 18 to 65."),
        ("180 70.5", {}, "Elevation 70.50° is 5.50° above the limit of 65.00°."),
        (
            "300 40",
            {"cable_min_deg": -130.0, "cable_max_deg": -100.0},
            "Azimuth 300.00° would turn the cable 90.84° beyond its stop at -100°.",
        ),
        (
            "120 40",
            {"cable_min_deg": -130.0, "cable_max_deg": -100.0},
            "Azimuth 120.00° would turn the cable 59.16° beyond its stop at -130°.",
        ),
        (
            "250 25",
            {"no_go_sectors": (NoGoSector(220.0, 240.0, 30.0),)},
            "no-go sector 220° to 240°, 5.00° too low. Go above 30° first.",
        ),
        (
            "250 25",
            {"no_go_sectors": (NoGoSector(220.0, 240.0, 30.0, "mast"),)},
            "no-go sector 220° to 240° (mast), 5.00° too low",
        ),
        ("180 10", {"homed": False, "position": None}, "Home it first"),
    ],
)
def test_a_limit_is_named_with_how_far_beyond_it_before_enter(typed, changes, says):
    ink, said = foretell(typed, view_of(**changes))
    assert ink == "warn"
    assert "Refused: " in said
    assert says in said


def test_a_sector_is_no_hindrance_above_it_or_the_other_way_round():
    sector = {"no_go_sectors": (NoGoSector(220.0, 240.0, 30.0),)}
    assert foretell("250 40", view_of(**sector))[0] == "text"
    assert foretell("150 25", view_of(**sector))[0] == "text"


def test_the_long_way_round_is_told_when_the_cable_leaves_no_other():
    assert "210.00° counterclockwise" in foretell("339.16 40", view_of())[1]


def test_a_user_s_stop_on_the_way_that_the_dish_takes_is_named():
    """Another way round would fit, but the dish does not take it by itself."""
    ink, said = foretell("300 40", view_of(cable_min_deg=-400.0, cable_max_deg=-100.0))
    assert ink == "warn"
    assert "would turn the cable 90.84° beyond its stop at -100°" in said


def of_unknown_turn(**changes):
    position = stand_in.at_rest(VirtualClock()).position
    return view_of(position=replace(position, cable_deg=None), turn=CableTurn.UNKNOWN, **changes)


def test_both_ways_round_are_told_while_the_turn_of_the_cable_is_unknown():
    said = foretell("10 40", of_unknown_turn())[1]
    assert "179.16° CCW or 180.84° CW" in said
    assert re.search(r"up to [\d.]+ s$", said)
    assert len(textwrap.wrap(said, 78)) <= 2
    assert "5.00° counterclockwise" in foretell("-5", of_unknown_turn())[1], "no turn of the cable makes that another"


def test_a_sector_on_either_way_round_is_named_while_the_turn_of_the_cable_is_unknown():
    ink, said = foretell("10 25", of_unknown_turn(no_go_sectors=(NoGoSector(220.0, 240.0, 30.0),)))
    assert ink == "warn"
    assert "may pass (cable turn unknown) the no-go sector 220° to 240°" in said


@pytest.mark.parametrize("name", ["held", "lost", "not-homed", "fault", "refused"])
def test_what_forbids_every_motion_is_said_first(name):
    assert "Refused" in foretell("180 40", view_of(stand_in.STATES[name]))[1]


@pytest.mark.parametrize("size", [(80, 24), (120, 36)])
def test_the_line_lies_over_the_last_rows_and_moves_nothing(size):
    async def open_it(app, pilot):
        pages = app.query_one("#pages").region
        await pilot.press("g", *"300")
        await pilot.pause()
        line = app.query_one(GotoLine).region
        assert app.query_one("#pages").region == pages
        assert line.bottom == size[1]
        assert line.height == 3
        return stand_in.text_of(app).splitlines()

    rows = run(open_it, size=size)
    assert "go to" in rows[-3]
    assert "Type two numbers, 300 45" in rows[-2]


def test_the_preview_follows_each_letter_and_enter_sends_what_it_said():
    async def go(app, pilot):
        app.show_page("control")
        await pilot.pause()
        await pilot.pause()
        before = app.focused
        await pilot.press("g", "plus", "5")
        await pilot.pause()
        text = stand_in.text_of(app)
        await pilot.press("space", "minus", "2")
        await pilot.pause()
        other = stand_in.text_of(app)
        await pilot.press("enter")
        await pilot.pause()
        assert app.focused is before is not None
        assert app.focused.id == "rose"
        return text, other, app.station.asked_for(Goto)

    text, other, asked = run(go)
    assert "az 194.16° SSW, el 42.87°   5.00° clockwise, elevation stays" in text
    assert "el 40.87°" in other
    assert asked == [Goto(pytest.approx(194.16), pytest.approx(40.87), "you")]


def test_what_cannot_be_read_stays_and_is_explained():
    async def go(app, pilot):
        await pilot.press("g", *"231", "enter")
        await pilot.pause()
        return app.query_one(Input).value, stand_in.text_of(app), app.station.asked_for(Goto)

    value, text, asked = run(go)
    assert value == "231"
    assert "Type two numbers, 231 45; or az=231, or el=231." in text
    assert asked == []


def test_esc_gives_the_focus_back_and_ctrl_c_stops():
    async def leave(app, pilot):
        app.show_page("control")
        await pilot.pause()
        await pilot.pause()
        await pilot.press("g", "1", "ctrl+c")
        stops = list(app.station.stops)
        await pilot.press("escape")
        return stops, app.focused.id, app.station.asked_for(Goto)

    assert run(leave) == (["you"], "rose", [])


def test_a_slot_is_foretold_with_its_skew():
    skew = "Skew -14.0° geometry +7.0° slot = -7.0°"
    located = Located("28.2E", "28.2°E Astra 28", True, 157.66, 29.28, skew=skew)
    ink, words = foretell("28.2E", replace(view_of(), track=track_stand_in.desk(None, located=located)))
    assert (ink, words.rpartition("   ")[2]) == ("text", skew)
    assert len(textwrap.wrap(words, 78)) <= 2, "the preview has two rows"


@pytest.mark.parametrize(
    ("state_of", "says"), [(stand_in.at_rest, "Esc, then L, sets it."), (stand_in.slewing, "Tab, Enter, then L, sets")]
)
def test_without_a_location_the_keys_named_work_in_the_line(state_of, says):
    located = Located("moon", "", False, None, None, problem=NO_LOCATION)
    view = replace(view_of(state_of), track=track_stand_in.desk(None, located=located))
    assert foretell("moon", view)[1].startswith(f"▲ No location set. {says}")
