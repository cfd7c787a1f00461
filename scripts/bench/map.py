"""How long a map of 131 x 41 directions takes, on a virtual clock, beside its floor and an existing tool's own method.

A simulated G2 with 20 to 100 ms a line, uniform. The floor is the larger of all motion (trapezoids of both axes at the
dish's own speeds, in the order of the map) and all exchanges (nine lines a direction of 60 ms, the mean), plus the time
in which the tuner is read. The peer does what winegard-sky-scan does (its `scan.py`): columns, upward,
0.2 s to settle, the way to the tuner's menu and back at each direction, 1 s to fly back; five columns, scaled up.

`python scripts/bench/map.py`, with `rows` for another order; `scripts/bench/map_redraw.py` has the time of a redraw.
"""

from __future__ import annotations

import sys
import tempfile
from itertools import pairwise
from pathlib import Path

from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.kinematics import plan_slew
from birdcage.link.link import Link
from birdcage.rotator.facts import Facts
from birdcage.signal.source_set import SourceSet
from birdcage.sim.port import SimPort, open_device
from birdcage.skymap.map_keeper import MapKeeper
from birdcage.skymap.map_request import MapRequest, estimate
from birdcage.skymap.map_task import map_tasks
from birdcage.skymap.plan import MapOrder, MapPlan
from birdcage.station.requests import BeginTask
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.station import Station

DISH = "g2?seed=1&latency_min=0.02&latency_max=0.1"
LINE_S, MOST_LINES, MOST_RATIO = 0.06, 9.0, 1.1
COLUMNS = 5
SETTLE_S, FLY_BACK_S = 0.2, 1.0


def mapped(plan: MapPlan) -> tuple[float, float, float, Facts, float]:
    """Return seconds, lines and seconds of reading a direction, what the dish is, and the estimate in seconds."""
    clock, sent = VirtualClock(), list[tuple[float, str]]()
    device, tasks = open_device(DISH, clock=clock), {}

    def open_link(name: str, _baud: int) -> Link:
        port = SimPort(device, name)
        write = port.write

        def writing(data: bytes) -> None:
            sent.extend((clock.monotonic(), line.decode()) for line in data.split(b"\r")[:-1])
            write(data)

        port.write = writing  # type: ignore[method-assign]
        return Link(port, clock)

    settings = StationSettings("sim:g2", "g2", open_link, tasks=tasks)
    station = Station(clock, settings)
    session, sources = Session(clock, station), SourceSet(Settings(), clock, threads=False)
    with tempfile.TemporaryDirectory() as folder:
        keeper = MapKeeper(sources, Path(folder) / "signal.sqlite", Settings(), lambda: None)
        tasks.update(map_tasks(keeper))
        sources.attach(station)
        keeper.attach(station)
        session.step(8.0)
        request = MapRequest(plan, "bench")
        told = estimate(request, station.state, dwell_s=None)
        begun = clock.monotonic()
        station.submit(BeginTask("map", request.values(), "bench"))
        session.step(0.1)
        while station.state.tasks:
            session.step(5.0)
        lines = [each for each in sent if each[0] >= begun]
        facts = station.state.dish
        assert facts is not None, "it has answered"
        session.close()
    reads = [after - at for (at, line), (after, _next) in pairwise(lines) if line.startswith("rssi")]
    assert len(reads) == plan.cells, "each direction was heard"
    dwell_s = sum(reads) / len(reads) - LINE_S
    return lines[-1][0] - begun, len(lines) / plan.cells, dwell_s, facts, told.seconds


def motion_s(plan: MapPlan, facts: Facts) -> float:
    """Return how long both axes turn, at once, from each direction to the next."""
    total_s = 0.0
    for one, other in pairwise(plan.sequence):
        ways = [abs(a - b) for a, b in zip(plan.at(one), plan.at(other), strict=True)]
        axes = (facts.azimuth, facts.elevation)
        total_s += max(plan_slew(0.0, way, axis.speed_deg_s, axis.acceleration_deg_s2).duration_s
                       for way, axis in zip(ways, axes, strict=True))  # fmt: skip
    return total_s


def peer_s(plan: MapPlan) -> float:
    """Return how long the existing tool's method takes for the whole map."""
    clock = VirtualClock()
    port = SimPort(open_device(DISH, clock=clock), "peer")

    def say(line: str, pause_s: float = 0.0) -> None:
        """Send a line, wait for its prompt, and then for a time."""
        port.write(f"{line}\r".encode())
        heard = b""
        while not heard.rstrip().endswith(b">"):
            due = port.next_event()
            clock.advance(max((due or clock.monotonic()) - clock.monotonic(), 1e-3))
            heard += port.read()
        clock.advance(pause_s)

    say("")
    say("mot")
    begun = clock.monotonic()
    for column in range(COLUMNS):
        say(f"a 0 {plan.x_low_deg + column * plan.step_deg:.2f}")
        say(f"a 1 {plan.y_low_deg:.2f}", FLY_BACK_S)
        for row in range(plan.rows):
            say(f"a 1 {plan.y_low_deg + row * plan.step_deg:.2f}", SETTLE_S)
            for line in ("q", "dvb", "rssi 10", "q", "mot"):
                say(line)
    port.close()
    return (clock.monotonic() - begun) / COLUMNS * plan.columns


def main() -> None:
    """Print what it takes, its floor, and the peer."""
    order = MapOrder(sys.argv[1]) if len(sys.argv) > 1 else MapOrder.COARSE
    plan = MapPlan(110.0, 240.0, 18.0, 58.0, 1.0, order)
    took_s, lines, dwell_s, facts, estimated_s = mapped(plan)
    motion, exchanges, dwell = motion_s(plan, facts), plan.cells * MOST_LINES * LINE_S, plan.cells * dwell_s
    floor_s, peer = max(motion, exchanges) + dwell, peer_s(plan)
    ratio = (took_s - dwell) / max(motion, exchanges)
    print(f"{plan.columns} x {plan.rows} directions, {order}: {took_s / 60:.1f} min, estimated {estimated_s / 60:.1f}")
    print(f"  motion {motion / 60:.1f} min, exchanges {exchanges / 60:.1f} min, tuner {dwell / 60:.1f} min")
    print(f"  times its floor ({floor_s / 60:.1f} min)       {took_s / floor_s:.3f}")
    print(f"  without the tuner, times the larger   {ratio:.3f}   (aim {MOST_RATIO})")
    print(f"  lines a direction                     {lines:.2f}   (aim {MOST_LINES:g})")
    print(f"  the existing tool's method            {peer / 60:.1f} min, {peer / took_s:.2f} times as long")


if __name__ == "__main__":
    main()
