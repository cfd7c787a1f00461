"""Names that amateurs type, in the app: the go-to line, Track's search, F7's filter; a real desk behind them."""

from __future__ import annotations

import pytest
import stand_in
from birdcage.base.presets import Preset
from birdcage.station.requests import Goto
from birdcage_tui.goto.goto_line import GotoLine
from desk_house import play
from textual.widgets import Input

LINE = {
    "moon": ("▲", "Moon is", "below the horizon. It rises at"),
    "polaris": ("Enter:", "Polaris: az 0.", "el 38."),
    "dish 119": ("Enter:", "119°W EchoStar 14: az 214.35° SW, el 38.7"),
    "E28.2": ("▲", "28.2°E Astra 28 is", "never rises here."),
    "28.2 east": ("▲", "never rises here."),
    "w110": ("Enter:", "110°W EchoStar 10: az 20"),
    "E 40": ("▲", "type az 90 el 40, or 40E."),
    "ao-7": ("▲", "AO-7 (7530) is not among your 7 satellites. `birdcage elements update`"),
    "noaa 18": ("▲", "silent since 2025-06-06"),
    "noaa 19": ("NOAA 19", "silent since 2025-08-13"),
    "ao-91": ("RADFXSAT (FOX-1B)",),
    "iss": ("ISS (ZARYA)",),
    "25544": ("ISS (ZARYA)",),
    "noaa": ("▲", "'noaa' fits several: NOAA 20 (JPSS-1) (43013), NOAA 19 (33591, silent since 2025-08-13)"),
    "polairs": ("▲", "No target is called 'polairs'. Did you mean Polaris?"),
    "cas a": ("Cas A",),
    "180,45": ("Enter:", "az 180.00° S, el 45.00°"),
    "180": ("▲", "Type two numbers, 180 45; or az=180"),
}


def test_the_go_to_line_says_what_is_meant_and_where_it_stands(tmp_path):
    async def through(house):
        await house.press("g")
        return {typed: await house.type(typed) for typed in LINE}

    shown = play(tmp_path, through)
    for typed, told in LINE.items():
        line = shown[typed].partition("go to")[2]
        for words in told:
            assert words in line, (typed, line)


def test_enter_goes_where_the_target_stands_also_if_it_comes_before_the_answer(tmp_path):
    async def go(house):
        await house.press("g", *"polaris", "enter")
        waiting = stand_in.text_of(house.app), list(house.asked)
        await house.look()
        await house.look()
        return waiting, house.asked, house.app.query_one(GotoLine).is_open

    (text, before), asked, is_open = play(tmp_path, go)
    assert "Looking for polaris" in text
    assert not any(isinstance(each, Goto) for each in before)
    (goto,) = (each for each in asked if isinstance(each, Goto))
    assert (goto.el_deg, goto.holder) == (pytest.approx(39.1, abs=0.9), "you")
    assert not is_open


@pytest.mark.parametrize("keys", [("x",), ("escape",), ("ctrl+c",)])
def test_an_enter_that_waits_is_taken_back_by_another_letter_esc_and_stop(tmp_path, keys):
    async def go(house):
        await house.press("g", *"polaris", "enter", *keys)
        for _ in range(3):
            await house.look()
        return house.asked

    assert not any(isinstance(each, Goto) for each in play(tmp_path, go))


def test_what_is_below_the_horizon_or_unknown_is_not_sent(tmp_path):
    async def go(house):
        for typed in ("E28.2", "ao-7", "noaa", "polairs", "E 40"):
            await house.press("g")
            await house.type(typed)
            await house.press("enter")
            await house.look()
            assert house.app.query_one(GotoLine).is_open, typed
            await house.press("escape")
        return house.asked

    assert not any(isinstance(each, Goto) for each in play(tmp_path, go))


def test_a_preset_counts_by_its_whole_name_and_is_ambiguous_by_a_part_that_targets_share(tmp_path):
    async def go(house):
        for name, az_deg in (("noaa", 10.0), ("Polaris tower", 20.0), ("Met mast", 30.0)):
            house.app.presets.add(Preset(name, az_deg, 30.0))
        await house.press("g")
        return {
            typed: (await house.type(typed)).partition("go to")[2] for typed in ("noaa", "polaris", "met", "met ma")
        }

    shown = play(tmp_path, go)
    assert "noaa: az 10.00°" in shown["noaa"]
    assert "Polaris: az 0." in shown["polaris"], "a whole name, and of the preset a part"
    assert "met matches the preset Met mast and one of several targets. Type the whole name." in shown["met"]
    assert "Met mast: az 30.00°" in shown["met ma"]


SEARCH = {
    "iss": ("▶  ISS (ZARYA)", "ISS (NAUKA)"),
    "ao-91": ("▶  RADFXSAT (FOX-1B)",),
    "METEOR-M N2-3": ("▶  METEOR-M2 3",),
    "noaa": ("▶  NOAA 20 (JPSS-1)", "silent since 2025-08"),
    "ao-7": ("AO-7 (7530) is not among your 7", "FUNCUBE-1 (AO-73)"),
    "noaa 18": ("NOAA 18 has been silent since 2025-06-06",),
    "polairs": ("No target is called 'polairs'.", "mean Polaris?"),
    "dish 119": ("119°W EchoStar 14", "geostationary"),
    "E28.2": ("28.2°E Astra 28", "never rises here"),
    "cas a": ("▶  Cas A",),
    "180,45": ("az 180.00° el",),
}


@pytest.mark.parametrize("size", [(80, 24), (120, 36)])
def test_tracks_search_finds_the_same_and_says_the_same(tmp_path, size):
    async def through(house):
        await house.press("f2", "c", "slash")
        return {typed: await house.type(typed) for typed in SEARCH}

    shown = play(tmp_path, through, size)
    for typed, told in SEARCH.items():
        for words in told:
            assert " ".join(words.split()) in shown[typed], (typed, shown[typed])


def test_a_silent_target_is_chosen_by_enter_and_track_says_so(tmp_path):
    async def choose(house):
        await house.press("f2", "c", "slash")
        await house.type("noaa 19")
        await house.press("enter")
        await house.look()
        shown = await house.look()
        await house.press("a", "enter")
        await house.look()
        return shown, house.app.track.now.choice, house.asked

    shown, choice, asked = play(tmp_path, choose, (120, 36))
    assert choice == "33591"
    assert "NOAA 19 has been silent since 2025-08-13" in shown
    assert any(isinstance(each, Goto) for each in asked), "a person may point at it all the same"


def test_what_is_below_the_horizon_says_when_it_rises_and_is_not_called_out_of_reach_for_ever(tmp_path):
    async def choose(house):
        shown = {}
        for typed in ("moon", "28.2E"):
            await house.press("f2", "c", "slash")
            await house.type(typed)
            await house.press("enter")
            await house.look()
            shown[typed] = await house.look()
        return shown

    shown = play(tmp_path, choose, (160, 48))
    assert "below the horizon. It rises at" in shown["moon"]
    assert "rises 13:06 in reach 14:41-01:09" in shown["moon"], "by the same horizon as what is said of it"
    assert "It rises at 13:06 UTC" in shown["moon"]
    assert "below the horizon and never rises here." in shown["28.2E"]
    assert not any("ever in reach" in text for text in shown.values())


def test_the_filter_of_passes_takes_other_names_and_says_why_nothing_is_left(tmp_path):
    async def through(house):
        for _ in range(8):
            await house.look(1.0)
        await house.press("f7", "slash")
        shown = {typed: await house.type(typed) for typed in ("ao-91", "ao-27", "noaa 18", "zzzzz")}
        return shown, house.app.screen.focused

    shown, field = play(tmp_path, through, (120, 36))
    assert isinstance(field, Input)
    assert "RADFXSAT" in shown["ao-91"]
    assert "METEOR" not in shown["ao-91"]
    assert "AO-27 (22825) is not among your 7 satellites" in shown["ao-27"]
    assert "NOAA 18 has been silent since 2025-06-06" in shown["noaa 18"]
    assert "No target is called 'zzzzz'" in shown["zzzzz"]


def test_enter_takes_no_other_satellite_for_one_that_is_absent(tmp_path):
    async def enter(house):
        await house.press("f2", "c", "slash")
        await house.type("ao-7")
        await house.press("enter")
        shown = await house.look()
        before = house.app.track.now.choice
        await house.press("down", "enter")
        await house.look()
        return shown, before, house.app.track.now.choice

    shown, before, after = play(tmp_path, enter)
    assert "AO-7 (7530) is not among your 7" in shown
    assert before is None
    assert after == "39444", "a person may still choose it"
