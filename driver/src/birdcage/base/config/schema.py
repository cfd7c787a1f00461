"""The schema as data: one row a key, derived from the sections, for checking, help and `birdcage config`."""

from __future__ import annotations

import dataclasses
import types
import typing
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from birdcage.base.config.fact_sections import FACT_SECTIONS
from birdcage.base.config.feeds import FeedProfile, FeedSettings
from birdcage.base.config.field import Declared, Section
from birdcage.base.config.network_sections import RotctldSettings
from birdcage.base.config.progress import SetupSettings
from birdcage.base.config.sections import (
    AlignmentSettings,
    AppSettings,
    DishSettings,
    LinkSettings,
    MotionSettings,
    PlaceSettings,
)
from birdcage.base.config.signals import SignalProfile
from birdcage.base.config.sky_sections import ElementsSettings
from birdcage.base.config.station_section import StationSection
from birdcage.base.config.tracking_sections import AutotrackSettings, HookSettings, RadioSettings, TrackingSettings
from birdcage.base.no_go import NoGoSector

SECTIONS: tuple[type[Section], ...] = (
    DishSettings,
    *FACT_SECTIONS,
    LinkSettings,
    MotionSettings,
    AlignmentSettings,
    PlaceSettings,
    FeedSettings,
    FeedProfile,
    SignalProfile,
    ElementsSettings,
    TrackingSettings,
    AutotrackSettings,
    HookSettings,
    StationSection,
    RadioSettings,
    RotctldSettings,
    AppSettings,
    SetupSettings,
)
"""In the order in which they are shown."""
NAMED: Mapping[str, type[Section]] = {"feed": FeedProfile, "signal": SignalProfile}
"""Those of which there may be many, `[feed.NAME]`, by the word before the name."""

_UNITS = {
    "_deg_s2": "deg/s2",
    "_deg_s": "deg/s",
    "_deg": "deg",
    "_hz": "Hz",
    "_s": "s",
    "_m": "m",
    "_k": "K",
    "_db": "dB",
}

Kind = Literal["text", "whole number", "number", "true or false", "choice", "sectors", "points"]


@dataclass(frozen=True, slots=True)
class KeyRow:
    """One key of the file."""

    section: str
    key: str
    kind: Kind
    default: object
    optional: bool
    """Whether it may be left unset (its default is None)."""
    unit: str | None
    minimum: float | None
    maximum: float | None
    choices: tuple[str, ...]
    doc: str
    env: str | None
    """The variable that overrides the file; None for what a variable cannot say."""
    limits_motion: bool

    @property
    def path(self) -> str:
        """The dotted key: `motion.min_elevation_deg`."""
        return f"{self.section}.{self.key}"


def rows() -> tuple[KeyRow, ...]:
    """Return every key that `birdcage.toml` may have, section by section."""
    return tuple(row for section in SECTIONS for row in rows_of(section).values())


def rows_of(section: type[Section]) -> dict[str, KeyRow]:
    """Return the rows of one section by key."""
    hints = typing.get_type_hints(section)
    assert dataclasses.is_dataclass(section)
    return {field.name: _row(section, field, hints[field.name]) for field in dataclasses.fields(section)}


def _row(section: type[Section], field: dataclasses.Field[Any], hint: object) -> KeyRow:
    declared: Declared = field.metadata["declared"]
    optional = isinstance(hint, types.UnionType) or typing.get_origin(hint) is typing.Union
    if optional:
        (hint,) = (each for each in typing.get_args(hint) if each is not type(None))
    kind, choices = _kind(hint)
    unit = next((unit for suffix, unit in _UNITS.items() if field.name.endswith(suffix)), None)
    env = declared.env
    if env is None and kind not in ("sectors", "points") and section not in NAMED.values():
        env = f"BIRDCAGE_{section.section}_{field.name}".replace(".", "_").upper()
    return KeyRow(
        section=section.section,
        key=field.name,
        kind=kind,
        default=field.default,
        optional=optional,
        unit=unit,
        minimum=declared.minimum,
        maximum=declared.maximum,
        choices=choices,
        doc=declared.doc,
        env=env,
        limits_motion=section.limits_motion,
    )


def _kind(hint: object) -> tuple[Kind, tuple[str, ...]]:
    if typing.get_origin(hint) is Literal:
        return "choice", typing.get_args(hint)
    if typing.get_origin(hint) is tuple:
        return ("sectors" if typing.get_args(hint)[0] is NoGoSector else "points"), ()
    plain: dict[object, Kind] = {str: "text", int: "whole number", float: "number", bool: "true or false"}
    return plain[hint], ()
