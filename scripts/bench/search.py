"""Typing into a catalogue of ten thousand, against one plain look through ten thousand names, in turn, in one run."""

from __future__ import annotations

import json
import statistics
import time
from datetime import UTC, datetime

from birdcage.sky.catalogue import CatalogueEntry, SearchIndex
from made_up import made_up

COUNT, RUNS = 10_000, 5
TYPED = ("made up 99", "up 4711", "nowhere", "xq zz", "active")


def median_ms(work: list[float]) -> float:
    return statistics.median(work) * 1000.0


def main() -> None:
    now = datetime.now(UTC)
    elements = made_up(COUNT, now)
    index = SearchIndex(CatalogueEntry(each, now, ("active",)) for each in elements)
    names = [each.name.casefold() for each in elements]
    ours, floor = [], []
    for _ in range(RUNS):
        for text in (word[:end] for word in TYPED for end in range(1, len(word) + 1)):
            begun = time.perf_counter()
            index.search(text)
            between = time.perf_counter()
            [name for name in names if text in name]
            ours.append(between - begun)
            floor.append(time.perf_counter() - between)
    found = {
        "keystroke_median_ms": median_ms(ours),
        "keystroke_p95_ms": sorted(ours)[len(ours) * 95 // 100] * 1000.0,
        "plain_look_through_median_ms": median_ms(floor),
        "ratio": median_ms(ours) / median_ms(floor),
    }
    print(json.dumps({name: round(value, 3) for name, value in found.items()}, indent=2))


if __name__ == "__main__":
    main()
