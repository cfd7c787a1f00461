"""What a build machine leaves to the night (`scripts/test -m soak`): it takes a few of each kind, a night takes all."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pytest

LIST = Path(__file__).parents[1] / "by_night.txt"


def by_night(values: Iterable[object], keep: int) -> list[object]:
    """Return the values as parameters; those after the first `keep` are left to the night."""
    return [value if index < keep else pytest.param(value, marks=pytest.mark.night)
            for index, value in enumerate(values)]  # fmt: skip


def listed() -> dict[str, int]:
    """Return how many cases of a test stay in the fast set, for each test of the list."""
    lines = (line.split() for line in LIST.read_text(encoding="utf-8").splitlines() if line and line[0] != "#")
    return {test: int(*keep) for test, *keep in lines}


def leave_to_the_night(items: list[pytest.Item]) -> None:
    """Mark what the list leaves to the night. The cases that stay lie evenly among all, the first and the last too."""
    keep, cases = listed(), dict[str, list[pytest.Item]]()
    for item in items:
        test = item.nodeid.partition("[")[0]
        if test in keep:
            cases.setdefault(test, []).append(item)
    for test, some in cases.items():
        count, gaps = len(some), max(keep[test] - 1, 1)
        staying = {round(place * (count - 1) / gaps) for place in range(keep[test])}
        for index, item in enumerate(some):
            if index not in staying and count > keep[test]:
                item.add_marker(pytest.mark.soak)
                item.add_marker(pytest.mark.night)
