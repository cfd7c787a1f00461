"""How well the middle of a source is found from 25 directions, beside taking the strongest of them.

Planted: a Gaussian beam on a floor, noise of 0.65 counts on a direction, 200 grids a row, their middles off by up to a
third of a beam. Simulated: a G2 on a virtual clock finds satellites from 2 degrees off, as `birdcage peak` does; its
beam is no Gaussian, and its counts do not add up. Medians, in degrees on the sky.
"""

from __future__ import annotations

import math
import random
from itertools import product
from statistics import median

from birdcage.base.clock import VirtualClock
from birdcage.base.geometry import separation
from birdcage.link.link import Link
from birdcage.signal.beam_fit import FALL, BeamPoint, fit_beam
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.signal.slots_heard import patterns_near, seen_from
from birdcage.sim.port import SimPort, open_device
from birdcage.sim.settings import SimSettings
from birdcage.sky.observer import Observer
from birdcage.station.events import Event, TaskChanged
from birdcage.station.requests import BeginTask
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.station import Station

NOISE, WIDTH_DEG, EL_DEG = 0.65, 6.4, 40.0
GRIDS = 200
PLANTED = ((150.0, 0.0, 0.03), (46.0, 0.0, 0.08), (150.0, 150.0, 0.1))
"""Rise of the source, of a neighbour 9.5 degrees to the right, and the aim in degrees."""
BESIDE_DEG = 9.5
SLOTS = (-61.5, -119.0, -110.0, -72.7)
SEEDS = range(8)


def level(right_deg: float, up_deg: float, rise: float) -> float:
    """Return what a source adds so far off its middle."""
    return rise * math.exp(-FALL * (right_deg**2 + up_deg**2) / WIDTH_DEG**2)


def planted(rise: float, beside: float) -> tuple[float, float]:
    """Return the median error of the fit, and that of the strongest direction."""
    rng, fitted, strongest = random.Random(1), [], []
    for _ in range(GRIDS):
        off = rng.uniform(-WIDTH_DEG / 3.0, WIDTH_DEG / 3.0), rng.uniform(-WIDTH_DEG / 3.0, WIDTH_DEG / 3.0)
        points = []
        for i, j in product(range(-2, 3), repeat=2):
            x, y = off[0] + i * 0.35 * WIDTH_DEG, off[1] + j * 0.35 * WIDTH_DEG
            value = 400.0 + level(x, y, rise) + level(x - BESIDE_DEG, y, beside) + rng.gauss(0.0, NOISE)
            points.append(BeamPoint(180.0 + x / math.cos(math.radians(EL_DEG)), EL_DEG + y, value, NOISE))
        found = fit_beam(points, 5.5, [[(BESIDE_DEG, 0.0)]] if beside else [[]])
        best = max(points, key=lambda each: each.value)
        fitted.append(math.inf if found is None else off_deg(found.az_deg, found.el_deg))
        strongest.append(off_deg(best.az_deg, best.el_deg))
    return median(fitted), median(strongest)


def off_deg(az_deg: float, el_deg: float) -> float:
    """Return how far a direction lies from the planted source, which the points have at 180 and `EL_DEG`."""
    return math.hypot((az_deg - 180.0) * math.cos(math.radians(EL_DEG)), el_deg - EL_DEG)


def simulated(east_deg: float, seed: int) -> float:
    """Return how far from a satellite a simulated G2 finds it."""
    clock, place = VirtualClock(), SimSettings()
    device = open_device(f"g2?seed={seed}", clock=clock)
    settings = StationSettings(
        "sim:g2", "g2", lambda port, _baud: Link(SimPort(device, port), clock), tasks=signal_tasks()
    )
    station = Station(clock, settings)
    session, ended = Session(clock, station), list[TaskChanged]()

    def hear(event: Event) -> None:
        if isinstance(event, TaskChanged):
            ended.append(event)

    station.subscribe(hear, TaskChanged)
    slots = seen_from(Observer(place.lat, place.lon), "none")
    meant = next(each for each in slots if each.slot.longitude_deg == east_deg)
    session.step(8.0)
    values = {
        "az_deg": meant.az_deg + 2.0, "el_deg": meant.el_deg - 1.0, "width_deg": 5.5,
        "patterns": patterns_near(meant.az_deg, meant.el_deg, slots, 5.5),
    }  # fmt: skip
    station.submit(BeginTask("peak", values, "bench"))
    session.step(120.0)
    session.close()
    found = ended[-1].task.found
    return separation(float(found["az_deg"]), float(found["el_deg"]), meant.az_deg, meant.el_deg) if found else math.inf


def main() -> None:
    """Print both tables."""
    print(f"planted, {GRIDS} grids: rise, neighbour {BESIDE_DEG}° away; fit, strongest direction, ratio; aim")
    for rise, beside, aim in PLANTED:
        fit, best = planted(rise, beside)
        print(f"  {rise:5.0f} {beside:5.0f}   {fit:6.3f}  {best:6.2f}  {best / fit:5.1f}   {aim}")
    print(f"simulated G2, {len(SEEDS)} dishes each: slot, median, worst")
    for east_deg in SLOTS:
        errors = sorted(simulated(east_deg, seed) for seed in SEEDS)
        print(f"  {-east_deg:5.1f}°W  {median(errors):6.2f}  {errors[-1]:6.2f}")


if __name__ == "__main__":
    main()
