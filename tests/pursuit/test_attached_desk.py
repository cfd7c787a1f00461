"""The pursuit desk of a station's program, as attached faces have it: shared, each with its own search."""

from __future__ import annotations

import threading
import time

import pytest
from birdcage.base.config import Settings
from birdcage.base.config.sections import PlaceSettings
from birdcage.base.errors import BadMessage
from birdcage.base.paths import Paths
from birdcage.pursuit.attached_desk import NO_DESK, NOT_ATTACHED, AttachedDesk
from birdcage.pursuit.now import DeskNow, Mode
from birdcage.pursuit.order_form import FROM_OUTSIDE, now_from_json, now_to_json, order_from_json, order_to_json
from birdcage.pursuit.orders import (
    AimOrder,
    ApplyOrder,
    AutotrackOrder,
    ChooseOrder,
    ChoosePassOrder,
    FollowOrder,
    FrequencyOrder,
    SearchOrder,
    TimeOffsetOrder,
)
from birdcage.sky.targets import Resolver
from birdcage.sky.targets.model import Satellite
from birdcage.station.attached import AttachedStation
from birdcage.station.control_client import owners_folder
from birdcage.station.control_server import ControlServer
from birdcage.station.events import LinkChanged
from birdcage.station.pursuit_state import DONE, Phase

from .conftest import NOW, ORBITS
from .shared_desk import SharedDesk


class Face:
    """An attached program with its desk."""

    def __init__(self, port: str) -> None:
        self.station = AttachedStation(Paths.default(), port)
        assert self.station.wait_attached(10.0), self.station.state.link
        self.told: list[DeskNow] = []
        self.desk = AttachedDesk(self.station, self.told.append)
        self.desk.start()

    @property
    def now(self) -> DeskNow:
        return self.desk.now

    def close(self) -> None:
        self.desk.close()
        self.station.close()


@pytest.fixture
def shared(tmp_path):
    port = tmp_path / "port"
    port.touch()
    bench = SharedDesk(tmp_path, port=str(port))
    bench.serve()
    yield bench
    bench.server.close()
    bench.desk.close()


@pytest.fixture
def attach(shared):
    faces = []

    def attach() -> Face:
        faces.append(Face(shared.port))
        return faces[-1]

    yield attach
    for face in faces:
        face.close()


def test_a_pass_is_followed_to_its_end_though_the_face_that_asked_is_gone(shared, attach):
    anna = attach()
    anna.desk.choose(ORBITS[0].name)
    shared.meanwhile(lambda: anna.now.plan is not None)
    assert anna.now.plan.course is not None, "the plan is whole: the face draws it"
    anna.desk.follow()
    shared.meanwhile(lambda: shared.phase() is Phase.FOLLOWING, 90_000.0, 60.0)
    shared.meanwhile(lambda: anna.station.state.pursuit.phase is Phase.FOLLOWING, every=0.1)
    assert anna.station.state.pursuit.plan.sky.at(NOW.timestamp()), "so is that of what is followed"
    anna.close()
    shared.until(lambda: shared.phase() is Phase.OVER)
    assert shared.pursuit.why == DONE
    assert shared.station.state.held is None


def test_two_faces_share_the_choice_and_search_each_for_itself(shared, attach):
    anna, bert = attach(), attach()
    anna.desk.search("sun")
    bert.desk.search("moon")
    bert.desk.locate("moon")
    anna.desk.choose(ORBITS[0].name)
    shared.meanwhile(lambda: [each.name for each in anna.now.found] == ["Sun"])
    shared.meanwhile(lambda: [each.name for each in bert.now.found] == ["Moon"])
    shared.meanwhile(lambda: bert.now.located is not None and anna.now.choice is not None)
    shared.meanwhile(lambda: bert.now.choice == anna.now.choice == ORBITS[0].name)
    assert anna.now.located is None
    assert (anna.now.query, bert.now.query, shared.desk.now.query) == ("sun", "moon", "")


def test_a_program_that_was_killed_in_a_pass_offers_it_when_it_runs_again(shared, attach):
    anna = attach()
    anna.desk.choose(ORBITS[0].name)
    anna.desk.search("moon")
    anna.desk.follow()
    shared.meanwhile(lambda: shared.phase() is Phase.FOLLOWING, 90_000.0, 60.0)
    shared.step(7.0)
    shared.end()
    real = time.monotonic() + 10.0
    while anna.now.problem != NOT_ATTACHED:
        assert time.monotonic() < real
        threading.Event().wait(0.01)
    assert anna.now.plan is None, "unknown is not shown"
    shared.start()
    shared.serve()
    shared.meanwhile(lambda: anna.now.unfinished is not None)
    assert anna.now.unfinished.name == ORBITS[0].name
    shared.meanwhile(lambda: anna.now.query == "moon")
    anna.desk.take_up()
    shared.meanwhile(lambda: shared.phase() is Phase.FOLLOWING)
    shared.meanwhile(lambda: anna.now.mode is Mode.FOLLOW)


def test_without_a_desk_over_there_a_face_says_so(shared, attach):
    shared.server.close()
    shared.server = ControlServer(shared.station, owners_folder(Paths.default()))
    shared.server._hear(LinkChanged(0.0, shared.clock.utc(), shared.station.state.link))
    anna = attach()
    shared.meanwhile(lambda: anna.now.problem == NO_DESK)
    anna.desk.follow()
    shared.meanwhile(lambda: len(anna.told) > 1)
    assert shared.pursuit is None


def test_settings_are_read_again_over_there(shared, attach):
    anna = attach()
    anna.desk.choose(ORBITS[0].name)
    shared.meanwhile(lambda: anna.now.passes)
    shared.settings = Settings(place=PlaceSettings(name="there", latitude_deg=-33.0, longitude_deg=151.0))
    anna.desk.apply(Settings(), None)
    shared.meanwhile(lambda: anna.now.look is not None and shared.desk._work._plans.observer.name == "there")


TARGETS = ["sun", "101W", "polaris", "180 45"]


@pytest.mark.parametrize("text", TARGETS)
def test_each_kind_of_target_comes_back_from_an_order(text):
    meant = Resolver().resolve(text).target
    assert order_from_json(order_to_json(ChooseOrder(text, meant))) == ChooseOrder(text, meant)


def test_a_satellite_comes_back_with_its_elements():
    order = ChooseOrder("leo 1", Satellite(ORBITS[0], 1.5))
    assert order_from_json(order_to_json(order)) == order


@pytest.mark.parametrize(
    "order",
    [SearchOrder("a"), ChooseOrder("iss"), ChoosePassOrder(NOW), TimeOffsetOrder(1.5), FrequencyOrder(None), AimOrder(),
     FollowOrder(), AutotrackOrder(on=True)],
)  # fmt: skip
def test_each_order_comes_back(order):
    assert order_from_json(order_to_json(order)) == order


@pytest.mark.parametrize(
    "told",
    [None, [], 7, {}, {"type": "ApplyOrder"}, {"type": "carry_out"}, {"type": "FollowOrder", "asked": False},
     {"type": "TimeOffsetOrder", "seconds": 1e9}, {"type": "ChooseOrder"}, {"type": "ChooseOrder", "text": 3},
     {"type": "ChooseOrder", "text": "x", "target": {"kind": "planet"}}, {"type": ["FollowOrder"]},
     {"type": "ChooseOrder", "text": "x", "target": {"kind": ["body"]}}, {"type": "AutotrackOrder", "on": "yes"}],
)  # fmt: skip
def test_an_order_that_is_garbage_is_refused(told):
    with pytest.raises(BadMessage):
        order_from_json(told)


def test_what_stays_inside_has_no_json_form():
    assert "ApplyOrder" not in FROM_OUTSIDE
    with pytest.raises(BadMessage):
        order_to_json(ApplyOrder(None, None))


def test_what_a_desk_shows_comes_back(bench):
    bench.desk.search("moon")
    bench.desk.choose(ORBITS[0].name)
    now = bench.do(3.0)
    assert now.plan is not None
    assert now.passes
    back = now_from_json(now_to_json(now))
    assert back.passes == now.passes
    assert back.found == now.found
    assert back.look == now.look
    assert back.plan.aim.name == now.plan.aim.name
