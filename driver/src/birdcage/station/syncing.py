"""Serves `Sync`: a person says where a machine points whose zero is where it was switched on."""

from __future__ import annotations

import math
from collections.abc import Mapping

from birdcage.base.errors import BirdcageError, CommandRefused, ConfirmationNeeded, LeaseDenied, OutOfRange
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator.readings import settled
from birdcage.station.applying import refuse_while_moving
from birdcage.station.parts import Parts
from birdcage.station.requests import Sync
from birdcage.station.silent_zero import SAME_DEG
from birdcage.station.state import Pointing

APART_S = 0.5
"""A dish at rest says the same again after so long."""
TELLING_DEG = 0.05
"""Less than this is no difference to ask about."""
MEASURED_DEG = 2.0
"""How far a machine that measures its elevation may be off what a person says before that is asked about."""


class Syncing:
    """Nothing turns by it, so neither HELD nor a fault keeps it back. Errors are raised, and become the future's."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._store, self._antenna, self._reader = parts, parts.store, parts.antenna, parts.reader

    def sync(self, request: Sync) -> Pointing:
        """Take in where it points, and return what is read then. See `Sync` for what is raised."""
        antenna, facts = self._antenna, self._antenna.rotator.facts
        if facts.no_sync:
            raise CommandRefused(f"{facts.no_sync} Nothing was changed.", reason=Reason.UNSUPPORTED)
        _check(request)
        holder = self._store.state.holder
        if holder not in (None, request.holder):
            raise LeaseDenied(f"{holder} has control. Take control, or wait until it is free.")
        self._parts.free_wire()
        refuse_while_moving(self._store, antenna, "The dish can't be synced")
        counted = self._counted_at_rest()
        az, el = facts.azimuth, facts.elevation
        own_el_deg = counted[el.name] + facts.zero_deg.get(el.name, 0.0)
        if request.el_deg is None or el.name not in facts.zero_at_power_up:
            self._ask_about_elevation(request, own_el_deg)
            el_deg = antenna.alignment.to_true(request.az_deg, own_el_deg)[1]
        else:
            el_deg = request.el_deg
        there = dict(zip((az.name, el.name), antenna.alignment.to_dish(request.az_deg, el_deg), strict=True))
        zero_deg = {az.name: shortest_turn(counted[az.name], there[az.name])}
        if el.name in facts.zero_at_power_up:
            zero_deg[el.name] = there[el.name] - counted[el.name]
        self._ask_about_change(request, el_deg)
        self._reader.tell_zero({name: deg for name, deg in zero_deg.items() if name in facts.zero_at_power_up})
        antenna.moving.forget()
        for axis in (az, el):
            antenna.gate.found_reference(axis.index)
        self._parts.mover.forget_target()
        found = self._reader.position()
        if found is None:
            raise BirdcageError("Synced, but the position can't be read yet.", reason=Reason.UNREAD)
        return found

    def _counted_at_rest(self) -> Mapping[str, float]:
        """Return where it counts its axes to stand. BirdcageError (`moving`) where it says otherwise 0.5 s later."""
        rotator, clock = self._antenna.rotator, self._store.clock
        before = settled(rotator.counted)
        until = clock.monotonic() + APART_S
        while clock.monotonic() < until:
            rotator.listen(until)
        counted = settled(rotator.counted)
        if any(abs(deg - counted.get(name, math.inf)) > SAME_DEG for name, deg in before.items()):
            raise BirdcageError("The dish is moving. Wait until it stops, then sync it.", reason=Reason.MOVING)
        return counted

    def _ask_about_elevation(self, request: Sync, own_el_deg: float) -> None:
        """ConfirmationNeeded where a person's elevation is far from what the machine measures."""
        if request.el_deg is None or request.agreed:
            return
        measured_deg = self._antenna.alignment.to_true(request.az_deg, own_el_deg)[1]
        if abs(measured_deg - request.el_deg) > MEASURED_DEG:
            raise ConfirmationNeeded(
                f"It measures its elevation itself: {measured_deg:.2f}°, and you say {request.el_deg:.2f}°. "
                "It keeps its own. Sync the azimuth all the same?"
            )

    def _ask_about_change(self, request: Sync, el_deg: float) -> None:
        """ConfirmationNeeded where it knows a direction already, and that is another one."""
        here = self._store.state.position
        if here is None or self._store.state.position_lost is not None or request.agreed:
            return
        turn, lift = shortest_turn(here.az_deg, request.az_deg), el_deg - here.el_deg
        if max(abs(turn), abs(lift)) > TELLING_DEG:
            raise ConfirmationNeeded(
                f"It is already synced: azimuth {here.az_deg:.2f}°, elevation {here.el_deg:.2f}°. "
                f"That would change by {turn:+.2f}° and {lift:+.2f}°. Change it?"
            )


def _check(request: Sync) -> None:
    """OutOfRange for what is no direction."""
    for name, deg, low, high in (("Azimuth", request.az_deg, 0.0, 360.0), ("Elevation", request.el_deg, -90.0, 90.0)):
        if deg is not None and not low <= deg <= high:
            raise OutOfRange(f"{name} {deg:g}° is out of range. Type {low:g} to {high:g}. Nothing was changed.")
