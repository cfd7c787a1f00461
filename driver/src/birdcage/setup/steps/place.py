"""Step 9: where the dish stands, and what time it is."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import timedelta

from birdcage.base.config.edit import Value
from birdcage.base.errors import BirdcageError
from birdcage.base.places import moved_settings
from birdcage.setup.step import Choice, Field, NoSuchChoice
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.typed import number, optional_number, time_of_day
from birdcage.sky.locator import encode

WRONG_CLOCK_S = 10.0
"""A clock this far off moves the Sun by 0.04 degrees: it must be set."""


class PlaceStep(Step):
    """Done when both are known."""

    name = "place"
    title = "Location, clock"

    @property
    def proven(self) -> bool | None:
        """What the file holds of the place must still be there."""
        return None if self._has_place and self.bench.settings.setup.clock is not None else False

    @property
    def _has_place(self) -> bool:
        place = self.bench.settings.place
        return place.latitude_deg is not None and place.longitude_deg is not None

    def evidence(self) -> str:
        """Show place and clock."""
        return f"{self._place()}; {self._clock()}"

    def _place(self) -> str:
        place = self.bench.settings.place
        lat, lon = place.latitude_deg, place.longitude_deg
        if lat is None or lon is None:
            return "location unknown"
        halves = f"{abs(lat):.4f} {'N' if lat >= 0 else 'S'} {abs(lon):.4f} {'E' if lon >= 0 else 'W'}"
        return f"{encode(lat, lon)}, {halves}, {place.height_m:.0f} m"

    def _clock(self) -> str:
        setup = self.bench.settings.setup
        offset_s = setup.clock_offset_s
        if offset_s is None:
            return "clock not compared"
        how = (setup.clock or "").partition(" ")[0]
        by = {"compared": "your watch", "gps": "GPS"}.get(how)
        return "clock trusted" if by is None else f"clock {offset_s:+g} s by {by}"

    def words(self) -> tuple[str, ...]:
        """Ask for both."""
        return (
            "Where does the dish stand? 0.1° is plenty for pointing.",
            "GPS tells location and clock: type gpsd, or the port of the receiver.",
            f"Clock: {self.bench.utc:%H:%M:%S} UTC. Compare it with an exact watch, or trust it.",
        )

    def choices(self) -> tuple[Choice, ...]:
        """Give a place, compare the clock."""
        place = self.bench.settings.place
        place_fields = (
            Field("latitude_deg", "latitude", "deg", "north is +", _text(place.latitude_deg)),
            Field("longitude_deg", "longitude", "deg", "east is +", _text(place.longitude_deg)),
            Field("height_m", "height", "m", "above the sea", f"{place.height_m:g}"),
        )
        locator = (
            Field("locator", "locator or city", hint="JO21jv, Rotterdam"), Field("height_m", "height", "m", "", "0"),
        )  # fmt: skip
        receiver = (Field("receiver", "receiver", "", "gpsd, /dev/ttyACM0", place.gps or "gpsd"),)
        here, clock = ("p", "enter") if self._has_place else ("enter", "c")
        return (
            Choice("typed", here, "Type latitude and longitude", fields=place_fields),
            Choice("locator", "m", "Look it up", fields=locator),
            Choice("gps", "g", "Ask GPS", fields=receiver),
            Choice(
                "clock", clock, "Compare the clock", fields=(Field("utc", "UTC on your watch now", "", "12:03:20"),)
            ),
            Choice("trust", "t", "Trust the clock: it is set by network or GPS"),
        )

    def take(self, choice: str, values: Mapping[str, str]) -> None:
        """Keep what was told."""
        if choice == "clock":
            self._compare(values.get("utc", ""))
        elif choice == "trust":
            self._keep({"setup.clock": f"trusted {self.bench.stamp}"})
        elif choice == "gps":
            receiver = values.get("receiver", "").strip() or "gpsd"
            self.begin(self._by_gps(receiver), f"asking {receiver} for a fix")
        else:
            lat, lon = self._located(values) if choice == "locator" else (
                number(values, "latitude_deg", "latitude", -90.0, 90.0),
                number(values, "longitude_deg", "longitude", -180.0, 180.0),
            )  # fmt: skip
            height_m = optional_number(values, "height_m", "height", -500.0, 9000.0) or 0.0
            changes = moved_settings(self.bench.settings.place, lat, lon, height_m)
            self._keep({**changes, "place.declination_deg": None})  # the model knows it; typed anew in step 10

    @staticmethod
    def _located(values: Mapping[str, str]) -> tuple[float, float]:
        from birdcage.sky.whereabouts import parse_place

        try:
            found = parse_place(values.get("locator", ""))
        except ValueError as error:
            raise NoSuchChoice(str(error)) from None
        return found.latitude_deg, found.longitude_deg

    def _by_gps(self, receiver: str) -> Plan:
        """Take place and clock from a receiver, as far as it tells them."""
        from birdcage.gps.fix import GpsFix
        from birdcage.gps.verdict import by_gps

        fix = yield self.bench.receiver(receiver, self.bench.settings.dish.port)
        assert isinstance(fix, GpsFix), "that is what a receiver gives"
        height_m = None if fix.height_m is None else round(fix.height_m, 1)
        here = self.bench.settings.place
        changes = moved_settings(here, round(fix.latitude_deg, 6), round(fix.longitude_deg, 6), height_m)
        changes["place.gps"] = receiver
        verdict = by_gps(fix)
        if verdict is not None and verdict.offset_s is not None:
            changes["setup.clock"] = f"gps {self.bench.stamp}: {verdict.offset_s:+.1f} s"
        self._keep(changes)
        if verdict is not None and (verdict.offset_s is None or abs(verdict.offset_s) > WRONG_CLOCK_S):
            self.bench.completed.discard(self.name)
            raise BirdcageError(f"Location saved. {verdict.doubt}")

    def _compare(self, text: str) -> None:
        """Compare now: what was typed is taken for this moment."""
        now = self.bench.utc
        offset: timedelta = now - time_of_day(text, now)
        offset_s = round(offset.total_seconds())
        self._keep({"setup.clock": f"compared {self.bench.stamp}: {offset_s:+d} s"})
        if abs(offset_s) > WRONG_CLOCK_S:
            self.bench.completed.discard(self.name)
            way = "fast" if offset_s > 0 else "slow"
            self.failure = f"This machine's clock is {abs(offset_s)} s {way}: set it, then compare again."

    def _keep(self, changes: dict[str, Value]) -> None:
        """Write it; the step is done when place and clock are both there."""
        self.bench.write(changes)
        if self._has_place and self.bench.settings.setup.clock is not None:
            evidence = self.evidence() + self.bench.overridden("place.latitude_deg", "place.longitude_deg")
            self.bench.done(self.name, evidence)
        else:
            self.bench.forget(self.name)


def _text(value: float | None) -> str:
    return "" if value is None else f"{value:g}"
