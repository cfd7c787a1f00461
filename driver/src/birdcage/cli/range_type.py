"""An option that takes two angles."""

from __future__ import annotations

import math

import click

Range = tuple[float, float]


class RangeType(click.ParamType["tuple[float, float]"]):
    """Two angles with a colon between."""

    name = "FROM:TO"

    def convert(self, value: str | Range, param: click.Parameter | None, ctx: click.Context | None) -> Range:
        """Return both."""
        if isinstance(value, tuple):
            return value
        low, _colon, high = value.partition(":")
        try:
            both = float(low), float(high)
        except ValueError:
            both = math.nan, math.nan
        if not all(map(math.isfinite, both)):
            self.fail(f"{value!r} is no range of degrees. Type 160:220.", param, ctx)
        return both
