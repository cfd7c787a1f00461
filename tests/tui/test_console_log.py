"""The console's log: lines, tail, hexadecimal, search, files."""

from dataclasses import replace

import pytest
from birdcage.station.state import LinkPhase
from birdcage_tui.console.log import LogView
from console_desk import desk, numbered

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]


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
        at.state(link=replace(at.app.station.state.link, state=LinkPhase.SILENT))
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
        return shown, at.log.back.rows[at.log.top].text, len(at.log.back.lines), len(at.log.back.rows)

    shown, still, lines, rows = desk(flood)
    assert shown == still
    assert lines == rows <= 5500


def test_a_thousand_lines_are_one_picture():
    async def flood(at):
        drawn = []
        draw = at.log.draw
        at.log.draw = lambda *given: (drawn.append(1), draw(*given))
        for line in numbered(1000):
            at.wire("<", line)
        quiet = len(drawn)
        at.app.stage.sheet._flush()
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


@pytest.mark.parametrize("size", SIZES[:2], ids=str)
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
