"""F4, NVS: edits wait in the app, are seen as old and new before they are written, and saved in a step of their own."""

import re
from concurrent.futures import Future
from dataclasses import replace

import pytest
import settings_stand_in
import stand_in
from birdcage.base.errors import CommandRefused
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.own_settings import SettingRow, SettingsTable, SettingsWritten
from birdcage.station.requests import ReadSettings, SaveSettings, WriteSettings
from birdcage_tui.shown.own_settings import OwnSettingsNow, setting_lines
from birdcage_tui.system.own_settings_pane import OwnSettingsPane
from settings_stand_in import ROWS, TABLE
from stage import run
from test_end_to_end import House, played, press
from textual.widgets import Input

SIZES = [(80, 24), (120, 36), (160, 48)]


def shown(wanted="", **more):
    return [line.row.index for line in setting_lines(OwnSettingsNow(TABLE), {}, wanted, **more)]


def test_a_filter_takes_words_of_name_number_and_value_in_any_order():
    assert shown() == [20, 38, 101, 140]
    assert shown("timer sleep") == [38]
    assert shown("101") == [101]
    assert shown("true") == [20]
    assert shown("nothing") == []


def test_only_modified_leaves_what_is_as_the_factory_made_it():
    assert shown(only_modified=True) == [20, 101]
    staged = OwnSettingsNow(TABLE, staged={38: "0"})
    assert [line.row.index for line in setting_lines(staged, {}, only_modified=True)] == [20, 38, 101]


async def with_table(app, pilot, **more):
    await pilot.press("f4", "n")
    await pilot.pause()
    settings_stand_in.fill(app, **more)
    app.paint()
    await pilot.pause()
    return stand_in.text_of(app)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_every_row_shows_its_values_and_what_is_special_and_lies_inside_the_screen(size):
    async def look(app, pilot):
        text = await with_table(app, pilot, staged={38: "0"})
        return text, app.query_one(OwnSettingsPane).region

    text, region = run(look, size=size)
    assert re.search(r"101  Minimum.*20\.00 +18\.00 +18\.00 +◍", text)
    assert re.search(r"38  Sleep.*420 +420 +420 +→", text)
    assert re.search(r"140  Spare 7 +0x1F +-- +--", text), "what is not told is a dash"
    assert "4 of 4 rows, 1 to write, 1 unsaved" in text
    assert region.right <= size[0]
    assert region.bottom <= size[1]


def test_a_filter_is_typed_and_esc_clears_it():
    async def look(app, pilot):
        await with_table(app, pilot)
        await pilot.press("slash", "s", "l", "e")
        await pilot.pause()
        filtered = stand_in.text_of(app)
        await pilot.press("escape")
        await pilot.pause()
        return filtered, stand_in.text_of(app)

    filtered, cleared = run(look, size=(120, 36))
    assert "Sleep Mode" in filtered
    assert "Spare" not in filtered
    assert "1 of 4 rows" in filtered
    assert "4 of 4 rows" in cleared


def test_a_dish_without_such_settings_says_so():
    async def look(app, pilot):
        await pilot.press("f4", "n")
        await pilot.pause()
        return stand_in.text_of(app), app.station.asked_for(ReadSettings)

    text, asked = run(look, state={"dish": replace(TRAVLER, has_own_settings=False)})
    assert "has no settings that can be read" in text
    assert asked == []


# On a real station, with a simulated dish


async def edit(house, index, value):
    pane = house.app.query_one(OwnSettingsPane)
    lines = pane.lines(house.app.view())
    pane.at = next(number for number, line in enumerate(lines) if line.row.index == index)
    await press(house, "e")
    await house.step(0.2)
    house.app.screen.query_one(Input).value = value
    await press(house, "enter")
    await house.step(0.2)


async def opened(house, tmp_path):
    house.app.system.own_settings._folder = tmp_path / "backups"
    await house.step(3)
    await press(house, "f4", "n")
    await house.step(3)


def nvram(house):
    return house.device.machine.firmware.board.nvram


def new_house(tmp_path):
    return House(backup_folder=tmp_path / "backups")


@played
async def test_an_edit_is_written_to_memory_after_a_question_and_saved_in_a_step_of_its_own(tmp_path):
    house = new_house(tmp_path)
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await opened(house, tmp_path)
        await edit(house, 38, "600")
        now = house.app.system.own_settings.now
        assert dict(now.staged) == {38: "600"}
        assert now.table.rows[38].current == "420", "nothing is written by an edit"
        await press(house, "w")
        await house.step(0.3)
        assert re.search(r"38 +Sleep Mode Timer Secs: +420 +→ +600 s", house.text())
        await press(house, "n")
        await house.step(1)
        assert house.app.system.own_settings.now.table.rows[38].current == "420", "n writes nothing"
        await press(house, "w", "y")
        await house.step(4)
        row = house.app.system.own_settings.now.table.rows[38]
        assert (row.current, row.saved) == ("600", "420")
        assert len(list((tmp_path / "backups").glob("*.txt"))) == 1
        await press(house, "s")
        await house.step(0.5)
        await press(house, "y")
        await house.step(4)
        row = house.app.system.own_settings.now.table.rows[38]
        assert (row.current, row.saved) == ("600", "600")
        assert "next power cycle" in house.text()


@played
async def test_undo_drops_edits_first_and_then_brings_back_what_the_last_write_replaced(tmp_path):
    house = new_house(tmp_path)
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await opened(house, tmp_path)
        await edit(house, 38, "600")
        await press(house, "w", "y")
        await house.step(4)
        await edit(house, 27, "60")
        await press(house, "u")
        await house.step(0.2)
        assert dict(house.app.system.own_settings.now.staged) == {}
        await press(house, "u")
        await house.step(0.2)
        assert dict(house.app.system.own_settings.now.staged) == {38: "420"}
        await press(house, "w", "y")
        await house.step(4)
        assert house.app.system.own_settings.now.table.rows[38].current == "420"


@played
async def test_a_backup_brings_back_every_row_that_was_changed_since(tmp_path):
    house = new_house(tmp_path)
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await opened(house, tmp_path)
        before = house.app.system.own_settings.now.table.printed
        await press(house, "B")
        await house.step(4)
        (backup,) = (tmp_path / "backups").glob("*.txt")
        for index, value in ((38, "600"), (27, "60")):
            await edit(house, index, value)
        await press(house, "w", "y")
        await house.step(4)
        await press(house, "s")
        await house.step(0.5)
        await press(house, "y")
        await house.step(4)
        said = house.app.system.own_settings.stage_from(backup)
        assert said.startswith("2 rows differ")
        await press(house, "w", "y")
        await house.step(4)
        await press(house, "s")
        await house.step(0.5)
        await press(house, "y")
        await house.step(4)
        assert house.app.system.own_settings.now.table.printed == before


@played
async def test_a_backup_of_a_simulated_dish_is_not_marked_for_a_real_one(tmp_path):
    house = new_house(tmp_path)
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await opened(house, tmp_path)
        await press(house, "B")
        await house.step(4)
        (backup,) = (tmp_path / "backups").glob("*.txt")
        feed, text = house.app.system.own_settings, backup.read_text()
        house.station._store.change(demo=False)
        backup.write_text(text.replace("# table:", "# DEMO\n# table:"))
        with pytest.raises(CommandRefused, match=rf"{backup.name} is of a simulated dish\. Nothing was sent"):
            feed.stage_from(backup)
        assert dict(feed.now.staged) == {}


@played
async def test_what_the_station_refuses_is_said_below_the_rows_and_the_edit_stays(tmp_path):
    house = House()  # without a folder for backups nothing may be written
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await opened(house, tmp_path)
        await edit(house, 38, "600")
        await press(house, "w", "y")
        await house.step(4)
        await house.step(2)
        assert "▲ No folder for a backup of the dish's settings." in house.text()
        assert dict(house.app.system.own_settings.now.staged) == {38: "600"}


def test_writing_and_saving_ask_first_and_say_who():
    async def look(app, pilot):
        await with_table(app, pilot, staged={38: "600"})
        await pilot.press("w")
        await pilot.pause()
        before = app.station.asked_for(WriteSettings)
        await pilot.press("y")
        await pilot.pause()
        wrote = app.station.asked_for(WriteSettings)
        app.system.own_settings.now = replace(app.system.own_settings.now, busy="")
        await pilot.press("s")
        await pilot.pause()
        unsaved = app.station.asked_for(SaveSettings)
        await pilot.press("y")
        await pilot.pause()
        return before, wrote, unsaved, app.station.asked_for(SaveSettings)

    before, wrote, unsaved, saved = run(look, size=(120, 36))
    assert (before, unsaved) == ([], [])
    assert wrote == [WriteSettings({38: "600"}, "you", agreed=True)]
    assert saved == [SaveSettings("you", agreed=True, shown={101: "20.00", 140: "0x1F"})]


class Slow:
    """A station that answers when it is told to."""

    def __init__(self, app):
        self.asked, self._station = [], app.station
        app.station.submit = self._submit

    def _submit(self, request):
        self.asked.append((request, Future()))
        return self.asked[-1][1]

    def of(self, kind):
        return [request for request, _ in self.asked if isinstance(request, kind)]

    def answer(self, kind, value):
        (future,) = [future for request, future in self.asked if isinstance(request, kind) and not future.done()]
        future.set_result(value)


def test_what_is_edited_while_a_write_is_under_way_is_not_written_with_it():
    async def look(app, pilot):
        await with_table(app, pilot, staged={38: "600"})
        slow = Slow(app)
        await pilot.press("w")
        await pilot.pause()
        app.system.own_settings.stage(38, "0")  # whatever is staged now, the question has shown 600
        await pilot.press("y")
        await pilot.pause()
        app.system.own_settings.stage(38, "10")
        slow.answer(WriteSettings, SettingsWritten("backup.txt", TABLE))
        await pilot.pause()
        await pilot.pause()
        return slow.of(WriteSettings), dict(app.system.own_settings.now.staged)

    wrote, staged = run(look, size=(120, 36))
    assert wrote == [WriteSettings({38: "600"}, "you", agreed=True)]
    assert staged == {38: "10"}


def test_another_dish_drops_what_was_staged_for_the_one_before():
    async def look(app, pilot):
        await with_table(app, pilot, staged={38: "600"})
        app.station.state = replace(app.station.state, port="/dev/ttyUSB7")
        app.paint()
        await pilot.pause()
        return app.system.own_settings.now

    now = run(look, size=(120, 36))
    assert (now.table, dict(now.staged)) == (None, {})


def test_a_command_of_the_tab_chosen_from_another_one_shows_it_first():
    async def look(app, pilot):
        await pilot.press("f4", "h")
        await pilot.pause()
        app.action_command("settings-filter")
        await pilot.pause()
        return app.page.tab, app.focused.region, app.focused.display

    tab, region, seen = run(look)
    assert tab == "settings"
    assert seen
    assert region.height == 1


def test_a_name_with_brackets_is_shown_as_it_is():
    async def look(app, pilot):
        await with_table(app, pilot)
        row = SettingRow(7, "a [/] b [deg]", "1", "1", "1")
        app.system.own_settings.now = OwnSettingsNow(SettingsTable(("x",), {7: row}), app.session.clock.monotonic())
        app.paint()
        await pilot.pause()
        await pilot.press("enter")
        await pilot.pause()
        return stand_in.text_of(app)

    assert "Row 7: a [/] b [deg]" in run(look, size=(120, 36))


def test_a_row_that_is_no_longer_as_it_was_shown_is_not_written():
    async def look(app, pilot):
        await with_table(app, pilot, staged={38: "600"})
        slow = Slow(app)
        await pilot.press("w")
        await pilot.pause()
        rows = {**ROWS, 38: SettingRow(38, "Sleep Mode Timer Secs", "60", "60", "420")}
        now = app.system.own_settings.now
        app.system.own_settings.now = replace(now, table=SettingsTable(("other",), rows))
        await pilot.press("y")
        await pilot.pause()
        return slow.of(WriteSettings), stand_in.text_of(app)

    wrote, text = run(look, size=(120, 36))
    assert wrote == []
    assert "have changed meanwhile. Nothing was written." in text


def test_what_the_dish_had_already_is_no_step_to_undo_and_names_no_backup():
    async def look(app, pilot):
        await with_table(app, pilot, staged={38: "420.0"})
        slow = Slow(app)
        await pilot.press("w", "y")
        await pilot.pause()
        slow.answer(WriteSettings, SettingsWritten(None, TABLE))
        await pilot.pause()
        await pilot.pause()
        return stand_in.text_of(app), app.system.own_settings.now.undo

    text, undo = run(look, size=(120, 36))
    assert "Nothing was written." in text
    assert undo == ()


def test_an_old_table_is_read_anew_before_anything_is_asked_and_a_late_question_waits_for_a_free_page():
    async def look(app, pilot):
        await with_table(app, pilot, staged={38: "600"})
        app.session.clock.advance(30.0)
        slow = Slow(app)
        await pilot.press("w")
        await pilot.pause()
        screens = len(app.screen_stack)
        await pilot.press("slash")
        await pilot.pause()
        slow.answer(ReadSettings, TABLE)
        await pilot.pause()
        await pilot.pause()
        return screens, len(app.screen_stack), slow.of(WriteSettings), app.feeds.notes.last

    screens, later, wrote, told = run(look, size=(120, 36))
    assert (screens, later, wrote) == (1, 1, [])
    assert told == "The dish's settings are read. Press the key again."
