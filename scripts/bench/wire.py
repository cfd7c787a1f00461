"""What the station puts on the wire, counted in the simulated dish, on a virtual clock: exact, not timed.

Rows: a position query (in the motor menu, and after another program left the dish elsewhere), and the traffic at rest
with everything on the dashboard watched, over the busiest 10 s. The peer is the earlier app's measured traffic
(17.1 commands a second idle, 67 % of them menu changes).
"""

from __future__ import annotations

import json
from itertools import pairwise

from birdcage.base.clock import VirtualClock
from birdcage.link.link import Link
from birdcage.sim.port import SimPort, open_device
from birdcage.station.requests import Goto, Watch
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.station import Station

EARLIER_APP_COMMANDS_PER_S = 17.1
NAVIGATION = {"", "q", "mot", "dvb", "nvs", "os"}


def main() -> None:
    clock = VirtualClock()
    device = open_device("g2?seed=1", clock=clock)
    settings = StationSettings("sim:g2", "g2", lambda port, _baud: Link(SimPort(device, port), clock))
    station = Station(clock, settings)
    session = Session(clock, station)
    station.submit(Watch("bench", frozenset({"position"}), 1.0))
    session.step(12)  # the link comes up, and identity and limits are read once

    def received() -> list[tuple[float, str]]:
        with device.lock:
            device.machine.run()
            return list(device.shell.received)

    before = len(received())
    session.step(10)
    query = [line for _at, line in received()[before:]]

    station.submit(Watch("bench", frozenset({"position", "rssi", "health"}), 10.0))
    session.step(20)
    start = clock.monotonic()
    session.step(120)
    rest = [(at, line) for at, line in received() if at > start]
    busiest = max(sum(at <= other < at + 10 for other, _ in rest) for at, _ in rest) / 10
    excursions = [at for at, line in rest if line == "dvb"]
    gap_s = min(later - earlier for earlier, later in pairwise(excursions))
    navigation = sum(line in NAVIGATION for _at, line in rest) / len(rest)

    station.submit(Goto(120.0, 40.0, "bench"))
    session.step(0.1)
    start = clock.monotonic()
    while station.state.motion is not None:
        session.step(0.05)
    moving = {line for at, line in received() if at > start}

    print(f"position query at rest, lines sent        {sorted(set(query))}, one each ({len(query)} in 10 s at 1 Hz)")
    print(f"rest, dashboard watched, busiest 10 s     {busiest:.1f} commands/s, {navigation:.0%} menu changes")
    print(f"  ratio to the earlier app                {busiest / EARLIER_APP_COMMANDS_PER_S:.2f}")
    print(f"  shortest time between excursions        {gap_s:.2f} s")
    print(f"while moving, lines sent                  {sorted(moving)}")
    print(json.dumps({
        "bench": "wire", "query_lines": sorted(set(query)), "rest_commands_per_s": busiest,
        "ratio_to_earlier_app": round(busiest / EARLIER_APP_COMMANDS_PER_S, 3), "excursion_gap_s": round(gap_s, 3),
        "moving_lines": sorted(moving), "budget": {"rest_commands_per_s": 3.0, "excursion_gap_s": 5.0},
    }))  # fmt: skip


if __name__ == "__main__":
    main()
