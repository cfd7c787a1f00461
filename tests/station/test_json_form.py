"""The JSON form of requests and events: there and back, and what is said of what is none."""

from __future__ import annotations

import contextlib
import json
import types
from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass, replace
from datetime import UTC, datetime, timedelta, timezone
from enum import Enum
from types import MappingProxyType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import pytest
from birdcage.base.errors import BadMessage
from birdcage.base.text import clean
from birdcage.rotator.feature import Reading
from birdcage.station.control_messages import ENDS, FROM_OUTSIDE, EventsEnded
from birdcage.station.events import LeaseChanged, PositionRead, PursuitChanged, ReadingRead
from birdcage.station.json_form import (
    STAYS_INSIDE,
    event_from_json,
    event_types,
    parse,
    request_from_json,
    request_types,
    to_json,
)
from birdcage.station.json_shapes import shape_of
from birdcage.station.plan_outline import PlanOutline
from birdcage.station.requests import ApplySettings, Goto, Jog, Pursue, Read, Request, Set, Watch
from birdcage.station.state import Pointing
from hypothesis import given, settings
from hypothesis import strategies as st

from .pursuit_bench import Phase, at, g2, plan_of

THEN = datetime(2026, 11, 23, 6, 4, 28, 250000, UTC)
TEXT = st.text(max_size=20).map(clean)
NUMBER = st.floats(allow_nan=False, allow_infinity=False)
LINES = st.lists(TEXT, min_size=1, max_size=3).map("\n".join)
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)
LEAVES = {
    str: TEXT, float: NUMBER, bool: st.booleans(), int: st.integers(-(2**53), 2**53), type(None): st.none(),
    datetime: st.datetimes(timezones=st.just(UTC)),
}  # fmt: skip
ALL = {**request_types(), **FROM_OUTSIDE, EventsEnded.__name__: EventsEnded, **event_types()}
QUICK = settings(max_examples=20, deadline=None, database=None)


def any_of(kind: Any) -> st.SearchStrategy[Any]:
    """Return values of a type, made from the type alone."""
    if kind in LEAVES:
        return LEAVES[kind]
    origin, arguments = get_origin(kind), get_args(kind)
    if origin in (Union, types.UnionType):
        return st.one_of(LINES if each is str and float in arguments else any_of(each) for each in arguments)
    if origin is Literal:
        return st.sampled_from(arguments)
    if origin is tuple and arguments[1:] == (...,):
        return st.lists(any_of(arguments[0]), max_size=3).map(tuple)
    if origin is tuple:
        return st.tuples(*map(any_of, arguments))
    if origin is frozenset:
        return st.frozensets(any_of(arguments[0]), max_size=3)
    if origin is Mapping:
        return st.dictionaries(any_of(arguments[0]), any_of(arguments[1]), max_size=3).map(MappingProxyType)
    if isinstance(kind, type) and issubclass(kind, Enum):
        return st.sampled_from(list(kind))
    assert is_dataclass(kind), f"{kind}: say here, and in json_shapes, what it looks like"
    hints = get_type_hints(kind, localns={"Plan": PlanOutline})
    return st.builds(kind, **{each.name: any_of(hints[each.name]) for each in fields(kind) if each.init})


def back(message: object) -> object:
    line = json.dumps(to_json(message), allow_nan=False)
    told = parse(line)
    name = type(message).__name__
    return event_from_json(told) if name in event_types() else request_from_json(told, ALL)


def test_every_request_has_a_form_or_a_reason_why_not() -> None:
    assert {*request_types().values(), *STAYS_INSIDE} == set(get_args(Request))
    assert {"Goto", "Stop", "Read", "Set"} <= set(request_types())
    assert {"PositionRead", "FaultRaised", "MoveEnded"} <= set(event_types())


def test_no_field_hides_version_or_type() -> None:
    assert not [kind for kind in ALL.values() if {"v", "type"} & {each.name for each in fields(kind)}]


@pytest.mark.parametrize("name", ALL)
@QUICK
@given(data=st.data())
def test_there_and_back(name: str, data: st.DataObject) -> None:
    message = data.draw(any_of(ALL[name]))
    assert back(message) == message


@pytest.mark.parametrize("name", ALL)
@QUICK
@given(data=st.data())
def test_what_enemies_send_is_refused_in_one_way(name: str, data: st.DataObject) -> None:
    told = to_json(data.draw(any_of(ALL[name])))
    key = data.draw(st.sampled_from([*told, "more"]))
    told[key] = data.draw(JSON)
    for take in (lambda told: request_from_json(told, ALL), event_from_json):
        with contextlib.suppress(BadMessage):
            take(told)


@QUICK
@given(JSON)
def test_any_json_is_refused_in_one_way(told: object) -> None:
    for take in (request_from_json, event_from_json):
        with pytest.raises(BadMessage):
            take(told)


@QUICK
@given(st.binary() | st.text().map(str.encode) | JSON.map(lambda told: json.dumps(told).encode()))
def test_any_bytes_are_json_or_refused(line: bytes) -> None:
    with contextlib.suppress(BadMessage):
        parse(line)


@pytest.mark.parametrize("line", [
    "[" * 100_000, '{"v": NaN}', '{"v": -Infinity}', "1" * 5000, b"\xff\xfe{}", b"\x00", "", "{", "{} {}",
])  # fmt: skip
def test_lines_that_break_parsers_are_refused(line: bytes | str) -> None:
    with pytest.raises(BadMessage):
        parse(line)


def test_a_request_reads_as_its_fields() -> None:
    assert to_json(Goto(180.0, 45, "you")) == {
        "v": 1, "type": "Goto", "az_deg": 180.0, "el_deg": 45.0, "holder": "you", "clamp": False, "take_over": False,
        "asked": True, "resume_within_s": 0.0,
    }  # fmt: skip
    assert to_json(Watch("you", frozenset({"rssi", "position"})))["features"] == ["position", "rssi"]


def test_an_event_reads_as_its_fields() -> None:
    here = Pointing(180.0, 45.0, 181.5, 45.0, 12.5, THEN)
    told = to_json(PositionRead(12.5, THEN, here))
    assert (told["type"], told["utc"]) == ("PositionRead", "2026-11-23T06:04:28.250000Z")
    assert told["position"]["cable_deg"] is None
    assert told["position"]["dish_az_deg"] == 181.5


def test_what_has_a_default_may_be_left_out() -> None:
    told = {"v": 1, "type": "Goto", "az_deg": 180, "el_deg": 45, "holder": "you"}
    assert request_from_json(told) == Goto(180.0, 45.0, "you")


def test_a_time_of_another_zone_is_the_same_time() -> None:
    told = to_json(LeaseChanged(0.0, THEN, "you", None)) | {"utc": "2026-11-23T08:04:28.25+02:00"}
    assert event_from_json(told) == LeaseChanged(0.0, THEN, "you", None)
    east = timezone(timedelta(hours=2))
    assert to_json(LeaseChanged(0.0, THEN.astimezone(east), None, None))["utc"] == "2026-11-23T06:04:28.250000Z"


@pytest.mark.parametrize(("change", "said"), [
    ({"v": 2}, "is in version 2, and this birdcage reads version 1. Update it"),
    ({"v": None}, 'says no version. Give "v": 1.'),
    ({"v": True}, "says no version"),
    ({"type": "Got"}, '"Got" is no request here. There are Goto, Follow,'),
    ({"type": ["Goto"]}, "a list is no request here"),
    ({"az_deg": "north"}, 'Goto.az_deg is "north". Give a number.'),
    ({"az_deg": True}, "Goto.az_deg is true. Give a number."),
    ({"az_deg": None}, "Goto.az_deg is null. Give a number."),
    ({"az_deg": 10**400}, "within ±2^53"),
    ({"clamp": 1}, "Goto.clamp is 1. Give true or false."),
    (
        {"azimuth": 1},
        'Goto has no field "azimuth". It has az_deg, el_deg, holder, clamp, take_over, asked, resume_within_s.',
    ),
    ({"type": "Pursue"}, "Pursue can't come from another program. A plan is made by the program that has the port"),
    ({"type": "ApplySettings"}, "Settings come from birdcage.toml"),
])  # fmt: skip
def test_what_is_wrong_is_named_with_what_belongs_there(change: dict[str, object], said: str) -> None:
    with pytest.raises(BadMessage) as refused:
        request_from_json(to_json(Goto(180.0, 45.0, "you")) | change)
    assert said in str(refused.value)


def test_a_missing_field_is_named() -> None:
    with pytest.raises(BadMessage, match=r"Jog lacks d_el_deg\. It has d_az_deg, d_el_deg, holder, take_over\."):
        request_from_json({"v": 1, "type": "Jog", "d_az_deg": 1.0, "holder": "you"})


@pytest.mark.parametrize("time", ["", "yesterday", "2026-11-23", "2026-11-23T06:04:28", "0001-01-01T00:00:00+14:00", 5])
def test_a_time_has_a_zone(time: object) -> None:
    with pytest.raises(BadMessage, match="Give a time like"):
        event_from_json(to_json(LeaseChanged(0.0, THEN, None, None)) | {"utc": time})


def test_numbers_that_json_lacks_are_refused() -> None:
    for wrong in (float("nan"), float("inf")):
        with pytest.raises(BadMessage, match=r"Jog\.d_az_deg"):
            to_json(Jog(wrong, 0.0, "you"))


@pytest.mark.parametrize("request_", [Pursue(None, "you"), ApplySettings(None, "you")])
def test_what_stays_inside_is_refused_by_name(request_: object) -> None:
    with pytest.raises(BadMessage, match=f"{type(request_).__name__} has no JSON form"):
        to_json(request_)


def test_text_from_outside_comes_in_clean() -> None:
    told = {"v": 1, "type": "Set", "feature": "la\x1b[2Jmp", "value": "a\u202eb", "holder": "an\nna", "agreed": True}
    assert request_from_json(told) == Set("la[2Jmp", "ab", "an na", agreed=True)


def test_text_of_several_lines_is_a_list_of_them() -> None:
    event = ReadingRead(1.0, THEN, "settings", "one\ntwo\n", "")
    assert to_json(event)["value"] == ["one", "two", ""]
    assert event_from_json(to_json(event)) == event


def test_a_plan_is_told_by_its_outline() -> None:
    bench = g2()
    bench.pursue(plan_of(at(bench), lasts_s=60.0))
    bench.until(Phase.FOLLOWING).step(2)
    event = [each for each in bench.events if isinstance(each, PursuitChanged)][-1]
    told, plan = to_json(event), event.pursuit.plan
    assert set(told["pursuit"]["plan"]) == {each.name for each in fields(PlanOutline)}
    assert len(json.dumps(told)) < 2500
    read = event_from_json(told)
    assert read.pursuit.plan.aim.name == plan.aim.name
    assert read.pursuit.plan.begins.timestamp() == pytest.approx(plan.legs[0].start_s, abs=1e-5)
    assert to_json(read) == told
    assert read.pursuit == replace(event.pursuit, plan=read.pursuit.plan)


def test_all_that_a_station_tells_of_a_pass_goes_there_and_back() -> None:
    bench = g2()
    bench.pursue(plan_of(at(bench), lasts_s=60.0))
    bench.until(Phase.FOLLOWING).step(5)
    bench.station.stop("you")
    bench.step(5)
    assert len({type(each) for each in bench.events}) >= 8
    for event in bench.events:
        told = to_json(event)
        assert to_json(event_from_json(parse(json.dumps(told, allow_nan=False)))) == told


def test_readings_go_by_name() -> None:
    shape = shape_of(Mapping[str, Reading])
    readings = {"rssi": Reading(237.0, "counts", 1.5, THEN)}
    assert shape.take(shape.tell(readings, "x"), "x") == readings


def test_a_type_without_a_form_is_found_when_it_is_declared() -> None:
    with pytest.raises(TypeError, match="has no JSON form"):
        shape_of(bytes)


def test_every_end_of_events_has_its_words() -> None:
    assert {each: ended.why for each, ended in ENDS.items()} == {each: each for each in ENDS}


def test_required_fields_are_those_without_a_default() -> None:
    required = [each.name for each in fields(Read) if each.default is MISSING]
    assert required == ["features"]
