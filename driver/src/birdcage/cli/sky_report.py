"""What `birdcage sky` lists: everything that is up at one time, and how it stands to this dish."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.cli.say import iso
from birdcage.cli.table import cut
from birdcage.cli.where_report import rounded

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.sky.catalogue import CatalogueEntry
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.look import LookAngle
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Target

NAME_WIDTH = 26


@dataclass(frozen=True, slots=True)
class SkyRow:
    """One thing that is up."""

    target: Target
    seen: LookAngle
    in_the_way: str | None
    """As `birdcage.cli.standing` has it."""
    rise_db: float | None
    elements: ElementSet | None

    def values(self, when: datetime) -> dict[str, object]:
        """Return it for JSON."""
        elements = self.elements
        return {
            "name": self.target.name,
            "kind": self.target.kind,
            "norad_id": None if elements is None else elements.norad_id or None,
            "azimuth_deg": round(self.seen.az_deg, 4) % 360.0,
            "elevation_deg": round(self.seen.el_deg, 4),
            "refraction": "none",
            "range_km": rounded(self.seen.range_km, 3),
            "range_rate_km_s": rounded(self.seen.range_rate_km_s, 6),
            "in_reach": None if self.in_the_way is None else not self.in_the_way,
            "in_the_way": self.in_the_way or None,
            "rise_db": rounded(self.rise_db, 4),
            "epoch": None if elements is None else iso(elements.epoch),
            "age_s": None if elements is None else round((when - elements.epoch).total_seconds()),
            "source": None if elements is None else elements.source or None,
        }


@dataclass(frozen=True, slots=True)
class SkyReport:
    """Everything that is up, the highest first, and what could not be told."""

    rows: tuple[SkyRow, ...]
    notes: tuple[str, ...]


def look_round(
    entries: Sequence[CatalogueEntry], observer: Observer, when: datetime, dish: Wanted, min_elevation_deg: float
) -> SkyReport:
    """Return what stands at `min_elevation_deg` or higher at a time."""
    from birdcage.cli.standing import what_stands_in_the_way
    from birdcage.sky.ephemeris.worker import NotCovered
    from birdcage.sky.rise import Ear, expected_rise_db
    from birdcage.sky.targets.model import Satellite

    ear, notes, in_the_way = Ear.of(dish.settings.active_feed, dish.beam), [], what_stands_in_the_way(dish)
    seen = [*_satellites(entries, observer, when), *_slots(observer, when)]
    try:
        seen += _bodies(observer, when)
    except NotCovered as error:
        notes.append(str(error))
    rows = [
        SkyRow(
            target,
            look,
            in_the_way(look),
            expected_rise_db(target, look, ear),
            target.elements if isinstance(target, Satellite) else None,
        )
        for target, look in seen
        if look.el_deg >= min_elevation_deg
    ]
    return SkyReport(tuple(sorted(rows, key=lambda row: -row.seen.el_deg)), tuple(notes))


def _satellites(
    entries: Sequence[CatalogueEntry], observer: Observer, when: datetime
) -> Iterator[tuple[Target, LookAngle]]:
    """Yield the satellites that have a position."""
    import math

    from birdcage.sky.look import LookAngle
    from birdcage.sky.propagate import Fleet
    from birdcage.sky.targets.model import Satellite

    fleet = Fleet(entry.elements for entry in entries)
    offsets = {index: entry.time_offset_s for index, entry in enumerate(entries) if entry.time_offset_s}
    looks = fleet.look(observer, when, offsets)
    for entry, az, el, far, away in zip(
        entries,
        looks.az_deg.tolist(),
        looks.el_deg.tolist(),
        looks.range_km.tolist(),
        looks.range_rate_km_s.tolist(),
        strict=True,
    ):
        if not math.isnan(el):
            yield Satellite(entry.elements, entry.time_offset_s or 0.0), LookAngle(az, el, far, away)


def _slots(observer: Observer, when: datetime) -> Iterator[tuple[Target, LookAngle]]:
    from birdcage.sky.slots import slots
    from birdcage.sky.targets.model import SlotTarget

    for slot in slots():
        target = SlotTarget(slot)
        yield target, target.look(observer, when)


def _bodies(observer: Observer, when: datetime) -> Iterator[tuple[Target, LookAngle]]:
    from birdcage.sky.ephemeris.bodies import BODIES
    from birdcage.sky.targets.model import BodyTarget

    for body in BODIES.values():
        target = BodyTarget(body)
        yield target, target.look(observer, when)


def table(rows: Sequence[SkyRow], when: datetime) -> Iterator[str]:
    """Yield the lines for people: elevation, azimuth, name, range, and what is to be said."""
    if rows:
        yield f"{'EL':>6}  {'AZ':>6}  {'NAME':{NAME_WIDTH}}  {'RANGE KM':>13}  NOTES"
    for row in rows:
        name = cut(row.target.name, NAME_WIDTH)
        far = "-" if row.seen.range_km is None else f"{row.seen.range_km:,.0f}"
        az_deg = round(row.seen.az_deg, 2) % 360.0
        yield f"{row.seen.el_deg:6.2f}  {az_deg:6.2f}  {name:{NAME_WIDTH}}  {far:>13}  {_notes(row, when)}".rstrip()


def _notes(row: SkyRow, when: datetime) -> str:
    from birdcage.sky.catalogue.words import age
    from birdcage.sky.rise import rise_words

    notes = [row.in_the_way] if row.in_the_way else []
    if row.rise_db is not None:
        notes.append(f"rise {rise_words(row.rise_db)}")
    if row.elements is not None:
        frozen = row.elements.source == "frozen"
        notes.append(f"FROZEN, of {row.elements.epoch:%Y-%m-%d}" if frozen else age(row.elements.epoch, when))
    return ", ".join(notes)
