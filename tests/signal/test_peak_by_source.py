"""A dish without a tuner finds a source by a receiver beside it, told in decibels; one that falls silent ends it."""

from __future__ import annotations

import math

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import shortest_turn
from birdcage.signal.ear import SourceEar
from birdcage.signal.listeners import Listeners
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.signal.source import Scale, SignalFacts, SignalReading
from birdcage.station.events import TaskChanged
from birdcage.station.requests import BeginTask, Goto
from birdcage.station.state import LinkPhase

from tests.station.conftest import Bench

FACTS = SignalFacts(
    "meter", "meter", "dBFS", Scale.LOG, 5.0, 1.0, None, 0.2, 1, 10.0, None, of_dish=False, demo=False
)  # fmt: skip
FLOOR_DB, WIDTH_DEG = -60.0, 4.0


class Planted:
    """Hears a source that stands at a direction, five times a second, 0.2 s each; wrong for long after a motion."""

    trouble = ""

    def __init__(self, to, rise=30.0):
        self.to, self.rise, self.facts = to, rise, FACTS
        self.readings, self.watchers, self.log, self.silent = Listeners(), set(), [], False
        self._next, self._count = 0.0, 0

    def subscribe(self, hear):
        return self.readings.add(hear)

    def watch(self, watcher, *, steady=False):
        self.watchers.add(watcher)
        self.log.append(f"watch {watcher}")

    def unwatch(self, watcher):
        self.watchers.discard(watcher)
        self.log.append(f"unwatch {watcher}")

    def tick(self, bench):
        now = bench.clock.monotonic()
        if not self.watchers or self.silent or now < self._next or bench.state.position is None:
            return
        self._next = now + 0.2
        self._count += 1
        position = bench.state.position
        across = shortest_turn(self.to[0], position.az_deg) * math.cos(math.radians(self.to[1]))
        far = math.hypot(across, position.el_deg - self.to[1])
        power = 1.0 + self.rise * math.exp(-4 * math.log(2) * (far / WIDTH_DEG) ** 2)
        if bench.state.motion is not None:
            power = 1000.0  # whatever is measured in motion counts for nothing
        value = FLOOR_DB + 10 * math.log10(power) + 0.1 * (-1) ** self._count
        self.readings.tell(SignalReading(value, "dBFS", now - 0.1, bench.clock.utc(), "meter", 0.2))


def made(machine, to):
    source, made = Planted(to), []
    tasks = signal_tasks(lambda _source: SourceEar(source, made[0].clock))
    bench = Bench(f"{machine}?seed=1", {"tasks": tasks}, firmware=machine)
    made.append(bench)
    return bench.connect(30.0), source


def run(bench, source, seconds=400.0, step_s=0.05):
    end = bench.clock.monotonic() + seconds
    while bench.state.tasks and bench.clock.monotonic() < end:
        source.tick(bench)
        bench.step(step_s)
    return [event.task for event in bench.events if isinstance(event, TaskChanged)][-1]


@pytest.mark.parametrize("machine", ["hal205", "carryout", "g2"])
def test_the_middle_is_found_by_a_receiver_on_every_machine(machine):
    bench, source = made(machine, (0.0, 0.0))
    assert bench.state.link.state is LinkPhase.UP
    if bench.state.position is None:  # the Carryout tells where it is only once it has moved
        bench.station.submit(Goto(180.0, 45.0, "you"))
        bench.step(60.0)
    here = bench.state.position
    el_deg = min(max(here.el_deg, 35.0), 50.0)
    source.to = (here.az_deg + 1.1) % 360.0, el_deg + 0.7
    bench.do(BeginTask("peak", {"az_deg": here.az_deg, "el_deg": el_deg, "width_deg": WIDTH_DEG}, "you"))
    ended = run(bench, source)
    assert ended.is_done, ended.why
    assert ended.found["unit"] == "dB"
    assert ended.found["rise"] == pytest.approx(10 * math.log10(31.0), abs=0.5)
    assert ended.found["floor"] == pytest.approx(FLOOR_DB, abs=1.5)
    assert ended.found["az_deg"] == pytest.approx(source.to[0], abs=0.05)
    assert ended.found["el_deg"] == pytest.approx(source.to[1], abs=0.05)
    assert " dB over the floor." in ended.why
    assert source.log == ["watch task", "unwatch task"], "it is read while the task needs it, and no longer"


def test_a_receiver_that_falls_silent_ends_it_and_says_why():
    bench, source = made("g2", (180.0, 40.0))
    position = bench.state.position
    bench.do(BeginTask("peak", {"az_deg": position.az_deg, "el_deg": 40.0, "width_deg": WIDTH_DEG}, "you"))
    for _ in range(200):
        source.tick(bench)
        bench.step(0.05)
    source.silent, source.trouble = True, "It closed the connection."
    ended = run(bench, source)
    assert not ended.is_done
    assert ended.why.startswith("The signal is lost. It closed the connection.")
    assert source.watchers == set()


def test_stop_lets_go_of_the_receiver():
    bench, source = made("g2", (180.0, 40.0))
    position = bench.state.position
    bench.do(BeginTask("sweep", {"axis": "az", "az_deg": position.az_deg, "el_deg": 40.0, "span_deg": 10.0,
                                 "step_deg": 1.0}, "you"))  # fmt: skip
    for _ in range(100):
        source.tick(bench)
        bench.step(0.05)
    assert source.watchers == {"task"}
    bench.station.stop("you")
    run(bench, source, 5.0)
    assert source.watchers == set()


def test_a_source_that_there_is_not_refuses_the_task():
    bench = Bench("g2?seed=1", {"tasks": signal_tasks()}).connect(6.0)
    with pytest.raises(CommandRefused, match="there is no signal source called meter"):
        bench.do(BeginTask("peak", {"az_deg": 180.0, "el_deg": 40.0, "source": "meter"}, "you"))


def test_a_lost_link_ends_it_and_no_release_is_promised_to_resume_it():
    bench, source = made("g2", (180.0, 40.0))
    bench.do(BeginTask("peak", {"az_deg": 180.0, "el_deg": 40.0, "width_deg": WIDTH_DEG}, "you"))
    while source.watchers != {"task"} or bench.state.tasks[0].done < 2:
        source.tick(bench)
        bench.step(0.05)
    source.silent = True  # the task waits for it, and asks the dish for nothing
    bench.step(0.5)
    bench.device.unplug()
    bench.step(2.0)
    ended = [event.task for event in bench.events if isinstance(event, TaskChanged)][-1]
    assert ended.why == (
        "The link is lost. Nothing more is sent, and a move that has begun may still end. The peak was not found."
    )
    assert source.watchers == set()
