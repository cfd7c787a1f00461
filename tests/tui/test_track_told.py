"""What is told of a pursuit while it goes on, on Craft and elsewhere, and what a hand on the keys does to it."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
import stand_in
from birdcage.station.events import End, MoveEnded, PursuitChanged
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import AcquireLease, Jog, ReleaseLease
from textual.widgets import Input
from track_stage import SIZES, read, run


@pytest.mark.parametrize("page", ["f1", "f2", "f7"])
def test_a_countdown_stands_in_the_row_under_the_status_on_every_page(page):
    row = run(read, "craft-countdown", keys=(page,)).splitlines()[1]
    assert "▲ MOVES to 17°/18° for METOP-C in 4 s" in row
    assert "Space cancels" in row


def test_a_countdown_rings_once_and_stop_ends_it():
    async def ring(app, pilot, _desk):
        rung = []
        app.track._bell = lambda: rung.append(1)
        pursuit = app.station.state.pursuit
        for phase in (Phase.WAITING, Phase.COUNTDOWN, Phase.COUNTDOWN):
            app.track.hear(PursuitChanged(0.0, app.session.clock.utc(), replace(pursuit, phase=phase)))
        await pilot.press("space")
        return rung, app.station.stops

    rung, stops = run(ring, "craft-countdown")
    assert rung == [1]
    assert stops == ["you"]


def test_esc_stops_while_something_is_pursued_though_nothing_moves():
    async def press(app, pilot, _desk):
        await pilot.press("escape")
        return app.station.stops

    assert run(press, "craft-waiting") == ["you"]


def test_why_it_waits_and_when_it_goes_on_are_told():
    text = run(read, "craft-waiting")
    assert "WAITING FOR METOP-C" in text
    assert "moves in 32:10" in text
    assert "Below the 18° floor" in text
    assert "rises in 31 min" in text


def test_an_interrupted_pursuit_is_told_in_the_row_under_the_status():
    assert "◌ PURSUIT INTERRUPTED  The link was lost" in run(read, "craft-interrupted", keys=("f1",)).splitlines()[1]


def test_the_keyhole_is_written_on_the_time_axis_before_it_comes():
    for size in SIZES:
        assert "keyhole" in run(read, "craft-keyhole", size=size)


def test_the_offset_says_what_it_means_in_degrees():
    assert "offset +0.3 s = 0." in run(read, "craft-waiting", size=(120, 36))


def test_what_was_left_in_mid_pass_is_offered_and_taken_up_or_forgotten():
    async def press(app, pilot, desk):
        text = stand_in.text_of(app)
        await pilot.press("U", "D")
        await pilot.pause()
        return text, desk.asked

    text, asked = run(press, "craft-over", size=(120, 36))
    assert "METEOR-M2 4 was left in mid-pass, in reach until 12:05:00" in text
    assert asked == [("take_up",), ("forget_unfinished",)]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_what_was_left_in_mid_pass_is_offered_on_the_first_page_too(size):
    row = run(read, "craft-over", size=size, keys=("f1",)).splitlines()[1]
    assert "LEFT IN MID-PASS  U resume METEOR-M2 4 (5:00 left): dish moves" in row


def test_a_frequency_is_typed_in_megahertz():
    async def type_it(app, pilot, desk):
        await pilot.press("F")
        await pilot.pause()
        field = app.screen.query_one(Input)
        assert field.value == "137.9"
        field.value = "0.3"
        await pilot.press("enter")
        assert desk.asked == []
        field.value = "145.825"
        await pilot.press("enter")
        await pilot.pause()
        return desk.asked

    assert run(type_it) == [("set_frequency", 145.825e6)]


def test_the_dashboard_and_the_status_line_say_it_in_brief():
    text = run(read, keys=("f1",))
    assert "FOLLOW ±0.0" in text.splitlines()[0]
    assert "tracker" in text.splitlines()[0]
    for words in ("FOLLOWING METEOR-M2 4", "error ±0.0", "In reach 02:35, then 65° ceiling", "LOS 12:11:06", "12:06"):
        assert words in text, words


def test_the_pocket_view_says_it_in_two_rows():
    rows = run(read, size=(40, 12), keys=()).splitlines()
    assert any("FOLLOW METEOR-M2 4" in row and "err ±0.0" in row for row in rows)
    assert any("In reach 02:35, then above 65° ceiling" in row for row in rows)


def test_f_on_the_dashboard_goes_to_craft():
    async def page(app, pilot, _desk):
        await pilot.pause()
        return app.page.tab, app.page.id

    assert run(page, keys=("f",)) == ("craft", "page-control")


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_passes_autotrack_and_radio_can_be_seen_at_every_size(size):
    async def look(app, pilot, _desk):
        seen = stand_in.text_of(app)
        for _ in range(3):
            await pilot.press("v")
            await pilot.pause()
            await pilot.pause()
            seen += stand_in.text_of(app)
        return seen

    text = run(look, size=size)
    for words in ("Passes of the target", "10h10", "dry run: 6 of 7", "overlaps"):
        assert words in text, words
    if size[0] != 120:
        assert "137.898157 MHz" in text


def test_the_network_tab_says_what_there_is_and_what_there_is_not():
    for size in SIZES:
        text = run(read, size=size, keys=("f2", "N"))
        for words in (
            "Tracker.",
            "arrows, g, presets",
            "birdcage stop",
            "birdcage release",
            "off. o serves Gpredict",
        ):
            assert words in text


def test_what_a_command_did_before_the_pursuit_is_not_told_as_if_it_were_now():
    async def tell(app, pilot, _desk):
        clock, state = app.session.clock, app.station.state
        app.note("Arrived at 126.98°/41.86°.")
        clock.advance(60.0)
        state = replace(state, pursuit=replace(state.pursuit, since=clock.monotonic() - 50.0))
        app.station.state = state
        app.paint()
        await pilot.pause()
        before = stand_in.text_of(app)
        app.note("Maximum speed set.")
        app.paint()
        await pilot.pause()
        return before, stand_in.text_of(app)

    before, after = run(tell, keys=("f2",))
    assert "Arrived at" not in before
    assert "An arrow takes over, or g and a direction." in before
    assert "Maximum speed set." in after


def test_the_presets_fill_the_width_and_esc_goes_back_to_the_rose(kept):
    async def back(app, pilot, _desk):
        text, focused = stand_in.text_of(app), app.focused.id
        await pilot.press("escape")
        await pilot.pause()
        return text, focused, app.focused.id, app.page.tab

    text, focused, after, tab = run(back, "craft-idle", keys=("f2", "P"), presets_file=kept)
    assert "Direction 11" in text
    assert "Command" not in text
    assert (focused, after, tab) == ("presets", "rose", "manual")


def test_a_pursuit_that_is_over_keeps_its_curve_and_tells_its_figures():
    text = run(read, "craft-over", size=(160, 48))
    assert "Followed: pass ±0.0" in text
    assert "dish alone RMS 0.0" in text
    assert "It has set." in text


def test_the_looks_of_another_pursuit_do_not_stay():
    async def hear(app, _pilot, _desk):
        before = len(app.track.looks)
        app.track.hear(PursuitChanged(0.0, app.session.clock.utc(), replace(app.station.state.pursuit, number=9)))
        return before, len(app.track.looks)

    before, after = run(hear)
    assert before > 30
    assert after == 0


def test_what_is_not_known_is_a_dash():
    async def unknown(app, pilot, _desk):
        state = app.station.state
        app.station.state = replace(state, beam=None, pursuit=replace(
            state.pursuit, sample=replace(state.pursuit.sample, loss_db=None)))  # fmt: skip
        app.track.looks[-1] = replace(app.track.looks[-1], loss_db=None)
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    assert "--.-- dB" in run(unknown)


def test_help_says_what_the_tab_is_for():
    async def ask(app, pilot, _desk):
        await pilot.press("question_mark")
        await pilot.pause()
        return str(app.screen.query_one("OptionList").get_option_at_index(0).prompt)

    assert "Track a target." in run(ask)
    assert "Who controls" in run(ask, keys=("f2", "N"))


def test_following_draws_when_the_dish_was_looked_at_and_not_between():
    async def pace(app, _pilot, _desk):
        return app.frames._beat._active.is_set(), app.view().moving

    assert run(pace) == (False, True)


def test_a_key_that_moves_by_hand_takes_your_own_pursuit_over():
    async def jog(app, pilot, _desk):
        await pilot.press("right")
        return [request for request in app.station.asked if isinstance(request, AcquireLease | Jog)]

    assert run(jog, keys=("f1",)) == [Jog(1.0, 0.0, "you", take_over=True)]


def test_it_takes_nothing_from_anybody_else():
    async def jog(app, pilot, _desk):
        app.station.state = replace(app.station.state, holder="Gpredict")
        await pilot.press("right")
        return [request for request in app.station.asked if isinstance(request, AcquireLease | Jog)]

    assert run(jog, keys=("f1",)) == [Jog(1.0, 0.0, "you")]


def test_follow_gives_back_what_was_taken_by_hand():
    async def follow(app, pilot, desk):
        app.station.state = replace(
            app.station.state,
            holder="you",
            pursuit=replace(app.station.state.pursuit, phase=Phase.YIELDED, why="You have control."),
        )
        app.paint()
        await pilot.pause()
        text = stand_in.text_of(app)
        await pilot.press("f", "enter")
        await pilot.pause()
        return text, app.station.asked_for(ReleaseLease), desk.asked

    text, released, asked = run(follow)
    assert "f and Enter follow again. x: end." in text
    assert released == [ReleaseLease("you")]
    assert asked == [("follow",)]


def test_quitting_in_mid_pass_leaves_what_is_followed_before_stop_ends_it():
    async def leave(app, pilot, desk):
        seen, stop = [], app.station.stop
        app.station.stop = lambda by, **how: (seen.append(desk.closed), stop(by, **how))
        await pilot.press("ctrl+q")
        await pilot.pause()
        return seen, app.station.stops

    assert run(leave) == ([True], ["you"])


@pytest.mark.parametrize(("what", "row", "word"), [
    ("park", "MOVES to park at 180°/40° after METOP-C in 4 s", "ABOUT TO PARK AFTER METOP-C"),
    ("follow", "MOVES to 19°/22° for METOP-C in 4 s", "ABOUT TO MOVE TO METOP-C"),
])  # fmt: skip
def test_a_countdown_tells_where_it_leads_and_not_where_the_pass_began(what, row, word):
    async def tell(app, pilot, _desk):
        state = app.station.state
        options = replace(state.pursuit.options, park_az_deg=180.0, park_el_deg=40.0)
        app.station.state = replace(state, pursuit=replace(state.pursuit, next_what=what, options=options))
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = run(tell, "craft-countdown")
    assert row in text.splitlines()[1]
    assert word in text


def test_what_is_shown_beside_what_is_followed_is_only_watched():
    async def other(app, pilot, _desk):
        pursuit = app.station.state.pursuit
        aim = replace(pursuit.plan.aim, name="NOAA 20", norad_id=43013)
        coming = replace(
            pursuit.plan.incidents[0], what="floor", at_s=app.session.clock.utc().timestamp() + 61, text="20° floor"
        )
        app.station.state = replace(
            app.station.state, pursuit=replace(pursuit, plan=replace(pursuit.plan, aim=aim, incidents=(coming,)))
        )
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = run(other)
    assert "FOLLOWING NOAA 20" in text
    assert "20° floor in 01:01" in text
    assert "f and Enter follow METEOR-M2 4 instead." in text
    assert "● w Watch" in text
    assert "○ f Follow" in text


def test_manual_shows_where_the_target_is_and_not_where_the_motors_would_stop():
    async def numbers(app, pilot, _desk):
        state = app.station.state
        target = state.pursuit.sample
        app.station.state = replace(
            state, target_az_deg=target.target_az_deg + 5.0, target_el_deg=target.target_el_deg + 5.0
        )
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app), target

    for size in SIZES[:2]:
        text, target = run(numbers, size=size, keys=("f2",))
        shown = re.search(r"target +az +([\d.]+)° *el +([\d.]+)°|target +([\d.]+)° +([\d.]+)°", text)
        assert shown is not None, text
        az_deg, el_deg = (float(each) for each in shown.groups() if each)
        assert abs(az_deg - target.target_az_deg) < 0.006
        assert abs(el_deg - target.target_el_deg) < 0.006
        assert not re.search(r"✕ [45]\.\d|target [45]\.\d\d°", text), "the scales"


def test_manual_has_the_whole_error_or_none_at_80x24():
    text = run(read, size=SIZES[0], keys=("f2",))
    assert re.search(r"METEOR-M2 4 +err ±?0\.\d\d°", text), text


@pytest.mark.parametrize("keys", [("f1",), ("f2",)])
def test_what_a_pursuit_arrived_at_on_its_way_is_not_told_as_the_result_of_a_command(keys):
    async def arrive(app, pilot, _desk):
        clock, told = app.session.clock, []
        for phase in (Phase.FOLLOWING, Phase.YIELDED):
            state = app.station.state
            app.station.state = replace(state, pursuit=replace(state.pursuit, phase=phase))
            for listener in app.station.listeners:
                listener(MoveEnded(clock.monotonic(), clock.utc(), End.ARRIVED, "arrived", state.position))
            await pilot.pause()
            app.paint()
            await pilot.pause()
            told.append("Arrived at" in stand_in.text_of(app))
        return told

    assert run(arrive, keys=keys) == [False, True]


def test_row_two_forgets_what_was_told_before_the_dish_began_to_follow():
    async def tell(app, pilot, _desk):
        clock, state = app.session.clock, app.station.state
        app.note("Arrived at 126.98°/41.86°.")
        clock.advance(0.5)
        told = []
        for since in (clock.monotonic() - 1.0, clock.monotonic() - 0.1):
            app.station.state = replace(state, pursuit=replace(state.pursuit, since=since))
            app.paint()
            await pilot.pause()
            told.append("Arrived at" in stand_in.text_of(app).splitlines()[1])
        return told

    assert run(tell, keys=("f1",)) == [True, False]
