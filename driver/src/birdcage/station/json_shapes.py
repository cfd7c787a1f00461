"""How a value of each Python type looks in JSON, and back: made from the fields of a dataclass and their types.

    bool, int, float, str           themselves; no number is NaN or infinite, and no whole one is beyond 2^53
    X | None                        X, or null
    datetime                        text, UTC: `2026-11-23T06:04:28.250000Z`
    Enum, Literal                   its value
    tuple, frozenset                a list; that of a set is sorted
    Mapping                         an object; numbers as keys are text
    dataclass, NamedTuple           an object with all its fields; one with a default may be left out when read
    Path                            text
    rows of numbers                 lists in a list
    a feature's value               a number, text, or true and false; text of several lines is a list of them
    Range                           its ends; one without an end has null there
    AnyJson                         itself, unread: whoever takes it reads it
    an array of numbers             a list; null for what is no number
    Plan, SkyMapping                its outline, which is also what is read back (`plan_outline`, `rotator.mapping`)

All text that is read is clean (`base.text`). What does not fit raises BadMessage, which names the field.
"""

# ruff: noqa: ANN401 - values of any type are told

from __future__ import annotations

import math
import re
import types
from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, dataclass, fields, is_dataclass, replace
from datetime import datetime
from enum import Enum
from functools import cache
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, NewType, Union, get_args, get_origin, get_type_hints

from birdcage.base.errors import BadMessage
from birdcage.base.text import clean
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import Range, Value
from birdcage.rotator.mapping import MappingOutline
from birdcage.station.json_values import (
    MOMENT,
    NUMBER,
    TEXT,
    TRUTH,
    WHOLE,
    ChoiceShape,
    FeatureValueShape,
    OptionalShape,
    Shape,
    shown,
    unfit,
)
from birdcage.station.plan_outline import PlanOutline, outline

_WHOLE_KEY = re.compile(r"-?\d{1,16}", re.ASCII)
_VALUE = frozenset(get_args(Value))
Rows = tuple[tuple[float, ...], ...]
IMPORTED = {
    "Refraction": "tracking.planning.refraction", "Skew": "sky.skew", "Downlink": "sky.downlinks",
    "ElementError": "sky.element_error", "Day": "tracking.day", "PointingError": "tracking.pointing_error",
    "LookAngle": "sky.look", "PassRow": "sky.pass_row", "PlanTarget": "tracking.plan", "PassReach": "sky.reach_model",
    "SunApproach": "sky.sun_crossing",
}  # fmt: skip
"""Where types are that modules import for their annotations alone, as they need much of sky or numpy."""
AnyJson = NewType("AnyJson", object)
"""What whoever takes it reads for itself."""
NAMES = {"Plan": PlanOutline, "SkyMapping": MappingOutline, "Target": AnyJson}
"""What names of types mean here: what stands for a plan, a mapping and a target in another program."""


@cache
def shape_of(kind: Any) -> Shape:
    """Return the shape of a type. TypeError for one that has none."""
    if kind in _PLAIN:
        return _PLAIN[kind]
    origin, arguments = get_origin(kind), get_args(kind)
    if origin in (Union, types.UnionType):
        rest = frozenset(arguments) - {type(None)}
        inner: Shape
        if rest == _VALUE | {Rows}:
            inner = RowsOrValueShape()
        else:
            inner = FeatureValueShape() if len(rest) > 1 and rest <= _VALUE else shape_of(*rest)
        return OptionalShape(inner) if len(rest) < len(arguments) else inner
    if origin is Literal:
        return ChoiceShape({each: each for each in arguments})
    if origin is tuple:
        every = arguments[1:] == (...,)
        return ListShape(shape_of(arguments[0]), tuple) if every else RowShape(tuple(map(shape_of, arguments)))
    if origin is frozenset:
        return ListShape(shape_of(arguments[0]), frozenset)
    if origin is Mapping:
        return ObjectShape(shape_of(arguments[1]), whole_keys=arguments[0] is int)
    if isinstance(kind, type) and issubclass(kind, Enum):
        return ChoiceShape({each.value: each for each in kind}, kind.__name__)
    if kind is Range:
        return RangeShape()
    if getattr(origin, "__module__", "") == "numpy":
        return FloatsShape()
    if is_dataclass(kind) or hasattr(kind, "_field_defaults"):
        return FieldsShape(kind)
    raise TypeError(f"{kind} has no JSON form")


class AnyShape:
    """Any JSON, as it is."""

    words = "any JSON"

    def tell(self, value: Any, where: str) -> object:  # noqa: ARG002 - any will do
        """Return it."""
        return value

    def take(self, told: object, where: str) -> Any:  # noqa: ARG002 - any will do
        """Return it."""
        return told


class FloatsShape:
    """A row of numbers, as an array."""

    words = "a list of numbers, null for what is none"

    def tell(self, value: Any, where: str) -> object:  # noqa: ARG002 - any array will do
        """Return a list."""
        return [each if math.isfinite(each) else None for each in value.tolist()]

    def take(self, told: object, where: str) -> Any:
        """Return the array."""
        import numpy as np

        if not isinstance(told, list) or not all(each is None or type(each) in (int, float) for each in told):
            raise unfit(told, where, self)
        try:
            return np.array([math.nan if each is None else each for each in told], dtype=np.float64)
        except OverflowError:
            raise unfit(told, where, self) from None


class ListShape:
    """A tuple of any length, or a set."""

    def __init__(self, item: Shape, make: Callable[[Iterable[Any]], Any]) -> None:
        self._item, self._make = item, make
        self.words = f"a list, each item {item.words}"

    def tell(self, value: Any, where: str) -> object:
        """Return a list; that of a set is sorted."""
        items: list[Any] = [self._item.tell(each, f"{where}[{at}]") for at, each in enumerate(value)]
        return sorted(items) if isinstance(value, frozenset) else items

    def take(self, told: object, where: str) -> Any:
        """Return the tuple or set."""
        if not isinstance(told, list):
            raise unfit(told, where, self)
        return self._make(self._item.take(each, f"{where}[{at}]") for at, each in enumerate(told))


class RowsOrValueShape:
    """The value of a feature, or rows of numbers."""

    words = "a number, text, true or false, or a list of lists of numbers"

    def __init__(self) -> None:
        self._rows = ListShape(ListShape(NUMBER, tuple), tuple)
        self._value = FeatureValueShape()

    def tell(self, value: Any, where: str) -> object:
        """Return it; rows as lists."""
        return (self._rows if isinstance(value, tuple) else self._value).tell(value, where)

    def take(self, told: object, where: str) -> Any:
        """Return it; lists of lists as rows. Text of several lines is a list of text."""
        is_rows = isinstance(told, list) and all(isinstance(each, list) for each in told)
        return (self._rows if is_rows else self._value).take(told, where)


class RowShape:
    """A tuple of so many, each of its own type."""

    def __init__(self, items: tuple[Shape, ...]) -> None:
        self._items = items
        self.words = f"a list of {len(items)}: {'; '.join(each.words for each in items)}"

    def tell(self, value: Any, where: str) -> object:
        """Return a list."""
        pairs = enumerate(zip(self._items, value, strict=True))
        return [shape.tell(each, f"{where}[{at}]") for at, (shape, each) in pairs]

    def take(self, told: object, where: str) -> Any:
        """Return the tuple."""
        if not isinstance(told, list) or len(told) != len(self._items):
            raise unfit(told, where, self)
        pairs = enumerate(zip(self._items, told, strict=True))
        return tuple(shape.take(each, f"{where}[{at}]") for at, (shape, each) in pairs)


class ObjectShape:
    """A mapping by name, or by whole number."""

    def __init__(self, item: Shape, *, whole_keys: bool) -> None:
        self._item, self._whole_keys = item, whole_keys
        keys = "whole numbers as text" if whole_keys else "text"
        self.words = f"an object, its keys {keys}, each value {item.words}"

    def tell(self, value: Any, where: str) -> object:
        """Return an object."""
        return {str(key): self._item.tell(each, f"{where}.{key}") for key, each in value.items()}

    def take(self, told: object, where: str) -> Any:
        """Return the mapping, which can't be changed."""
        if not isinstance(told, dict):
            raise unfit(told, where, self)
        return MappingProxyType({self._key(key, where): self._item.take(each, where) for key, each in told.items()})

    def _key(self, key: str, where: str) -> str | int:
        if not self._whole_keys:
            return clean(key)
        if not _WHOLE_KEY.fullmatch(key):
            raise BadMessage(f"{where} has the key {shown(key)}. Give a whole number as text.")
        return int(key)


@dataclass(frozen=True, slots=True)
class ShapedField:
    """One field of an object."""

    name: str
    shape: Shape
    required: bool
    """Whether it has no default, so that JSON must have it."""


class FieldsShape:
    """A dataclass, or a tuple with names."""

    def __init__(self, kind: Any) -> None:
        self.kind = kind
        self.words = f"an object ({kind.__name__})"
        hints = get_type_hints(kind, localns=_Names(NAMES))
        self.fields = tuple(
            ShapedField(name, shape_of(hints[name]), required) for name, required in _names_of(kind).items()
        )

    def tell(self, value: Any, where: str) -> dict[str, object]:
        """Return an object with all fields."""
        value = self._told(value)
        if not isinstance(value, self.kind):
            raise unfit(repr(value), where, self)
        return {each.name: each.shape.tell(getattr(value, each.name), f"{where}.{each.name}") for each in self.fields}

    def take(self, told: object, where: str) -> Any:
        """Return the value."""
        if not isinstance(told, dict):
            raise unfit(told, where, self)
        names = [each.name for each in self.fields]
        has = f"It has {', '.join(names) or 'no fields'}."
        if unknown := [key for key in told if key not in names]:
            raise BadMessage(f"{where} has no field {shown(unknown[0])}. {has}")
        given = {}
        for each in self.fields:
            if each.name in told:
                given[each.name] = each.shape.take(told[each.name], f"{where}.{each.name}")
            elif each.required:
                raise BadMessage(f"{where} lacks {each.name}. {has}")
        try:
            return self.kind(**given)
        except (ValueError, ArithmeticError, LookupError) as error:
            raise BadMessage(f"{where} does not fit together: {error}") from None

    def _told(self, value: Any) -> Any:
        """Return what is told of a value: its outline, where the value itself stays inside."""
        if self.kind is PlanOutline:
            return outline(value)
        if isinstance(value, Facts) and value.mapping is not None:
            return replace(value, mapping=MappingOutline.of(value.axes, value.mapping))
        return value


class _Names(dict[str, Any]):
    """Names of types, with those that are imported when a type is first told."""

    def __missing__(self, name: str) -> Any:
        if name not in IMPORTED:
            raise KeyError(name)
        return getattr(import_module(f"birdcage.{IMPORTED[name]}"), name)


def _names_of(kind: Any) -> dict[str, bool]:
    """Return the fields that a value is made from, and whether each is required."""
    if not is_dataclass(kind):
        return {name: name not in kind._field_defaults for name in kind._fields}
    made = (each for each in fields(kind) if each.init)
    return {each.name: each.default is MISSING and each.default_factory is MISSING for each in made}


class RangeShape:
    """The least and the greatest value of a feature, which may have no end."""

    words = "an object with `low` and `high`, each a number, or null for no end"

    def tell(self, value: Range, where: str) -> object:
        """Return an object."""
        ends = {"low": value.low, "high": value.high}
        return {key: None if math.isinf(end) else NUMBER.tell(end, f"{where}.{key}") for key, end in ends.items()}

    def take(self, told: object, where: str) -> Range:
        """Return the range."""
        if not isinstance(told, dict) or not told.keys() <= {"low", "high"}:
            raise unfit(told, where, self)
        return Range(**{key: NUMBER.take(end, f"{where}.{key}") for key, end in told.items() if end is not None})


class PathShape:
    """A path of a file on this machine."""

    words = "text"

    def tell(self, value: Any, where: str) -> object:
        """Return it as text."""
        return TEXT.tell(str(value), where)

    def take(self, told: object, where: str) -> Path:
        """Return the path."""
        return Path(TEXT.take(told, where))


_PLAIN: dict[Any, Shape] = {str: TEXT, float: NUMBER, int: WHOLE, bool: TRUTH, datetime: MOMENT, Path: PathShape(),
                            AnyJson: AnyShape()}  # fmt: skip
