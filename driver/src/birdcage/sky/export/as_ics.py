"""Passes as a calendar (RFC 5545), one event a pass, from AOS to LOS."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime, timedelta

from birdcage.sky.observer import Observer
from birdcage.sky.pass_row import PassRow


def passes_ics(rows: Iterable[PassRow], observer: Observer, made: datetime, note: str = "") -> bytes:
    """Return a calendar file. `made` is the time of writing; `note` goes into every event: what is doubtful of it.

    An event that is written again for the same pass has the same identity, so that a calendar replaces it.
    """
    from icalendar import Calendar, Event

    calendar = Calendar()
    calendar.add("prodid", "-//birdcage//passes//EN")
    calendar.add("version", "2.0")
    for row in rows:
        passing = row.passing
        event = Event()
        # To ten minutes: newer elements move a pass by seconds.
        slot = round(passing.tca.timestamp() / 600.0)
        event.add("uid", f"{passing.norad_id or passing.name.replace(' ', '-')}-{slot}@birdcage")
        event.add("dtstamp", made)
        event.add("dtstart", _to_second(passing.aos))
        event.add("dtend", _to_second(passing.los))
        event.add("summary", f"{passing.name} {passing.max_elevation_deg:.0f}°")
        event.add("description", "\n".join(filter(None, [*_lines(row), note])))
        if observer.name:
            event.add("location", observer.name)
        event.add("geo", (observer.latitude_deg, observer.longitude_deg))
        event.add("transp", "TRANSPARENT")
        calendar.add_component(event)
    ics: bytes = calendar.to_ical()
    return ics


def _lines(row: PassRow) -> list[str]:
    passing, found = row.passing, row.reach
    lines = [
        f"AOS {passing.aos:%H:%M:%S} at {passing.aos_azimuth_deg:.0f}°",
        f"TCA {passing.tca:%H:%M:%S} at {passing.tca_azimuth_deg:.0f}°, {passing.max_elevation_deg:.1f}° high",
        f"LOS {passing.los:%H:%M:%S} at {passing.los_azimuth_deg:.0f}° (all UTC)",
    ]
    lines += [f"In reach {one.start:%H:%M:%S} to {one.end:%H:%M:%S}" for one in found.intervals] or ["Not in reach"]
    if found.lost:
        lines.append(f"Else: {', '.join(found.words())}")
    return lines


def _to_second(when: datetime) -> datetime:
    """Return the nearest whole second: the format has no fractions."""
    return (when + timedelta(milliseconds=500)).replace(microsecond=0)
