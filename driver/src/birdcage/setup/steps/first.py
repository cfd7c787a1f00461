"""Step 11: the first satellite."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.setup.step import Choice, Mark
from birdcage.setup.steps.base import Plan, Step
from birdcage.sky.geostationary import slots_in_sight
from birdcage.sky.slots import Slot
from birdcage.station.requests import Goto


class FirstStep(Step):
    """Says where to look; finding out what is heard there comes with the Signal page."""

    name = "first"
    title = "First satellite"
    page = "control"

    _pointed = ""

    @property
    def mark(self) -> Mark:
        """There are no means yet to tell that a satellite was found."""
        mark = super().mark
        return mark if mark in (Mark.FAILED, Mark.SKIPPED) else Mark.LATER

    def _slot(self) -> tuple[Slot, float, float] | None:
        """Return the well-known slot that stands highest within the dish's limits, with azimuth and elevation."""
        place, state = self.bench.settings.place, self.bench.state
        if place.latitude_deg is None or place.longitude_deg is None:
            return None
        low = 0.0 if state.el_min_deg is None else max(0.0, state.el_min_deg)
        high = 90.0 if state.el_max_deg is None else state.el_max_deg
        seen = slots_in_sight(place.latitude_deg, place.longitude_deg, low, high)
        return max(seen, key=lambda each: each[2], default=None)

    def evidence(self) -> str:
        """Say where the likeliest one stands, and whether the dish was turned there."""
        return self._pointed or self._expected()

    def _expected(self) -> str:
        """Name the slot and where it stands; empty if none does."""
        found = self._slot()
        if found is None:
            return ""
        slot, az_deg, el_deg = found
        return f"{slot.name} ({slot.label}) expected at {az_deg:.1f} / {el_deg:.1f}"

    def words(self) -> tuple[str, ...]:
        """Say what is there, and what is not yet."""
        place = self.bench.settings.place
        if place.latitude_deg is None:
            where = "Set the location in step 9 first: directions need it."
        elif self._pointed:
            where = f"The dish {self._pointed}."
        elif self._slot() is None:
            where = "No well-known geostationary slot is within this dish's limits here."
        else:
            where = f"{self._expected()}: the highest of the well-known slots, so the easiest to hear."
        missing = () if self._aligned else ("To point there, home it (step 4) and set north (step 10).",)
        return (
            where,
            "Searching, peaking and identifying by signal come in a later version.",
            *missing,
            *self.trouble(),
        )

    @property
    def _aligned(self) -> bool:
        kept = self.bench.kept("north")
        return kept is not None and kept.done and self.bench.position is not None

    def choices(self) -> tuple[Choice, ...]:
        """Point there, when everything that this needs is known."""
        found = self._slot()
        if not self._aligned or found is None:
            return self.release_choice()
        return (*self.release_choice(), Choice("point", "enter", f"Point at {found[0].name}", moves=True))

    def take(self, choice: str, values: Mapping[str, str]) -> None:  # noqa: ARG002 - a step's signature
        """Point, or release."""
        if choice == "release":
            self.begin(self.release(), "releasing")
            return
        found = self._slot()
        assert found is not None, "the choice is only there with a slot"
        self.begin(self._point(*found), f"turning to {found[0].name}")

    def _point(self, slot: Slot, az_deg: float, el_deg: float) -> Plan:
        yield self.bench.ask(Goto(az_deg, el_deg, self.bench.holder))
        self._pointed = f"points at {az_deg:.2f} / {el_deg:.2f}, where {slot.name} ({slot.label}) stands"
        self.bench.completed.add(self.name)
