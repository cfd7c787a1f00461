"""How a value of each Python type looks in JSON, and back: made from the fields of a dataclass and their types.

    bool, int, float, str           themselves; no number is NaN or infinite, and no whole one is beyond 2^53
    X | None                        X, or null
    datetime                        text, UTC: `2026-11-23T06:04:28.250000Z`
    Enum, Literal                   its value
    tuple, frozenset                a list; that of a set is sorted
    Mapping                         an object; numbers as keys are text
    dataclass                       an object with all its fields; one with a default may be left out when read
    a feature's value               a number, text, or true and false; text of several lines is a list of them
    Plan                            its outline, which is also what is read back (`plan_outline`)

All text that is read is clean (`base.text`). What does not fit raises BadMessage, which names the field.
"""

# ruff: noqa: ANN401 - values of any type are told

from __future__ import annotations

import math
import re
import types
from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, Field, fields, is_dataclass
from datetime import UTC, datetime
from enum import Enum
from functools import cache
from types import MappingProxyType
from typing import Any, Literal, Protocol, Union, get_args, get_origin, get_type_hints

from birdcage.base.errors import BadMessage
from birdcage.base.text import clean
from birdcage.rotator.feature import Value
from birdcage.station.plan_outline import PlanOutline, outline

MOST = 2**53
"""Beyond this, programs that keep every number as a float do not agree on whole ones."""
MOST_LISTED = 15
"""Words of an enum that a sentence still lists."""
_MOMENT = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d(:\d\d(\.\d{1,6})?)?(Z|[+-]\d\d:\d\d)", re.ASCII)
_WHOLE = re.compile(r"-?\d{1,15}", re.ASCII)
_VALUE = frozenset(get_args(Value))
_NAMES = {"Plan": PlanOutline}
"""What names of types mean here that their modules know only while types are checked."""


class Shape(Protocol):
    """One type, as JSON."""

    @property
    def words(self) -> str:
        """What JSON it is, for errors and documents: `a number`, `a list, each item text`."""

    def tell(self, value: Any, where: str) -> object:
        """Return a value as JSON; `where` names its field. BadMessage for what JSON can't hold."""

    def take(self, told: object, where: str) -> Any:
        """Return the value of JSON that came from outside. BadMessage for what does not fit."""


@cache
def shape_of(kind: Any) -> Shape:
    """Return the shape of a type. TypeError for one that has none."""
    if kind in _PLAIN:
        return _PLAIN[kind]
    origin, arguments = get_origin(kind), get_args(kind)
    if origin in (Union, types.UnionType):
        rest = frozenset(arguments) - {type(None)}
        inner: Shape = FeatureValueShape() if rest == _VALUE else shape_of(*rest)
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
    if is_dataclass(kind):
        return FieldsShape(kind)
    raise TypeError(f"{kind} has no JSON form")


def shown(told: object) -> str:
    """Return JSON from outside, short enough for a sentence."""
    if isinstance(told, list | dict):
        return "a list" if isinstance(told, list) else "an object"
    if told is None or isinstance(told, bool):
        return "null" if told is None else str(told).lower()
    text = f'"{told}"' if isinstance(told, str) else str(told)
    return text if len(text) <= 60 else f"{text[:60]}…"


def unfit(told: object, where: str, shape: Shape) -> BadMessage:
    """Return the error for JSON that does not fit."""
    return BadMessage(f"{where} is {shown(told)}. Give {shape.words}.")


class PlainShape:
    """Text, or true and false."""

    def __init__(self, kind: type, words: str) -> None:
        self._kind, self.words = kind, words

    def tell(self, value: Any, where: str) -> object:
        """Return it as it is."""
        if not isinstance(value, self._kind):
            raise unfit(repr(value), where, self)
        return value

    def take(self, told: object, where: str) -> Any:
        """Return it, text clean."""
        if type(told) is not self._kind:
            raise unfit(told, where, self)
        return clean(told) if isinstance(told, str) else told


class NumberShape:
    """A number; a whole one where the field is an `int`."""

    def __init__(self, *, whole: bool) -> None:
        self._whole = whole
        self.words = "a whole number" if whole else "a number"

    def tell(self, value: Any, where: str) -> object:
        """Return it. BadMessage for NaN and infinity, which JSON does not have."""
        if not isinstance(value, int | float) or not math.isfinite(value):
            raise unfit(repr(value), where, self)
        return int(value) if self._whole else float(value)

    def take(self, told: object, where: str) -> Any:
        """Return it; a whole number does for any other."""
        if isinstance(told, bool) or not isinstance(told, int if self._whole else int | float):
            raise unfit(told, where, self)
        if (isinstance(told, int) and abs(told) > MOST) or not math.isfinite(told):
            raise BadMessage(f"{where} is {shown(told)}. Give {self.words} within ±2^53.")
        return told if self._whole else float(told)


class MomentShape:
    """A time."""

    words = "a time like 2026-11-23T06:04:28Z"

    def tell(self, value: Any, where: str) -> object:
        """Return it as text, in UTC."""
        if not isinstance(value, datetime) or value.tzinfo is None:
            raise unfit(repr(value), where, self)
        return f"{value.astimezone(UTC).replace(tzinfo=None).isoformat()}Z"

    def take(self, told: object, where: str) -> Any:
        """Return it, in UTC."""
        if not isinstance(told, str) or not _MOMENT.fullmatch(told):
            raise unfit(told, where, self)
        try:
            return datetime.fromisoformat(told).astimezone(UTC)
        except (ValueError, OverflowError):
            raise unfit(told, where, self) from None


class ChoiceShape:
    """One of some words, or numbers."""

    def __init__(self, choices: Mapping[Any, object], name: str = "") -> None:
        """Take the choices by their words; `name` is what they are called where they are too many to list."""
        self._choices = choices
        self._words = {value: word for word, value in choices.items()}
        listed = ", ".join(map(shown, choices))
        self.words = f"a word of {name}" if name and len(choices) > MOST_LISTED else f"one of {listed}"

    def tell(self, value: Any, where: str) -> object:
        """Return its word."""
        if value not in self._words:
            raise unfit(repr(value), where, self)
        return self._words[value]

    def take(self, told: object, where: str) -> Any:
        """Return what the word stands for."""
        if isinstance(told, bool) or not isinstance(told, str | int) or told not in self._choices:
            raise unfit(told, where, self)
        return self._choices[told]


class OptionalShape:
    """A type, or null for what is not known."""

    def __init__(self, inner: Shape) -> None:
        self._inner = inner
        self.words = f"{inner.words}, or null"

    def tell(self, value: Any, where: str) -> object:
        """Return it, or null."""
        return None if value is None else self._inner.tell(value, where)

    def take(self, told: object, where: str) -> Any:
        """Return it, or None."""
        return None if told is None else self._inner.take(told, where)


class FeatureValueShape:
    """The value of a feature of the dish."""

    words = "a number, text, true or false"

    def tell(self, value: Any, where: str) -> object:
        """Return it; text of several lines as a list of them."""
        if isinstance(value, str):
            return value.split("\n") if "\n" in value else value
        return value if isinstance(value, bool) else _NUMBER.tell(value, where)

    def take(self, told: object, where: str) -> Any:
        """Return it; a list of lines as one text."""
        if isinstance(told, list) and told:
            return "\n".join(_TEXT.take(line, f"{where}[{at}]") for at, line in enumerate(told))
        if isinstance(told, bool):
            return told
        if isinstance(told, int | float):
            return _NUMBER.take(told, where)
        if isinstance(told, str):
            return clean(told)
        raise unfit(told, where, self)


class ListShape:
    """A tuple of any length, or a set."""

    def __init__(self, item: Shape, make: Callable[[Iterable[Any]], Any]) -> None:
        self._item, self._make = item, make
        self.words = f"a list, each item {item.words}"

    def tell(self, value: Any, where: str) -> object:
        """Return a list; that of a set is sorted."""
        items = sorted(value) if isinstance(value, frozenset) else value
        return [self._item.tell(each, f"{where}[{at}]") for at, each in enumerate(items)]

    def take(self, told: object, where: str) -> Any:
        """Return the tuple or set."""
        if not isinstance(told, list):
            raise unfit(told, where, self)
        return self._make(self._item.take(each, f"{where}[{at}]") for at, each in enumerate(told))


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
        if not _WHOLE.fullmatch(key):
            raise BadMessage(f"{where} has the key {shown(key)}. Give a whole number as text.")
        return int(key)


class FieldsShape:
    """A dataclass."""

    def __init__(self, kind: Any) -> None:
        self.kind = kind
        self.words = f"an object ({kind.__name__})"
        hints = get_type_hints(kind, localns=_NAMES)
        self.fields: tuple[tuple[Field[Any], Shape], ...] = tuple(
            (each, shape_of(hints[each.name])) for each in fields(kind) if each.init
        )

    def tell(self, value: Any, where: str) -> dict[str, object]:
        """Return an object with all fields."""
        if self.kind is PlanOutline:
            value = outline(value)
        if not isinstance(value, self.kind):
            raise unfit(repr(value), where, self)
        return {each.name: shape.tell(getattr(value, each.name), f"{where}.{each.name}") for each, shape in self.fields}

    def take(self, told: object, where: str) -> Any:
        """Return the dataclass."""
        if not isinstance(told, dict):
            raise unfit(told, where, self)
        names = [each.name for each, _ in self.fields]
        has = f"It has {', '.join(names) or 'no fields'}."
        if unknown := [key for key in told if key not in names]:
            raise BadMessage(f"{where} has no field {shown(unknown[0])}. {has}")
        given = {}
        for each, shape in self.fields:
            if each.name in told:
                given[each.name] = shape.take(told[each.name], f"{where}.{each.name}")
            elif is_required(each):
                raise BadMessage(f"{where} lacks {each.name}. {has}")
        return self.kind(**given)


def is_required(field: Field[Any]) -> bool:
    """Return whether a field has no default, so that JSON must have it."""
    return field.default is MISSING and field.default_factory is MISSING


_TEXT, _NUMBER = PlainShape(str, "text"), NumberShape(whole=False)
_PLAIN: dict[Any, Shape] = {
    str: _TEXT, float: _NUMBER, int: NumberShape(whole=True), bool: PlainShape(bool, "true or false"),
    datetime: MomentShape(),
}  # fmt: skip
