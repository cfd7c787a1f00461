"""The kinds of targets. All of them know their name and where they stand."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime, timedelta
from typing import Literal, Protocol

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.sky.elements import ElementSet
from birdcage.sky.ephemeris.bodies import Body, look_at_star
from birdcage.sky.geostationary import look_at_slot
from birdcage.sky.look import LookAngle, LookRate, rate_between
from birdcage.sky.observer import Observer
from birdcage.sky.skew import Skew, skew_of
from birdcage.sky.slots import Slot

Kind = Literal["satellite", "slot", "body", "star", "fixed"]
RATE_OVER_S = 1.0


class NoPosition(BirdcageError):
    """The elements of a satellite give no position at that time: it has decayed, or they are no orbit."""

    reason = Reason.NO_POSITION


class Target(Protocol):
    """Anything that stands somewhere in the sky."""

    @property
    def name(self) -> str:
        """What people call it."""

    @property
    def kind(self) -> Kind:
        """Which of the kinds it is."""

    def look(self, observer: Observer, when: datetime) -> LookAngle:
        """Return where it stands. `when` is aware; ValueError otherwise, BirdcageError where that is not known."""


@dataclass(frozen=True, slots=True)
class Satellite:
    """A satellite by its elements."""

    elements: ElementSet
    time_offset_s: float = 0.0
    """How much later than computed it comes."""
    kind: Kind = field(default="satellite", init=False)

    @property
    def name(self) -> str:
        """Its name, or its number where it has none."""
        return self.elements.name or str(self.elements.norad_id)

    def look(self, observer: Observer, when: datetime) -> LookAngle:
        """Return where SGP4 puts it. NoPosition where it puts it nowhere."""
        import math

        from birdcage.sky.frames import posix_s
        from birdcage.sky.propagate import track

        seen = track(self.elements, observer, [posix_s(when)], self.time_offset_s)
        az, el, far, away = (
            float(values[0]) for values in (seen.az_deg, seen.el_deg, seen.range_km, seen.range_rate_km_s)
        )
        if math.isnan(el):
            raise NoPosition(
                f"The elements of {self.name} (epoch {self.elements.epoch:%Y-%m-%d}) give no position "
                f"on {when:%Y-%m-%d}: it has decayed, or they are damaged."
            )
        return LookAngle(az, el, far, away)


@dataclass(frozen=True, slots=True)
class SlotTarget:
    """A place on the geostationary arc: what stands there is taken not to move."""

    slot: Slot
    kind: Kind = field(default="slot", init=False)

    @property
    def name(self) -> str:
        """Its longitude, and who is known to stand there."""
        return f"{self.slot.label} {self.slot.name}".strip()

    def look(self, observer: Observer, when: datetime) -> LookAngle:  # noqa: ARG002 - it stands still
        """Return where it stands at any time."""
        seen = look_at_slot(observer, self.slot.longitude_deg)
        return LookAngle(seen.az_deg, seen.el_deg, seen.range_km, 0.0)

    def skew(self, observer: Observer) -> Skew | None:
        """Return how far a feed is to be turned for a linear downlink; None if it is circular."""
        return skew_of(self.slot, observer)


@dataclass(frozen=True, slots=True)
class BodyTarget:
    """Sun, Moon or a planet."""

    body: Body
    kind: Kind = field(default="body", init=False)

    @property
    def name(self) -> str:
        """`Sun`."""
        return self.body.name

    def look(self, observer: Observer, when: datetime) -> LookAngle:
        """Return where its middle stands. NotCovered outside the ephemeris."""
        return self.body.look(observer, when)


@dataclass(frozen=True, slots=True)
class Star:
    """A point that goes round with the stars: ICRS, as good as J2000."""

    name: str
    ra_deg: float
    dec_deg: float
    kind: Kind = field(default="star", init=False)

    def look(self, observer: Observer, when: datetime) -> LookAngle:
        """Return where it stands. NotCovered outside the ephemeris."""
        return look_at_star(observer, when, self.ra_deg, self.dec_deg)


@dataclass(frozen=True, slots=True)
class Fixed:
    """A direction that does not move: true azimuth and elevation."""

    name: str
    az_deg: float
    el_deg: float
    kind: Kind = field(default="fixed", init=False)

    def look(self, observer: Observer, when: datetime) -> LookAngle:  # noqa: ARG002 - the same from everywhere, always
        """Return the direction."""
        return LookAngle(self.az_deg, self.el_deg)


def rate(target: Target, observer: Observer, when: datetime) -> LookRate:
    """Return how fast a target moves across the sky, over the second about `when`."""
    half = timedelta(seconds=RATE_OVER_S / 2.0)
    return rate_between(target.look(observer, when - half), target.look(observer, when + half), RATE_OVER_S)
