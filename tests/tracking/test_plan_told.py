"""A plan as text and as JSON: what a person and a program read."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import datetime, timedelta

import pytest
from birdcage.sky.downlinks import Downlink
from birdcage.sky.targets.model import Fixed
from birdcage.tracking.plan_values import plan_values
from birdcage.tracking.plan_words import plan_lines
from birdcage.tracking.planning.planner import plan_pass

from .orbits import NOW, PLACE, mount, plan_of, travler


@pytest.fixture(scope="module")
def rewinding():
    return plan_of(-2.0, orbit={"inclination_deg": 51.6, "height_km": 420.0})


@pytest.fixture(scope="module")
def through_the_keyhole():
    return plan_of(0.07, mount(travler(5.0), at=(200.0, 30.0)), orbit={"northbound": False}, frequency_hz=1.7e9)


def test_the_text_fits_a_terminal_and_tells_what_matters(rewinding, through_the_keyhole):
    for plan in (rewinding, through_the_keyhole):
        assert max(map(len, plan_lines(plan))) <= 80
    text = "\n".join(plan_lines(rewinding))
    assert "MADE UP (999)" in text
    assert "Rewind   12:12:52Z: dish +23° to -333°, 9.6 s" in text
    assert "↺ rewind" in text
    assert "Leave    12:08:" in text
    assert "Beyond the cable stop for 10 s." in text
    text = "\n".join(plan_lines(through_the_keyhole))
    assert "1700 MHz" in text
    assert "at best 2.69°" in text
    assert " TCA " in text


def test_a_plan_says_what_is_sent_and_what_satdump_calls_it(rewinding):
    sent = Downlink(
        "X", 1.7013e9, 1.7013e9, "AHRPT", "RHCP", True, "a test", "2019", symbol_rate_baud=2333333.0,
        pipeline="metop_ahrpt",
    )  # fmt: skip
    plan = replace(rewinding, aim=replace(rewinding.aim, frequency_hz=1.7013e9, downlink=sent))
    assert "AHRPT, RHCP, 2.333 Mbaud   SatDump metop_ahrpt   doubtful: 2019, " in "\n".join(plan_lines(plan))
    assert max(map(len, plan_lines(plan))) <= 80
    told = plan_values(plan)["target"]["downlink"]
    assert (told["pipeline"], told["symbol_rate_baud"], told["doubtful"]) == ("metop_ahrpt", 2333333.0, True)
    assert plan_values(rewinding)["target"]["downlink"] is None


def test_a_row_shows_target_and_dish_only_where_the_dish_is_on_it(rewinding):
    rows = {line[:9]: line for line in plan_lines(rewinding) if line[2:3] == ":"}
    assert rows["12:11:59Z"].split() == ["12:11:59Z", "TCA", "325.6", "58.8", "-34.4", "58.8", "0.10°", "0.02", "dB"]
    assert rows["12:06:35Z"].split() == ["12:06:35Z", "AOS", "240.5", "0.6"]


def test_what_cannot_be_followed_is_told_without_numbers_for_the_dish():
    text = "\n".join(plan_lines(plan_pass(Fixed("low", 200.0, 5.0), PLACE, mount(beam_deg=None), NOW)))
    assert "nothing: it is not within reach" in text
    assert "18° floor" in text
    assert "Error" not in text


def test_the_values_are_json_with_utc_times(rewinding):
    values = json.loads(json.dumps(plan_values(rewinding)))
    assert values["target"]["norad_id"] == 999
    assert values["made_at"] == "2026-11-21T12:00:00.000Z"
    assert [leg["part"] for leg in values["legs"]] == ["follow", "rewind", "follow"]
    assert values["rewinds"] == 1
    assert [one["what"] for one in values["incidents"]] == [
        "aos", "reach", "tca", "rewind", "reach", "unreach", "los"
    ]  # fmt: skip
    times = [datetime.fromisoformat(row["at"]) for row in values["path"]]
    assert times[1] - times[0] == timedelta(seconds=1)
    assert all(row["at"].endswith("Z") for row in values["path"])


def test_unknown_values_are_null():
    values = plan_values(plan_of(4.0, mount(beam_deg=None, at=None)))
    assert values["forecast"]["max_loss_db"] is None
    assert values["path"][0]["dish_az_deg"] is None
    assert {row["loss_db"] for row in values["path"]} == {None}
    assert values["pass"]["max_elevation_deg"] == pytest.approx(58.0, abs=0.5)
