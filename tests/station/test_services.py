"""Named services of a station's program, and whole plans, as attached programs have them."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from birdcage.base.errors import BadMessage, CommandRefused
from birdcage.base.paths import Paths
from birdcage.base.reason import Reason
from birdcage.station.attached import AttachedStation
from birdcage.station.events import PursuitChanged
from birdcage.station.plan_form import plan_from_json, plan_to_json
from birdcage.station.plan_outline import PlanOutline, outline
from birdcage.station.pursuit_state import Phase, Pursuit, PursuitOptions
from birdcage.station.services import News

from tests.tracking.orbits import plan_of

from .attached_bench import until


class Counter:
    """A service that tells the sum of its orders, to each caller its own."""

    def __init__(self) -> None:
        self.visits: list[Visit] = []

    def join(self, wake):
        self.visits.append(Visit(wake))
        return self.visits[-1]


class Visit:
    def __init__(self, wake) -> None:
        self._wake, self.total, self.plans, self.told, self.closed = wake, 0, (), None, False

    def take(self, order) -> None:
        if not isinstance(order, int):
            raise BadMessage("Give a whole number.")
        self.total += order
        self._wake()

    def news(self):
        if self.told == self.total:
            return None
        self.told = self.total
        return News({"total": self.total}, self.plans)

    def close(self) -> None:
        self.closed = True


@pytest.fixture
def face(owner):
    station = AttachedStation(Paths.default(), owner.state.port)
    assert station.wait_attached(10.0)
    yield station
    station.close()


def ask(caller, number, kind, **fields) -> None:
    caller.say({"v": 1, "id": number, "request": {"v": 1, "type": kind, "service": "sum", **fields}})


def test_each_caller_has_a_visit_of_its_own(owner, face):
    owner.services.offer("sum", service := Counter())
    other, heard, theirs = AttachedStation(Paths.default(), owner.state.port, name="bert"), [], []
    face.services.join("sum", heard.append)
    other.services.join("sum", theirs.append)
    face.services.order("sum", 3).result(10.0)
    until(lambda: heard and heard[-1] == {"total": 3})
    until(lambda: theirs == [{"total": 0}])
    other.close()
    until(lambda: [visit.closed for visit in service.visits].count(True) == 1)


def test_a_service_that_comes_later_is_joined_then_and_one_that_goes_is_told(owner, face):
    heard = []
    face.services.join("sum", heard.append)
    until(lambda: heard == [None])
    with pytest.raises(CommandRefused) as refused:
        face.services.order("sum", 1).result(10.0)
    assert refused.value.reason is Reason.UNSUPPORTED
    withdraw = owner.services.offer("sum", Counter())
    until(lambda: heard == [None, {"total": 0}])
    withdraw()
    until(lambda: heard == [None, {"total": 0}, None])


def test_the_next_program_is_joined_too(owner, face):
    heard = []
    owner.services.offer("sum", Counter())
    face.services.join("sum", heard.append)
    until(lambda: heard == [{"total": 0}])
    owner.server.close()
    until(lambda: heard == [{"total": 0}, None])
    owner.serve_again()
    owner.services.offer("sum", Counter())
    until(lambda: heard[-1] == {"total": 0})


def test_an_order_that_is_garbage_is_refused_and_ends_nothing(owner, attach):
    owner.services.offer("sum", Counter())
    anna = attach()
    ask(anna, 1, "JoinService")
    ask(anna, 2, "AskService", order={"much": [None]})
    assert anna.until(id=2)["error"]["sentence"] == "Give a whole number."
    ask(anna, 3, "AskService")
    assert "lacks order" in anna.until(id=3)["error"]["sentence"]
    ask(anna, 4, "AskService", order=5)
    assert anna.until(id=4)["ok"] is True
    assert anna.until(type="ServiceTold", news={"total": 5})


def test_a_slow_reader_gets_the_newest_news_and_not_all(owner, attach):
    owner.services.offer("sum", service := Counter())
    anna = attach()
    ask(anna, 1, "JoinService")
    anna.until(type="ServiceTold")
    for _ in range(2000):
        service.visits[0].take(1)
    seen = [anna.until(type="ServiceTold")["news"]["total"]]
    while seen[-1] != 2000:
        seen.append(anna.until(type="ServiceTold")["news"]["total"])
    assert seen == sorted(seen)
    assert len(seen) < 2000


def same(one, other) -> bool:
    """Whether two plans are equal, arrays and all."""
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other, equal_nan=True)
    if isinstance(one, tuple) and not hasattr(one, "_fields"):
        return len(one) == len(other) and all(map(same, one, other))
    if dataclasses.is_dataclass(one):
        return type(one) is type(other) and all(
            same(getattr(one, field.name), getattr(other, field.name)) for field in dataclasses.fields(one)
        )
    return one == other


def test_a_plan_comes_back_whole_from_its_json_form():
    plan = plan_of()
    assert plan.course is not None
    assert plan.forecast is not None
    back = plan_from_json(plan_to_json(plan))
    assert same(plan, back)
    assert back.course.at(plan.sky.start_s + 100.0) == plan.course.at(plan.sky.start_s + 100.0)


@pytest.mark.parametrize("sky", [[], {"t_s": [1.0], "az_deg": [1.0], "el_deg": [1.0]}, {"t_s": ["1.0"]}, None])
def test_a_plan_that_is_none_is_refused(sky):
    told = plan_to_json(plan_of())
    told["plan"]["sky"] = sky
    with pytest.raises(BadMessage):
        plan_from_json(told)


def followed(plan) -> Pursuit:
    return Pursuit(1, "tracker", plan, PursuitOptions(), Phase.WAITING, 0.0, "")


def test_an_attached_face_has_the_plan_of_a_pursuit_whole_and_is_told_it_once(owner, face, attach):
    plan, events, anna = plan_of(), [], attach()
    face.subscribe(events.append, PursuitChanged)
    for why in ("first", "second", "third"):
        pursuit = dataclasses.replace(followed(plan), why=why)
        owner.board.change(pursuit=pursuit)
        owner.board.tell(PursuitChanged(*owner.board.stamp(), pursuit))
    until(lambda: len(events) == 3)
    assert same(face.state.pursuit.plan, plan)
    assert all(same(event.pursuit.plan, plan) for event in events)
    told = [anna.hear()["type"]]
    while told.count("PursuitChanged") < 3:
        told.append(anna.hear()["type"])
    assert told.count("PlanTold") == 1
    assert told.index("PlanTold") < told.index("PursuitChanged")


def test_the_plans_of_news_are_told_before_them(owner, face):
    service, plan, heard = Counter(), plan_of(), []
    owner.services.offer("sum", service)
    face.services.join("sum", heard.append)
    until(lambda: heard)
    service.visits[0].plans = (plan,)
    face.services.order("sum", 1)
    until(lambda: len(heard) == 2)
    assert same(face.services.plans.whole(outline(plan)), plan)
    assert isinstance(face.services.plans.whole(outline(plan_of(5.0))), PlanOutline)
