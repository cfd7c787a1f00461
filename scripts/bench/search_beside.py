"""How long a thread waits for its turn beside the search for passes: none, in this process, and in one of its own.

The thread sleeps for 10 ms and makes four system calls, as a key does on its way from the terminal to the dish. Printed
is what that takes beyond the 10 ms. 6,000 satellites, whose catalogue changes all the time. The first row is the
machine's own.
"""

from __future__ import annotations

import json
import os
import select
import statistics
import sys
import tempfile
import time
from pathlib import Path

from birdcage.base.clock import RealClock
from birdcage.sky.observer import Observer
from birdcage.sky.watch import SkyWatch
from made_up import fill
from terminal import percentile

SATELLITES, RUNS, RUN_S, SLEEP_S = 6000, 3, 14.0, 0.01
MODES = {"no search": None, "in this process": False, "in its own process": True}


def run(catalogue: Path, apart: bool | None) -> list[float]:
    """Return what the thread's turns took beyond its sleep."""
    watch = SkyWatch(catalogue, lambda _now: None, RealClock(), observer=Observer(47.0, 8.0), apart=bool(apart))
    if apart is not None:
        watch.start()
    time.sleep(3.0)
    reader, writer = os.pipe()
    waits: list[float] = []
    begun = time.monotonic()
    while (now := time.monotonic()) < begun + RUN_S:
        if len(waits) % 50 == 0:
            os.utime(catalogue)  # the watch looks every five seconds, and searches anew
        time.sleep(SLEEP_S)
        os.write(writer, b"x")
        select.select([reader], [], [], 1.0)
        os.read(reader, 1)
        os.write(writer, b"y")
        os.read(reader, 1)
        waits.append(time.monotonic() - now - SLEEP_S)
    watch.close(0.5)
    os.close(reader)
    os.close(writer)
    return waits


def main() -> None:
    sys.setswitchinterval(0.001)
    found: dict[str, list[float]] = {name: [] for name in MODES}
    with tempfile.TemporaryDirectory() as folder:
        catalogue = fill(Path(folder), SATELLITES)
        for _run in range(RUNS):
            for name, apart in MODES.items():
                found[name] += run(catalogue, apart)
    report = {
        name: {"median_ms": statistics.median(waits) * 1e3, "p95_ms": percentile(waits, 0.95) * 1e3}
        for name, waits in found.items()
    }
    for name, values in report.items():
        print(f"{name:20}{values['median_ms']:8.2f} ms{values['p95_ms']:8.2f} ms")
    print(json.dumps({"bench": "search_beside", **report}))


if __name__ == "__main__":
    main()
