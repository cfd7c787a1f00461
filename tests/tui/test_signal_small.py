"""F3, its dialogs and the pocket view where room is short: the figures stay whole, and every key is answered."""

from __future__ import annotations

from datetime import timedelta

import pytest
import stage
import stand_in
import track_stage
from birdcage_tui.pocket.pocket_layout import arrange
from birdcage_tui.shown.notes import CommandNote
from birdcage_tui.signal.head import ANSWER_S, SignalHead
from birdcage_tui.signal.replay_panes import ReplayKeys, ReplayLevelPane, ReplayStripPane
from birdcage_tui.widgets.status import BadDayRow
from test_signal_following import passed
from test_signal_replay import path, replayed  # noqa: F401 - a fixture
from test_signal_sweep import task
from textual.containers import Vertical
from textual.widgets import OptionList

RESULT = "Peak at azimuth 132.75° ±0.09°, 12.5 dB over the floor of -60.2 dB, 5.5° wide, as far as it is known."


def row_of(app, kind):
    region = app.query_one(kind).region
    return stand_in.text_of(app).splitlines()[region.y].rstrip()


def test_a_long_result_is_cut_behind_a_figure():
    async def look(app, pilot):
        app.note(RESULT)
        app.paint()
        await pilot.pause()
        return row_of(app, BadDayRow)

    assert stage.run(look, key="f3") == " Peak at azimuth 132.75° ±0.09°, 12.5 dB over the floor of -60.2 dB …"


@pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
def test_a_key_is_answered_while_row_2_tells_of_something_wrong(size):
    async def look(app, pilot):
        before = row_of(app, SignalHead)
        await pilot.press("F")
        app.paint()
        await pilot.pause()
        after = row_of(app, SignalHead)
        app.session.clock.advance(ANSWER_S + 1.0)
        app.paint()
        await pilot.pause()
        return before, after, row_of(app, SignalHead), row_of(app, BadDayRow)

    before, after, later, wrong = stage.run(look, "refused", size, key="f3")
    assert "NO MOTION" in wrong
    assert after == " The tuner is not tuned from here. s chooses an RTL-SDR behind rtl_tcp."
    for row in (before, later):
        assert row.startswith(" Source: dish tuner (counts)"), row


def test_what_row_2_tells_of_stop_is_not_told_twice():
    async def look(app, pilot):
        held = app.station.state.held
        rows = []
        for words, after_s in (("STOP.", 0.2), ("Tone off.", 4.0)):
            app.feeds.notes.last = words
            app.feeds.notes._told.append(CommandNote(held.utc + timedelta(seconds=after_s), words))
            app.paint()
            await pilot.pause()
            rows.append(row_of(app, SignalHead))
        return rows

    stopped, answered = stage.run(look, "held", key="f3")
    assert stopped.startswith(" Source:")
    assert answered == " Tone off."


def test_a_recording_leaves_the_source_in_the_row():
    async def look(app, pilot):
        rows = []
        for words in ("● recording, 190 readings", "The disk is full: recording has ended. " * 2):
            type(app.signals).recorded = property(lambda _self, words=words: words)
            app.paint()
            await pilot.pause()
            rows.append(row_of(app, SignalHead))
        return rows

    feed = {}

    async def with_recording(app, pilot):
        feed["kind"], feed["was"] = type(app.signals), type(app.signals).recorded
        try:
            return await look(app, pilot)
        finally:
            feed["kind"].recorded = feed["was"]

    kept, failed = stage.run(with_recording, key="f3")
    assert kept.startswith(" ● recording, 190 readings  Source: dish tuner (counts)")
    assert failed.startswith(" The disk is full: recording has ended. The disk is full: recording has ended.")


def test_what_counts_while_following_is_whole_at_80_columns():
    async def look(app, pilot, _desk):
        passed(app)
        app.paint()
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = track_stage.run(look, size=(80, 24), keys=("f3",))
    beside = " ".join(line[41:].strip("│ ") for line in text.splitlines()[4:10])
    assert "begins anew with the best." in beside
    assert "…" not in beside


def test_a_dialog_tells_what_the_line_with_the_focus_is_for():
    async def look(app, pilot):
        told = []
        for key in ("w", "tab", "tab", "tab"):
            await pilot.press(key)
            await pilot.pause()
            told.append(stand_in.text_of(app))
        await pilot.press(*"firmware")
        await pilot.pause()
        return [*told, stand_in.text_of(app)]

    axis, span, step, by, firmware = stage.run(look, key="f3")
    assert "az or el" in axis
    assert "from one end to the other" in span
    assert "from one direction to the next" in step
    assert "steps or firmware" in by
    assert "steps or firmware" not in firmware
    assert "The dish sweeps by itself." in firmware


def test_a_sweep_that_goes_on_has_its_whole_axis_and_round_levels():
    async def look(app, pilot):
        app.signals.sweeps.take(task(1, (130.0, 131.0, 132.0)))
        await pilot.press("v")
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = stage.run(look, key="f3")
    ends = next(line for line in text.splitlines() if "130.0°" in line)
    assert "138.0°" in ends
    assert "   400 " in text


def test_the_dialogs_of_a_phone_end_no_hint_and_no_warning_in_mid_sentence():
    async def look(app, pilot):
        await pilot.press("f", "down", "enter")
        await pilot.resize_terminal(40, 12)
        await pilot.pause()
        step_track = stand_in.text_of(app)
        await pilot.resize_terminal(60, 20)
        await pilot.pause()
        wider = stand_in.text_of(app)
        await pilot.resize_terminal(80, 24)
        await pilot.pause()
        whole = stand_in.text_of(app)
        await pilot.press("escape")
        await pilot.press("w", "tab", "tab", "tab", *"firmware")
        await pilot.resize_terminal(40, 12)
        await pilot.pause()
        await pilot.pause()
        return step_track, wider, whole, stand_in.text_of(app)

    step_track, wider, whole, sweep = stage.run(look, key="f3")
    assert " or empty …" in step_track
    assert " or empty. Its way is remembered … " in wider
    assert " or empty. Its way is remembered by it. " in whole
    assert "where it begins." in sweep


def test_the_sweeps_beneath_are_named():
    async def look(app, pilot):
        found = []
        await pilot.press("v")
        for number, first_deg in ((1, 130.0), (2, 131.0), (3, 132.0), (4, 190.0)):
            app.signals.sweeps.take(task(number, (first_deg, first_deg + 1.0, first_deg + 2.0)))
            app.paint()
            await pilot.pause()
            found.append(next(line for line in stand_in.text_of(app).splitlines() if "─ Sweep" in line))
        return found

    alone, second, third, elsewhere = stage.run(look, key="f3")
    assert "─ Sweep ─" in alone
    assert "─ Sweep, dim: the one before ─" in second
    assert "─ Sweep, dim: 2 before it ─" in third
    assert "─ Sweep ─" in elsewhere, "none of them is on its axis"


def test_a_replay_has_its_curve_and_its_keys_on_a_phone(path):  # noqa: F811 - the fixture
    async def look(app, pilot, _deck):
        await pilot.resize_terminal(40, 12)
        await pilot.pause()
        app.screen.show(app.view())
        await pilot.pause()
        panes = [app.screen.query_one(kind) for kind in (ReplayLevelPane, ReplayStripPane, ReplayKeys)]
        return stand_in.text_of(app), [pane.region for pane in panes], app.screen.region

    _listed, (text, regions, screen) = replayed(look, path)
    assert all(screen.contains_region(region) and region.area for region in regions), regions
    assert "REPLAY 12:00:00Z  paused" in text
    assert "l live" in text
    assert "Z" in text.splitlines()[regions[1].bottom - 1]


def test_a_time_to_jump_to_is_not_saved(path):  # noqa: F811 - the fixture
    async def look(app, pilot, _deck):
        await pilot.press("g")
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    _listed, text = replayed(look, path)
    assert "Enter jumps" in text


def test_the_pocket_view_keeps_one_row_of_the_signal_beside_three_of_words():
    assert arrange(40, 11, heard=True, wrong_in=lambda _columns: 3).signal == 1
    assert arrange(40, 11, heard=True, wrong_in=lambda _columns: 0).signal == 2
    assert arrange(40, 11, heard=True, wrong_in=lambda _columns: 4).signal == 0


def test_what_is_chosen_from_a_list_is_read_as_well_as_what_it_is_called():
    async def look(app, pilot):
        await pilot.press("f", "down")
        await pilot.pause()
        rows = app.screen.query_one(OptionList)
        prompts = [rows.get_option_at_index(index).prompt for index in range(rows.option_count)]
        return [any(span.style == "dim" for span in prompt.spans) for prompt in prompts]

    dim = stage.run(look, key="f3")
    assert dim == [True, False, True, True, True]


@pytest.mark.parametrize("key", ["D", "w"])
def test_the_line_that_is_typed_into_is_seen_where_a_dialog_is_higher_than_the_screen(key):
    async def look(app, pilot):
        await pilot.press(key)
        await pilot.resize_terminal(40, 12)
        await pilot.pause()
        found = []
        for _ in range(4):
            await pilot.pause()
            await pilot.pause()
            line, frame = app.screen.focused, app.screen.query_one(Vertical)
            found.append(frame.content_region.contains_region(line.region))
            await pilot.press("tab")
        return found

    assert stage.run(look, key="f3") == [True] * 4
