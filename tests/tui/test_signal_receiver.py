"""F3: what the dish's own receiver tells, and what it lets be set."""

from __future__ import annotations

import asyncio
import re
from dataclasses import replace
from types import MappingProxyType, SimpleNamespace

import pytest
import stage
import stand_in
from birdcage.rotator.feature import Reading
from birdcage.station.converter import FeedConverter
from birdcage.station.events import ReadingRead
from birdcage.station.requests import Read, Set, Watch
from birdcage_tui.commands import BY_NAME
from birdcage_tui.signal.polarisations import LATE_S, PolarisationPane
from birdcage_tui.signal.receiver import ReceiverPane
from test_demo import stage_of_the_pictures
from textual.widgets import Static

SIZES = [(80, 24), (120, 36), (160, 48)]
TOLD = {
    "lock": True, "snr": (9.1, "dB"), "network": "0x1004", "rf_agc": (1412.0, "counts"), "if_agc": (1206.0, "counts"),
    "raw_rssi": (235.0, "counts"), "transponder": 15.0, "frequency": (1178.12, "MHz"), "symbol_rate": (20000.0, "ksps"),
    "polarisation": "V", "lnb_supply": (13.1, "V"), "tuner_chip": "0x4515",
}  # fmt: skip
STOCK = FeedConverter(11.25e9)


def rows(size, *, age_s=5.0, converter=STOCK, name="idle", **values):
    """Return the rows of the pane with what was told, so long ago."""

    async def look(app, pilot):
        now, utc = app.session.clock.monotonic(), app.session.clock.utc()
        readings = dict(app.station.state.readings)
        for each, value in (TOLD | values).items():
            if value is not None:
                told, unit = value if isinstance(value, tuple) else (value, "")
                readings[each] = Reading(told, unit, now - age_s, utc)
        app.station.state = replace(app.station.state, readings=MappingProxyType(readings), converter=converter)
        app.paint()
        await pilot.pause()
        pane = app.query_one(ReceiverPane)
        region = pane.content_region
        lines = stand_in.text_of(app).splitlines()[region.y : region.bottom]
        return [line[region.x : region.right].rstrip() for line in lines]

    return stage.run(look, name, size, key="f3")


@pytest.mark.parametrize("size", SIZES[1:], ids=str)
def test_where_there_is_room_all_of_it_stands_in_three_rows_by_subject(size):
    found = [" ".join(row.split()) for row in rows(size)]
    assert found == [
        "lock yes SNR 9.1 dB network 0x1004 AGC RF/IF 1412/1206 ADC 235 counts",
        "transponder 15 RF 12428.1 MHz IF 1178.1 MHz symbols 20000 ksps wants vertical",
        "LNB 13.1 V vertical chip 0x4515",
    ]


def test_on_a_small_screen_what_counts_comes_first_and_nothing_is_cut():
    found = [" ".join(row.split()) for row in rows((80, 24))]
    assert found == [
        "lock yes SNR 9.1 dB network 0x1004 LNB 13.1 V vertical transponder 15",
        "RF 12428.1 MHz AGC RF/IF 1412/1206 IF 1178.1 MHz wants vertical",
    ]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_what_was_not_told_is_a_dash(size):
    text = " ".join(" ".join(rows(size, transponder=None, frequency=None, rf_agc=None, lnb_supply=None)).split())
    for words in ("transponder -", "RF -", "IF -", "AGC RF/IF -/1206", "LNB -"):
        assert words in text, words


def test_the_frequency_in_the_sky_needs_the_lo_of_the_feed():
    assert "RF - IF 1178.1 MHz" in " ".join(" ".join(rows((120, 36), converter=None)).split())
    above = " ".join(" ".join(rows((120, 36), converter=FeedConverter(13.6e9, high_side=True))).split())
    assert "RF 12421.9 MHz" in above


@pytest.mark.parametrize(("volts", "said"), [
    (18.2, "LNB 18.2 V horizontal"), (13.0, "LNB 13 V vertical"), (0.4, "LNB 0.4 V chip"), (15.6, "LNB 15.6 V chip"),
])  # fmt: skip
def test_the_supply_says_which_polarisation_it_means_and_none_in_between(volts, said):
    assert said in " ".join(" ".join(rows((120, 36), lnb_supply=(volts, "V"))).split())


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_what_is_old_shows_its_age_where_there_is_room(size):
    found = rows(size, age_s=200.0)
    assert any("(3m old)" in row for row in found) is (size != (80, 24))
    assert "chip 0x4515 (" not in " ".join(found)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_every_row_ends_inside_the_pane(size):
    for row in rows(size, age_s=200.0):
        assert len(row) < size[0] - 2, row


def test_a_supply_of_the_other_polarisation_is_marked_and_the_right_one_is_not():
    assert "wants vertical ▲" in " ".join(rows((120, 36), lnb_supply=(18.1, "V")))
    assert "▲" not in " ".join(rows((120, 36)))
    assert "▲" not in " ".join(rows((120, 36), lnb_supply=(15.6, "V"))), "neither voltage says nothing"


def test_a_machine_without_a_receiver_says_so():
    assert rows((120, 36), name="travler-slew")[0].strip() == "This dish has no receiver of its own."


def asked(*keys, name="idle", size=(120, 36), **state):
    """Return what the station was asked after these keys, what is seen, and why the commands are refused."""

    async def press(app, pilot):
        for key in keys:
            await pilot.press(key)
            await pilot.pause()
        app.paint()
        await pilot.pause()
        dialog = app.screen if len(app.screen_stack) > 1 else None
        words = "" if dialog is None else " ".join(str(each.render()) for each in dialog.query(Static))
        text = stand_in.text_of(app)
        refused = [BY_NAME[each].refused(app.view()) for each in ("signal-transponder", "signal-13v")]
        return SimpleNamespace(
            sets=app.station.asked_for(Set), reads=app.station.asked_for(Read), text=text, refused=refused,
            dialog=" ".join(words.split()),
        )  # fmt: skip

    return stage.run(press, name, size, key="f3", state=state)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_13_volts_are_asked_about_with_their_consequence_and_only_y_sends_them(size):
    question = asked("V", size=size)
    assert "No command back to 18 V is known; a power cycle of the dish brings it back." in question.dialog
    assert "Supply now: not read yet." in question.dialog
    assert question.sets == []
    assert asked("V", "enter", size=size).sets == []
    agreed = asked("V", "y", size=size)
    assert agreed.sets == [Set("enable_lna", True, "you", agreed=True)]
    assert "lnb_supply" in agreed.reads[-1].features


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_transponder_is_typed_within_its_range(size):
    question = asked("n", size=size)
    assert "What it is tuned to is not known." in question.dialog
    assert "Odd ones are vertical, at 13 V, even ones horizontal, at 18 V." in question.dialog
    tuned = asked("n", "7", "enter", size=size)
    assert tuned.sets == [Set("transponder", 7.0, "you")]
    assert {"transponder", "frequency", "lnb_supply"} <= set(tuned.reads[-1].features)
    assert "Tuning to transponder 7." in tuned.text


@pytest.mark.parametrize(("typed", "said"), [("33", "Give 1 to 32."), ("0", "Give 1 to 32."), ("a", "Type 1 to 32.")])
def test_a_number_that_there_is_not_is_refused_and_nothing_is_sent(typed, said):
    refused = asked("n", *typed, "enter")
    assert refused.sets == []
    assert said in refused.dialog


@pytest.mark.parametrize(("name", "state", "said"), [
    ("travler", {}, "The Trav'ler has no "), ("lost", {}, "The dish does not answer."),
    ("held", {}, "STOP is latched. Enter releases it."), ("idle", {"holder": "Gpredict"}, "Gpredict has control."),
])  # fmt: skip
def test_where_neither_can_be_set_both_are_refused_with_the_reason(name, state, said):
    for key in ("n", "V"):
        pressed = asked(key, name=name, **state)
        assert (pressed.sets, pressed.dialog) == ([], "")
        assert all(reason.startswith(said) for reason in pressed.refused), pressed.refused


BOTH = {"even_level", "odd_level"}


def watched(*keys, size=(120, 36), name="idle"):
    """Return which watches asked for both polarisations after these keys, and whether they were agreed to."""

    async def press(app, pilot):
        for key in keys:
            await pilot.press(key)
            await pilot.pause()
        app.paint()
        await pilot.pause()
        asked_for = [(set(each.features) >= BOTH, each.agreed) for each in app.station.asked_for(Watch)]
        return asked_for, stand_in.text_of(app), app.query_one(PolarisationPane).region, app.screen.region

    return stage.run(press, name, size, key="f3")


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_both_polarisations_are_read_only_after_a_yes_and_while_they_are_shown(size):
    question = asked("b", size=size).dialog
    assert "Each reading switches the LNB supply to 18 V and to 13 V." in question
    assert "Which of them stays afterwards is not known." in question
    assert not any(both or agreed for both, agreed in watched("b", "enter", size=size)[0])
    asked_for, text, region, screen = watched("b", "y", size=size)
    assert asked_for[-1] == (True, True)
    assert screen.contains_region(region)
    assert "not read yet" in text
    assert watched("b", "y", "v", size=size)[0][-1] == (False, False)


def test_while_both_are_shown_they_take_turns_with_the_supply_alone_and_it_is_told():
    async def press(app, pilot):
        await pilot.press("b", "y")
        supply = {"lnb_supply": Reading(13.1, "V", app.session.clock.monotonic(), app.session.clock.utc())}
        app.station.state = replace(app.station.state, readings={**app.station.state.readings, **supply})
        app.paint()
        await pilot.pause()
        both = app.station.asked_for(Watch)[-1].features, stand_in.text_of(app)
        app.session.clock.advance(LATE_S + 1.0)
        app.paint()
        await pilot.pause()
        assert "13.1 V" not in stand_in.text_of(app), "it may be another one by now"
        await pilot.press("v")
        await pilot.pause()
        return both, app.station.asked_for(Watch)[-1].features, stand_in.text_of(app)

    (features, text), after, later = stage.run(press, "idle", (120, 36), key="f3")
    assert set(features) == BOTH | {"position", "lnb_supply"}
    assert "LNB supply 13.1 V vertical" in text
    assert "─ Receiver ─" not in text
    assert {"snr", "frequency"} <= set(after)
    assert "─ Receiver ─" in later


def test_on_a_screen_for_the_pocket_view_neither_is_read_and_what_was_said_stays_true():
    async def shrink(app, pilot):
        await pilot.press("b", "y")
        await pilot.resize_terminal(40, 12)
        await pilot.pause()
        small = app.station.asked_for(Watch)[-1], app.view().note
        await pilot.resize_terminal(120, 36)
        await pilot.pause()
        return small, app.station.asked_for(Watch)[-1]

    (small, note), again = stage.run(shrink, "idle", (120, 36), key="f3")
    assert (set(small.features) & BOTH, small.agreed) == (set(), False)
    assert note == "Both polarisations are read while F3 shows them. v shows another view."
    assert (set(again.features) >= BOTH, again.agreed) == (True, True)


def test_other_views_never_come_to_it():
    assert not any(both for both, _agreed in watched("v", "v", "v", "v")[0])


def test_a_dish_without_that_command_says_so():
    asked_for, text, _region, _screen = watched("b", name="travler")
    assert "has no command that hears both polarisations" in text
    assert not any(both for both, _agreed in asked_for)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_either_is_shown_with_unit_and_age_inside_the_pane(size):
    async def look(app, pilot):
        await pilot.press("b", "y")
        now, utc = app.session.clock.monotonic(), app.session.clock.utc()
        for age_s, even, odd in ((20.0, 489.0, 235.0), (3.0, 612.0, 240.0)):
            for name, value in (("even_level", even), ("odd_level", odd)):
                app.signals.polarisations.take(ReadingRead(now - age_s, utc, name, value, "counts"))
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = stage.run(look, "idle", size, key="f3")
    for words in ("612 counts", "240 counts", "3.0s old", "(18 V, horizontal)", "(13 V, vertical)"):
        assert words in text, words
    told = (re.match(r"│ +(\d+) (?!counts)", line) for line in text.splitlines())
    labels = [int(found[1]) for found in told if found]
    assert len(labels) >= 4, labels
    assert all(label % 10 == 0 for label in labels), labels


def test_in_the_demo_the_tuner_is_tuned_and_the_lnb_has_13_volts_afterwards():
    """The real page, the real station, the simulated dish: what goes out, and what is shown then."""
    pictures = stage_of_the_pictures()

    async def play():
        async with pictures.demo((120, 36)) as on:
            await on.wait(9)
            await on.press("f3", "right")
            await on.wait(6)
            await on.press("n", "8", "enter")
            await on.wait(4)
            tuned = on.text()
            await on.press("V", "y")
            await on.wait(4)
            return tuned, on.text(), dict(on.app.station.state.readings)

    tuned, fed, readings = asyncio.run(play())
    assert "transponder 8" in tuned
    assert "IF 1076.1 MHz" in " ".join(tuned.split())
    assert "wants horizontal ▲" in " ".join(fed.split())
    assert readings["lnb_supply"].value == pytest.approx(13.0, abs=0.3)
