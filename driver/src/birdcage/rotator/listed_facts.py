"""All facts of a machine one by one, under flat names: `azimuth.max_deg`, `second_same`, `boot_s`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum

from birdcage.base.beam import CountedBeam, Reflector
from birdcage.rotator.axis import Axis, CableRange, MeasuredTimes, Role
from birdcage.rotator.facts import Facts, SilentSlew
from birdcage.rotator.origin import Origin
from birdcage.rotator.sweep import OwnSweep

AXES = ("azimuth", "elevation", "skew")
UNITS = {"_deg_s2": "deg/s2", "_deg_s": "deg/s", "_deg": "deg", "_hz": "Hz", "_s": "s", "_m": "m"}
"""By the end of a name, the longest first."""
_PARTS = (Axis, CableRange, SilentSlew, OwnSweep, Reflector, CountedBeam)
"""What is listed field by field; sentences, plugs and tables are no facts of this kind."""
_LEFT_OUT = {"any_baud", *(f"{axis}.{key}" for axis in AXES for key in ("name", "role", "turn_by", "speed_known"))}
"""How the others are to be taken, and no facts of their own."""


@dataclass(frozen=True, slots=True)
class ListedFact:
    """One of them, for a person."""

    name: str
    value: str | float | bool | None
    """None if it is not known, or there is no such thing."""
    unit: str
    origin: Origin | None
    """None if it has no source."""


def listed(facts: Facts) -> Iterator[ListedFact]:
    """Return every fact, in the order in which `Facts` declares them."""
    for name, value in _flat("", facts):
        unit = next((unit for end, unit in UNITS.items() if name.endswith(end)), "")
        yield ListedFact(name, value, unit, None if value is None else facts.origin_of(name))


def _arcs(axes: Iterable[Axis]) -> Iterator[tuple[str, str | float | bool | None]]:
    """Return those of axes that have names of their own alone."""
    for axis in axes:
        if axis.role is Role.ARC:
            for name, value in _flat("", axis):
                if name not in ("name", "role", "turn_by", "speed_known"):
                    yield f"{axis.name}.{name}", value


def _flat(before: str, part: object) -> Iterator[tuple[str, str | float | bool | None]]:
    assert is_dataclass(part)
    for field in fields(part):
        name, value = before + field.name, getattr(part, field.name)
        if name in _LEFT_OUT or (isinstance(part, Facts) and name in AXES[:2] and value not in part.axes):
            continue
        if name == "axes":
            yield from _arcs(value)
        if isinstance(value, _PARTS):
            yield from _flat(f"{name}.", value)
        elif isinstance(value, MeasuredTimes):
            yield name, "table"
        elif isinstance(value, Enum):
            yield name, str(value.value)
        elif name == "stop_ladder":
            yield name, ", ".join(rung.means for rung in value)
        elif value is None or isinstance(value, str | float | int):
            yield name, None if value == "" else value
