"""How wide a dish's beam is: a property of its reflector and of the feed in its focus together.

Theory for a reflector that its feed fills with the usual taper: width at half power = 70 degrees x wavelength / size.
Off its middle a beam loses 12 (offset / width)^2 dB, the offsets across and up each by their own width. A beam that
was measured goes before theory, but for one measured in counts of a tuner: those compress the peak, which makes a beam
look wider than it is, so that such a width is an upper bound and theory goes before it where it is narrower.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.base.config.feeds import FeedProfile

LIGHT_M_S = 299_792_458.0
WIDTH_DEG = 70.0
"""Width at half power, for a reflector of one wavelength."""
PEAK_LOSS_DB = 12.0
"""Lost a whole width off the middle."""
OCTAVE = 2.0
SAME_BAND = 0.02
"""Bands whose middles differ by less than this share are one."""
MOST_DEG = 180.0


class BeamOrigin(Enum):
    """How the width of a beam came to be known."""

    THEORY = "reflector and frequency"
    SCAN = "scan"
    COUNTS = "counts"
    ENTERED = "entered"

    @property
    def words(self) -> str:
        """For people, after the width."""
        return _ORIGIN_WORDS[self]

    @property
    def brief(self) -> str:
        """The same in a word or two."""
        return _ORIGIN_BRIEF[self]


_ORIGIN_WORDS = {
    BeamOrigin.THEORY: "from reflector and frequency",
    BeamOrigin.SCAN: "measured by a scan",
    BeamOrigin.COUNTS: "measured in counts: upper bound",
    BeamOrigin.ENTERED: "entered by hand",
}


_ORIGIN_BRIEF = {
    BeamOrigin.THEORY: "theory",
    BeamOrigin.SCAN: "by a scan",
    BeamOrigin.COUNTS: "at most (counts)",
    BeamOrigin.ENTERED: "by hand",
}


@dataclass(frozen=True, slots=True)
class CountedBeam:
    """What a scan of the dish with its stock feed showed in counts: the beam is at most so wide."""

    az_deg: float
    """On the sky, across the line of sight."""
    el_deg: float
    at_hz: float


@dataclass(frozen=True, slots=True)
class Reflector:
    """The reflector of a dish, as it is mounted."""

    width_m: float
    """Its horizontal size, which makes the beam's width in azimuth."""
    height_m: float
    """The other one, which makes the beam's width in elevation."""
    counted: CountedBeam | None = None

    def beam_at(self, frequency_hz: float) -> Beam:
        """Return the beam by theory at a frequency."""
        wavelength_m = LIGHT_M_S / frequency_hz
        az_deg, el_deg = (min(WIDTH_DEG * wavelength_m / size_m, MOST_DEG) for size_m in (self.width_m, self.height_m))
        return Beam(az_deg, el_deg, frequency_hz, BeamOrigin.THEORY)


@dataclass(frozen=True, slots=True)
class Beam:
    """An elliptical beam: full widths at half power, in degrees on the sky."""

    az_deg: float
    """Across the line of sight, along the horizon: a turn of the azimuth counts times the cosine of the elevation."""
    el_deg: float
    at_hz: float | None = None
    """The frequency at which it is so wide: the middle of the feed's band. None if that is not known."""
    origin: BeamOrigin = BeamOrigin.ENTERED
    bound_deg: tuple[float, float] | None = None
    """At most so wide, az and el, by a measurement in counts; None without one."""

    @property
    def narrow_deg(self) -> float:
        """The narrower of both widths: it counts wherever only the size of an error is known, not its direction."""
        return min(self.az_deg, self.el_deg)

    @property
    def mean_deg(self) -> float:
        """The width of the round beam of the same area."""
        return math.sqrt(self.az_deg * self.el_deg)

    @property
    def size(self) -> str:
        """Both widths for people, az x el: `2.0° x 2.9°`."""
        return _size(self.az_deg, self.el_deg)

    @property
    def words(self) -> str:
        """Both widths and where they come from; and the bound, where a narrower width counts."""
        told = f"{self.size} {self.origin.words}"
        if self.bound_deg is None or self.origin is BeamOrigin.COUNTS:
            return told
        return f"{told}; {_size(*self.bound_deg)} {BeamOrigin.COUNTS.words}"

    @property
    def brief(self) -> str:
        """The same in a narrow place: `5.5° x 5.5° theory (up to 6.4° x 6.3°)`."""
        told = f"{self.size} {self.origin.brief}"
        if self.bound_deg is None or self.origin is BeamOrigin.COUNTS:
            return told
        return f"{told} (up to {_size(*self.bound_deg)})"

    def values(self) -> dict[str, float | str | None]:
        """Return it for JSON: widths in degrees, az x el, and where they come from."""
        bound = (None, None) if self.bound_deg is None else self.bound_deg
        return {
            "az_deg": round(self.az_deg, 3),
            "el_deg": round(self.el_deg, 3),
            "at_hz": self.at_hz,
            "origin": self.origin.value,
            "az_at_most_deg": bound[0],
            "el_at_most_deg": bound[1],
        }

    def at(self, frequency_hz: float | None) -> Beam:
        """Return the beam at another frequency: it grows with the wavelength.

        As it is, where no frequency is asked for, or its own is not known or an octave away: no law tells how a feed
        works that is not made for a frequency.
        """
        if self.at_hz is None or frequency_hz is None:
            return self
        ratio = self.at_hz / frequency_hz
        if not 1.0 / OCTAVE <= ratio <= OCTAVE:
            return self
        bound = None if self.bound_deg is None else (self.bound_deg[0] * ratio, self.bound_deg[1] * ratio)
        return replace(
            self, az_deg=self.az_deg * ratio, el_deg=self.el_deg * ratio, at_hz=frequency_hz, bound_deg=bound
        )

    def loss_db(self, across_deg: float, up_deg: float) -> float:
        """Return what is lost so far off the middle: across the line of sight (not in azimuth), and in elevation."""
        return PEAK_LOSS_DB * ((across_deg / self.az_deg) ** 2 + (up_deg / self.el_deg) ** 2)

    def most_loss_db(self, error_deg: float) -> float:
        """Return what is lost at most by an error of unknown direction: by the narrower width."""
        return PEAK_LOSS_DB * (error_deg / self.narrow_deg) ** 2

    def error_deg(self, loss_db: float) -> float:
        """Return the error that loses no more than this, whatever its direction."""
        return self.narrow_deg * math.sqrt(loss_db / PEAK_LOSS_DB)


def beam_of(feed: FeedProfile, reflector: Reflector | None) -> Beam | None:
    """Return the beam of a dish and a feed together, at the middle of the feed's band; None if it is not known.

    In this order: what the feed says was measured or entered; theory, by the reflector and the feed's band; a width
    measured in counts, which is an upper bound.
    """
    own, middle_hz = _own(feed), feed.middle_hz
    if own is not None and own.origin is not BeamOrigin.COUNTS:
        return own
    theory = None if reflector is None or middle_hz is None else reflector.beam_at(middle_hz)
    bound = (own.az_deg, own.el_deg) if own is not None else _counted(reflector, middle_hz)
    if theory is None:
        return own
    if bound is None:
        return theory
    az_deg, el_deg = min(theory.az_deg, bound[0]), min(theory.el_deg, bound[1])
    origin = BeamOrigin.COUNTS if (az_deg, el_deg) == bound else BeamOrigin.THEORY
    return Beam(az_deg, el_deg, middle_hz, origin, bound)


def _own(feed: FeedProfile) -> Beam | None:
    """Return the beam that the feed itself says; a single `beam_deg` is a round one."""
    az_deg = feed.beam_deg if feed.beam_az_deg is None else feed.beam_az_deg
    el_deg = feed.beam_deg if feed.beam_el_deg is None else feed.beam_el_deg
    if az_deg is None or el_deg is None:
        return None
    origin = BeamOrigin(feed.beam_origin)
    return Beam(az_deg, el_deg, feed.middle_hz, origin, (az_deg, el_deg) if origin is BeamOrigin.COUNTS else None)


def _counted(reflector: Reflector | None, middle_hz: float | None) -> tuple[float, float] | None:
    """Return the bound that a scan of this dish gave, for a feed of the band in which it was made."""
    if reflector is None or reflector.counted is None or middle_hz is None:
        return None
    counted = reflector.counted
    return (counted.az_deg, counted.el_deg) if abs(middle_hz / counted.at_hz - 1.0) < SAME_BAND else None


def _size(az_deg: float, el_deg: float) -> str:
    return f"{az_deg:.1f}° x {el_deg:.1f}°"
