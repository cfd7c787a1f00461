"""Step 9: where the dish stands, and what time it is."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import timedelta

from birdcage.setup.bench import Value
from birdcage.setup.step import Choice, Field, NoSuchChoice
from birdcage.setup.steps.base import Step
from birdcage.setup.typed import number, optional_number, time_of_day
from birdcage.sky.locator import decode, encode

WRONG_CLOCK_S = 10.0
"""A clock this far off moves the Sun by 0.04 degrees: it must be set."""
COARSE_DEG = 0.2
"""Half the height of a locator square from which its middle is no place to point from."""


class PlaceStep(Step):
    """Done when both are known."""

    name = "place"
    title = "Place and clock"

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
            return "place unknown"
        halves = f"{abs(lat):.4f} {'N' if lat >= 0 else 'S'} {abs(lon):.4f} {'E' if lon >= 0 else 'W'}"
        return f"{encode(lat, lon)}, {halves}, {place.height_m:.0f} m"

    def _clock(self) -> str:
        setup = self.bench.settings.setup
        offset_s = setup.clock_offset_s
        if offset_s is None:
            return "clock not compared"
        return f"clock {offset_s:+g} s by your watch" if "compared" in (setup.clock or "") else "clock trusted"

    def words(self) -> tuple[str, ...]:
        """Ask for both; say that there is no GPS."""
        return (
            "Type where the dish stands: from a map, or a Maidenhead locator. 0.1° is plenty for pointing.",
            "By GPS: later. This version has no GPS yet.",
            f"Clock: {self.bench.utc:%H:%M:%S} UTC. Compare it with a watch set by radio or network, or trust it.",
        )

    def choices(self) -> tuple[Choice, ...]:
        """Type a place, compare the clock."""
        place = self.bench.settings.place
        place_fields = (
            Field("latitude_deg", "latitude", "deg", "north is +", _text(place.latitude_deg)),
            Field("longitude_deg", "longitude", "deg", "east is +", _text(place.longitude_deg)),
            Field("height_m", "height", "m", "above the sea", f"{place.height_m:g}"),
        )
        locator = (Field("locator", "locator", hint="JO21jv"), Field("height_m", "height", "m", "", "0"))
        here, clock = ("p", "enter") if self._has_place else ("enter", "c")
        return (
            Choice("typed", here, "Type latitude and longitude", fields=place_fields),
            Choice("locator", "m", "Type a Maidenhead locator", fields=locator),
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
        else:
            lat, lon = self._located(values) if choice == "locator" else (
                number(values, "latitude_deg", "latitude", -90.0, 90.0),
                number(values, "longitude_deg", "longitude", -180.0, 180.0),
            )  # fmt: skip
            height_m = optional_number(values, "height_m", "height", -500.0, 9000.0) or 0.0
            keys = {"place.latitude_deg": lat, "place.longitude_deg": lon, "place.height_m": height_m}
            self._keep({**keys, "place.declination_deg": None})  # what was typed for another place

    @staticmethod
    def _located(values: Mapping[str, str]) -> tuple[float, float]:
        try:
            lat, lon, half_deg = decode(values.get("locator", ""))
        except ValueError as error:
            raise NoSuchChoice(str(error)) from None
        if half_deg > COARSE_DEG:
            raise NoSuchChoice(f"That square is {4 * half_deg:g}° wide: give six characters, such as JO21jv.")
        return round(lat, 6), round(lon, 6)

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
