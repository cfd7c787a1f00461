"""Named directions, kept in `presets.toml`."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

from birdcage.base.geometry import wrap_360
from birdcage.base.named_tables import NamedTables, TablesRead, checked_name, number_of, same

LONGEST_NOTE = 200
HEADER = "# Directions with names. True degrees: azimuth clockwise from north, elevation above the horizon.\n\n"


@dataclass(frozen=True, slots=True)
class Preset:
    """A direction with a name. True degrees; azimuth in [0, 360), elevation from -90 to 180."""

    name: str
    az_deg: float
    el_deg: float
    note: str = ""


@dataclass(frozen=True, slots=True)
class Presets:
    """What a file holds, as far as it could be read."""

    path: Path
    entries: tuple[Preset, ...] = ()
    problems: tuple[str, ...] = field(default=())
    """Sentences with file and line; while there are any, the file is not written."""

    def named(self, name: str) -> Preset | None:
        """Return the preset of that name, whatever its capitals; None if there is none."""
        return next((preset for preset in self.entries if same(preset.name, name)), None)


def checked(name: str, az_deg: float, el_deg: float, note: str = "") -> Preset:
    """Return a preset that may be kept. ValueError says what is wrong with it, in words for a person."""
    name, note = checked_name(name), " ".join(note.split())
    if len(note) > LONGEST_NOTE or not note.isprintable():
        raise ValueError(f"a note has at most {LONGEST_NOTE} characters, all to be seen")
    if not (math.isfinite(az_deg) and -360.0 <= az_deg <= 360.0):
        raise ValueError("the azimuth lies from -360 to 360 degrees")
    if not (math.isfinite(el_deg) and -90.0 <= el_deg <= 180.0):
        raise ValueError("the elevation lies from -90 to 180 degrees")
    return Preset(name, wrap_360(az_deg), el_deg, note)


def load_presets(path: Path) -> Presets:
    """Read the file; one that is absent is empty. Nothing is raised: what is wrong stands in `problems`."""
    return _presets(path, _FILE.load(path))


def add_preset(path: Path, preset: Preset, at: int | None = None) -> Presets:
    """Keep another one, at the end or as the entry number `at`.

    This and the two below raise ConfigError, with nothing written: the file is damaged or can't be written, a name is
    there twice or no more.
    """
    return _presets(path, _FILE.add(path, preset, at))


def replace_preset(path: Path, name: str, preset: Preset) -> Presets:
    """Put `preset` in the place of the one called `name`."""
    return _presets(path, _FILE.replace(path, name, preset))


def delete_preset(path: Path, name: str) -> Presets:
    """Take out the one called `name`."""
    return _presets(path, _FILE.delete(path, name))


def _presets(path: Path, found: TablesRead[Preset]) -> Presets:
    return Presets(path, found.entries, found.problems)


def _read(row: dict[str, object]) -> Preset:
    name, note = row.get("name"), row.get("note", "")
    if not isinstance(name, str) or not isinstance(note, str):
        raise ValueError("a preset has a name, and its note is text")
    return checked(name, number_of(row, "az_deg"), number_of(row, "el_deg"), note)


def _cells(preset: Preset) -> dict[str, object]:
    return {"name": preset.name, "az_deg": preset.az_deg, "el_deg": preset.el_deg, "note": preset.note or None}


_FILE = NamedTables("preset", "presets", HEADER, read=_read, cells=_cells)
