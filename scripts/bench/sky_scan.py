"""The simulated sky beside a real one: the scan that a Carryout G2 made of its southern sky, cell by cell.

The real one is `example/scan_data.txt` of cdavidson0522/winegard-sky-scan: azimuth 110 to 240, elevation 18 to 58 in
steps of a degree, mean of ten reads. Its site is not written there: the angles of its `satellite_data.csv` fit Denver.
To see what a change of the simulator did, run it before and after: `python scripts/bench/sky_scan.py`.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime

from birdcage.sim.almanac import geostationary
from birdcage.sim.settings import SimSettings
from birdcage.sim.sky import SimSky

DENVER = 39.74, -104.99
NIGHT = datetime(2026, 3, 20, 6, tzinfo=UTC)
AZ_DEG, EL_DEG = range(110, 241), range(18, 59)
PEAKS = {124: 544, 137: 529, 174: 562, 188: 514, 201: 545}
"""Azimuth in degrees to the greatest counts there."""
NEAR_DEG = 4
"""A peak may stand so far beside: the real dish leaned, and its slots carry satellites beside their middle."""
SHARES = {440: 7.5, 500: 2.3}
"""Counts to the percentage of cells above them."""
AT_MOST = {-91.0: 423, -129.0: 440}
"""Slot in degrees east to the most that was heard there."""

Scan = dict[tuple[int, int], int]


def simulated() -> Scan:
    """Return the counts of each cell, (azimuth, elevation) in degrees, without noise."""
    sky = SimSky(SimSettings(lat=DENVER[0], lon=DENVER[1]))
    return {(az, el): round(sky.level(NIGHT, az, el)) for az in AZ_DEG for el in EL_DEG}


def peak(scan: Scan, az_deg: int) -> int:
    """Return the most that is heard near an azimuth."""
    return max(counts for (az, _), counts in scan.items() if abs(az - az_deg) <= NEAR_DEG)


def share(scan: Scan, threshold: int) -> float:
    """Return the percentage of cells above a threshold."""
    return 100.0 * sum(counts > threshold for counts in scan.values()) / len(scan)


def at_slot(scan: Scan, slot_deg_east: float) -> int:
    """Return the counts in the cell of a slot."""
    az, el = geostationary(slot_deg_east, *DENVER)
    return scan[round(az), round(el)]


def main() -> None:
    """Print the real scan beside the simulated one."""
    scan = simulated()
    rows: list[tuple[str, float, float]] = [("maximum", max(PEAKS.values()), max(scan.values()))]
    rows += [(f"peak at azimuth {az}", counts, peak(scan, az)) for az, counts in PEAKS.items()]
    rows += [(f"{-slot:g} W, at most", counts, at_slot(scan, slot)) for slot, counts in AT_MOST.items()]
    rows += [(f"% of cells above {counts}", percent, share(scan, counts)) for counts, percent in SHARES.items()]
    print(f"{'counts':24} {'real':>6} {'simulated':>10}")
    for name, real, ours in rows:
        form: Callable[[float], str] = "{:.1f}".format if name.startswith("%") else "{:.0f}".format
        print(f"{name:24} {form(real):>6} {form(ours):>10}")


if __name__ == "__main__":
    main()
