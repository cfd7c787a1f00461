"""What a client's `p`, `P` and `S` do, who may move the dish, and what HELD is to clients."""

from __future__ import annotations

import pytest
from birdcage.base.held import HeldReason
from birdcage.rotctld.client_view import ClientRole
from birdcage.rotctld.rprt import Rprt
from birdcage.station.events import ClientIgnored
from birdcage.station.requests import AcquireLease, Goto, Release, ReleaseLease
from birdcage.station.state import Activity

from .shared_bench import SharedBench, code_of


@pytest.fixture
def bench():
    return SharedBench()


def test_p_tells_where_the_dish_is_and_asks_it_nothing(bench):
    clients = bench.join(*(f"client {number}" for number in range(50)))
    bench.run(3.0)
    lines = len(bench.lines())
    for _ in range(20):
        told = {client.position() for client in clients}
        assert told == {(bench.state.position.az_deg, bench.state.position.el_deg)}
    assert len(bench.lines()) == lines
    before = len(bench.lines())
    bench.run(10.0)
    assert len(bench.lines()) - before <= 12, "fifty clients cost one poll a second"


def test_the_last_one_who_leaves_ends_the_polls(bench):
    one, other = bench.join("one", "other")
    one.leave()
    other.leave()
    bench.run(1.0)
    before = len(bench.lines())
    bench.run(5.0)
    assert len(bench.lines()) == before


def test_before_it_is_read_there_is_no_position(bench):
    client = bench.shared.client("early")
    assert code_of(client.position) is Rprt.EIO
    assert code_of(client.set_position, 100.0, 40.0) is Rprt.EIO
    bench.connect()
    bench.run(1.0)
    client.position()
    assert not bench.sent_moves()


def test_a_dish_that_is_not_homed_has_no_position():
    bench = SharedBench(more="unhomed=1&nvs20=0")
    client = bench.join("client")
    assert bench.state.homed is False
    assert code_of(client.position) is Rprt.EIO


def test_the_first_wish_takes_a_free_lease_and_the_dish_arrives(bench):
    client = bench.join("client")
    assert bench.state.holder is None
    client.set_position(123.0, 41.0)
    bench.settle()
    assert bench.state.holder == "client"
    assert bench.sent_moves() == ["a 0 123.00", "a 1 41.00"]
    assert client.position() == pytest.approx((123.0, 41.0), abs=0.1)
    view = bench.view("client")
    assert (view.role, view.ignored, view.why) == (ClientRole.CONTROL, 0, "")


def test_in_motion_p_follows_the_dish(bench):
    client = bench.join("client")
    client.set_position(350.0, 40.0)
    bench.settle()
    client.set_position(200.0, 40.0)
    bench.run(1.5)
    assert bench.state.motion is not None
    assert 203.0 < client.position()[0] < 347.0


@pytest.mark.parametrize(
    ("asked", "sent"),
    [
        ((169.90, 156.92), ["a 0 349.90", "a 1 23.08"]),
        ((190.45, 158.37), ["a 0 10.45", "a 1 21.63"]),
        ((100.0, 130.0), ["a 0 280.00", "a 1 50.00"]),
        ((30.0, 178.0), ["a 0 210.00", "a 1 18.00"]),
        ((-10.0, 30.0), ["a 0 350.00", "a 1 30.00"]),
        ((400.0, 30.0), ["a 0 40.00", "a 1 30.00"]),
        ((100.0, 0.0), ["a 0 100.00", "a 1 18.00"]),
        ((100.0, -5.0), ["a 0 100.00", "a 1 18.00"]),
        ((100.0, 88.0), ["a 0 100.00", "a 1 65.00"]),
        ((100.0, 90.0), ["a 0 100.00", "a 1 65.00"]),
    ],
)
def test_flips_folded_azimuths_and_clamped_elevations_on_the_wire(bench, asked, sent):
    client = bench.join("client")
    client.set_position(*asked)
    bench.settle()
    assert bench.sent_moves() == [line for line in sent if line in bench.sent_moves()]
    assert bench.state.position.az_deg == pytest.approx(float(sent[0].split()[2]), abs=0.1)
    assert bench.state.position.el_deg == pytest.approx(float(sent[1].split()[2]), abs=0.1)
    assert bench.view("client").ignored == 0


@pytest.mark.parametrize("asked", [(float("nan"), 10.0), (10.0, float("inf")), (10.0, 271.0), (10.0, -91.0)])
def test_what_is_no_direction_moves_nothing(bench, asked):
    client = bench.join("client")
    assert code_of(client.set_position, *asked) is Rprt.EINVAL
    bench.run(2.0)
    assert not bench.sent_moves()


def test_a_stream_that_crosses_north_goes_on_on_the_same_turn(bench):
    client = bench.join("client")
    client.set_position(356.0, 40.0)
    bench.settle()
    seen = []
    for step in range(10):
        client.set_position((356.0 + step) % 360.0, 40.0)
        for _ in range(10):
            bench.run(0.1)
            seen.append(bench.device.truth().az_deg % 360.0)
    bench.run(3.0)
    assert bench.state.position.az_deg == pytest.approx(5.0, abs=0.1)
    assert all(az > 350.0 or az < 10.0 for az in seen), "it went round by the south"


def test_an_identical_wish_is_not_sent_anew(bench):
    client = bench.join("client")
    for _ in range(5):
        client.set_position(123.0, 41.0)
        bench.run(0.2)
    bench.settle()
    lines = [line for line in bench.lines() if line.startswith("a ")]
    for _ in range(10):
        client.set_position(123.0, 41.0)
        bench.run(1.0)
    assert [line for line in bench.lines() if line.startswith("a ")] == lines == bench.sent_moves()
    assert bench.kinds().count("MoveStarted") == 1


def test_the_newest_of_many_wishes_wins(bench):
    client = bench.join("client")
    for az in range(100, 200):
        client.set_position(float(az), 41.0)
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(199.0, abs=0.1)
    assert len(bench.sent_moves()) <= 3


def test_two_clients_the_first_wish_wins_and_the_other_is_shown(bench):
    one, other = bench.join("one", "other")
    one.set_position(100.0, 40.0)
    other.set_position(200.0, 50.0)
    bench.settle()
    other.set_position(210.0, 50.0)
    bench.run(2.0)
    assert bench.state.position.az_deg == pytest.approx(100.0, abs=0.1)
    view = bench.view("other")
    assert (view.role, view.ignored, view.wish.az_deg) == (ClientRole.IGNORED, 2, 210.0)
    assert "one has control" in view.why
    assert not [line for line in bench.sent_moves() if line not in ("a 0 100.00", "a 1 40.00")]


def test_one_who_is_ignored_is_told_of_once_a_minute(bench):
    one, other = bench.join("one", "other")
    one.set_position(100.0, 40.0)
    bench.run(0.3)
    for _ in range(100):
        other.set_position(90.0, 40.0)
        bench.run(0.9)
    told = [each for each in bench.events if isinstance(each, ClientIgnored)]
    assert [each.client for each in told][:1] == ["other"]
    assert told[0].why == "one has control of the dish."
    assert len(told) <= 2


def test_where_the_server_is_strict_the_other_is_told():
    bench = SharedBench(strict=True)
    one, other = bench.join("one", "other")
    one.set_position(100.0, 40.0)
    bench.run(0.2)
    assert code_of(other.set_position, 200.0, 50.0) is Rprt.ERJCTED
    bench.settle()
    bench.station.stop("you")
    bench.run(2.0)
    assert code_of(one.set_position, 101.0, 40.0) is Rprt.ERJCTED
    bench.run(2.0)
    assert bench.sent_moves() == ["a 0 100.00", "a 1 40.00"]


@pytest.mark.parametrize("strict", [False, True])
def test_a_server_that_is_read_only_moves_nothing(strict):
    bench = SharedBench(read_only=True, strict=strict)
    client = bench.join("client")
    if strict:
        assert code_of(client.set_position, 100.0, 40.0) is Rprt.ERJCTED
    else:
        client.set_position(100.0, 40.0)
    bench.run(3.0)
    assert not bench.sent_moves()
    assert bench.state.holder is None
    assert bench.view("client").ignored == 1


def test_s_ends_this_clients_motion_and_lease_and_latches_nothing(bench):
    one, other = bench.join("one", "other")
    one.set_position(350.0, 40.0)
    bench.settle()
    one.set_position(180.0, 40.0)
    bench.run(0.8)
    other.stop()
    bench.run(0.3)
    assert (bench.state.holder, bench.state.activity) == ("one", Activity.SLEWING), "another's S is not ours"
    one.stop()
    bench.settle()
    assert (bench.state.holder, bench.state.held) == (None, None)
    assert 185.0 < bench.state.position.az_deg < 345.0
    other.set_position(90.0, 45.0)
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(90.0, abs=0.1)


def test_the_stop_of_one_who_has_no_control_leaves_a_persons_motion(bench):
    client = bench.join("client")
    bench.station.submit(Goto(180.0, 40.0, "you"))
    bench.run(0.5)
    client.stop()
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(180.0, abs=0.1)
    assert bench.state.holder == "you"


def test_a_persons_stop_stays_latched_whatever_clients_send(bench):
    one, other = bench.join("one", "other")
    one.set_position(180.0, 40.0)
    bench.run(0.5)
    bench.station.stop("you")
    bench.run(3.0)
    sent, here = bench.sent_moves(), bench.state.position.az_deg
    for number in range(10):
        one.set_position(100.0 + number, 40.0)
        other.set_position(50.0, 50.0)
        one.stop()
        other.stop()
        bench.run(0.5)
    assert bench.sent_moves() == sent
    assert bench.state.position.az_deg == pytest.approx(here, abs=0.05)
    assert bench.state.held.reason is HeldReason.STOP
    assert bench.view("one").ignored == 10
    bench.do(Release("you"))
    bench.run(2.0)
    assert bench.sent_moves() == sent, "a release moves nothing"
    one.set_position(100.0, 40.0)
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(100.0, abs=0.1)


def test_a_person_takes_control_over_and_gives_it_back(bench):
    client = bench.join("client")
    client.set_position(100.0, 40.0)
    bench.settle()
    bench.do(AcquireLease("you", take_over=True))
    client.set_position(120.0, 40.0)
    bench.run(2.0)
    assert bench.state.position.az_deg == pytest.approx(100.0, abs=0.1)
    assert bench.view("client").role is ClientRole.IGNORED
    bench.do(ReleaseLease("you"))
    client.set_position(120.0, 40.0)
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(120.0, abs=0.1)
    assert bench.view("client").role is ClientRole.CONTROL


def test_settings_that_cannot_be_read_keep_clients_from_moving_it():
    bench = SharedBench(station={"refuse_motion": "The settings cannot be read."})
    client = bench.join("client")
    client.set_position(100.0, 40.0)
    bench.run(2.0)
    assert not bench.sent_moves()
    assert bench.view("client").why == "The settings cannot be read."


def test_one_who_hangs_up_lets_the_motion_finish_and_the_lease_go(bench):
    one, other = bench.join("one", "other")
    one.set_position(180.0, 40.0)
    bench.run(0.3)
    one.leave()
    other.position()
    bench.run(0.3)
    assert bench.state.holder == "one"
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(180.0, abs=0.1)
    assert bench.state.holder is None
    assert [view.name for view in bench.shared.views()] == ["other"]


def test_what_one_who_hung_up_left_in_motion_is_the_next_ones(bench):
    """`rotctl P 180 45`, and then `rotctl P 100 45`: two connections of one person."""
    one, other, third = bench.join("one", "other", "third")
    one.set_position(100.0, 45.0)
    bench.run(0.3)
    one.leave()
    bench.run(0.2)
    assert bench.state.holder == "one"
    other.set_position(20.0, 40.0)
    bench.run(0.2)
    assert bench.state.holder == "other"
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(20.0, abs=0.2)
    third.set_position(60.0, 40.0)
    bench.run(0.3)
    assert bench.view("third").ignored == 1, "one who is there keeps control"


def test_s_ends_what_one_who_hung_up_left_in_motion(bench):
    one, other = bench.join("one", "other")
    one.set_position(170.0, 45.0)
    bench.run(0.3)
    one.leave()
    bench.run(0.2)
    other.stop()
    bench.run(3.0)
    assert bench.state.activity is Activity.IDLE
    assert bench.state.holder is None
    assert bench.state.held is None
    assert abs(bench.state.position.az_deg - 170.0) > 2.0


def test_control_is_given_back_also_where_the_server_ends_first(bench):
    client = bench.join("client")
    client.set_position(180.0, 40.0)
    bench.run(0.3)
    client.leave()
    bench.step(20.0)
    assert bench.state.position.az_deg == pytest.approx(180.0, abs=0.1)
    assert bench.state.holder is None


def test_each_name_is_taken_once(bench):
    bench.join("one")
    with pytest.raises(ValueError, match="one already"):
        bench.shared.client("one")


def test_leapfrog_aims_beyond_the_targets_of_a_stream_and_is_clamped_as_well():
    bench = SharedBench(leapfrog=True)
    client = bench.join("client")
    client.set_position(350.0, 45.0)
    bench.settle()
    for az, el in ((347.0, 45.0), (344.0, 45.0), (341.0, 5.0)):
        client.set_position(az, el)
        bench.run(1.0)
    sent = [float(line.split()[2]) for line in bench.sent_moves() if line.startswith("a 0 ")]
    assert sent[0] == 350.0
    assert all(0.4 < asked - az <= 1.0 for asked, az in zip((347.0, 344.0, 341.0), sent[1:], strict=True)), sent
    assert [line for line in bench.sent_moves() if line.startswith("a 1 ")][-1] == "a 1 18.00"


def test_without_it_each_target_is_exact(bench):
    client = bench.join("client")
    client.set_position(350.0, 45.0)
    bench.settle()
    for az in (347.0, 344.0, 341.0):
        client.set_position(az, 45.0)
        bench.run(1.0)
    assert [line for line in bench.sent_moves() if line.startswith("a 0 ")][1:] == [
        "a 0 347.00", "a 0 344.00", "a 0 341.00",
    ]  # fmt: skip
