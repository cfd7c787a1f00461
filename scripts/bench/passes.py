"""The pass search: against Skyfield, against the bare SGP4 calls that it makes, for one and ten thousand satellites.

The catalogue is the one of the Debian package `gpredict` (979 satellites of January 2018), fetched once with
`apt-get download`, unpacked and never installed, and kept in the cache folder. Medians of five interleaved runs.
"""

from __future__ import annotations

import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
from birdcage.sky import propagate
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search, search_in_parts
from birdcage.sky.propagate import Fleet
from made_up import made_up
from sgp4.api import Satrec, SatrecArray
from skyfield.api import EarthSatellite, load, wgs84
from skyfield.timelib import Timescale

RUNS = 5
START = datetime(2018, 1, 21, 12, tzinfo=UTC)
HOURS = 24.0
OBSERVER = Observer(47.0, 8.0, 500.0)
ISS = (
    "1 25544U 98067A   18021.21573878  .00002217  00000-0  40532-4 0  9993",
    "2 25544  51.6427  49.4461 0003350   8.8293 137.1127 15.54298420 95721",
)
BUDGET = {
    "ratio_skyfield": 20.0, "ratio_bare": 3.0, "one_s": 0.003, "ten_thousand_s": 2.0, "look_cpu_s": 0.020,
}  # fmt: skip


def gpredict() -> list[tuple[str, str, str]]:
    """Return (name, line 1, line 2) of the package's satellites."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "birdcage-bench"
    kept = cache / "gpredict-satellites.dat"
    if not kept.exists():
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["apt-get", "download", "gpredict"], cwd=folder, check=True, timeout=120,
                           stdout=subprocess.DEVNULL)  # fmt: skip
            (package,) = Path(folder).glob("gpredict_*.deb")
            subprocess.run(["dpkg", "-x", package, f"{folder}/tree"], check=True, timeout=60)
            found = Path(folder, "tree/usr/share/gpredict/data/satdata/satellites.dat").read_bytes()
        cache.mkdir(parents=True, exist_ok=True)
        kept.write_bytes(found)
    return re.findall(r"^NAME=(.*)\n(?:.*\n)*?TLE1=(.*)\nTLE2=(.*)", kept.read_text(encoding="utf-8"), re.MULTILINE)


def elements_of(name: str, line1: str, line2: str) -> ElementSet:
    record = Satrec.twoline2rv(line1, line2)
    return ElementSet(
        name=name,
        norad_id=record.satnum,
        epoch=datetime(1949, 12, 31, tzinfo=UTC) + timedelta(days=record.jdsatepoch - 2433281.5 + record.jdsatepochF),
        inclination_deg=math.degrees(record.inclo),
        raan_deg=math.degrees(record.nodeo),
        eccentricity=record.ecco,
        argument_of_perigee_deg=math.degrees(record.argpo),
        mean_anomaly_deg=math.degrees(record.mo),
        mean_motion_rev_day=record.no_kozai * 720.0 / math.pi,
        bstar=record.bstar,
    )


Call = tuple[Any, np.ndarray, np.ndarray]
"""Records or one record of SGP4, day, part of the day."""


def calls_of(fleet: Fleet) -> list[Call]:
    """Return every SGP4 call that a search of `fleet` makes."""
    calls: list[Any] = []

    def noting(inner: Callable[..., Any]) -> Callable[..., Any]:
        def noted(*call: object) -> object:
            calls.append(call)
            return inner(*call)

        return noted

    with mock.patch.multiple(propagate, over_grid=noting(propagate.over_grid), over_times=noting(propagate.over_times)):
        search(fleet, OBSERVER, START, HOURS)
    return [*calls, (fleet.satrecs, calls[0][1][:1], calls[0][2][:1])]  # the last: `Fleet.states` at the start


def bare(calls: list[Call]) -> None:
    for records, day, part in calls:
        if isinstance(records, Satrec):
            records.sgp4_array(day, part)
        else:
            SatrecArray(records).sgp4(day, part)


def skyfield_search(satellites: list[EarthSatellite], scale: Timescale) -> int:
    place = wgs84.latlon(OBSERVER.latitude_deg, OBSERVER.longitude_deg, OBSERVER.height_m)
    begin, end = scale.from_datetime(START), scale.from_datetime(START + timedelta(hours=HOURS))
    return sum(int(np.sum(satellite.find_events(place, begin, end)[1] == 1)) for satellite in satellites)


def timed(job: Callable[[], Any], clock: Callable[[], float] = time.perf_counter) -> float:
    began = clock()
    job()
    return clock() - began


def main() -> None:
    lines = gpredict()
    fleet = Fleet(elements_of(*one) for one in lines)
    scale = load.timescale()
    peers = [EarthSatellite.from_satrec(Satrec.twoline2rv(line1, line2), scale) for _, line1, line2 in lines]
    calls = calls_of(fleet)
    states = sum(len(day) * (1 if isinstance(records, Satrec) else len(records)) for records, day, part in calls)
    # As many states as the search asks for, with no call for a single satellite: the strictest floor.
    grid = np.full(round(states / len(fleet)), 2458140.5), np.linspace(0.0, 1.0, round(states / len(fleet)))
    array = SatrecArray(list(fleet.satrecs))
    one, many = Fleet([elements_of("ISS", *ISS)]), Fleet(made_up(10_000, START))
    catalogue = Fleet(made_up(6_000, START, seed=6))
    jobs: dict[str, Callable[[], Any]] = {
        f"birdcage, {len(fleet)} satellites": lambda: search(fleet, OBSERVER, START, HOURS),
        "the bare SGP4 calls of it": lambda: bare(calls),
        "as many states, one call": lambda: array.sgp4(*grid),
        "Skyfield find_events": lambda: skyfield_search(peers, scale),
        "birdcage, one satellite": lambda: search(one, OBSERVER, START, HOURS),
        "birdcage, 10 000 satellites": lambda: search(many, OBSERVER, START, HOURS),
        "  first part of them": lambda: next(search_in_parts(many, OBSERVER, START, HOURS)),
        "  SGP4 records of them": lambda: Fleet(many),
    }
    times: dict[str, list[float]] = {name: [] for name in jobs}
    look_s = []
    for run in range(RUNS + 1):
        for name, job in jobs.items():
            spent_s = timed(job)
            if run:
                times[name].append(spent_s)
        when = START + timedelta(seconds=run)
        look_s.append(timed(lambda when=when: catalogue.look(OBSERVER, when), time.process_time))
    medians = {name: statistics.median(values) for name, values in times.items()}
    ours_s, bare_s, strict_s, skyfield_s, one_s, many_s, *_ = medians.values()
    for name, median_s in medians.items():
        print(f"{name:34}{median_s * 1e3:10.2f} ms{median_s / ours_s:9.2f}")
    print(f"{'look angles of 6 000, once':34}{statistics.median(look_s[1:]) * 1e3:10.2f} ms of CPU")
    report = {
        "bench": "passes", "runs": RUNS, "satellites": len(fleet), "passes": len(search(fleet, OBSERVER, START, HOURS)),
        "sgp4_states": states, "ratio_skyfield": round(skyfield_s / ours_s, 1), "ratio_bare": round(ours_s / bare_s, 2),
        "ratio_states_in_one_call": round(ours_s / strict_s, 2), "one_s": round(one_s, 5),
        "ten_thousand_s": round(many_s, 3), "look_cpu_s": round(statistics.median(look_s[1:]), 4), "budget": BUDGET,
    }  # fmt: skip
    print(json.dumps(report))
    met = report["ratio_skyfield"] >= BUDGET["ratio_skyfield"] and all(
        report[name] <= BUDGET[name] for name in BUDGET if name != "ratio_skyfield"
    )
    sys.exit(0 if met else "a figure is outside its budget")


if __name__ == "__main__":
    main()
