"""Many passes, as arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.elements import ElementSet
from birdcage.sky.frames import Floats, utc
from birdcage.sky.passes.model import Pass


@dataclass(frozen=True, slots=True)
class Failure:
    """SGP4 gave up on a satellite: its passes are known up to some time only, or not at all."""

    fleet_index: int
    name: str
    norad_id: int
    t_s: float
    """POSIX seconds: from here on there is no position."""
    why: str
    """In SGP4's words."""


@dataclass(frozen=True, slots=True)
class PassTable:
    """Passes in order of AOS: one entry of each array for each pass. `table[i]` and iteration make `Pass` of them."""

    fleet: Sequence[ElementSet]
    """The satellites that were searched."""
    fleet_index: NDArray[np.intp]
    """Whose pass it is."""
    aos_s: Floats
    """POSIX seconds, as all times here."""
    tca_s: Floats
    los_s: Floats
    aos_azimuth_deg: Floats
    tca_azimuth_deg: Floats
    los_azimuth_deg: Floats
    max_elevation_deg: Floats
    already_up: NDArray[np.bool_]
    still_up: NDArray[np.bool_]
    failed: tuple[Failure, ...] = ()
    """The satellites that SGP4 gave up on, in order of the fleet."""

    def __len__(self) -> int:
        return len(self.aos_s)

    def __getitem__(self, index: int) -> Pass:
        elements = self.fleet[int(self.fleet_index[index])]
        return Pass(
            name=elements.name,
            norad_id=elements.norad_id,
            aos=utc(self.aos_s[index]),
            tca=utc(self.tca_s[index]),
            los=utc(self.los_s[index]),
            aos_azimuth_deg=float(self.aos_azimuth_deg[index]),
            tca_azimuth_deg=float(self.tca_azimuth_deg[index]),
            los_azimuth_deg=float(self.los_azimuth_deg[index]),
            max_elevation_deg=float(self.max_elevation_deg[index]),
            already_up=bool(self.already_up[index]),
            still_up=bool(self.still_up[index]),
        )

    def __iter__(self) -> Iterator[Pass]:
        return (self[index] for index in range(len(self)))

    def chosen(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> PassTable:
        """Return the passes of a mask or of indices, in that order."""
        return replace(self, **{name: getattr(self, name)[which] for name in _COLUMNS})

    @classmethod
    def joined(cls, tables: Sequence[PassTable]) -> PassTable:
        """Return the passes of several searches of one fleet in one table. ValueError for none."""
        if not tables:
            raise ValueError("no table to join")
        columns: dict[str, Any] = {
            name: np.concatenate([getattr(table, name) for table in tables]) for name in _COLUMNS
        }
        failed = sorted((one for table in tables for one in table.failed), key=lambda one: one.fleet_index)
        whole = replace(replace(tables[0], failed=tuple(failed)), **columns)
        return whole.chosen(np.argsort(whole.aos_s, kind="stable"))


_COLUMNS = tuple(field.name for field in fields(PassTable) if field.name not in ("fleet", "failed"))
