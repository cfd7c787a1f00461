"""Serves what is read and set by name: the machine's own table of features, at what each costs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

from birdcage.base.errors import CommandRefused, ConfirmationNeeded, LeaseDenied, MotionRefused
from birdcage.base.reason import Reason
from birdcage.rotator.feature import END_TV_SEARCH, TV_SEARCH, Feature, FeatureKind, Reading, Value, speed_of
from birdcage.station.applying import refuse_while_moving
from birdcage.station.feature_report import only_held
from birdcage.station.menu_visit import MenuVisit
from birdcage.station.parts import Parts
from birdcage.station.raw import CONSOLE
from birdcage.station.requests import Set
from birdcage.station.search_control import SearchControl


class FeatureHandler:
    """Errors are raised, and become the future's."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._store, self._antenna, self._control = parts, parts.store, parts.antenna, parts.control
        self._reader, self._search, self._visit = parts.reader, SearchControl(parts), MenuVisit(parts)
        self._written_at = -math.inf
        """When a feature was written last: what was read before need not hold any more."""

    def read(self, ids: tuple[str, ...], *, agreed: bool = False) -> Mapping[str, Reading]:
        """Ask the machine for some features, and tell all; what it did not tell is left out.

        What was read less than its `min_interval_s` ago, and after anything was written, is not asked for again.
        BirdcageError (`moving`) while the machine moves, unless each may be read then; LeaseDenied while a person has
        its console; ConfirmationNeeded where a person has to agree first.
        """
        features = [self._feature(each, readable=True) for each in ids]
        hazard = next((each.read_hazard for each in features if each.read_hazard), "")
        if hazard and not agreed:
            raise ConfirmationNeeded(f"{hazard} Nothing was sent.")
        readings = {each.id: told for each in features if (told := self._fresh(each)) is not None}
        due = [each for each in features if each.id not in readings]
        if due:
            if self._store.state.holder == CONSOLE:
                raise LeaseDenied(
                    "A person has the console of the dish, so nothing else is asked. Wait until it is free."
                )
            if not all(each.cost.while_moving for each in due):
                refuse_while_moving(self._store, self._antenna, "Nothing is read")
            self._parts.free_wire()
            readings |= self._ask([each.id for each in due])
        return {each: readings[each] for each in ids if each in readings}

    def set(self, request: Set) -> Reading:
        """Write a feature, and return what was read back.

        CommandRefused (`unsupported`) for what can't be written, OutOfRange for a value that it can't have,
        ConfirmationNeeded where a person has to agree first.
        """
        feature, value = self._feature(request.feature, readable=False), request.value
        feature.check(value)
        if feature.kind is FeatureKind.HELD:
            raise CommandRefused(only_held(feature.id, feature.label), reason=Reason.UNSUPPORTED)
        if feature.hazard and not request.agreed:
            raise ConfirmationNeeded(f"{feature.hazard} Nothing was sent.")
        axes = {speed_of(axis.name): axis for axis in self._antenna.rotator.facts.axes}
        if feature.id in axes:
            self.set_speed(axes[feature.id].index, float(value), request.holder)
        elif feature.id in (TV_SEARCH, END_TV_SEARCH):
            disabled = feature.id == END_TV_SEARCH or not value
            self._search.refuse(disabled=disabled)
            if feature.id == TV_SEARCH:  # one that runs is ended just because it moves the dish
                refuse_while_moving(self._store, self._antenna, f"{feature.label} is not set")
            self._visit.make_free_for(request.holder)
            self._search.set(disabled=disabled)
        else:
            return self._write(feature, value, request.holder)
        return self._store.state.readings[feature.id]

    def note_written(self) -> None:
        """Something is about to be written: what was read before need not hold any more, even if no reply comes."""
        self._written_at = self._store.clock.monotonic()

    def set_speed(self, motor: int, speed_deg_s: float, holder: str) -> float:
        """Set the greatest speed of an axis until the dish restarts; return what it shows. Moves nothing."""
        rotator = self._antenna.rotator
        self._control.may_take(holder)
        if not rotator.facts.has_speeds:
            raise CommandRefused(f"The {rotator.facts.name} has no command for its speed.", reason=Reason.UNSUPPORTED)
        if motor not in (rotator.facts.azimuth.index, rotator.facts.elevation.index):
            raise MotionRefused(f"This dish has no motor {motor}. Nothing was sent.", reason=Reason.UNSUPPORTED)
        self._parts.free_wire()
        refuse_while_moving(self._store, self._antenna, "No speed is set")
        speed_deg_s = self._reader.set_speed(motor, speed_deg_s)
        rotator.make_ready()
        return speed_deg_s

    def set_search(self, holder: str, *, disabled: bool) -> Path | None:
        """Switch the firmware's own TV search as `SetSearch` asks, and take control; return the path of the backup."""
        self._search.refuse(disabled=disabled)
        self._control.admit(holder)
        self._parts.free_wire()
        return self._search.set(disabled=disabled)

    def _feature(self, name: str, *, readable: bool) -> Feature:
        feature = self._antenna.rotator.features.get(name)
        if feature is None or not (feature.is_readable if readable else feature.is_writable):
            dish, done = self._antenna.rotator.facts.name, "read" if readable else "set"
            raise CommandRefused(
                f"The {dish} has no feature {name} that can be {done}. Nothing was sent. `birdcage features` lists "
                "what it has.",
                reason=Reason.UNSUPPORTED,
            )
        return feature

    def _fresh(self, feature: Feature) -> Reading | None:
        """Return the last reading while it is too early for another."""
        last = self._store.state.readings.get(feature.id)
        if last is None or last.at < self._written_at:
            return None
        return last if self._store.clock.monotonic() - last.at < feature.cost.min_interval_s else None

    def _ask(self, ids: list[str]) -> Mapping[str, Reading]:
        readings: Mapping[str, Reading] = self._visit.talk(lambda: self._antenna.rotator.read(ids))
        self._reader.note(readings)
        return readings

    def _write(self, feature: Feature, value: Value, holder: str) -> Reading:
        if not feature.cost.while_moving:
            refuse_while_moving(self._store, self._antenna, f"{feature.label} is not set")
        self._visit.make_free_for(holder)
        self.note_written()
        reading: Reading = self._visit.talk(lambda: self._antenna.rotator.write(feature.id, value))
        if feature.is_readable:  # else it may have forgotten it since, and nothing would tell
            self._reader.note({feature.id: reading})
        return reading
