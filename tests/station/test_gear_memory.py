"""What is known of a dish's own gear: overshoot learnt from readings at rest, play set by its owner, both kept."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from statistics import fmean

import pytest
from birdcage.base.errors import ConfigError
from birdcage.link.identity import dish_folder
from birdcage.rotator.origin import Origin
from birdcage.rotator.own import OwnFact, OwnFacts
from birdcage.station.facts_file import FILE, FactsFile
from birdcage.station.pursuit_state import Phase
from birdcage.station.report import status_report
from birdcage.station.requests import Goto, Release, Stop

from .pursuit_bench import PursuitBench, at, plan_of

UTC_NOW = datetime(2026, 11, 22, tzinfo=UTC)
LASTS_S = 70.0
AZ_UP, AZ_PLAY = "azimuth.mean_overshoot_up_deg", "azimuth.play_deg"
UPS = {AZ_UP, "elevation.mean_overshoot_up_deg"}
OVERSHOOTS = UPS | {"azimuth.mean_overshoot_down_deg", "elevation.mean_overshoot_down_deg"}


def dish(tmp_path, options="seed=1&overshoot=1", identity="usb:A"):
    address = f"g2?az=-180&{options}"
    return PursuitBench(address, {"state_folder": tmp_path, "identify": lambda _port: identity}).connect()


def kept(tmp_path, identity="usb:A"):
    return FactsFile(dish_folder(tmp_path, identity) / FILE, "g2")


def to_and_fro(bench, times):
    for _ in range(times):
        bench.do(Goto(200, 40, "you"))
        bench.step(2.0)
        bench.do(Goto(190, 30, "you"))
        bench.step(2.0)


def learnt(bench):
    return {name: round(fact.value, 3) for name, fact in bench.state.own.facts.items()}


def test_overshoot_is_learnt_in_each_direction_and_shown_with_where_it_comes_from(tmp_path):
    bench = dish(tmp_path)
    to_and_fro(bench, 9)
    found = bench.state.own.facts
    assert set(found) == OVERSHOOTS
    for name, fact in found.items():
        assert fact.value == pytest.approx(0.03 if name in UPS else 0.04, abs=0.012)
        assert fact.origin is Origin.LEARNT
        assert fact.readings >= 6
    assert bench.state.dish.azimuth.mean_overshoot_up_deg == found[AZ_UP].value
    told = status_report(bench.state, bench.clock.monotonic())["gear"]
    assert told["azimuth_overshoot_up_readings"] == found[AZ_UP].readings
    assert "learnt from" in told["sentence"]
    json.dumps(told)


def test_a_few_readings_tell_nothing(tmp_path):
    bench = dish(tmp_path)
    to_and_fro(bench, 4)
    bench.step(60.0)  # the same rest, read again and again
    assert learnt(bench) == {}


def test_a_dish_that_stops_on_its_target_is_known_to_do_so(tmp_path):
    bench = dish(tmp_path, "seed=1&overshoot=0")
    to_and_fro(bench, 9)
    assert max(map(abs, learnt(bench).values())) < 0.006


def test_a_dish_that_never_says_that_it_took_a_move_teaches_nothing(tmp_path):
    bench = dish(tmp_path, "seed=1&overshoot=1&move_reply=none")
    to_and_fro(bench, 9)
    assert learnt(bench) == {}


def test_where_stop_leads_is_no_target_that_was_missed(tmp_path):
    bench = dish(tmp_path)
    for _ in range(8):
        bench.station.submit(Goto(250, 45, "you"))
        bench.step(0.5)
        bench.do(Stop("you"))
        bench.step(3.0)
        bench.do(Release("you"))
        bench.station.submit(Goto(190, 45, "you"))
        bench.step(0.5)
        bench.do(Stop("you"))
        bench.step(3.0)
        bench.do(Release("you"))
    assert learnt(bench) == {}


def test_the_next_program_knows_it_of_that_dish_and_of_no_other(tmp_path):
    first = dish(tmp_path)
    to_and_fro(first, 9)
    first.session.close()
    assert set(learnt(dish(tmp_path))) == set(learnt(first))
    assert learnt(dish(tmp_path, identity="usb:B")) == {}
    assert learnt(dish(tmp_path, identity=None)) == {}
    kept(tmp_path).forget_gear()
    assert learnt(dish(tmp_path)) == {}


def said(**changes):
    fact = {"name": AZ_PLAY, "value": 0.05, "origin": "user", "utc": "2026-11-22T00:00:00+00:00", "readings": 0}
    return json.dumps({"firmware": "g2", "facts": [fact | changes]})


@pytest.mark.parametrize(
    "text",
    [
        "", "{", "[]", "[" * 2000, '{"firmware": "g2", "facts": [{"name": "azimuth.play_deg"}]}', '{"firmware": "g2"}',
        '{"firmware": "g2", "facts": 7}', '{"firmware": "g2", "facts": ["azimuth"]}', said(value=3.0),
        said(value=float("nan")), said(value="far"), said(value=None), said(origin="documented"), said(utc="yesterday"),
        said(utc="2026-11-22T00:00:00"), said(readings=-1), said(name="elevation.max_deg"),
        said(name="second_same", value="flee"), said().replace("g2", "hal205"), "\0" * 100_000,
        json.dumps({"firmware": "g2", "facts": [json.loads(said())["facts"][0]] * 50}),
        said(name="x" * 100_000),
    ],
    ids=range(22),
)  # fmt: skip
def test_a_damaged_file_tells_nothing(tmp_path, text):
    kept(tmp_path).write(OwnFacts())
    kept(tmp_path).path.write_text(text)
    assert learnt(dish(tmp_path)) == {}


def test_play_that_was_set_meanwhile_is_not_lost_when_something_is_learnt(tmp_path):
    bench = dish(tmp_path)
    kept(tmp_path).set_play(0.05, None, UTC_NOW)
    to_and_fro(bench, 9)
    assert kept(tmp_path).read().facts[AZ_PLAY].value == 0.05
    assert bench.state.dish.azimuth.play_deg == 0.05


@pytest.mark.parametrize("deg", [-0.01, 0.2, float("nan"), float("inf")])
def test_a_play_that_cannot_be_one_is_refused(tmp_path, deg):
    with pytest.raises(ConfigError, match=r"type 0 to 0\.15"):
        kept(tmp_path).set_play(deg, None, UTC_NOW)


def test_what_cannot_be_written_is_learnt_all_the_same(tmp_path):
    (tmp_path / "dishes").write_text("in the way")
    bench = dish(tmp_path)
    to_and_fro(bench, 9)
    assert AZ_UP in learnt(bench)


def followed(tmp_path, *, known, low=18.0, high=40.0):
    """The mean of what the shaft is off, in its own degrees, up and down, as it really stands; and the bench."""
    if known:
        own = OwnFacts()
        for axis in ("azimuth", "elevation"):
            own = own.with_fact(f"{axis}.play_deg", OwnFact(0.06, Origin.USER, UTC_NOW))
        for name in OVERSHOOTS:
            own = own.with_fact(name, OwnFact(0.0, Origin.LEARNT, UTC_NOW, 20))
        kept(tmp_path).write(own)
    bench = dish(tmp_path, "seed=1&overshoot=0&backlash=0.06")
    plan = plan_of(at(bench) + 30.0, from_az=170.0, low=low, high=high, lasts_s=LASTS_S)
    bench.pursue(plan)
    bench.until(Phase.FOLLOWING)
    off = {True: [], False: []}
    for _ in range(int(LASTS_S / 0.4)):
        bench.step(0.4)
        now, truth = at(bench), bench.device.truth()
        gone_s = now - plan.legs[0].start_s
        if 3.0 < gone_s < LASTS_S - 1.0 and abs(gone_s - LASTS_S / 2) > 6:
            az, el = plan.course.at(now)
            off[gone_s < LASTS_S / 2].append((truth.az_deg - az % 360.0, truth.el_deg - el))
    return [[fmean(each) for each in zip(*values, strict=True)] for values in off.values()], bench


def test_known_play_is_taken_up_and_the_error_told_is_that_of_the_shaft(tmp_path):
    (up, down), bench = followed(tmp_path, known=True)
    assert max(map(abs, (*up, *down))) < 0.009
    assert bench.pursuit.rms_error_deg < 0.035
    (up, down), _bench = followed(tmp_path / "other", known=False)
    assert up[0] < -0.02
    assert up[1] < -0.015
    assert down[1] > 0.015


def test_no_command_leaves_the_limits_for_it(tmp_path):
    _off, bench = followed(tmp_path, known=True, low=18.0, high=65.0)
    bench.until(Phase.OVER)
    assert "beyond" not in bench.pursuit.why
    assert bench.state.fault is None
    sent = [float(line.split()[2]) for _at, line in bench.received() if line.startswith("a 1 ")]
    assert min(sent) >= 18.0
    assert max(sent) <= 65.0
