#!/usr/bin/env python3
"""Cut the years and bodies that birdcage needs out of JPL's DE421, into the driver's package data.

    pip download --no-deps skyfield-data && unzip skyfield_data-*.whl 'skyfield_data/data/de421.bsp'
    .venv/bin/python scripts/cut_ephemeris.py skyfield_data/data/de421.bsp

The numbers are copied as they are: the excerpt gives, to the last bit, what the whole file gives.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from jplephem.excerpter import write_excerpt
from jplephem.spk import SPK

OUT = Path(__file__).parents[1] / "driver/src/birdcage/sky/data/de421_2020_2053.bsp"
FIRST_JD, LAST_JD = 2458849.5, 2471184.5
"""1 January 2020 to 9 October 2053, where DE421 ends (TDB)."""
PLUTO = 9
"""The one barycentre that no small dish is pointed at."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("de421", type=Path, help="the whole ephemeris, 1899 to 2053")
    parser.add_argument("-o", "--out", type=Path, default=OUT)
    given = parser.parse_args()
    with given.out.open("w+b") as excerpt:
        spk = SPK.open(given.de421)
        summaries = [(name, values) for name, values in spk.daf.summaries() if int(values[2]) != PLUTO]
        write_excerpt(spk, excerpt, FIRST_JD, LAST_JD, summaries)
        spk.close()
    cut = SPK.open(given.out)
    print(cut)
    cut.close()
    print(f"{given.out}: {given.out.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
