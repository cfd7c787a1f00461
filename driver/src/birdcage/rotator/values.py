"""The plain values of the public API."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from birdcage.rotator.feature import Value

MOTOR_AZIMUTH = 0
MOTOR_ELEVATION = 1
MOTOR_SKEW = 2


@dataclass
class Position:
    """Where the dish points, in degrees, in the dish's own frame."""

    azimuth: float
    elevation: float
    skew: float | None = None


@dataclass(frozen=True, slots=True)
class Look:
    """Where a machine tells that its axes are."""

    angles: Mapping[str, float]
    """Its own degrees, by the name of the axis; an axis that it does not tell of is missing."""


@dataclass(frozen=True, slots=True)
class Taken:
    """What a dish answered to the command of a move."""

    sure: bool
    """Whether the answer tells that the command was taken; else only the position does."""
    said: str
    """What was printed, on one line; empty for nothing."""
    took_s: float
    """From its first byte out to the prompt, in seconds of the wire."""


@dataclass
class RssiReading:
    """Signal strength as the DVB tuner counts it: `reads` samples, their `average`, and the `current` one."""

    reads: int
    average: int
    current: int


@dataclass(frozen=True, slots=True)
class Survey:
    """What a dish tells about itself. What it does not tell is empty or None."""

    identity: Mapping[str, str] = field(default_factory=dict)
    """Field name to text, as printed."""
    features: Mapping[str, Value] = field(default_factory=dict)
    """What the same answers told of the machine's features, by id: its version, its speeds, its limits, …"""
    settings: Mapping[str, str] = field(default_factory=dict)
    """Settings in force, by name (`nvs.20`), as printed."""
    el_min_deg: float | None = None
    el_max_deg: float | None = None
    search_disabled: bool | None = None
    """Whether the firmware's own TV search is switched off for good."""
