"""The longest of the soak: a build machine takes a few of each kind, a night (`scripts/test -m soak`) all."""

from __future__ import annotations

from collections.abc import Iterable

import pytest


def by_night(values: Iterable[object], keep: int) -> list[object]:
    """Return the values as parameters; those after the first `keep` are left to the night."""
    return [value if index < keep else pytest.param(value, marks=pytest.mark.night)
            for index, value in enumerate(values)]  # fmt: skip
