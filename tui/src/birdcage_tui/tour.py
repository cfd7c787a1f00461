"""The demo's guided tour: along the geostationary arc, slot by slot, until the first key."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future

from birdcage.base.geometry import separation
from birdcage.sky.geostationary import arc, slots_in_sight
from birdcage.station.requests import Goto, ReleaseLease, Request
from birdcage.station.state import Activity

from birdcage_tui.view import View

HOLDER = "demo tour"
FIRST_S = 3.0
DWELL_S = 3.0
HOP_DEG = 1.5
MARGIN_DEG = 1.0

Submit = Callable[[Request], "Future[object]"]


class Tour:
    """Moves the simulated dish a little every few seconds. Ends for ever at the first key, and never begins held."""

    def __init__(self, submit: Submit) -> None:
        self._submit = submit
        self._ended = False
        self._due: float | None = None
        self._stops: list[tuple[str, float, float]] = []
        self._next = 0

    @property
    def running(self) -> bool:
        """Whether it has not ended."""
        return not self._ended

    def end(self) -> None:
        """End it for ever, and give control back."""
        if not self._ended:
            self._ended = True
            if self._next:
                self._submit(ReleaseLease(HOLDER))

    def step(self, view: View) -> str:
        """Move on if it is time. Return what the tour says, empty when there is none."""
        state = view.state
        if self._ended or not state.demo or view.settings.place is None:
            return ""
        if state.held is not None or state.fault is not None or (state.holder or HOLDER) != HOLDER:
            self.end()
            return ""
        ready = view.link_up and state.homed and state.position is not None and state.motion_refused_because is None
        if not ready or state.position is None:
            self._due = None
            return ""
        if view.moving or state.activity is not Activity.IDLE:
            self._due = view.now + DWELL_S
            name = self._stops[self._next % len(self._stops) - 1][0] if self._next else ""
            return f"Demo tour: on the way to {name}. Any key ends it." if name else ""
        if not self._stops:
            self._stops = self._route(view)
            if not self._stops:
                self._ended = True
                return ""
        if self._due is None:
            self._due = view.now + FIRST_S
        name, az_deg, el_deg = self._stops[self._next % len(self._stops)]
        if view.now >= self._due:
            self._next += 1
            self._due = view.now + DWELL_S
            self._submit(Goto(az_deg, el_deg, HOLDER))
            return f"Demo tour: on the way to {name}. Any key ends it."
        return f"Demo tour: {name} in {max(1.0, self._due - view.now):.0f} s. Any key ends it."

    @staticmethod
    def _route(view: View) -> list[tuple[str, float, float]]:
        """Return the stops, there and back, beginning at the slot farthest from where the dish points."""
        place, position = view.settings.place, view.state.position
        assert place is not None, "checked by step"
        assert position is not None, "checked by step"
        low = (view.state.el_min_deg if view.state.el_min_deg is not None else 0.0) + MARGIN_DEG
        high = (view.state.el_max_deg if view.state.el_max_deg is not None else 90.0) - MARGIN_DEG
        slots = slots_in_sight(place.latitude_deg, place.longitude_deg, low, high)
        named = {round(slot.longitude_deg, 1): slot for slot, _, _ in slots}
        names = {f"{slot.label} {slot.name}" for slot, _, _ in slots}
        stops = []
        for longitude_deg, az_deg, el_deg in arc(place.latitude_deg, place.longitude_deg, HOP_DEG, low):
            if el_deg > high:
                continue
            close = min(named, key=lambda slot_deg: abs(slot_deg - longitude_deg), default=None)
            if close is not None and abs(close - longitude_deg) <= HOP_DEG / 2:
                continue  # the slot itself is a stop
            half = "E" if longitude_deg >= 0 else "W"
            stops.append((f"{abs(longitude_deg):.1f}°{half}", az_deg, el_deg))
        stops += [(f"{slot.label} {slot.name}", az_deg, el_deg) for slot, az_deg, el_deg in slots]
        # In order along the arc: from the eastern end to the western one as seen over the meridian that it crosses.
        middle = 180.0 if place.latitude_deg >= 0 else 0.0
        stops.sort(key=lambda stop: (stop[1] - middle + 180) % 360)
        heard = [index for index, stop in enumerate(stops) if stop[0] in names]
        if heard:  # beyond the outermost satellites there is nothing to hear
            stops = stops[heard[0] : heard[-1] + 1]
        if stops:
            first, last = stops[0], stops[-1]
            here = (position.az_deg, position.el_deg)
            if separation(*here, last[1], last[2]) > separation(*here, first[1], first[2]):
                stops.reverse()
        return stops + stops[-2:0:-1]
