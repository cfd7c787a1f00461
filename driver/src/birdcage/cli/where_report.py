"""What `birdcage where` says of a target: as values, and as lines."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.cli.say import iso

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.cli.options import Wanted
    from birdcage.sky.age import ExpectedError
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.look import LookAngle, LookRate
    from birdcage.sky.observer import Observer
    from birdcage.sky.skew import Skew
    from birdcage.sky.targets import Target
    from birdcage.tracking.planning.refraction import Refraction


NO_SKEW = dict.fromkeys(("skew_deg", "slot_tilt_deg", "feed_skew_deg"))
FAINT_DB = 0.1
"""A meter does not show less."""


@dataclass(frozen=True, slots=True)
class Report:
    """All that is known of where a target stands; what is not known is None."""

    target: Target
    observer: Observer
    when: datetime
    seen: LookAngle
    turning: LookRate
    in_the_way: str | None
    """Why this dish can't point there; empty for nothing, None when its limits are not known."""
    skew: Skew | None
    """Of a slot that is not circular."""
    refraction: Refraction
    """By what this dish is lifted when it tracks; nothing here is."""
    rise_db: float | None
    beam: Beam | None
    """Of the dish that was named, with the active feed."""
    feed: str
    system_k: float
    system_given: bool
    """Whether somebody set that; else it is an assumption."""
    sidereal_h: float
    elements: ElementSet | None
    time_offset_s: float

    @classmethod
    def of(cls, target: Target, observer: Observer, when: datetime, dish: Wanted) -> Report:
        """Look. BirdcageError where that is not known, as for a satellite that has decayed."""
        from birdcage.cli.standing import what_stands_in_the_way
        from birdcage.sky.rise import Ear, expected_rise_db
        from birdcage.sky.sidereal import local_sidereal_h
        from birdcage.sky.targets.model import Satellite, SlotTarget, rate

        seen, feed = target.look(observer, when), dish.settings.active_feed
        return cls(
            target=target,
            observer=observer,
            when=when,
            seen=seen,
            turning=rate(target, observer, when),
            in_the_way=what_stands_in_the_way(dish)(seen),
            skew=target.skew(observer) if isinstance(target, SlotTarget) else None,
            refraction=dish.settings.tracking.refraction,
            rise_db=expected_rise_db(target, seen, Ear.of(feed, dish.beam)),
            beam=dish.beam,
            feed=dish.settings.feed.active,
            system_k=feed.system_k,
            system_given=f"feed.{dish.settings.feed.active}.system_k" in dish.settings.sources,
            sidereal_h=local_sidereal_h(when, observer.longitude_deg),
            elements=target.elements if isinstance(target, Satellite) else None,
            time_offset_s=target.time_offset_s if isinstance(target, Satellite) else 0.0,
        )

    @property
    def age_s(self) -> float | None:
        """How old the elements are at the time that was asked for."""
        return None if self.elements is None else (self.when - self.elements.epoch).total_seconds()

    @property
    def error(self) -> ExpectedError | None:
        """How far off the elements may be: where it is up at its distance, else at its closest; None without any."""
        from birdcage.sky.age import expected_error

        if self.elements is None:
            return None
        return expected_error(self.elements, self.when, self.seen.range_km if self.seen.el_deg > 0.0 else None)

    @property
    def lift_deg(self) -> float | None:
        """How much higher the dish points when it tracks this; None below the horizon."""
        from birdcage.tracking.planning.refraction import lift_deg

        if self.seen.el_deg < 0.0 or self.target.kind == "fixed":
            return None
        return float(lift_deg(self.seen.el_deg, self.refraction))

    def values(self) -> dict[str, object]:
        """Return it for JSON."""
        from birdcage.sky.age import error_values

        elements = self.elements
        return {
            "name": self.target.name,
            "kind": self.target.kind,
            "norad_id": None if elements is None else elements.norad_id or None,
            "at": iso(self.when),
            "latitude_deg": self.observer.latitude_deg,
            "longitude_deg": self.observer.longitude_deg,
            "height_m": self.observer.height_m,
            "azimuth_deg": round(self.seen.az_deg, 4) % 360.0,
            "elevation_deg": round(self.seen.el_deg, 4),
            "azimuth_rate_deg_s": round(self.turning.az_deg_s, 6),
            "elevation_rate_deg_s": round(self.turning.el_deg_s, 6),
            "range_km": rounded(self.seen.range_km, 3),
            "range_rate_km_s": rounded(self.seen.range_rate_km_s, 6),
            "in_reach": None if self.in_the_way is None else not self.in_the_way,
            "in_the_way": self.in_the_way or None,
            "refraction": "none",
            "refraction_deg": rounded(self.lift_deg, 4),
            **(NO_SKEW if self.skew is None else self.skew.values()),
            "rise_db": rounded(self.rise_db, 4),
            "feed": self.feed,
            "beam": None if self.beam is None else self.beam.values(),
            "system_k": self.system_k,
            "sidereal_time_h": round(self.sidereal_h, 6) % 24.0,
            "epoch": None if elements is None else iso(elements.epoch),
            "age_s": rounded(self.age_s, 0),
            "source": None if elements is None else elements.source or None,
            "time_offset_s": self.time_offset_s if elements is not None else None,
            **({} if self.error is None else error_values(self.error)),
        }

    def lines(self) -> list[str]:
        """Return it for people; what is not known is a dash."""
        from birdcage.sky.sidereal import sidereal_words

        seen, place = self.seen, self.observer
        number = f" ({self.elements.norad_id})" if self.elements is not None and self.elements.norad_id else ""
        where = f"{abs(place.latitude_deg):.4f}°{'NS'[place.latitude_deg < 0]} "
        where += f"{abs(place.longitude_deg):.4f}°{'EW'[place.longitude_deg < 0]} {place.height_m:.0f} m"
        far = "-" if seen.range_km is None else f"{seen.range_km:11,.0f} km"
        away = "" if seen.range_rate_km_s is None else f"{seen.range_rate_km_s:+9.3f} km/s"
        lines = [
            f"{self.target.name}{number}",
            f"time       {self.when.astimezone(UTC):%Y-%m-%d %H:%M:%S} UTC, sidereal {sidereal_words(self.sidereal_h)}",
            f"place      {where} {place.name}".rstrip(),
            f"azimuth    {seen.az_deg:11.3f} °  {self.turning.az_deg_s:+9.4f} °/s",
            f"elevation  {seen.el_deg:11.3f} °  {self.turning.el_deg_s:+9.4f} °/s",
            f"refraction not in these angles{self._lift_words()}",
            f"range      {far}  {away}".rstrip(),
            f"this dish  {self._reach_words()}",
        ]
        if self.skew is not None:
            lines += [f"{name:10} {words}" for name, words in zip(("skew", "tilt"), self.skew.words(), strict=True)]
        if self.beam is not None and self.target.kind == "body":
            first, *more = self.beam.words.split("; ")
            lines += [f"beam       {first}", *(f"           {each}" for each in more)]
        lines.append(f"rise       {self._rise_words()}")
        if self.elements is not None:
            lines.append(f"elements   {self._age_words()}")
        if self.error is not None:
            lines.append(f"error      {self.error.glyph} {self.error.grade}: {self.error.words}")
        return lines

    def _lift_words(self) -> str:
        if not self.lift_deg:
            return ""
        return f": tracking points {self.lift_deg:.3f}° higher ({self.refraction})"

    def _rise_words(self) -> str:
        from birdcage.base.config import feed_label
        from birdcage.sky.rise import rise_words

        if self.rise_db is None:
            unknown = self.target.kind == "body" and self.beam is None
            return "- (name the dish with --firmware: its reflector makes the beam)" if unknown else "-"
        noise = f"{self.system_k:g} K of noise {'' if self.system_given else 'assumed'}".rstrip()
        faint = "; too little to see without averaging" if self.rise_db < FAINT_DB else ""
        return f"{rise_words(self.rise_db)} to expect with feed {feed_label(self.feed)}, {noise}{faint}"

    def _reach_words(self) -> str:
        if self.in_the_way is None:
            return "- (name it with --firmware, or set motion.min_elevation_deg)"
        return f"cannot point there: {self.in_the_way}" if self.in_the_way else "can point there"

    def _age_words(self) -> str:
        from birdcage.sky.catalogue.words import span

        assert self.elements is not None, "asked for satellites only"
        assert self.age_s is not None, "elements have an age"
        when = f"epoch {self.elements.epoch:%Y-%m-%d %H:%M} UTC"
        words = (
            f"{when}, {span(self.age_s)} old" if self.age_s >= 0.0 else f"{when}, {span(-self.age_s)} later than this"
        )
        if self.elements.source == "frozen":
            words += ", FROZEN"
        if self.time_offset_s:
            later = "later" if self.time_offset_s > 0.0 else "earlier"
            words += f", comes {abs(self.time_offset_s):g} s {later} than computed"
        return words


def rounded(value: float | None, digits: int) -> float | None:
    """Return a number with so many digits; None stays None."""
    return None if value is None else round(value, digits)
