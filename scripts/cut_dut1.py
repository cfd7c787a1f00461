"""Cuts the table of UT1-UTC that ships with birdcage from the IERS file in `astropy-iers-data`.

    scripts/cut_dut1.py > driver/src/birdcage/sky/data/dut1.txt

The source is IERS Bulletin A, finals2000A.all: measured values, then a prediction for about a year.
"""

from __future__ import annotations

from pathlib import Path

import astropy_iers_data

HEAD = """\
# UT1-UTC in seconds at 0 h UTC on the first of each month, January to December.
# IERS, finals2000A.all (Bulletin A) as of {until}; the months after that are its prediction.
"""


def main() -> None:
    years: dict[int, list[str]] = {}
    measured = ""
    for line in Path(astropy_iers_data.IERS_A_FILE).read_text(encoding="ascii").splitlines():
        year, month, day, value = int(line[0:2]), int(line[2:4]), int(line[4:6]), line[58:68].strip()
        year += 1900 if year >= 73 else 2000
        if not value:
            continue
        if line[57] == "I":
            measured = f"{year}-{month:02d}-{day:02d}"
        if day == 1:
            # The file begins on 2 January 1973; that month's first is one day's change before it.
            years.setdefault(year, []).append(f"{float(value):.4f}")
    first = min(years)
    if len(years[first]) == 11:
        years[first].insert(0, "0.8112")
    print(HEAD.format(until=measured), end="")
    for year, values in sorted(years.items()):
        print(year, *values)


if __name__ == "__main__":
    main()
