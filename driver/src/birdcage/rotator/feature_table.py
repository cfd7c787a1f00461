"""The table of features beside the calls that read and write them: how a language declares what its machine tells."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from datetime import timedelta
from typing import Any

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.rotator.feature import Feature, Reading, Value, by_id


@dataclass(frozen=True, slots=True)
class FeatureRow:
    """One feature, and how the machine is asked for it. What is called gets the machine itself."""

    feature: Feature
    read: Callable[[Any], Mapping[str, Value]] | None = None
    """Returns what was told, by id, also of other features: one that several rows share is called once for all.

    What was not told is left out.
    """
    write: Callable[[Any, Value], Mapping[str, Value]] | None = None
    """Writes a value that was checked, and returns what was then read back, by id."""


class FeatureTable:
    """All rows of a machine. ValueError where two have the same id, or one lacks the call for what it can do."""

    def __init__(self, *rows: FeatureRow) -> None:
        self.features = by_id(row.feature for row in rows)
        self._rows = {row.feature.id: row for row in rows}
        for name, row in self._rows.items():
            _check_calls(name, row)

    def read(self, machine: object, name: str, ids: Iterable[str], stamp: Stamp) -> dict[str, Reading]:
        """Ask a machine (called `name`) for some features; what it did not tell is left out.

        What the same answers told of other features is among what is returned. All of a menu is asked in one go.

        CommandRefused (`unsupported`) for what it does not tell at all, before anything is sent. A question that the
        machine refuses, or answers with nonsense, leaves its own features out: it raises CommandRefused or NoReply
        where nothing else was told, and wherever a motor is in trouble.
        """
        rows = {each: self._rows.get(each) for each in ids}
        for each, row in rows.items():
            if row is None or row.read is None:
                raise lacks(name, each, "read")
        readings: dict[str, Reading] = {}
        first: CommandRefused | NoReply | None = None
        for ask in _questions(row for row in rows.values() if row is not None):
            try:
                told = ask(machine)
            except (CommandRefused, NoReply) as error:
                if ends_reading(error):
                    raise
                first = first or error
                continue
            readings |= {each: self._reading(each, value, stamp) for each, value in told.items() if each in self._rows}
        if first is not None and not readings:
            raise first
        return readings

    def write(self, machine: object, name: str, feature: str, value: Value, stamp: Stamp) -> Reading:
        """Write one, and return what was read back.

        CommandRefused (`unsupported`) where it can't be written, OutOfRange for a value outside its range: nothing was
        sent then.
        """
        row = self._rows.get(feature)
        if row is None or row.write is None:
            raise lacks(name, feature, "written")
        row.feature.check(value)
        return self._reading(feature, row.write(machine, value)[feature], stamp)

    def _reading(self, feature: str, value: Value, stamp: Stamp) -> Reading:
        return stamp(value, self._rows[feature].feature.unit)


def _questions(rows: Iterable[FeatureRow]) -> Iterable[Callable[[Any], Mapping[str, Value]]]:
    """Return what is asked for rows, each once, menu by menu in the order in which they are named first."""
    asked: dict[str | None, dict[Callable[[Any], Mapping[str, Value]], None]] = {}
    for row in rows:
        if row.read is not None:
            asked.setdefault(row.feature.cost.menu, {})[row.read] = None
    return [ask for of_menu in asked.values() for ask in of_menu]


def ends_reading(error: CommandRefused | NoReply) -> bool:
    """Return whether nothing more can be asked after an error: a motor is in trouble, or nothing answers."""
    if isinstance(error, CommandRefused):
        return error.trouble is not None
    return error.reason not in (Reason.GARBAGE, Reason.NO_ROW)


def _check_calls(name: str, row: FeatureRow) -> None:
    """Raise ValueError where a row can't be asked for, or written, as its feature says."""
    feature = row.feature
    if feature.is_readable and row.read is None:
        raise ValueError(f"the row of {name!r} has no `read`: give it one, or say `told=False` if it can only be set")
    if feature.is_writable is not (row.write is not None):
        raise ValueError(f"the row of {name!r} has to have both a `Writer` and a `write`, or neither")


Stamp = Callable[[Value, str], Reading]
"""Makes a reading of a value in a unit, with the time at which it was so."""


def middle_of(clock: Clock, took_s: Callable[[], float]) -> Stamp:
    """Return what stamps a reading with the middle between the last question and its answer, which took so long."""

    def stamp(value: Value, unit: str) -> Reading:
        ago_s = took_s() / 2.0
        utc = clock.utc() - timedelta(seconds=ago_s * clock.rate)
        return Reading(value, unit, clock.monotonic() - ago_s, utc)

    return stamp


def lacks(name: str, feature: str, done: str) -> CommandRefused:
    """Return the error for what a machine (called `name`) has not, or not so."""
    return CommandRefused(
        f"The {name} has no feature {feature} that can be {done}. Nothing was sent.", reason=Reason.UNSUPPORTED
    )
