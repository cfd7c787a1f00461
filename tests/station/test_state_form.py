"""The state as JSON: what arrives equals what left, for every state of recorded runs."""

from __future__ import annotations

import json
import math
from dataclasses import fields, replace

import pytest
from birdcage.base.errors import BadMessage, CommandRefused
from birdcage.base.reason import Reason
from birdcage.rotator.axis import Axis, Role
from birdcage.rotator.feature import Feature, Range
from birdcage.rotator.mapping import Arc, MappingOutline
from birdcage.station.attach_messages import state_from_json, state_shape, state_to_json
from birdcage.station.json_form import parse
from birdcage.station.json_shapes import shape_of
from birdcage.station.plan_outline import outline
from birdcage.station.requests import Goto, Home, Read
from birdcage.station.state import StationState
from birdcage.station.state_changes import StateChanges

from .conftest import Bench
from .pursuit_bench import Phase, at, g2, plan_of, travler
from .story import Story


def recorded(bench, act) -> list[StationState]:
    """Every state that a bench goes through."""
    states = []
    end = bench.station.watch(states.append)
    act(bench)
    end()
    return states


def as_told(state: StationState) -> StationState:
    """A state with outlines in the place of what stays inside."""
    if state.pursuit is not None:
        state = replace(state, pursuit=replace(state.pursuit, plan=outline(state.pursuit.plan)))
    if state.dish is not None and state.dish.mapping is not None:
        mapping = MappingOutline.of(state.dish.axes, state.dish.mapping)
        state = replace(state, dish=replace(state.dish, mapping=mapping))
    return state


def replayed(states):
    """What arrives at the other end, where only changes are told after the first."""
    before = arrived = None
    for state in states:
        told = state_to_json(state, before)
        if told is not None:
            arrived = state_from_json(parse(json.dumps(told, allow_nan=False)), arrived or StationState())
        before = state
        yield state, arrived


def check(states) -> None:
    assert len(states) > 20
    for left, arrived in replayed(states):
        assert arrived == as_told(left)
    whole = state_from_json(parse(json.dumps(state_to_json(states[-1], None))), StationState())
    assert whole == as_told(states[-1])


def a_day(bench) -> None:
    bench.connect(12.0)
    bench.step(10.0)
    bench.watch("position", "health")
    bench.do(Goto(180.0, 45.0, "you"), 200)
    readable = [each.id for each in bench.state.dish.features.values() if each.is_readable and not each.read_hazard]
    if readable:
        bench.do(Read(tuple(readable[:5])))
    bench.station.submit(Goto(250.0, 50.0, "you"))
    bench.step(2.0)
    bench.station.stop("you")
    bench.step(8.0)


@pytest.mark.parametrize("firmware", ["g2", "hal205", "carryout"])
def test_a_day_of_each_machine_arrives_as_it_left(firmware: str) -> None:
    check(recorded(Bench(f"{firmware}?seed=1", firmware=firmware), a_day))


def test_a_homing_and_a_lost_cable_arrive_as_they_left() -> None:
    def act(bench) -> None:
        bench.connect()
        bench.do(Home("you"), 120)
        bench.device.unplug()
        bench.step(5.0)

    check(recorded(Bench(), act))


@pytest.mark.parametrize("make", [g2, travler])
def test_a_pass_arrives_as_it_left_its_plan_by_its_outline(make) -> None:
    def act(bench) -> None:
        bench.pursue(plan_of(at(bench), lasts_s=60.0))
        bench.until(Phase.FOLLOWING).step(15)

    states = recorded(make(), act)
    assert any(state.pursuit is not None and state.pursuit.sample is not None for state in states)
    check(states)


@pytest.mark.parametrize("seed", range(4))
def test_stories_around_the_console_arrive_as_they_left(seed: int) -> None:
    check(recorded(Story(seed), lambda story: story.tell()))


def test_a_position_alone_is_told_as_a_position_alone() -> None:
    bench = Bench().connect()
    before = bench.state
    after = replace(before, holder="you")
    assert state_to_json(after, before) == {"v": 1, "type": "StateChanged", "changes": {"holder": "you"}}
    assert state_to_json(replace(before), before) is None


def test_a_value_that_json_lacks_is_left_out_and_the_rest_is_told() -> None:
    state = StationState()
    odd = replace(state, el_min_deg=math.nan, holder="you")
    assert state_to_json(odd, state)["changes"] == {"holder": "you"}


@pytest.mark.parametrize(("told", "said"), [
    ({"v": 2, "type": "StateTold", "state": {}}, "version 2"), ({"v": 1, "type": "StateTold"}, "The state is null"),
    ({"v": 1, "type": "StateTold", "state": {"hat": 1}}, 'no field "hat"'),
    ({"v": 1, "type": "StateChanged", "changes": []}, "Give an object"),
    ({"v": 1, "type": "StateChanged", "changes": {"hat": 1}}, 'no field "hat"'),
    ({"v": 1, "type": "StateChanged", "changes": {"holder": 5}}, "holder is 5. Give text."),
])  # fmt: skip
def test_a_state_is_read_strictly(told, said) -> None:
    with pytest.raises(BadMessage) as refused:
        state_from_json(told, StationState())
    assert said in str(refused.value)


def test_every_field_of_the_state_is_told_and_may_be_changed() -> None:
    names = [each.name for each in fields(StationState)]
    assert [each.name for each in state_shape().fields] == names
    assert list(StateChanges.__annotations__) == names


def test_facts_that_do_not_fit_together_are_refused() -> None:
    told = state_to_json(Bench().connect().state, None)
    told["state"]["dish"]["axes"] = []
    with pytest.raises(BadMessage, match="does not fit together"):
        state_from_json(told, StationState())


def test_a_range_without_an_end_has_null_there() -> None:
    shape = shape_of(Feature)
    feature = Feature("speed", "speed", range=Range(low=0.0))
    assert shape.tell(feature, "x")["range"] == {"low": 0.0, "high": None}
    assert shape.take(shape.tell(feature, "x"), "x") == feature


def swings(deg: float) -> tuple[float, float]:
    return (deg + 360.0) % 360.0, 40.0 - abs(deg) / 10.0


HOUR = Axis("hour", Role.ARC, -60.0, 60.0, 2.0, 1.0, 0.1)


def test_the_curve_of_a_single_axis_is_told_by_points_and_read_back_near_enough() -> None:
    told = MappingOutline.of((HOUR,), Arc("hour", -60.0, 60.0, swings))
    shape = shape_of(MappingOutline)
    back = shape.take(json.loads(json.dumps(shape.tell(told, "x"))), "x")
    assert back == told
    for deg in (-60.0, -33.3, -0.5, 0.5, 17.0, 60.0):
        az, el = back.to_sky({"hour": deg})
        assert (az - swings(deg)[0] + 180.0) % 360.0 - 180.0 == pytest.approx(0.0, abs=0.01)
        assert el == pytest.approx(swings(deg)[1], abs=0.06)
    angles, miss = back.to_axes(20.0, 38.0)
    assert angles["hour"] == pytest.approx(20.0, abs=0.05)
    assert miss == pytest.approx(0.0, abs=0.05)
    assert MappingOutline.of((HOUR,), back) is back


def test_the_outline_of_two_axes_says_how_far_it_reaches_and_points_nowhere() -> None:
    class Pair:
        def to_axes(self, az_deg, el_deg):
            return {"x": 0.0, "y": 0.0}, 0.0

        def to_sky(self, angles):
            return (180.0 + angles["x"]) % 360.0, 30.0 + angles["y"]

    axes = replace(HOUR, name="x"), replace(HOUR, name="y", min_deg=-10.0, max_deg=10.0)
    told = MappingOutline.of(axes, Pair())
    assert told.sky[0].min_deg == pytest.approx(120.0, abs=0.1)
    assert told.points == ()
    with pytest.raises(CommandRefused, match="Only the program that has the port") as refused:
        told.to_sky({"x": 0.0, "y": 0.0})
    assert refused.value.reason is Reason.UNSUPPORTED
