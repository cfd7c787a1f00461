"""The console over a page, on a stand-in: what it shows, asks, keeps and sends."""

import asyncio
from concurrent.futures import Future
from dataclasses import replace

import pytest
import stand_in
from birdcage.base.errors import Held, LeaseDenied
from birdcage.station.raw import CONSOLE, Entry, Grade
from birdcage.station.requests import AcquireLease, ListCommands, Raw, ReleaseLease, Watch
from birdcage.station.state import Link
from birdcage_tui.console.entry import ConsoleInput, FindInput
from birdcage_tui.console.log import LogView
from birdcage_tui.dialogs import QuestionScreen
from birdcage_tui.footer import KeyBar
from birdcage_tui.panes.pointing import PointingPane
from birdcage_tui.status import BadDayRow, TopRow
from textual.widgets import ContentSwitcher

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]
KEYS = {" ": "space", "?": "question_mark", "*": "asterisk", "+": "plus", "-": "minus", ".": "full_stop"}


class Desk:
    """The app with the console open, and hands on it."""

    def __init__(self, app, pilot):
        self.app, self.pilot, self.clock = app, pilot, app.session.clock

    @property
    def log(self):
        return self.app.query_one(LogView)

    @property
    def line(self):
        return self.app.query_one(ConsoleInput)

    async def press(self, *keys):
        await self.pilot.press(*keys)
        await self.pilot.pause()

    async def type(self, text):
        if not self.line.has_focus:
            await self.press("i")
        await self.press(*[KEYS.get(letter, letter) for letter in text])

    def wire(self, direction, *lines):
        for line in lines:
            self.app.session.wire(Entry(self.clock.utc(), direction, line))

    async def look(self):
        self.app.paint()
        await self.pilot.pause()
        return stand_in.text_of(self.app)

    def state(self, **changes):
        self.app.station.state = replace(self.app.station.state, **changes)

    def raw(self):
        return [(each.line, each.confirmed) for each in self.app.station.asked_for(Raw)]

    def words(self):
        """The text of the screen in which wrapped sentences stand in one piece."""
        return " ".join(stand_in.text_of(self.app).replace("│", " ").split())


def desk(test, name="idle", size=(80, 24), **options):
    async def body():
        app = stand_in.app_in(name, **options)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            await pilot.press("f5")
            await pilot.pause()
            await pilot.pause()
            at = Desk(app, pilot)
            await at.look()
            return await test(at)

    return asyncio.run(body())


def numbered(count, first=0):
    return [b"line %d\r\n" % number for number in range(first, first + count)]


# Where it is.


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["idle", "held", "lost", "not-homed"])
def test_it_lies_inside_the_screen_and_covers_neither_status_nor_footer(name, size):
    async def regions(at):
        await at.look()
        app = at.app
        parts = [*app.sheet.query("*")]
        rows = {kind: app.query_one(kind).region for kind in (TopRow, BadDayRow, KeyBar)}
        seen = [(part, part.region) for part in parts if part.display]
        return app.sheet.region, seen, rows, app.query_one("#stage").region

    whole, parts, rows, stage = desk(regions, name, size)
    assert stage.contains_region(whole)
    assert whole.height == pytest.approx(stage.height * 2 / 3, abs=1)
    assert whole.bottom == stage.bottom
    for part, region in parts:
        assert region.area > 0, part
        assert whole.contains_region(region), part
    for kind, region in rows.items():
        assert region.area > 0
        assert not region.overlaps(whole), kind


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_every_key_of_the_log_can_be_clicked_at_every_size(size):
    async def clicked(at):
        hot = {command for _, command in at.app.sheet._keys.hot}
        await at.press("i")
        await at.look()
        return hot, {command for _, command in at.app.sheet._keys.hot}

    log, line = desk(clicked, size=size)
    assert log >= {"console-type", "console-find", "console-stamps", "console-hex", "console-save", "page-console"}
    assert line >= {"console-complete", "console-older", "console-recall", "console-end-line", "page-console"}


def test_no_text_field_has_the_focus_on_arrival_and_the_page_above_goes_on():
    async def arrive(at):
        focused = at.app.focused
        before = await at.look()
        position = at.app.station.state.position
        at.state(position=replace(position, az_deg=22.22))
        text = await at.look()
        assert at.app.query_one(PointingPane).is_on_screen
        return focused, before, text

    focused, before, text = desk(arrive)
    assert isinstance(focused, LogView)
    assert before.splitlines()[4:9] != text.splitlines()[4:9], "the digits above changed"
    assert "WATCH" in text


@pytest.mark.parametrize("key", ["f5", "escape"])
def test_at_rest_it_closes_and_gives_the_focus_back(key):
    async def close(at):
        await at.press(key)
        await at.pilot.pause()
        return at.app.sheet.is_open, at.app.focused, at.app.scopes()[0].scope

    assert desk(close) == (False, None, "dashboard")


def test_escape_stops_first_while_the_dish_moves():
    async def stop(at):
        await at.press("escape")
        return at.app.station.stops, at.app.sheet.is_open

    assert desk(stop, "slewing") == (["you"], True)


def test_digits_are_typed_and_function_keys_change_the_page_under_the_open_console():
    async def digits(at):
        await at.type("1234")
        typed = at.line.value
        await at.press("f4")
        await at.pilot.pause()
        return typed, at.app.query_one("#pages", ContentSwitcher).current, at.app.sheet.is_open, at.app.focused

    typed, page, is_open, focused = desk(digits)
    assert (typed, page, is_open) == ("1234", "page-system", True)
    assert isinstance(focused, ConsoleInput)


def test_letters_in_the_log_do_not_step_the_dish():
    async def press(at):
        at.app.station.asked.clear()
        await at.press("h", "l", "left", "right", "k", "j")
        return at.app.station.asked

    assert desk(press) == []


# STOP.


@pytest.mark.parametrize("opening", [(), ("i",), ("slash",), ("i", "ctrl+r"), ("question_mark",)])
def test_ctrl_c_stops_from_everywhere(opening):
    async def stop(at):
        await at.press(*opening)
        await at.press("ctrl+c")
        return at.app.station.stops

    assert desk(stop, "slewing") == ["you"]


def test_space_stops_in_the_log_and_types_in_the_line_and_the_search():
    async def space(at):
        await at.press("space")
        in_log = len(at.app.station.stops)
        await at.type("a 1")
        await at.press("escape", "slash")
        await at.press("x", "space", "y")
        return in_log, at.line.value, at.app.query_one(FindInput).value, len(at.app.station.stops)

    assert desk(space) == (1, "a 1", "x y", 1)


def test_space_stops_in_the_question_before_a_hazard():
    async def ask(at):
        at.state(holder=CONSOLE, menu="mot")
        await at.type("a 0 200")
        await at.press("enter")
        assert isinstance(at.app.screen, QuestionScreen)
        await at.press("space")
        return at.app.station.stops, at.raw()

    assert desk(ask) == (["you"], [])


# Hazards.

HAZARDS = [
    ("root", "q"), ("root", "reboot"), ("root", "stow"), ("os", "reboot"), ("a3981", "reset"), ("adc", "scan"),
    ("dvb", "def"), ("dvb", "lnbdc odu"), ("dvb", "srch"), ("dvb", "e 1 2"), ("eeprom", "ee 1 2"), ("eeprom", "inv 3"),
    ("eeprom", "def"), ("nvs", "e 20 1"), ("nvs", "s"), ("gpio", "w 3 1"), ("mot", "a 0 9999"), ("mot", "g 100 40"),
    ("mot", "h 0"), ("mot", "h *"), ("mot", "e"), ("mot", "r"), ("mot", "w 0 OFF"), ("mot", "sp 0 10"),
    ("mot", "sw 0 1"), ("mot", "vms 0 1 1"), ("mot", "motorboth"), ("mot", "sd"), ("mot", "azscan 1 2 3"),
    ("mot", "azscanwxp 0 10 10 1"), ("mot", "mv 0 10"), ("mot", "ma 0 10"), ("mot", "pid 0 1 2 3"),
    ("step", "v 0 100"), ("step", "p 0 100"), ("peak", "pxy1"), ("peak", "pw"), ("peak", "stb"), ("mot", "frobnicate"),
]  # fmt: skip


@pytest.mark.parametrize("homed", [True, False], ids=["homed", "unhomed"])
def test_each_hazard_names_its_consequence_before_enter_counts(homed):
    async def warn(at):
        await at.press("i")
        for menu, typed in HAZARDS:
            at.app.station.asked.clear()
            at.state(holder=CONSOLE, menu=menu, homed=homed)
            at.line.value = typed
            await at.look()
            verdict = at.app.station.judge(typed)
            assert verdict.grade > Grade.HARMLESS, typed
            assert verdict.consequence in at.words()
            assert verdict.limit in at.words()
            await at.press("enter")
            await at.look()
            assert at.raw() == [], f"the first Enter sends nothing: {typed}"
            if verdict.grade >= Grade.MOVES or verdict.limit:
                assert isinstance(at.app.screen, QuestionScreen)
                assert verdict.consequence in at.words()
                await at.press("enter")
                assert at.raw() == [], f"Enter is no answer: {typed}"
                await at.press("enter", "y")
            else:
                assert "Enter again sends it" in at.words()
                await at.press("enter")
            assert at.raw() == [(typed, True)]
            assert at.line.value == ""

    desk(warn, size=(120, 36))


def test_a_change_of_the_text_or_escape_takes_the_first_enter_back():
    async def arm(at):
        at.state(holder=CONSOLE, menu="nvs")
        await at.type("s")
        await at.press("enter", "backspace", "s", "enter")
        assert at.raw() == []
        await at.press("escape")
        await at.look()
        assert "Enter again" not in at.words()
        await at.press("enter")
        assert at.raw() == []
        await at.press("enter")
        assert at.raw() == [("s", True)]

    desk(arm)


def test_another_menu_takes_the_first_enter_back():
    async def arm(at):
        at.state(holder=CONSOLE, menu="nvs")
        await at.type("s")
        await at.press("enter")
        at.state(menu="mot")
        await at.look()
        await at.press("enter")
        return at.raw()

    assert desk(arm) == []


def test_a_harmless_line_goes_out_at_once():
    async def send(at):
        at.state(holder=CONSOLE, menu="mot")
        await at.type("a")
        await at.press("enter")
        return at.raw(), at.line.value

    assert desk(send) == ([("a", False)], "")


# Control.


def test_the_first_enter_takes_control_and_another_holder_is_named_first():
    async def take(at):
        at.state(holder="Gpredict", menu="mot")
        await at.type("a")
        await at.press("enter")
        await at.look()
        assert "Gpredict has control" in at.words()
        assert at.app.station.asked_for(AcquireLease) == []
        await at.press("y")
        return at.app.station.asked_for(AcquireLease)

    assert desk(take) == [AcquireLease(CONSOLE, take_over=True)]


def test_talk_says_that_polling_pauses_and_how_old_the_position_is():
    async def talk(at):
        at.state(holder=CONSOLE)
        at.clock.advance(12)
        return await at.look()

    text = desk(talk)
    assert "TALK" in text
    assert "polling paused, position 12s old" in text


def test_closing_gives_control_back():
    async def close(at):
        at.state(holder=CONSOLE)
        await at.press("f5")
        return at.app.station.asked_for(ReleaseLease)

    assert desk(close) == [ReleaseLease(CONSOLE)]


def test_while_one_types_only_the_position_is_polled_so_that_the_menu_stays():
    async def watches(at):
        await at.press("i")
        await at.press("escape")
        return [set(each.features) for each in at.app.station.asked_for(Watch)]

    first, typing, after = desk(watches)
    assert typing == {"position"}
    assert "rssi" in first
    assert after == first


@pytest.mark.parametrize("error", [Held("STOP is latched."), LeaseDenied("Gpredict has control.")])
def test_a_line_that_failed_is_told_and_comes_back(error):
    async def fail(at):
        at.state(holder=CONSOLE, menu="mot")
        failed = Future()
        at.app.sheet._sent._submit = lambda request: failed
        await at.type("a")
        await at.press("enter")
        failed.set_exception(error)
        await at.pilot.pause()
        return await at.look(), at.line.value

    text, value = desk(fail)
    assert f"# `a`: {error}" in text
    assert value == "a"


def test_a_line_that_prints_on_says_so_and_enter_ends_it():
    async def stream(at):
        at.state(holder=CONSOLE, menu="dvb")
        await at.type("agc")
        await at.press("enter")
        at.clock.advance(3)
        text = await at.look()
        await at.press("enter")
        return text, at.raw()

    text, raw = desk(stream)
    assert "`agc` running 3 s, Enter ends it." in text
    assert raw == [("agc", False), ("", False)]


# The log.


def test_lines_show_time_direction_and_prompt():
    async def see(at):
        at.wire(">", b"a\r")
        at.wire("<", b"a\r\nAngle[0] = 1.00\r\n", b"MOT>")
        at.wire("#", b"lost ttyUSB0")
        at.state(menu="mot")
        return await at.look()

    text = desk(see)
    assert "12:00:00.000 > a" in text
    assert "< Angle[0] = 1.00" in text
    assert "# lost ttyUSB0" in text
    assert "  MOT> " in text.splitlines()[-3]


def test_an_unknown_prompt_is_a_question_mark_and_without_a_link_a_dash():
    async def see(at):
        row = (await at.look()).splitlines()[-3]
        at.wire("<", b"TRK>")
        at.state(menu="root")
        known = (await at.look()).splitlines()[-3]
        at.state(link=replace(at.app.station.state.link, state=Link.SILENT))
        down = (await at.look()).splitlines()[-3]
        return row, known, down

    row, known, down = desk(see)
    assert row.strip("│ ") == "?"
    assert known.strip("│ ") == "root TRK>"
    assert down.strip("│ ") == "—"


def test_reading_stops_the_tail_and_counts_what_is_new_and_end_follows():
    async def read(at):
        at.wire("<", *numbered(50))
        assert "line 49" in await at.look()
        await at.press("pageup")
        before = [row for row in (await at.look()).splitlines() if "< line" in row]
        at.wire("<", *numbered(12, 50))
        text = await at.look()
        still = [row for row in text.splitlines() if "< line" in row]
        await at.press("end")
        return before, still, text, await at.look()

    before, still, text, end = desk(read)
    assert before == still, "what is being read stays"
    assert "▼ 12 new, End follows" in text
    assert "line 61" in end
    assert "new, End" not in end


def test_scrolling_down_to_the_end_follows_again():
    async def read(at):
        at.wire("<", *numbered(50))
        await at.look()
        await at.press("up", "up", "down", "down")
        at.wire("<", *numbered(1, 50))
        return await at.look()

    assert "line 50" in desk(read)


def test_the_scrollback_is_bounded_and_what_is_read_stays_in_sight():
    async def flood(at):
        at.wire("<", *numbered(4000))
        await at.look()
        await at.press("pageup")
        shown = at.log.back.rows[at.log.top].text
        at.wire("<", *numbered(4900, 4000))
        await at.look()
        return shown, at.log.back.rows[at.log.top].text, len(at.log.back.lines)

    shown, still, kept = desk(flood)
    assert shown == still
    assert kept <= 5500


def test_a_thousand_lines_are_one_picture():
    async def flood(at):
        drawn = []
        draw = at.log.draw
        at.log.draw = lambda *given: (drawn.append(1), draw(*given))
        for line in numbered(1000):
            at.wire("<", line)
        quiet = len(drawn)
        at.app.sheet._flush()
        return quiet, len(drawn), at.log.back.taken

    assert desk(flood) == (0, 1, 1000)


def test_what_came_before_the_first_visit_is_there_and_what_was_dropped_is_counted():
    async def late(at):
        await at.press("f5")
        at.wire("<", *numbered(5003))
        await at.press("f5")
        await at.look()
        await at.press("home")
        return await at.look()

    text = desk(late)
    assert "3 events are not shown" in text
    assert "line 3" in text


def test_only_rows_that_changed_are_sent():
    async def count(at):
        at.wire("<", *numbered(3))
        await at.look()
        asked = []
        at.log.refresh = lambda *regions, **_: asked.append(len(regions))
        await at.look()
        return list(asked)

    assert desk(count) == []


def test_hex_shows_every_byte_and_times_change():
    async def change(at):
        at.wire(">", b"a 0 180\r")
        at.clock.advance(0.25)
        at.wire("<", b"ok\r\n")
        await at.press("x")
        in_hex = await at.look()
        await at.press("x", "t")
        gaps = await at.look()
        await at.press("t")
        return in_hex, gaps, await at.look()

    in_hex, gaps, plain = desk(change)
    assert "61 20 30 20 31 38 30 0d" in in_hex
    assert "a 0 180." in in_hex
    assert "+0.250 < ok" in gaps
    assert "│ < ok" in plain
    assert "12:00:00.000" not in plain


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_hex_rows_fit(size):
    async def rows(at):
        at.wire("<", bytes(range(256)))
        await at.press("x")
        await at.look()
        return at.log.back.rows, at.log.content_size.width

    rows, width = desk(rows, size=size)
    assert max(len(row.stamp) + 2 + len(row.text) for row in rows) <= width
    assert "fe ff" in rows[-1].text


def test_search_counts_and_steps_and_escape_ends_it():
    async def search(at):
        at.wire("<", *numbered(40))
        await at.press("slash", "e", "space", "1")
        typed = await at.look()
        await at.press("enter", "N")
        back = await at.look()
        focused = at.app.focused
        await at.press("n", "n")
        around = await at.look()
        await at.press("escape")
        return typed, back, focused, around, await at.look()

    typed, back, focused, around, ended = desk(search)
    assert '"e 1" 11 of 11' in typed
    assert '"e 1" 10 of 11' in back
    assert isinstance(focused, LogView)
    assert '"e 1" 1 of 11' in around
    assert '"e 1"' not in ended


def test_saving_writes_a_transcript_and_never_over_another(tmp_path):
    async def save(at):
        at.app.settings = replace(at.app.settings, logs_folder=tmp_path)
        at.wire(">", b"a\r")
        await at.look()
        await at.press("s", "s")
        return await at.look()

    text = desk(save, size=(200, 60))
    files = sorted(tmp_path.iterdir())
    assert len(files) == 2
    assert all(str(path) in text for path in files)
    assert r" > a\r" in files[0].read_text()
    assert "DEMO" in files[0].read_text().splitlines()[0]


def test_clearing_empties_the_view():
    async def clear(at):
        at.wire("<", *numbered(3))
        await at.look()
        await at.press("c")
        return await at.look()

    assert "line 1" not in desk(clear)


# The line.


def test_history_survives_a_restart_and_holds_no_line_twice_in_a_row(tmp_path):
    def session(test):
        async def body(at):
            at.state(holder=CONSOLE, menu="mot")
            return await test(at)

        return desk(body, history_file=tmp_path / "state" / "history.txt")

    async def first(at):
        for line in ("a", "a", "life", "mv"):
            await at.type(line)
            await at.press("enter")

    async def second(at):
        await at.type("p")
        seen = []
        for key in ("up", "up", "up", "up", "down", "down", "down"):
            await at.press(key)
            seen.append(at.line.value)
        return seen

    session(first)
    assert (tmp_path / "state" / "history.txt").read_text() == "a\nlife\nmv\n"
    assert session(second) == ["mv", "life", "a", "a", "life", "mv", "p"]


def test_recall_finds_takes_and_sends_nothing(tmp_path):
    path = tmp_path / "history.txt"
    path.write_text("rssi 5\nmv\nrssi 10\n")

    async def recall(at):
        await at.press("i", "ctrl+r", "r", "s")
        newest = await at.look()
        await at.press("ctrl+r")
        older = await at.look()
        await at.press("enter")
        return newest, older, at.line.value, at.raw(), at.app.focused

    newest, older, value, raw, focused = desk(recall, history_file=path)
    assert "rssi 10" in newest
    assert "rssi 5" in older
    assert (value, raw) == ("rssi 5", [])
    assert isinstance(focused, ConsoleInput)


def test_tab_completes_from_the_menu_with_usage_and_goes_round():
    async def complete(at):
        at.state(menu="mot")
        await at.type("azscanw")
        await at.press("tab")
        whole = at.line.value
        text = await at.look()
        at.line.value = "m"
        await at.press("tab")
        first = at.line.value
        await at.press("tab")
        return whole, text, first, at.line.value, isinstance(at.app.focused, ConsoleInput)

    whole, text, first, second, still = desk(complete)
    assert whole.strip() == "azscanwxp"
    assert "azscanwxp" in text
    assert first.startswith("m")
    assert second.startswith("m")
    assert first != second
    assert still


def test_tab_on_an_empty_line_asks_the_dish_while_talking():
    async def ask(at):
        at.state(holder=CONSOLE, menu="mot")
        await at.press("i", "tab")
        return at.app.station.asked_for(ListCommands)

    assert desk(ask) == [ListCommands(CONSOLE)]


def test_usage_and_help_of_a_command_show_while_it_is_typed():
    async def usage(at):
        at.state(menu="dvb")
        await at.type("rssi 5")
        await at.look()
        found = next(each for each in at.app.station.commands("dvb") if each.name == "rssi")
        return found, at.words()

    found, words = desk(usage)
    assert found.usage in words
    assert " ".join(found.help.split()) in words


def test_the_footer_says_ctrl_c_while_space_is_a_space():
    async def typing(at):
        await at.press("i")
        return (await at.look()).splitlines()[-1]

    row = desk(typing)
    assert "Ctrl+C STOP" in row
    assert "go to" not in row
