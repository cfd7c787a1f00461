"""What stands in the sky now and can be gone to by its name: Sun, Moon, and the named slots that are in reach."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.sky.geostationary import slots_in_sight

from birdcage_tui.shown.view import View


@dataclass(frozen=True, slots=True)
class SkyDirection:
    """A direction that is worked out, and so cannot be edited."""

    name: str
    az_deg: float
    el_deg: float
    typed: str
    """What leads there in the go-to line."""


def sky_directions(view: View) -> list[SkyDirection]:
    """Return what is up and between the dish's limits of elevation; nothing without a place."""
    place, state = view.settings.place, view.state
    if place is None:
        return []
    low, high = state.el_min_deg or 0.0, state.el_max_deg or 90.0
    found = []
    if view.sky is not None:
        for name, where in (("Sun", view.sky.sun), ("Moon", view.sky.moon)):
            if where is not None and low <= where[1] <= high:
                found.append(SkyDirection(name, *where, name.lower()))
    for slot, az_deg, el_deg in slots_in_sight(place.latitude_deg, place.longitude_deg, low, high):
        found.append(SkyDirection(f"{slot.label} {slot.name}", az_deg, el_deg, slot.label.replace("°", "")))
    return found
