"""The Sun in maps, as different dishes would have heard it."""

from __future__ import annotations

import math
import random
from datetime import UTC, datetime, timedelta

from birdcage.base.geometry import beside, offset
from birdcage.sim.almanac import sun
from birdcage.sim.beam import COMPRESSION, gain
from birdcage.sim.settings import SimSettings
from birdcage.sim.sky import SimSky
from birdcage.skymap.plan import MapFrame, MapPlan

from tests.skymap.made import made_map, sample

MORNING = datetime(2026, 6, 20, 16, tzinfo=UTC)
PLACE = {"latitude_deg": 39.1, "longitude_deg": -95.7}
EVERY_S = 3.0


class Travler(SimSettings):
    """A simulated dish with a reflector of 33 by 23 inches."""

    reflector_in = (33.0, 23.0)


def half_power_of_the_simulator(settings: type[SimSettings]) -> tuple[float, float]:
    """Return where its beam has half of its power, on both sides, in azimuth and in elevation."""

    def side(right: float, up: float) -> float:
        low, high = 0.0, 12.0
        for _ in range(50):
            at = (low + high) / 2.0
            share = max(gain(right * at, up * at, settings.reflector_in), 0.0) ** COMPRESSION
            low, high = (at, high) if share > 0.5 else (low, at)
        return low

    return side(1.0, 0.0) + side(-1.0, 0.0), side(0.0, 1.0) + side(0.0, -1.0)


def map_of(plan, power, noise_db, seed=1, begin=MORNING, floor_db=-60.0, **about):
    """Return a map of decibels over `floor_db`; `power(when, az, el)` over that of the empty sky."""
    dice, samples = random.Random(seed), []
    for index, cell in enumerate(plan.sequence):
        when = begin + timedelta(seconds=EVERY_S * index)
        aim = sun(when, PLACE["latitude_deg"], PLACE["longitude_deg"])
        at, followed = plan.at(cell), {}
        if plan.frame is MapFrame.TARGET:
            at, followed = beside(*aim, *at), {"aim_az_deg": aim[0], "aim_el_deg": aim[1]}
        level = floor_db + 10.0 * math.log10(power(when, *at)) + dice.gauss(0.0, noise_db)
        samples.append(sample(cell, *at, level, utc=when, **followed))
    told = {"target": "Sun", "freq_hz": 12.45e9, **PLACE, **about}
    empty = made_map(plan, lambda _x, _y: 0.0, heard=0, decibels=True, unit="dB", about=told)
    return empty.with_samples(tuple(samples))


def around(reach_az_deg, reach_el_deg, step_deg):
    return MapPlan(-reach_az_deg, reach_az_deg, -reach_el_deg, reach_el_deg, step_deg, frame=MapFrame.TARGET)


def simulated(settings, plan, noise_db=0.05, **other):
    """Return a map that a receiver in the simulator's beam would make."""
    sky, widths = SimSky(settings()), half_power_of_the_simulator(settings)
    about = {"beam_az_deg": widths[0], "beam_el_deg": widths[1], **other}
    return map_of(plan, lambda when, az, el: 1.0 + sky.warmth(when, az, el), noise_db, **about)


def airy(plan, width_deg, kelvins, system_k, noise_db=0.02, **other):
    """Return a map by an evenly lit round aperture, over the disc of the Sun: no Gaussian, and none of our code."""

    def j1(x):
        return sum(math.cos(t - x * math.sin(t)) for t in ((k + 0.5) * math.pi / 40 for k in range(40))) / 40.0

    def pattern(away_deg):
        u = 3.2327 * away_deg / width_deg  # half of the power at 1.6163
        return 1.0 if u < 1e-6 else (2.0 * j1(u) / u) ** 2

    table = [pattern(0.02 * index) for index in range(4000)]
    disc = [(0.2665 * math.sqrt((r + 0.5) / 4), a * math.pi / 4) for r in range(4) for a in range(8)]

    def power(when, az, el):
        x, y = offset(*sun(when, PLACE["latitude_deg"], PLACE["longitude_deg"]), az, el)
        parts = [table[round(math.hypot(x + r * math.cos(a), y + r * math.sin(a)) / 0.02)] for r, a in disc]
        # A beam whose solid angle is that of a Gaussian of this width takes in so much of an even disc.
        solid = math.pi / 4.0 / math.log(2.0) * width_deg**2
        return 1.0 + kelvins * (math.pi * 0.2665**2 / solid) * sum(parts) / len(parts) / system_k

    return map_of(plan, power, noise_db, beam_az_deg=width_deg, beam_el_deg=width_deg, **other)
