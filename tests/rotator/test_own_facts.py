"""Facts one by one, who stands for them, and what an owner says laid over them."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.base.config import rows
from birdcage.rotator import machines
from birdcage.rotator.facts import SecondMove
from birdcage.rotator.ladder import EVERY_MOVE, Rung, StopMeans
from birdcage.rotator.listed_facts import listed
from birdcage.rotator.origin import Origin
from birdcage.rotator.own import OwnFact, OwnFacts, laid_by_owner, with_speeds

UTC_NOW = datetime(2026, 11, 22, tzinfo=UTC)
G2, TRAVLER = map(machines.facts_of, ("g2", "hal205"))


@pytest.mark.parametrize("firmware", ["g2", "hal205", "hal000", "pro", "carryout"])
def test_somebody_stands_for_every_fact_of_ours_that_is_known(firmware):
    facts = machines.facts_of(firmware)
    told = {fact.name: fact for fact in listed(facts)}
    assert set(facts.origin) <= set(told), "an origin of no fact"
    assert [name for name, fact in told.items() if fact.value is not None and fact.origin is None] == []


def test_a_fact_has_its_value_its_unit_and_its_origin():
    told = {fact.name: (fact.value, fact.unit, fact.origin) for fact in listed(TRAVLER)}
    assert told["elevation.max_deg"] == (90.0, "deg", Origin.DOCUMENTED)
    assert told["azimuth.times"] == ("table", "", Origin.MEASURED)
    assert told["azimuth.acceleration_deg_s2"] == (20.0, "deg/s2", Origin.INFERRED)
    assert told["second_same"] == ("queue", "", Origin.DOCUMENTED)
    assert told["homing_s"] == (None, "s", None)


def test_what_the_file_may_say_is_a_fact_of_that_name():
    names = {fact.name for fact in listed(TRAVLER)}
    assert {row.path.removeprefix("dish.facts.") for row in rows() if row.path.startswith("dish.facts.")} <= names


def test_what_the_owner_says_lies_over_what_is_known_of_its_kind():
    said, wrong = laid_by_owner(
        G2, {"azimuth.min_deg": 30.0, "azimuth.speed_deg_s": 40.0, "homing_s": 25.0, "power_switch": "plug"}
    )
    assert wrong == ()
    assert (said.azimuth.min_deg, said.azimuth.speed_deg_s, said.homing_s) == (30.0, 40.0, 25.0)
    assert said.power_switch == "plug"
    assert said.origin_of("azimuth.speed_deg_s") is Origin.USER
    assert said.origin_of("elevation.speed_deg_s") is Origin.DOCUMENTED
    assert G2.azimuth.min_deg == 0.0


def test_a_speed_replaces_times_that_were_measured_at_another_dish():
    said, _wrong = laid_by_owner(TRAVLER, {"azimuth.speed_deg_s": 5.0})
    assert (said.azimuth.times, said.azimuth.speed_deg_s) == (None, 5.0)
    assert said.elevation.times is not None


@pytest.mark.parametrize(
    ("facts", "values", "sentence"),
    [
        (G2, {"elevation.min_deg": 10.0}, "is 10, 8 deg beyond the Carryout G2's own limit of 18 deg"),
        (G2, {"elevation.max_deg": 90.0}, "is 90, 25 deg beyond"),
        (G2, {"cable.max_deg": 24.0}, "is 24, 0.67 deg beyond"),
        (G2, {"skew.speed_deg_s": 4.0}, "no skew axis of the Carryout G2 is known"),
        (G2, {"elevation.min_deg": 70.0}, "leaves no range: 70 to 65 deg"),
        (TRAVLER, {"second_same": "retarget"}, "known to queue, and STOP rests on that"),
        (TRAVLER, {"second_other": "unknown"}, "known to queue, and STOP rests on that"),
        (TRAVLER, {"homing_s": 20.0}, "homes only by itself"),
    ],
)
def test_what_could_harm_it_is_refused_and_what_is_known_counts(facts, values, sentence):
    said, (wrong,) = laid_by_owner(facts, values)
    assert wrong.startswith(f"dish.facts.{next(iter(values)).rpartition('.')[0]}")
    assert sentence in wrong
    assert wrong.endswith("It does not count.")
    assert [fact.value for fact in listed(said)] == [fact.value for fact in listed(facts)]


def test_a_range_that_is_an_assumption_may_be_widened():
    said, wrong = laid_by_owner(TRAVLER, {"skew.min_deg": -90.0})
    assert wrong == ()
    assert said.skew.min_deg == -90.0


def test_a_dish_that_is_said_to_wait_is_stopped_at_the_end_of_its_move():
    said, wrong = laid_by_owner(G2, {"second_same": "block", "second_other": "block"})
    assert wrong == ()
    assert [rung.means for rung in said.stop_ladder] == ["end of move", "release", "key", "power"]
    assert [rung.means for rung in G2.stop_ladder] == ["retarget", "release", "key", "power"]


def test_its_own_stop_command_stays_where_it_is_on_the_ladder():
    command = Rung(means=StopMeans.COMMAND, ends=EVERY_MOVE, proven=True, sentence="it halts")
    first = OwnFacts().that_waits(UTC_NOW).on(replace(G2, stop_ladder=(command, *G2.stop_ladder)))
    assert [rung.means for rung in first.stop_ladder] == ["command", "end of move", "release", "key", "power"]


def test_the_owner_goes_before_what_was_learnt_and_that_before_the_kind():
    waits = OwnFacts().that_waits(UTC_NOW)
    assert waits.on(G2).second_same is SecondMove.BLOCK
    assert waits.on(G2).origin_of("second_same") is Origin.LEARNT
    said, _wrong = laid_by_owner(G2, {"second_same": "retarget", "second_other": "retarget", "azimuth.play_deg": 0.02})
    play = OwnFact(0.05, Origin.USER, UTC_NOW)
    own = waits.with_fact("azimuth.play_deg", play).with_fact("elevation.play_deg", play).on(said)
    assert (own.second_same, own.stop_ladder[0].means) == (SecondMove.RETARGET, "retarget")
    assert (own.azimuth.play_deg, own.elevation.play_deg) == (0.02, 0.05)


def test_a_speed_that_is_in_force_counts_and_never_more_than_the_owner_says():
    said, _wrong = laid_by_owner(G2, {"azimuth.speed_deg_s": 40.0})
    assert with_speeds(said, {0: 65.0, 1: 30.0}).azimuth.speed_deg_s == 40.0
    assert with_speeds(said, {0: 20.0}).azimuth.speed_deg_s == 20.0
    assert with_speeds(said, {0: 65.0, 1: 30.0}).elevation.speed_deg_s == 30.0
