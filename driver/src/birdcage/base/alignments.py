"""Sets of the alignment with names, kept in `alignments.toml`: one for each way in which a dish is put up.

The terms that count stand in `[alignment]` of `birdcage.toml`; `alignment_settings` is what is written there to use a
set, and `active` there remembers its name.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

from birdcage.base.config.edit import Value
from birdcage.base.config.sections import AlignmentSettings
from birdcage.base.errors import ConfigError
from birdcage.base.named_tables import NamedTables, TablesRead, checked_name, number_of, same

HEADER = (
    "# Alignments with names, in degrees: true = the dish's own + offset, then tilt and collimation.\n"
    "# `birdcage calibrate apply NAME` puts one into birdcage.toml.\n\n"
)
TERMS = ("az_offset_deg", "el_offset_deg", "ca_deg", "an_deg", "aw_deg")
MOST_DEG = {"az_offset_deg": 360.0, "el_offset_deg": 90.0, "ca_deg": 10.0, "an_deg": 20.0, "aw_deg": 20.0}
"""As [alignment] of birdcage.toml allows."""


@dataclass(frozen=True, slots=True)
class AlignmentSet:
    """A set with a name. Terms as in [alignment]: without what the feed adds."""

    name: str
    az_offset_deg: float
    el_offset_deg: float
    ca_deg: float = 0.0
    an_deg: float = 0.0
    aw_deg: float = 0.0
    rms_deg: float | None = None
    """How far the peaks lay from it that it was fitted to; None if it was fitted to none."""
    peaks: int | None = None
    """How many those were."""
    made: str = ""
    """When, as the file has it."""


@dataclass(frozen=True, slots=True)
class AlignmentSets:
    """What a file holds, as far as it could be read."""

    path: Path
    entries: tuple[AlignmentSet, ...] = ()
    problems: tuple[str, ...] = ()
    """Sentences with file and line; while there are any, the file is not written."""

    def named(self, name: str) -> AlignmentSet | None:
        """Return the set of that name, whatever its capitals; None if there is none."""
        return next((each for each in self.entries if same(each.name, name)), None)


def load_sets(path: Path) -> AlignmentSets:
    """Read the file; one that is absent is empty. Nothing is raised: what is wrong stands in `problems`."""
    return _sets(path, _FILE.load(path))


def keep_set(path: Path, entry: AlignmentSet) -> AlignmentSets:
    """Keep a set, in the place of the one of that name if there is one. ConfigError as for `named_tables`."""
    try:
        checked = _checked(entry)
    except ValueError as error:
        raise ConfigError(f"That alignment can't be kept: {error}. Nothing was written.") from None
    if load_sets(path).named(checked.name) is None:
        return _sets(path, _FILE.add(path, checked))
    return _sets(path, _FILE.replace(path, checked.name, checked))


def remove_set(path: Path, name: str) -> AlignmentSets:
    """Take out the one called `name`. ConfigError as for `named_tables`."""
    return _sets(path, _FILE.delete(path, name))


def north_settings(
    now: AlignmentSettings, az_offset_deg: float, el_offset_deg: float | None
) -> tuple[dict[str, Value], str]:  # fmt: skip
    """Return what to write to set north by one direction, and a remark on what goes by that; empty for none.

    `el_offset_deg` of None leaves that as it is. Tilt and collimation go: they were fitted together with the offsets,
    and to a base that stood otherwise.
    """
    changes: dict[str, Value] = {"alignment.az_offset_deg": az_offset_deg}
    if el_offset_deg is not None:
        changes["alignment.el_offset_deg"] = el_offset_deg
    if not (now.ca_deg or now.an_deg or now.aw_deg):
        return changes, ""
    changes |= dict.fromkeys(f"alignment.{name}" for name in ("active", "ca_deg", "an_deg", "aw_deg"))
    return changes, "; the tilt of the last calibration is dropped"


def alignment_settings(entry: AlignmentSet) -> dict[str, Value]:
    """Return what `base.config.edit` has to write so that this set counts."""
    return {"alignment.active": entry.name, **{f"alignment.{term}": getattr(entry, term) for term in TERMS}}


def is_in_force(entry: AlignmentSet, settings: AlignmentSettings) -> bool:
    """Return whether [alignment] holds the terms of this set, and its name."""
    return same(entry.name, settings.active or "") and all(
        getattr(entry, term) == getattr(settings, term) for term in TERMS
    )


def _sets(path: Path, found: TablesRead[AlignmentSet]) -> AlignmentSets:
    return AlignmentSets(path, found.entries, found.problems)


def _checked(entry: AlignmentSet) -> AlignmentSet:
    """Return a set that may be kept. ValueError says what is wrong with it, in words for a person."""
    for term, most in MOST_DEG.items():
        value = getattr(entry, term)
        if not (math.isfinite(value) and abs(value) <= most):
            raise ValueError(f"{term} lies from -{most:g} to {most:g} degrees, and is {value:.2f}")
    return replace(entry, name=checked_name(entry.name))


def _read(row: dict[str, object]) -> AlignmentSet:
    name, made, peaks = row.get("name"), row.get("made", ""), row.get("peaks")
    if not isinstance(name, str) or not isinstance(made, str):
        raise ValueError("an alignment has a name, and when it was made is text")
    if peaks is not None and (isinstance(peaks, bool) or not isinstance(peaks, int)):
        raise ValueError("peaks is a whole number")
    az, el, ca, an, aw = (number_of(row, term) if term in row else 0.0 for term in TERMS)
    rms_deg = number_of(row, "rms_deg") if "rms_deg" in row else None
    return _checked(AlignmentSet(name, az, el, ca, an, aw, rms_deg, peaks, made))


def _cells(entry: AlignmentSet) -> dict[str, object]:
    terms: dict[str, object] = {term: getattr(entry, term) for term in TERMS}
    return {"name": entry.name, **terms, "rms_deg": entry.rms_deg, "peaks": entry.peaks, "made": entry.made or None}


_FILE = NamedTables("alignment", "alignments", HEADER, read=_read, cells=_cells)
