"""What a station's maps are made with: the source that is heard, the file that keeps them, what is known beside."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from statistics import fmean, stdev
from typing import TYPE_CHECKING, Any

from birdcage.rotator.feature import POSITION, RSSI, TRANSPONDER, speed_of
from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
from birdcage.signal.ear import TaskEar
from birdcage.signal.source import Scale, SignalFacts, SignalSource
from birdcage.skymap.battery import Battery, read_battery
from birdcage.skymap.drift import crosses_in
from birdcage.skymap.map_file import MapWriter, NewMap, heard_so_far
from birdcage.skymap.map_request import KIND, MapRequest
from birdcage.skymap.sky_map import MEASURED_SETTINGS, MapSample
from birdcage.station.requests import Unwatch, Watch

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.signal.source_set import SourceSet
    from birdcage.station.access import StationAccess
    from birdcage.station.state import StationState

LOW_PERCENT = 10.0
"""A map ends while the battery can still park the dish."""
SETTINGS = (TRANSPONDER, "frequency", "symbol_rate", "polarisation", "lnb_supply", *MEASURED_SETTINGS)
"""How the dish's own tuner is set: read at the beginning, and again with each reference cross."""


class KeptMap:
    """One map that is being made."""

    def __init__(
        self, new: NewMap, path: Path | None, ear: TaskEar, source: SignalSource, station: StationAccess
    ) -> None:  # fmt: skip
        self.ear, self.of_dish, self.decibels = ear, source.facts.of_dish, new.decibels
        self._source, self._station, self._awake = source, station, False
        self.heard, points = (frozenset[int](), ()) if path is None else heard_so_far(path, new.key)
        """The cells that the file has."""
        made = crosses_in(points, decibels=new.decibels)
        self.crosses = max((each.number for each in made), default=-1) + 1
        """The number of the next reference cross."""
        self.first_cross = next((each.fit for each in made if each.fit is not None), None)
        self._new, self._path = new, path
        self._writer: MapWriter | None = None

    @property
    def problem(self) -> str:
        """Why nothing is kept any more; empty while all is well."""
        return "" if self._writer is None else self._writer.problem

    @property
    def settings_ids(self) -> tuple[str, ...]:
        """What is read of the dish's own tuner to know how it is set."""
        return self.told_of(SETTINGS) if self.of_dish else ()

    def told_of(self, ids: tuple[str, ...]) -> tuple[str, ...]:
        """Return those features that this machine has."""
        dish = self._station.state.dish
        return () if dish is None else tuple(each for each in ids if each in dish.features)

    def sample(self, values: Sequence[float], **more: Any) -> MapSample:  # noqa: ANN401 - the fields of a sample
        """Return what was heard in a direction, with what the station knows beside it.

        Each of `values` may be the mean of several of the tuner's own: the scatter is that of one of those.
        """
        state = self._station.state
        feature = None if state.dish is None else state.dish.features.get(RSSI)
        each = feature.samples or 1 if self.of_dish and feature is not None else 1
        polarisation = state.readings.get("polarisation")
        return MapSample(
            value=fmean(values), scatter=stdev(values) * math.sqrt(each) if len(values) > 1 else None,
            n=len(values) * each, settings=0, target=state.signal_owners.get(self._source.facts.id, ""),
            polarisation=None if polarisation is None or not self.of_dish else str(polarisation.value),
            state=state.activity.value, **more,
        )  # fmt: skip

    def keep_awake(self, *, on: bool) -> None:
        """Have the dish asked where it points now and then, while nothing else is said to it.

        A G2 has a sleep timer of 420 s (setting 38), and what sleep does to its console is open
        (`docs/reference/g2.md`).
        """
        if on is not self._awake:
            self._awake = on
            self._station.submit(Watch(KIND, frozenset({POSITION}), 1.0) if on else Unwatch(KIND))

    def add(self, sample: MapSample) -> None:
        """Keep it, if there is a file to keep it in."""
        if writer := self._writing():
            writer.add(sample, self._settings())

    def end(self, utc: datetime) -> None:
        """Every direction that can be heard was heard: wait until that is on the disk."""
        if writer := self._writing():
            writer.end(utc)
            writer.flush()

    def _writing(self) -> MapWriter | None:
        """Return the writer, made when something is to be written: a task may be refused before."""
        if self._writer is None and self._path is not None:
            self._writer = MapWriter(self._path, self._new)
        return self._writer

    def close(self) -> None:
        """Write what is waiting; nothing is added any more."""
        if self._writer is not None:
            self._writer.close()

    def _settings(self) -> Mapping[str, str]:
        if not self.of_dish:
            return dict(self._source.facts.set_to)
        told = self._station.state.readings
        return {name: _told(name, told[name].value) for name in SETTINGS if name in told}


def _told(name: str, value: object) -> str:
    # A supply of 18.1 V is one of 18 V: its readings scatter.
    return f"{float(value):.0f} V" if name == "lnb_supply" and isinstance(value, int | float) else str(value)


class MapKeeper:
    """Of one station. It makes the tasks that the station is given, so `attach` comes once that is there."""

    def __init__(
        self, sources: SourceSet | None = None, path: Path | None = None, settings: Settings | None = None,
        battery: Callable[[], Battery | None] = read_battery,
    ) -> None:  # fmt: skip
        """`path` is the file of recordings; None keeps nothing."""
        self._sources, self._path, self._settings, self.battery = sources, path, settings, battery
        self._station: StationAccess | None = None

    def attach(self, station: StationAccess) -> None:
        """Serve this station."""
        self._station = station

    @property
    def _state(self) -> StationState:
        assert self._station is not None, "it was attached"
        return self._station.state

    @property
    def beam_deg(self) -> float:
        """The mean width of the beam, or what it is assumed to be."""
        beam = self._state.beam
        return ASSUMED_WIDTH_DEG if beam is None else beam.mean_deg

    @property
    def park(self) -> tuple[float, float] | None:
        """Where the dish is parked, true azimuth and elevation; None where that is not set."""
        tracking = None if self._settings is None else self._settings.tracking
        if tracking is None or tracking.park_az_deg is None or tracking.park_el_deg is None:
            return None
        return tracking.park_az_deg, tracking.park_el_deg

    def speeds_deg_s(self, part: float) -> Mapping[int, float]:
        """Return a part of the speed of each axis whose speed can be set, by motor number."""
        dish = self._state.dish
        axes = () if dish is None else (dish.azimuth, dish.elevation)
        return {axis.index: axis.speed_deg_s * part for axis in axes if dish and speed_of(axis.name) in dish.features}

    def open(self, request: MapRequest) -> KeptMap:
        """Return the map as the file has it. TypeError, which refuses the task: its source is unknown."""
        assert self._sources is not None, "a station that makes maps has sources"
        assert self._station is not None, "it was attached"
        if request.quiet and not self.speeds_deg_s(1.0):
            raise TypeError("this dish has no speed setting. Leave quiet out")
        ear = self._sources.ear(request.source)
        source = self._sources.get(request.source or self._sources.chosen)
        facts = source.facts
        new = NewMap(
            request.key, request.plan, facts.id, facts.unit, facts.scale is Scale.LOG, self._state.demo or facts.demo,
            self._about(request, facts),
        )  # fmt: skip
        return KeptMap(new, self._path, ear, source, self._station)

    def _about(self, request: MapRequest, facts: SignalFacts) -> Mapping[str, object]:
        state, settings = self._state, self._settings
        dish, beam, alignment = state.dish, state.beam, state.alignment
        told: dict[str, object] = {
            "dish": "" if dish is None else dish.name, "firmware": self._firmware, "feed": state.feed_name,
            "source_label": facts.label, "target": request.target, "az_offset_deg": alignment.az_offset_deg,
            "el_offset_deg": alignment.el_offset_deg, "ca_deg": alignment.ca_deg, "an_deg": alignment.an_deg,
            "aw_deg": alignment.aw_deg,
        }  # fmt: skip
        if beam is not None:
            told |= {"beam_az_deg": beam.az_deg, "beam_el_deg": beam.el_deg}
        if settings is not None:
            place, freq_hz = settings.place, settings.active_feed.middle_hz
            if place.latitude_deg is not None and place.longitude_deg is not None:
                told |= {
                    "latitude_deg": place.latitude_deg, "longitude_deg": place.longitude_deg,
                    "height_m": place.height_m,
                }  # fmt: skip
            if freq_hz is not None:
                told["freq_hz"] = freq_hz
        wanted = request.values()
        for name in ("reads", "details", "quiet", "reference_az_deg", "reference_el_deg", "reference_every_s"):
            told[name] = wanted[name]
        return told

    @property
    def _firmware(self) -> str:
        state = self._state
        names = ("" if state.dish is None else state.dish.firmware, state.firmware_version or "")
        return " ".join(name for name in names if name)
