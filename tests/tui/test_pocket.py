"""Below 80x24: everything a person at the dish needs, at every size from 40x12 up; status and STOP even below that."""

import asyncio
import itertools
from dataclasses import replace

import pytest
import stage
import stand_in
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.requests import AcknowledgeFault, Goto, Home, Jog, Release
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.pocket import reading
from birdcage_tui.pocket.keys import PocketKeys, StopBar
from birdcage_tui.pocket.pocket_layout import arrange
from birdcage_tui.pocket.reading import PocketReading
from birdcage_tui.shown.state_words import bad_day
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.status import StatusLine
from stage import read
from textual.widgets import OptionList

SIZES = [(40, 12), (40, 23), (50, 20), (60, 40), (79, 23), (79, 12), (120, 20), (160, 12), (43, 60)]


def run(test, name="idle", size=(40, 12), **options):
    return stage.run(test, name, size, **options)


async def press(app, pilot, *keys):
    for key in keys:
        await pilot.press(key)
        await pilot.pause()


async def click(app, pilot, words, *, last=False):
    """Click where these words stand on the screen."""
    rows = stand_in.text_of(app).splitlines()
    found = [(row.index(words), y) for y, row in enumerate(rows) if words in row]
    assert found, words
    x, y = found[-1 if last else 0]
    await pilot.click(offset=(x + len(words) // 2, y))
    await pilot.pause()


def squeezed(text):
    return " ".join(text.split())


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_everything_is_inside_the_screen_and_nothing_overlaps(size):
    async def regions(app, pilot):
        kinds = (StatusLine, PocketReading, PocketKeys, StopBar, SignalPane, SkyPane)
        shown = [
            widget
            for kind in kinds
            for widget in app.query(f"Screen > TopRow > {kind.__name__}, PocketPage {kind.__name__}")
        ]
        return [(type(one), one.region) for one in shown if one.display and one.region.area], app.screen.region

    for name, (found, screen) in stage.run_each(regions, size=size).items():
        assert {StatusLine, PocketReading, PocketKeys, StopBar} <= {kind for kind, _ in found}, name
        for kind, region in found:
            assert screen.contains_region(region), (name, kind)
        for (one, first), (other, second) in itertools.combinations(found, 2):
            assert not first.overlaps(second), (name, one, other)
        bar = next(region for kind, region in found if kind is StopBar)
        assert bar.width == screen.width, name
        assert bar.bottom == screen.bottom, name


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_first_questions_are_answered(size):
    text = run(read, "slewing", size)
    for words in (
        "G2 ●",
        "you",
        "12:00:00Z",
        "DEMO",
        "SLEWING 40.6° to go",
        "STOP should take 0.3 s",
        "CCW 303°",
        "143° CW",
    ):
        assert words in text, words
    for words in ("◀", "▲", "▼", "▶", "1°", "g go to", "H home", "? help", ": all", "■  S T O P"):
        assert words in text, words
    assert "480 counts" in text
    assert "┌───┘" in text or "┌─┘" in text, "big digits"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_what_is_wrong_is_told_to_the_last_word(size):
    async def told(app, pilot):
        pane = app.query_one(PocketReading)
        text = "\n".join("".join(segment.text for segment in strip) for strip in pane._strips)
        return squeezed(text), squeezed(bad_day(app.view())[1])

    wrong = ("held", "fault", "lost", "silent", "not-homed", "refused")
    for name, (text, words) in stage.run_each(told, wrong, size).items():
        assert words in text, name


def test_a_key_stands_beside_what_it_does(monkeypatch):
    words = "HELD by you. Enter release: nothing moves then   U resume LEO 1"
    monkeypatch.setattr(reading, "bad_day", lambda _view: ("warn", words))
    for columns in range(16, 80):
        _ink, rows = reading.wrong_rows(None, columns)
        assert " ".join(rows).split() == words.split()
        assert not any(row.split()[-1] in ("U", "Enter") for row in rows), rows


def test_the_stop_bar_stops_on_the_press_and_space_anywhere():
    async def stop(app, pilot):
        bar = app.query_one(StopBar)
        for x in (0, bar.size.width - 1):
            await pilot.mouse_down(bar, offset=(x, 0))
            await pilot.pause()
        pressed = list(app.station.stops)
        await press(app, pilot, "space")
        return pressed, app.station.stops

    pressed, stops = run(stop, "slewing")
    assert pressed == ["you", "you"]
    assert len(stops) == 3


@pytest.mark.parametrize("size", [(40, 12), (60, 40)], ids=str)
def test_jogging_by_key_and_by_thumb(size):
    async def jog(app, pilot):
        await press(app, pilot, "minus", "left", "k")
        await click(app, pilot, "▶")
        await click(app, pilot, "-]" if size == (40, 12) else "│-│")
        await click(app, pilot, "▼")
        await click(app, pilot, "[+" if size == (40, 12) else "│+│")
        return [(each.d_az_deg, each.d_el_deg) for each in app.station.asked_for(Jog)], app.motions.step_deg

    jogs, step_deg = run(jog, size=size)
    assert jogs == [(-0.5, 0.0), (0.0, 0.5), (0.5, 0.0), (0.0, -0.2)]
    assert step_deg == 0.5


@pytest.mark.parametrize("name", ["held", "fault"])
def test_what_is_wrong_is_a_touch_target_and_says_which_key(name):
    async def let_go(app, pilot):
        text = stand_in.text_of(app)
        await click(app, pilot, "HELD by" if name == "held" else "Azimuth stalled")
        await click(app, pilot, "Enter release" if name == "held" else "Enter acknowledge", last=True)
        return text, app.station.asked_for(Release if name == "held" else AcknowledgeFault)

    text, asked = run(let_go, name)
    assert "Enter" in text
    assert len(asked) == 2


def test_a_press_on_not_homed_asks_before_it_homes():
    async def home(app, pilot):
        await click(app, pilot, "NOT HOMED")
        before = list(app.station.asked_for(Home))
        text = stand_in.text_of(app)
        await click(app, pilot, "area is clear: home")
        return before, text, app.station.asked_for(Home)

    before, text, asked = run(home, "not-homed")
    assert before == []
    for words in ("12 V", "area is clear: home", "Esc  do nothing", "■ STOP"):
        assert words in text
    assert len(asked) == 1


def test_refused_keys_are_told_apart_without_colour():
    text = run(read, "held")
    assert "(" in next(row for row in text.splitlines() if "◀" in row)
    assert "[" in next(row for row in run(read).splitlines() if "◀" in row)
    assert "╎" in run(read, "held", (60, 40))
    assert "╎" not in run(read, "idle", (60, 40))


def test_width_makes_the_digits_larger():
    assert "┌───┘" in run(read, "slewing", (60, 40))
    assert "┌───┘" in run(read, "slewing", (120, 20))
    assert "┌───┘" not in run(read, "slewing", (50, 20))


def test_an_old_position_says_its_age():
    async def age(app, pilot):
        state, clock = app.station.state, app.session.clock
        clock.advance(5.0)
        app.station.state = replace(state, link=replace(state.link, last_reply=clock.monotonic()))
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    assert "5.2s old" in run(age)


def test_a_dish_without_signal_has_no_empty_frame():
    async def quiet(app, pilot):
        app.signals.book.of(TUNER_FACTS).clear()
        app.paint()
        await pilot.pause()
        await pilot.pause()
        return stand_in.text_of(app), app.query_one(SignalPane).display

    text, shown = run(quiet)
    assert not shown
    assert "Nothing heard" not in text
    assert "At rest." in text, "words take the room"
    assert run(quiet, size=(60, 40))[1] is False


def test_the_go_to_line_leaves_status_and_stop_in_sight():
    async def go(app, pilot):
        await press(app, pilot, "g", *"200", "space", *"40")
        text = stand_in.text_of(app)
        line, bar = app.query_one(GotoLine).region, app.query_one(StopBar).region
        await press(app, pilot, "enter")
        return text, line.overlaps(bar), app.station.asked_for(Goto)

    text, covered, asked = run(go)
    assert not covered
    assert "S T O P" in text
    assert "12:00:00Z" in text
    assert "200 40" in text
    assert [(each.az_deg, each.el_deg) for each in asked] == [(200.0, 40.0)]


@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("H", ("area is clear: home", "Esc  do nothing")),
        ("question_mark", ("The pocket view", "Space", "Esc closes")),
        ("colon", ("Type part of a command", "STOP")),
        ("semicolon", (" a ", " w ", "■ STOP")),
    ],
)
def test_dialogs_fit(key, words):
    async def opened(app, pilot):
        await press(app, pilot, key)
        await pilot.wait_for_scheduled_animations()
        return stand_in.text_of(app)

    text = run(opened)
    for each in words:
        assert each in text, text
    rows = text.splitlines()
    assert len(rows) == 12
    assert "G2 ●" in rows[0]


def test_a_long_question_scrolls_and_its_answers_do_not():
    async def ask(app, pilot):
        app.push_screen(QuestionScreen("Release", "It may fall. " * 40 + "Last words.", "release"))
        await pilot.pause()
        before = stand_in.text_of(app)
        await press(app, pilot, "end")
        await pilot.wait_for_scheduled_animations()
        return before, stand_in.text_of(app)

    before, after = run(ask)
    assert "Last words." not in before
    assert "Last words." in after
    for text in (before, after):
        assert "y   release" in text
        assert "Esc  do nothing" in text


def test_help_scrolls_to_its_last_line():
    async def down(app, pilot):
        await press(app, pilot, "question_mark", "end")
        await pilot.wait_for_scheduled_animations()
        return stand_in.text_of(app)

    assert "Survey" in run(down)


def test_smaller_than_40x12_status_and_stop_stay_alive():
    async def small(app, pilot):
        bar = app.query_one(StopBar)
        await pilot.mouse_down(bar, offset=(3, 0))
        await press(app, pilot, "space")
        return stand_in.text_of(app), app.station.stops, app.screen.region.contains_region(bar.region)

    for size in ((39, 12), (40, 11), (30, 6)):
        text, stops, inside = run(small, "idle", size)
        assert "need 40x12" in text, size
        assert "12:00:00Z" in text
        assert "189.16" in text or "├─┤╰─┤" in text
        assert len(stops) == 2
        assert inside


def test_a_terminal_that_grows_and_shrinks_changes_the_view():
    async def resize(app, pilot):
        found = []
        for size in ((80, 24), (40, 12), (120, 36), (79, 40)):
            await pilot.resize_terminal(*size)
            await pilot.pause()
            await pilot.pause()
            found.append((app.page.id, stand_in.text_of(app)))
        return found

    found = run(resize)
    assert [page for page, _ in found] == ["page-dashboard", "page-pocket", "page-dashboard", "page-pocket"]
    assert "S T O P" not in found[0][1]
    assert "S T O P" in found[1][1]
    assert "What next" in found[2][1]


def test_a_page_key_says_that_pages_need_room():
    async def visit(app, pilot):
        await press(app, pilot, "4")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app), app.page.id

    text, page = run(visit)
    assert "Pages need 80x24" in text
    assert page == "page-pocket"


@pytest.mark.parametrize("heard", [True, False])
@pytest.mark.parametrize("wrong", [0, 2, 5, 8])
def test_every_row_is_shared_out_at_every_size(wrong, heard):
    for width, height in itertools.product(range(40, 161), range(11, 70)):
        layout = arrange(width, height, heard=heard, wrong_in=lambda _: wrong)
        column = layout.reading + layout.signal + layout.words
        body = height - layout.keys - layout.stop
        assert min(layout.reading, layout.signal, layout.words) >= 0
        assert layout.reading >= min(wrong, body) + (0 if wrong else 2), (width, height)
        assert column == body if layout.beside or not layout.sky else body - column >= 8, (width, height)
        if layout.beside:
            assert layout.column >= 40
            assert width - layout.column >= 24


def test_the_words_name_no_key_that_does_nothing_here_and_say_once_that_it_is_not_homed():
    text = run(read, "not-homed", (60, 20)).casefold()
    assert "pages" not in text
    assert "is not homed" not in text, "the row that is wrong says so"
    assert text.count("h homes it") == 1
    assert "end stops" in text


@pytest.mark.parametrize("size", [(40, 12), (60, 20), (66, 20)], ids=str)
def test_row_1_has_both_angles_or_none(size):
    for name in ("idle", "not-homed"):
        row = run(read, name, size).splitlines()[0]
        assert ("AZ" in row) == ("EL" in row), row


@pytest.mark.parametrize("size", [(40, 12), (60, 20), (80, 24)], ids=str)
def test_no_line_of_the_help_is_broken_by_its_frame(size):
    async def look(app, pilot):
        await press(app, pilot, "question_mark")
        rows = app.screen.query_one(OptionList)
        room = rows.scrollable_content_region.width - 2
        options = [rows.get_option_at_index(index) for index in range(rows.option_count)]
        return room, [line for each in options if each.id for line in str(each.prompt).splitlines()]

    room, lines = run(look, "slewing", size)
    assert lines
    assert [line for line in lines if len(line) > room] == []


@pytest.mark.parametrize("size", [(40, 12), (60, 20)], ids=str)
def test_a_frame_painted_while_the_terminal_is_made_small_draws_what_is_there(size):
    """A tick or a reply of the dish paints at any turn of the loop, also while the pocket view is being mounted."""

    async def shrink(app, pilot):
        resized = asyncio.create_task(pilot.resize_terminal(*size))
        for _ in range(20):
            await asyncio.sleep(0)
            app.paint()
        await resized
        return stand_in.text_of(app)

    assert "■  S T O P" in run(shrink, size=(120, 36))
