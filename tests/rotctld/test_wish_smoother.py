"""Between the wishes of a stream the dish follows their target; and when it does not."""

from __future__ import annotations

import math

import pytest
from birdcage.base.geometry import separation, shortest_turn, wrap_360
from birdcage.rotctld.client_view import ClientRole
from birdcage.rotctld.wish_smoother import EACH_S
from birdcage.station.requests import AcquireLease

from .shared_bench import SharedBench

RATE_DEG_S = 1.2


def target(second):
    """Where the target is: it crosses north."""
    return wrap_360(325.0 + RATE_DEG_S * second), 35.0 + 5.0 * math.sin(second / 20.0)


class StreamBench(SharedBench):
    """A client that sends where its target is once a second."""

    def __init__(self, more="", firmware="g2", **options):
        super().__init__(firmware, f"az=-35&el=35{more}" if firmware == "g2" else more, **options)
        self.client = self.join("client")
        self.client.set_position(*target(0.0))
        self.settle()
        self.start = self.clock.monotonic()
        self.errors = []

    @property
    def second(self):
        return self.clock.monotonic() - self.start

    def run(self, seconds):
        end = self.clock.monotonic() + seconds
        while (left_s := end - self.clock.monotonic()) > 1e-6:
            self.step(min(left_s, 0.05))
            self.shared.tick()
            if self.opened and hasattr(self, "errors"):
                truth = self.device.truth()
                self.errors.append(separation(truth.az_deg, truth.el_deg, *target(self.second)))

    def stream(self, seconds, each_s=1.0):
        begun = self.clock.monotonic()
        for number in range(1, round(seconds / each_s) + 1):
            self.client.set_position(*target(self.second))
            self.run(begun + number * each_s - self.clock.monotonic())

    def rms(self):
        return math.sqrt(sum(error**2 for error in self.errors) / len(self.errors))

    @property
    def lead_s(self):
        return self.view("client").lead_s


def after(bench, seconds):
    """Return what the dish is sent in the time that follows."""
    before = len(bench.sent_moves())
    bench.run(seconds)
    return bench.sent_moves()[before:]


@pytest.fixture
def bench():
    bench = StreamBench()
    bench.stream(12.0)
    assert bench.lead_s is not None
    return bench


def test_an_even_stream_is_followed_between_its_wishes():
    errors = {}
    for smoother in ("off", "auto"):
        bench = StreamBench(smoother=smoother)
        bench.stream(12.0)
        bench.errors.clear()
        bench.stream(30.0)
        errors[smoother] = bench.rms()
        assert (bench.lead_s is None) == (smoother == "off")
        assert bench.view("client").role is ClientRole.CONTROL
        assert bench.view("client").ignored == 0
    assert errors["auto"] < 0.25 * errors["off"], errors


@pytest.mark.parametrize("latency_s", [0.02, 0.1])
def test_the_lead_is_what_the_wire_takes_and_half_a_period(latency_s):
    bench = StreamBench(f"&latency_min={latency_s}&latency_max={latency_s}")
    bench.stream(20.0)
    assert latency_s - 0.03 < bench.lead_s - EACH_S / 2.0 < 2.0 * latency_s + 0.03, "a look may go before it"


def test_a_slow_wire_costs_no_lag():
    errors = {}
    for smoother in ("off", "auto"):
        bench = StreamBench("&latency_min=0.1&latency_max=0.1", smoother=smoother)
        bench.stream(12.0)
        bench.errors.clear()
        bench.stream(20.0)
        errors[smoother] = bench.rms()
    assert errors["auto"] < 0.35 * errors["off"], errors


def test_the_client_is_told_where_the_dish_is(bench):
    bench.run(0.2)
    told, truth = bench.client.position(), bench.device.truth()
    assert separation(*told, truth.az_deg, truth.el_deg) < 0.5
    assert bench.view("client").wish == bench.client._wishes.wish


def test_a_stream_that_breaks_off_ends_at_its_last_wish(bench):
    wish = bench.view("client").wish
    sent = after(bench, 8.0)
    assert 2 <= len(sent) <= 16, "targets for two intervals, then the wish"
    assert bench.lead_s is None
    assert bench.client.position() == pytest.approx((wish.az_deg, wish.el_deg), abs=0.1)
    assert not after(bench, 5.0)


class Gpredict:
    """As `gtk-rot-ctrl.c` of Gpredict does: a wish where the dish is off by a threshold, ahead by as much."""

    def __init__(self, bench, threshold_deg):
        self.bench, self.threshold_deg, self.wishes = bench, threshold_deg, 0

    def _off(self, one, other):
        return max(abs(shortest_turn(one[0], other[0])), abs(one[1] - other[1])) > self.threshold_deg

    def run(self, seconds):
        for _ in range(round(seconds)):
            begun, here = self.bench.clock.monotonic(), target(self.bench.second)
            if self._off(here, self.bench.client.position()):
                ahead_s = 0.0
                while not self._off(here, target(self.bench.second + ahead_s)):
                    ahead_s += 0.1
                self.bench.client.set_position(*target(self.bench.second + ahead_s - 0.1))
                self.wishes += 1
            self.bench.run(begun + 1.0 - self.bench.clock.monotonic())


@pytest.mark.parametrize("threshold_deg", [1.0, 5.0])
def test_who_wishes_by_a_threshold_is_left_alone(threshold_deg):
    """Gpredict's wishes lie ahead of its target, and it wishes nothing while the dish is on target."""
    errors = {}
    for smoother in ("off", "auto"):
        bench = StreamBench(smoother=smoother)
        Gpredict(bench, threshold_deg).run(14.0)
        bench.errors.clear()
        Gpredict(bench, threshold_deg).run(26.0)
        assert bench.lead_s is None
        errors[smoother] = bench.rms()
    assert errors["auto"] <= 1.05 * errors["off"], errors


def test_after_s_a_client_may_be_another():
    bench = StreamBench()
    gpredict = Gpredict(bench, 1.0)
    gpredict.run(14.0)
    bench.stream(8.0)
    assert bench.lead_s is None
    bench.client.stop()
    bench.stream(8.0)
    assert bench.lead_s is not None


def test_s_ends_it_at_once(bench):
    bench.client.stop()
    bench.run(0.5)
    assert not after(bench, 4.0)
    assert bench.lead_s is None
    assert bench.state.holder is None


def test_leaving_ends_it_at_once(bench):
    bench.client.leave()
    assert not after(bench, 4.0)


def test_another_who_takes_control_ends_it(bench):
    bench.station.submit(AcquireLease("you", take_over=True))
    bench.run(0.3)
    assert not after(bench, 4.0)
    assert bench.view("client").ignored == 0, "what no client sent is not counted"
    assert bench.lead_s is None
    bench.stream(6.0)
    assert bench.lead_s is None
    assert bench.view("client").role is ClientRole.IGNORED


def test_stop_of_a_person_ends_it(bench):
    bench.station.stop("you")
    bench.run(0.3)
    assert not after(bench, 4.0)
    assert bench.view("client").ignored == 0, "what no client sent is not counted"
    bench.stream(6.0)
    assert not after(bench, 1.0)
    assert bench.lead_s is None
    assert bench.state.held is not None


def test_a_lost_link_ends_it_and_the_newest_wish_is_carried_out_as_it_is(bench):
    bench.device.unplug()
    bench.run(1.0)
    assert bench.lead_s is None
    wish = (20.0, 40.0)
    bench.client.set_position(*wish)
    bench.device.plug()
    bench.run(15.0)
    assert bench.state.held is None
    assert bench.client.position() == pytest.approx(wish, abs=0.1)
    assert bench.lead_s is None


def test_a_jump_is_gone_to_as_it_is(bench):
    bench.client.set_position(200.0, 50.0)
    bench.run(0.3)
    assert bench.sent_moves()[-2:] == ["a 0 200.00", "a 1 50.00"]
    assert bench.lead_s is None


def test_it_is_kept_from_the_limits(bench):
    client, second = bench.client, 0
    for second in range(12):
        client.set_position(200.0 + second, 55.0 + second)
        bench.run(1.0)
    assert bench.lead_s is not None
    assert max(float(line.split()[2]) for line in bench.sent_moves() if line.startswith("a 1")) <= 65.0


def test_a_queued_dish_gets_each_wish_as_it_is():
    bench = StreamBench("", "hal205", smoother="on")
    bench.stream(10.0)
    assert bench.lead_s is None


def test_a_published_server_with_leapfrog_does_as_its_document_says():
    bench = StreamBench(leapfrog=True)
    bench.stream(10.0)
    assert bench.lead_s is None


def test_a_park_in_a_stream_is_gone_to(bench):
    parked = StreamBench(park=(180.0, 40.0))
    parked.stream(8.0)
    parked.client.park()
    parked.settle()
    assert parked.client.position() == pytest.approx((180.0, 40.0), abs=0.1)
    assert parked.lead_s is None
