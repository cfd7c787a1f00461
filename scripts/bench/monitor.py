"""How often the signal is read while it is watched steadily, beside what the wire leaves: on a virtual clock, exact.

The floor is the driver alone: a position, then `rssi 10` one after the other until a second is over. The station does
that with everything else that it looks after, and counts the second from the answer, too.
Two wires: answers after 5 to 20 ms, and after 20 to 100 ms.
"""

from __future__ import annotations

from birdcage.base.clock import VirtualClock
from birdcage.link.link import Link
from birdcage.protocol.g2.protocol import CarryoutG2Protocol
from birdcage.sim.port import SimPort, open_device
from birdcage.station.requests import Watch
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.station import Station
from birdcage_tui.signal.receiver import FEATURES

SECONDS = 120.0
AIM = 0.95
RATE_HZ = 100.0
WIRES = {"5 to 20 ms": "g2?seed=1", "20 to 100 ms": "g2?seed=1&latency_min=0.02&latency_max=0.1"}


def floor_hz(address: str) -> float:
    """Return readings a second of the driver alone, with a position a second."""
    clock = VirtualClock()
    protocol = CarryoutG2Protocol()
    protocol.attach(Link(SimPort(open_device(address, clock=clock), "sim"), clock), clock)
    clock.advance(10.0)
    protocol.get_position()
    protocol.get_rssi(10)  # the line is settled, each menu was visited
    clock.advance(10.0)
    start, reads, look_at = clock.monotonic(), 0, clock.monotonic()
    while clock.monotonic() < start + SECONDS:
        if clock.monotonic() >= look_at:
            protocol.get_position()
            look_at = clock.monotonic() + 1.0  # as the station counts
        protocol.get_rssi(10)
        reads += 1
    return reads / (clock.monotonic() - start)


def watched_hz(address: str, *, more: frozenset[str] = frozenset()) -> tuple[float, float]:
    """Return readings and positions a second of a station that watches the signal steadily."""
    clock = VirtualClock()
    device = open_device(address, clock=clock)
    settings = StationSettings("sim:g2", "g2", lambda port, _baud: Link(SimPort(device, port), clock))
    station = Station(clock, settings)
    session = Session(clock, station)
    station.submit(Watch("signal", frozenset({"rssi"}), RATE_HZ, steady=True))
    station.submit(Watch("page", frozenset({"position"}) | more, 1.0))
    session.step(20.0)
    start = clock.monotonic()
    session.step(SECONDS)
    with device.lock:
        device.machine.run()
        lines = [line for at, line in device.shell.received if at > start]
    return sum(line.startswith("rssi ") for line in lines) / SECONDS, lines.count("a") / SECONDS


def main() -> None:
    panel = frozenset(FEATURES)
    print("| answers after | floor, readings/s | watched | of the floor | positions/s | with the receiver's panel |")
    print("|---|---|---|---|---|---|")
    for name, address in WIRES.items():
        floor, (reads, looks) = floor_hz(address), watched_hz(address)
        beside, _ = watched_hz(address, more=panel)
        share = reads / floor
        print(f"| {name} | {floor:.2f} | {reads:.2f} | {share:.1%} | {looks:.2f} | {beside:.2f} |")
        if share < AIM:
            print(f"below the aim of {AIM:.0%}")


if __name__ == "__main__":
    main()
