"""How the tables of a G2's features are written: a line of a menu, with all that its answer tells."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from birdcage.protocol.motors import AZIMUTH, ELEVATION
from birdcage.protocol.trk.reading import printed
from birdcage.rotator.feature import Cost, Feature, FeatureKind, FeaturePage, Range, Value
from birdcage.rotator.feature_table import FeatureRow

if TYPE_CHECKING:
    from birdcage.protocol.g2.protocol import CarryoutG2Protocol

FROM_0 = Range(0.0, math.inf)
_EVERY_S = 5.0
"""How long a menu is left alone between two reads of the same."""
_SHOWN = {"eeprom": "EE"}
"""Menus whose prompt is not their name."""


@dataclass(frozen=True, slots=True)
class Question:
    """A line of a menu, and what it costs to have it answered."""

    menu: str
    line: str
    lines: int = 1
    """How many lines are sent at most, what ends a stream among them."""
    min_interval_s: float = _EVERY_S

    def about(self, feature: Feature) -> Feature:
        """Return a feature that its answer tells."""
        cost = Cost(self.lines, self.menu, self.min_interval_s)
        return replace(feature, cost=cost, asked=f"{_SHOWN.get(self.menu, self.menu).upper()}> {self.line}")


def stream(line: str) -> Question:
    """Return the question of a stream of the tuner: its line, and what ends it."""
    return Question("dvb", line, 2)


def told(
    question: Question, ask: Callable[[CarryoutG2Protocol], Mapping[str, Value]], *features: Feature
) -> tuple[FeatureRow, ...]:
    """Return the rows of all that one command tells; it is sent once, whichever of them are read."""
    return tuple(FeatureRow(question.about(each), ask) for each in features)


def one(question: Question, ask: Callable[[CarryoutG2Protocol], Value], feature: Feature) -> FeatureRow:
    """Return the row of what a command of its own tells."""
    return FeatureRow(question.about(feature), lambda dish: {feature.id: ask(dish)})


def in_lines(
    question: Question, ask: Callable[[CarryoutG2Protocol], Iterable[str]], name: str, label: str
) -> FeatureRow:
    """Return the row of an answer of several lines, as printed."""
    return FeatureRow(question.about(lines(name, label)), lambda dish: printed(name, ask(dish)))


def text(name: str, label: str) -> Feature:
    """Return a feature that is a text of one line."""
    return Feature(name, label, kind=FeatureKind.TEXT)


def lines(name: str, label: str) -> Feature:
    """Return a feature that is a text of several lines."""
    return Feature(name, label, kind=FeatureKind.LINES)


def counts(name: str, label: str) -> Feature:
    """Return a feature in counts of a converter."""
    return Feature(name, label, "counts", range=FROM_0)


def each(feature: Feature) -> tuple[Feature, ...]:
    """Return a feature for each axis, which its label names as `{}`."""
    return tuple(
        replace(feature, id=f"{feature.id}.{axis}", label=feature.label.format(axis)) for axis in (AZIMUTH, ELEVATION)
    )


def under(page: FeaturePage, group: str, *rows: FeatureRow) -> tuple[FeatureRow, ...]:
    """Return rows that stand under a heading of a page."""
    return tuple(replace(row, feature=replace(row.feature, page=page, group=group)) for row in rows)
