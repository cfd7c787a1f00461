"""Whatever happens in whatever order: after STOP nothing but STOP's own lines moves the dish until a release."""

from __future__ import annotations

from birdcage.base.errors import BirdcageError, Stopped
from birdcage.station.requests import (
    AcknowledgeFault,
    Engage,
    Follow,
    Goto,
    Home,
    Jog,
    Release,
    ReleaseMotors,
    SetSpeed,
    Stow,
    TurnSkew,
    Watch,
)
from birdcage.station.state import LinkPhase
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from .conftest import Bench

AZ = st.integers(0, 360)
EL = st.integers(16, 67)
HOLDER = st.sampled_from(["you", "you", "tracker"])
SECONDS = st.one_of(st.floats(0.005, 0.3), st.floats(0.01, 4.0))
PRESS = st.one_of(st.none(), st.none(), st.integers(1, 6))
"""After how many writes to the dish STOP is called in the middle of an exchange; None for not at all."""

MOVES = st.one_of(
    st.builds(Goto, AZ, EL, HOLDER, st.booleans()),
    st.builds(Goto, AZ, EL, HOLDER, st.booleans()),
    st.builds(Follow, AZ, EL, HOLDER, st.booleans()),
    st.builds(Jog, st.integers(-5, 5), st.integers(-5, 5), HOLDER),
    st.builds(Home, HOLDER, st.sampled_from([(), (0,), (1,)])),
    st.builds(Engage, HOLDER),
    st.builds(Stow, HOLDER),
    st.builds(TurnSkew, st.integers(0, 180), HOLDER),
)
OTHERS = st.one_of(
    st.builds(ReleaseMotors, HOLDER),
    st.builds(SetSpeed, st.sampled_from([0, 1]), st.sampled_from([0.0, 5.0, 45.0]), HOLDER),
    st.just(Release("you")),
    st.just(AcknowledgeFault("you")),
    st.builds(Watch, st.just("test"), st.sampled_from([frozenset(), frozenset({"position", "rssi"})])),
)
EVENTS = st.sampled_from(["unplug", "plug", "silence", "speech", "reboot", "settled"])
KINDS = {
    "move": st.tuples(st.just("move"), MOVES, PRESS),
    "other": st.tuples(st.just("other"), OTHERS, PRESS),
    "stop": st.just(("stop",)),
    "freed": st.just(("freed",)),
    "event": st.tuples(EVENTS),
    "step": st.tuples(st.just("step"), SECONDS),
    "clock": st.tuples(st.just("clock"), st.floats(-9.0, 9.0)),
}
OFTEN = ["move", "move", "move", "step", "step", "step", "stop", "freed", "freed", "event", "event", "other", "clock"]
HAPPENS = st.sampled_from(OFTEN).flatmap(KINDS.__getitem__)


class Watched:
    """Counts the lines that move the dish and go out while STOP holds, STOP's own apart."""

    def __init__(self, address="g2?seed=1&az=-180", firmware="g2"):
        self.bench = Bench(address, {"stow_allowed": True}, firmware)
        self.stopped = False
        self.falls = False
        """Whether a release of the motors was asked for after the last STOP: that alone may follow it."""
        self.own = []
        self.wrong = []
        self.press = None
        self.turns = 0
        self._wrap_stopper()
        self._wrap_opening()

    def _wrap_stopper(self):
        """Lines that STOP itself interjects are known by who calls."""
        protocol = self.bench.station._antenna.rotator.protocol
        interject = protocol.interject

        def interjecting(lines):
            self.own.append(b"".join(line.encode() + b"\r" for line in lines))
            interject(lines)

        protocol.interject = interjecting
        find_next = self.bench.station._next

        def counting(now):
            due, work = find_next(now)
            self.turns += due <= now
            return due, work

        self.bench.station._next = counting

    def _wrap_opening(self):
        opened = self.bench.opened

        class Opened(list):
            def append(inner, sim):  # noqa: N805 - `self` is the outer one
                write = sim.write

                def writing(data):
                    if data in self.own:
                        self.own.remove(data)
                    elif self.stopped and data == b"r\r" and self.falls:
                        pass
                    elif self.stopped and data.startswith((b"a ", b"h ", b"g ", b"r\r", b"e\r", b"stow\r")):
                        self.wrong.append(data)
                    write(data)
                    if self.press is not None:
                        self.press -= 1
                        if self.press <= 0:
                            self.press = None
                            self.stop()

                sim.write = writing
                super().append(sim)

        self.bench.opened = Opened(opened)

    def stop(self):
        self.stopped, self.falls = True, False
        self.bench.station.stop("you")

    def step(self, seconds):
        before = self.turns
        self.bench.step(seconds)
        # A turn of the loop costs an exchange of 10 ms or so, or a try to reconnect; anything more is a busy loop.
        assert self.turns - before < 60 + 120 * (seconds + 20), "the station spins"

    def release(self, futures):
        future = self.bench.station.submit(Release("you"))
        future.add_done_callback(self.released)
        futures.append(future)
        self.step(0.001)

    def released(self, future):
        if future.exception() is None:
            self.stopped = False

    def happen(self, what, futures):
        bench = self.bench
        match what:
            case ("move", request, press):
                self.press = press
                futures.append(bench.station.submit(request))
            case ("other", Release(), _press):
                self.release(futures)
            case ("other", request, press):
                self.press = press
                self.falls = self.falls or isinstance(request, ReleaseMotors)
                futures.append(bench.station.submit(request))
            case ("step", seconds):
                self.step(seconds)
            case ("clock", seconds):
                bench.clock.step_utc(seconds)
            case ("stop",):
                self.stop()
            case ("freed",):
                self.step(2)
                futures.append(bench.station.submit(AcknowledgeFault("you")))
                self.release(futures)
            case ("unplug",):
                bench.device.unplug()
            case ("plug",):
                bench.device.plug()
            case ("silence",):
                bench.device.wire.to_host.silent = True
            case ("speech",):
                bench.device.wire.to_host.silent = False
            case ("reboot",):
                bench.device.reboot()
            case ("settled",):
                self.step(5)


@given(st.lists(HAPPENS, min_size=3, max_size=14))
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_after_stop_nothing_moves_the_dish_until_released(story):
    check(Watched(), story, 3)


@given(st.lists(HAPPENS, min_size=3, max_size=14))
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_after_stop_nothing_moves_a_queued_dish_until_released(story):
    check(Watched("hal205?seed=1&boot_home_s=20&search_finds=0", "hal205"), story, 15)


def check(watched, story, seconds):
    futures = []
    watched.step(seconds)
    watched.stopped = False
    for what in story:
        watched.happen(what, futures)
        assert watched.wrong == []
        if watched.stopped:
            assert watched.bench.station._control.latched
    watched.press = None
    watched.bench.device.plug()
    watched.bench.device.wire.to_host.silent = False
    for _ in range(30):
        watched.step(5)
        if all(future.done() for future in futures) and watched.bench.state.link.state is LinkPhase.UP:
            break
    assert watched.wrong == []
    assert watched.bench.state.link.state is LinkPhase.UP
    for future in futures:
        assert future.done()
        assert future.exception(0) is None or isinstance(future.exception(0), BirdcageError)
    if watched.stopped:
        assert watched.bench.state.held is not None
        watched.step(30)
        searches = watched.bench.firmware != "g2" and ("reboot",) in story
        assert searches or not watched.bench.device.truth().moving
        assert watched.wrong == []


def test_a_release_ends_what_a_stop_stopped_that_was_not_taken_up_before(bench):
    future = bench.station.submit(Goto(210, 45, "you"))
    bench.step(1)
    assert bench.device.truth().moving
    bench.station.stop("you")
    bench.station._stopper.release(bench.station._stopper.count)  # as a release that is served at once
    assert isinstance(future.exception(0), Stopped)
    assert (bench.state.held, bench.state.motion) == (None, None)
    assert bench.state.last_stop.by == "you"
    bench.step(6)
    assert (bench.state.held, bench.state.fault) == (None, None), "nothing of that STOP comes later"
