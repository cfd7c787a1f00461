"""The page of passes in the app: what a person reads and does there."""

import re
from dataclasses import replace

import pytest
import sky_stand_in
from birdcage.station.requests import Unwatch, Watch
from birdcage_tui.passes.figures import PassFigures
from birdcage_tui.passes.head import PassHeadRow
from birdcage_tui.passes.listing import PassList
from birdcage_tui.passes.plot import PassSky
from birdcage_tui.passes.strip import PassStrip
from birdcage_tui.passes.timeline import WIDE_NAME, Timeline
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.status import BadDayRow, StatusLine, StopButton
from stage import read, run
from stand_in import text_of
from textual.widgets import Input

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]


def on_page(test, size=(80, 24), name="idle", *, sky=None, **options):
    return run(test, name, size, key="f7", sky=sky or sky_stand_in.make(), **options)


async def listed(app, _pilot):
    """What stands in the list's frame, in one line."""
    rows = ("".join(segment.text for segment in strip).strip() for strip in app.query_one(PassList)._strips)
    return " ".join(filter(None, rows))


async def pressed(app, pilot, *keys):
    for key in keys:
        await pilot.press(key)
        await pilot.pause()
    app.paint()
    await pilot.pause()
    return text_of(app)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("keys", [(), ("v",), ("v", "v"), ("v", "v", "v"), ("slash",)], ids=str)
def test_every_pane_lies_inside_the_screen(size, keys):
    async def regions(app, pilot):
        await pressed(app, pilot, *keys)
        kinds = (
            PassHeadRow,
            PassList,
            PassSky,
            PassStrip,
            PassFigures,
            Timeline,
            StatusLine,
            StopButton,
            BadDayRow,
            KeyBar,
        )
        panes = [app.query_one(kind) for kind in kinds]
        return {
            type(pane).__name__: pane.region for pane in panes if pane.display and pane.region.area
        }, app.screen.region

    found, screen = on_page(regions, size)
    wanted = {"PassHeadRow", "PassList", "StatusLine", "StopButton", "BadDayRow", "KeyBar"}
    if size[0] >= 100:
        wanted |= {"PassSky", "PassFigures" if keys.count("v") % 2 else "PassStrip", "Timeline"}
    else:
        wanted |= {("PassSky", "PassStrip", "PassFigures", "Timeline")[keys.count("v")]}
    assert set(found) == wanted
    panes = list(found.items())
    for index, (what, region) in enumerate(panes):
        assert screen.contains_region(region), f"{what} {region}"
        for other, second in panes[index + 1 :]:
            assert not region.overlaps(second), f"{what} lies over {other}"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_person_reads_what_comes_next(size):
    text = on_page(read, size)
    assert re.search(r"out +01:29 METEOR-M2 4 +7m28 +71°", text), text
    assert re.search(r"reach +05:23 NOAA 20.* 8m20 +44°", text)
    assert re.search(r"AOS +36:00 TERRA +none +11°", text)
    for words in ("now 12:00:00Z", "43 of 43", "demo orbits", "out of reach in 01:29", "7m28 in reach, best 65°"):
        assert words in text
    assert "NOT NOW" not in text


def test_larger_screens_say_why_a_pass_is_lost_and_show_its_times():
    text = on_page(read, (160, 48))
    assert re.search(r"METEOR-M2 4 .*◍ ceiling", text)
    assert re.search(r"TERRA .*○ floor", text)
    for words in ("AOS  11:56:00 341.0°", "LOS  12:10:00 158.0°", "ceiling 12:01:29, 3m09", "12:04:38 to 12:08:22"):
        assert words in text
    assert "Timeline of favourites" in text


def test_a_chosen_pass_is_drawn_and_stays_chosen_in_another_order():
    async def choose(app, pilot):
        first = await pressed(app, pilot, "down", "down")
        other = await pressed(app, pilot, "s", "s")
        back = await pressed(app, pilot, "home")
        return first, other, back

    first, other, back = on_page(choose)
    assert "ISS (ZARYA)  25544" in first
    assert "in reach in 14:00" in first
    assert "ISS (ZARYA)  25544" in other
    assert "sort: highest" in other
    assert "SUOMI NPP  37849" in back, "Home follows what stands first"


def test_a_click_chooses():
    async def click(app, pilot):
        await pilot.click(PassList, offset=(20, 3))
        return await pressed(app, pilot)

    assert "NOAA 20 (JPSS-1)  43013" in on_page(click)


def test_the_filter_works_as_one_types_and_esc_clears_it():
    async def type_it(app, pilot):
        await pressed(app, pilot, "slash")
        assert isinstance(app.focused, Input)
        typing = await pressed(app, pilot, *"metop")
        kept = await pressed(app, pilot, "enter")
        assert isinstance(app.focused, PassList)
        await pressed(app, pilot, "slash", *"zzz")
        nothing = await listed(app, pilot)
        cleared = await pressed(app, pilot, "escape")
        return typing, kept, nothing, cleared

    typing, kept, nothing, cleared = on_page(type_it)
    assert "2 of 43" in typing
    assert "2 of 43" in kept
    assert '/ "metop"' in kept
    assert 'No pass matches "zzz".' in nothing
    assert "43 of 43" in cleared


def test_only_what_is_in_reach_and_only_favourites():
    async def hide(app, pilot):
        reach = await pressed(app, pilot, "r")
        both = await pressed(app, pilot, "F")
        return reach, both

    reach, both = on_page(hide)
    assert "TERRA" not in reach
    assert "in reach only" in reach
    assert "7 of 43" in both


def test_only_what_the_feed_hears():
    async def hide(app, pilot):
        return await pressed(app, pilot, "h"), await pressed(app, pilot, "h")

    heard, again = on_page(hide, (160, 48))
    assert "3 of 43" in heard
    assert "heard by helix" in heard
    assert "sends 137.9 MHz LRPT" in heard
    assert "43 of 43" in again
    first = on_page(read, sky=sky_stand_in.make(hear_first=True))
    assert "3 of 43" in first, "it is on where the user has said which feed is mounted"


def test_a_feed_without_a_band_hears_nobody_knows_what():
    async def hide(app, pilot):
        return await pressed(app, pilot, "h")

    text = on_page(hide, sky=sky_stand_in.make(feed=""))
    assert "The feed has no band" in text
    assert "43 of 43" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_age_of_the_elements_is_told(size):
    text = on_page(read, size)
    assert "◐ elements 1 d old" in text


# The time machine.


def test_another_moment_is_marked_and_one_key_leads_back():
    async def travel(app, pilot):
        ahead = await pressed(app, pilot, "right_square_bracket", "right_curly_bracket")
        head = app.query_one(PassHeadRow)
        inked = sum(len(one.text) for one in head._strips[0] if one.style == head.inks["warn-row"])
        buttons = sum(region.width for region, command in head.hot if command not in ("pass-sort", "pass-filter"))
        still = await pressed(app, pilot, "z")
        app.session.clock.advance(30.0)
        later = await pressed(app, pilot)
        back = await pressed(app, pilot, "n")
        return ahead, inked == head.size.width - buttons, still, later, back

    ahead, marked, still, later, back = on_page(travel)
    assert "▲ NOT NOW  12:31:00Z, 31 min ahead, 1x" in ahead
    assert marked, "the whole row is in the colour of a warning"
    assert "NOAA 20" not in ahead, "it is over by then"
    assert re.search(r"reach +02:13 METOP-C", ahead)
    assert "12:31:00Z, 31 min ahead, paused" in still
    assert "12:31:00Z" in later
    assert "now 12:00:30Z" in back
    assert "NOT NOW" not in back


def test_the_time_machine_touches_neither_clock_nor_dish():
    async def travel(app, pilot):
        before = app.session.clock.utc()
        await pressed(app, pilot, "right_curly_bracket", "full_stop", "full_stop", "e", "left_square_bracket")
        moved = [each for each in app.station.asked if not isinstance(each, Watch | Unwatch)]
        return before == app.session.clock.utc(), moved, text_of(app).splitlines()[0]

    same, moved, status = on_page(travel)
    assert same
    assert not moved
    assert "12:00:00Z" in status, "the status line shows the clock's time, always"


def test_jumps_go_from_event_to_event_of_the_chosen_pass():
    async def jump(app, pilot):
        await pressed(app, pilot, "down")
        return [await pressed(app, pilot, "e") for _ in range(5)]

    texts = on_page(jump)
    found = [re.search(r"NOT NOW  (\S+)Z", text)[1] for text in texts]
    assert found[0] == "12:03:00", "NOAA 20 rises"
    assert found == sorted(found)
    assert all("NOAA 20 (JPSS-1)  43013" in text for text in texts)
    assert "No more events before it sets." in texts[-1]


def test_time_runs_faster():
    async def hurry(app, pilot):
        await pressed(app, pilot, "full_stop", "full_stop")
        app.session.clock.advance(10.0)
        return await pressed(app, pilot)

    assert "12:10:00Z, 9 min 50 s ahead, 60x" in on_page(hurry)


def test_the_mouse_scrubs_the_timeline():
    async def scrub(app, pilot):
        pane = app.query_one(Timeline)
        column = WIDE_NAME + 40
        await pilot.mouse_down(Timeline, offset=(column + 1, 3))
        await pilot.hover(Timeline, offset=(column + 11, 3))
        await pilot.mouse_up(Timeline, offset=(column + 11, 3))
        text = await pressed(app, pilot)
        return pane._column(app.query_one(PassHeadRow)._selection.time(app.view())), text

    column, text = on_page(scrub, (120, 36))
    assert column == 50
    assert "NOT NOW" in text


# Favourites and files.


def test_a_favourite_is_marked_and_undone():
    async def mark(app, pilot):
        await pressed(app, pilot, "down", "asterisk")
        marked = text_of(app)
        undone = await pressed(app, pilot, "u")
        return marked, undone, app.sky.source.favourites

    marked, undone, asked = on_page(mark)
    assert asked == [(43013, True), (43013, False)]
    assert re.search(r"▶★ reach +05:23 NOAA 20", marked)
    assert "NOAA 20 (JPSS-1) is a favourite. u: undo." in marked
    assert re.search(r"▶  reach +05:23 NOAA 20", undone)


def test_what_is_listed_is_written():
    async def export(app, pilot):
        text = await pressed(app, pilot, "slash", *"metop", "enter", "x")
        return [row.name for row in app.sky.source.exported[0]], text

    names, text = on_page(export)
    assert names == ["METOP-C", "METOP-C"]
    assert "Wrote 2 passes." in text


# Nothing to show.


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"rows": (), "searched": None}, ("Reading the catalogue",)),
        ({"rows": (), "searched": 0.3}, ("Searching 43 satellites",)),
        ({"rows": (), "satellites": 0}, ("holds no satellites", "birdcage elements update")),
        ({"rows": ()}, ("No passes soon: 43 satellites searched.",)),
        ({"problem": "The sky stopped."}, ("The sky stopped.",)),
    ],
)
def test_an_empty_page_says_what_to_do(changes, words):
    if "problem" in changes:
        changes = {**changes, "rows": ()}
    text = on_page(listed, sky=sky_stand_in.make(**changes))
    for each in words:
        assert each in text


def test_without_a_place_the_page_names_the_key_that_sets_it():
    async def look(app, pilot):
        app.settings = replace(app.settings, place=None)
        await pressed(app, pilot)
        return await listed(app, pilot)

    text = on_page(look, sky=sky_stand_in.make(rows=(), searched=None))
    assert "No location set. L sets it." in text


def test_elements_that_ship_are_said_to_be_no_use_to_a_dish():
    note = "These are the 40 sets that ship with birdcage, the newest of 2026-03-01. They are too old for pointing."
    sky = sky_stand_in.make(note=note, source="elements that ship")
    assert "▲ elements that ship" in on_page(read, sky=sky)
    text = on_page(listed, sky=sky)
    assert "the newest of 2026-03-01. They are too old for pointing." in text
    assert "birdcage elements update" in text
    assert "METOP-C" not in run(read, "idle", (160, 48), sky=sky), "the dashboard announces none of them"


# Calm.


def test_a_second_changes_only_what_counts_down():
    async def tick(app, pilot):
        asked = []
        app.session.clock.advance(0.2)
        app.paint()
        for pane in app.query("PassesPage Pane"):
            pane.refresh = lambda *regions, pane=pane, **_: asked.append((type(pane).__name__, len(regions)))
        app.paint()
        still = list(asked)
        app.session.clock.advance(1.0)
        app.paint()
        return still, dict(asked)

    still, asked = on_page(tick, (120, 36))
    assert still == []
    assert asked["PassHeadRow"] == 1
    assert asked["PassList"] <= 8, "countdowns above an hour change once a minute"
    assert "Timeline" not in asked


# What is hidden is told.


@pytest.mark.parametrize("keys", [(), ("right_square_bracket",)], ids=str)
def test_no_filter_hides_passes_unsaid_on_a_small_screen(keys):
    async def hide(app, pilot):
        await pressed(app, pilot, *keys, "r", "F", "slash", *"metop", "enter")
        return app.query_one(PassHeadRow)._strips[0].text

    head = on_page(hide)
    assert "3 filters" in head or all(words in head for words in ('"metop"', "in reach only", "favourites only"))


def test_what_stays_up_is_left_out_and_counted_but_found_by_name():
    table = sky_stand_in.rows()
    fixed = sky_stand_in.changed(table[0], name="GEO 95W", norad_id=9, already_up=True, still_up=True)

    async def find(app, pilot):
        before = await pressed(app, pilot)
        return before, await pressed(app, pilot, "slash", *"geo", "enter")

    before, found = on_page(find, sky=sky_stand_in.make(rows=(*table, fixed)))
    assert "43 of 43, 1 always up left out" in before
    assert "GEO 95W" not in before
    assert re.search(r"GEO 95W", found)


def test_the_end_of_the_search_is_no_event():
    table = sky_stand_in.rows()
    last = sky_stand_in.changed(table[1], still_up=True)
    end_s = last.los_s
    held = sky_stand_in.changed(last, reach=sky_stand_in.in_reach((last.aos_s + 60.0, end_s), best=40.0))
    assert held.next_event(last.aos_s) == (last.aos_s + 60.0, "reach")
    assert held.next_event(last.aos_s + 90.0) is None, "nobody knows when it ends"
    assert "LOS" not in [word for _, word in held.events()]


def test_a_typed_time_is_shown_and_a_wrong_one_is_answered():
    async def typed(app, pilot):
        await pressed(app, pilot, "t", *("n", "o", "o", "n"), "enter")
        wrong = text_of(app)
        await pressed(app, pilot, *["backspace"] * 4, "plus", "2", "0", "m", "enter")
        return wrong, await pressed(app, pilot)

    wrong, after = on_page(typed, (120, 36))
    assert "▲ Type 21:30, +1h30" in wrong
    assert "12:20:00" in after
    assert "12:00:00Z" in after  # the clock itself
