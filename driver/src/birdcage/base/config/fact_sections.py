"""`[dish.facts]`: what the owner says of this machine, over what is known of its kind. It counts from the next start.

An axis has a part of its own: `azimuth.speed_deg_s = 30`. `birdcage facts` lists what counts, and where it comes from.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal

from birdcage.base.config.field import Complaint, Section, setting


@dataclass(frozen=True, slots=True)
class OwnFactSettings(Section):
    """Facts of the machine as a whole."""

    section: ClassVar[str] = "dish.facts"
    limits_motion: ClassVar[bool] = True

    second_same: Literal["retarget", "queue", "block", "unknown"] | None = setting(
        None, "What a second move does while its own axis still runs; STOP rests on it."
    )
    second_other: Literal["retarget", "queue", "block", "unknown"] | None = setting(
        None, "What a second move does while the other axis still runs; STOP rests on it."
    )
    homing_s: float | None = setting(None, "The longest that homing one axis takes.", minimum=0.1, maximum=3600.0)
    boot_s: float | None = setting(None, "The longest that a boot takes.", minimum=0.1, maximum=3600.0)
    power_switch: str | None = setting(None, "What you switch off where no STOP helps: 12 V switch.")


@dataclass(frozen=True, slots=True)
class RangeFacts(Section):
    """A range of angles."""

    limits_motion: ClassVar[bool] = True

    min_deg: float | None = setting(
        None, "Where its range begins; it narrows the documented one.", minimum=-1080.0, maximum=1080.0
    )
    max_deg: float | None = setting(
        None, "Where its range ends; it narrows the documented one.", minimum=-1080.0, maximum=1080.0
    )

    def complaints(self) -> Iterator[Complaint]:
        """Yield a range that is none."""
        if self.min_deg is not None and self.max_deg is not None and self.min_deg >= self.max_deg:
            yield "min_deg", f"is {self.min_deg:g}, which is not below max_deg ({self.max_deg:g})"


@dataclass(frozen=True, slots=True)
class AxisFacts(RangeFacts):
    """An axis."""

    speed_deg_s: float | None = setting(
        None, "The fastest that it turns; it replaces measured times.", minimum=0.01, maximum=400.0
    )
    acceleration_deg_s2: float | None = setting(
        None, "How it gains and loses speed; it replaces measured times.", minimum=0.1, maximum=10_000.0
    )


@dataclass(frozen=True, slots=True)
class GearedAxisFacts(AxisFacts):
    """An axis that points the beam."""

    overshoot_deg: float | None = setting(
        None, "How far past its target it may come to rest, at most.", minimum=0.0, maximum=5.0
    )
    play_deg: float | None = setting(
        None, "Play of its gear; `birdcage gear --help` says how to measure it.", minimum=0.0, maximum=0.15
    )
    mean_overshoot_up_deg: float | None = setting(
        None, "How far past its target it rests on the mean, of moves to greater angles.", minimum=-0.1, maximum=0.1
    )
    mean_overshoot_down_deg: float | None = setting(
        None, "How far past its target it rests on the mean, of moves to lesser angles.", minimum=-0.1, maximum=0.1
    )


@dataclass(frozen=True, slots=True)
class AzimuthFacts(GearedAxisFacts):
    """The azimuth."""

    section: ClassVar[str] = "dish.facts.azimuth"


@dataclass(frozen=True, slots=True)
class ElevationFacts(GearedAxisFacts):
    """The elevation, in the dish's own frame."""

    section: ClassVar[str] = "dish.facts.elevation"


@dataclass(frozen=True, slots=True)
class SkewFacts(AxisFacts):
    """The axis that turns the feed."""

    section: ClassVar[str] = "dish.facts.skew"


@dataclass(frozen=True, slots=True)
class CableFacts(RangeFacts):
    """How far the cable lets the azimuth turn, counted from the homing reference."""

    section: ClassVar[str] = "dish.facts.cable"


FACT_PARTS: tuple[type[RangeFacts], ...] = (AzimuthFacts, ElevationFacts, SkewFacts, CableFacts)
FACT_SECTIONS: tuple[type[Section], ...] = (OwnFactSettings, *FACT_PARTS)
