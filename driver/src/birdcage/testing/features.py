"""Cases: what the machine tells, and lets be set, besides its position."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import BirdcageError, CommandRefused, OutOfRange
from birdcage.base.reason import Reason
from birdcage.rotator import machines
from birdcage.rotator.facts import Facts, SearchSwitch
from birdcage.rotator.feature import (
    END_TV_SEARCH,
    HEALTH,
    POSITION,
    TV_SEARCH,
    WELL_FORMED,
    Feature,
    FeatureKind,
    Reading,
    Value,
    Writer,
)
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.rotator import Rotator
from birdcage.station.requests import Goto, Read
from birdcage.testing.stage import FIRST_DEG, STEP_S, Stage, require
from birdcage.testing.twin import MachineBench, Twin

LACKING = "no_such_feature"
NEAR = 0.01
"""How far what is read back may lie from what was written, of the whole range: machines count in steps."""
KINDS: dict[FeatureKind, type | tuple[type, ...]] = {
    FeatureKind.NUMBER: (float, int), FeatureKind.TEXT: str, FeatureKind.LINES: str, FeatureKind.SWITCH: bool,
    FeatureKind.MOMENTARY: bool, FeatureKind.HELD: (float, int),
}  # fmt: skip


@contextmanager
def opened(bench: MachineBench) -> Iterator[tuple[Rotator, Twin]]:
    """Open the machine itself, without a station, at its twin."""
    clock, rotator = VirtualClock(), machines.make(bench.machine)
    twin = bench.twin(clock)
    rotator.open(twin.address, None, clock, Hooks(dial=twin.dial))
    try:
        rotator.meet()
        rotator.make_ready()
        yield rotator, twin
    finally:
        rotator.close(0.0)


def refused(twin: Twin, ask: Callable[[], object], error: type[Exception], what: str) -> Exception:
    """Return the error with which something is refused; fail the case for any other outcome, and for a line sent."""
    before = twin.received()
    try:
        told = ask()
    except error as why:
        require(twin.received() == before, f"{what} was refused after something was sent")
        return why
    raise AssertionError(f"{what} was not refused: {told}")


class FeatureContract:
    """A machine without features keeps each of these by refusing what it is asked."""

    def test_its_features_are_well_formed(self, bench: MachineBench) -> None:
        """They are known before a port is open, each by an id of its own; the facts of its search say the same."""
        facts = machines.facts_of(bench.machine)
        told = facts.features
        require(machines.make(bench.machine).features == told, "the machine and its facts have different features")
        for name, switch in ((TV_SEARCH, SearchSwitch.FOR_GOOD), (END_TV_SEARCH, SearchSwitch.UNTIL_POWER_UP)):
            switched = facts.search_switch is switch
            require(
                (name in told) is switched, f"its search is switched {facts.search_switch.value}, with {list(told)}"
            )
        for name, each in told.items():
            require(
                name == each.id and WELL_FORMED.fullmatch(name), f"{name!r} is no id: small letters, digits, _ and ."
            )
            require(name not in (POSITION, HEALTH), f"{name} is what faces watch for; no feature may have that id")
            require(each.health is None or each.is_readable, f"{name} tells of its health, and can't be read")
            require(each.label, f"{name} has no label")
            once, momentary = each.writer is Writer.AT_ONCE, each.kind is FeatureKind.MOMENTARY
            sent = each.kind is FeatureKind.TEXT and not each.told  # it is over once its answer came
            require(
                (momentary or sent) if once else not momentary,
                f"{name} is {each.kind.value}, and written {each.writer.value}",
            )
            require(each.is_readable or each.is_writable, f"{name} can neither be read nor set")
            require(each.range is None or each.range.low < each.range.high, f"{name}: {each.range} is no range")
            held = each.kind is FeatureKind.HELD
            require(
                each.range is None or held or each.kind is FeatureKind.NUMBER, f"{name} is no number, and has a range"
            )
            require(
                held is (each.held is not None) is (each.writer is Writer.WHILE_HELD),
                f"{name} is {each.kind.value}, written {each.writer.value}, and drives {each.held}",
            )
            if each.held is not None:
                self._is_held_soundly(facts, each)
            require(each.cost.lines > 0 and each.cost.min_interval_s >= 0.0, f"{name} costs {each.cost}")

    @staticmethod
    def _is_held_soundly(facts: Facts, feature: Feature) -> None:
        name, limits, held = feature.id, feature.range, feature.held
        assert held is not None
        require(held.axis in {axis.name for axis in facts.axes}, f"{name} drives {held.axis}, which is no axis")
        require(
            limits is not None and limits.low < 0.0 < limits.high < math.inf and limits.holds(held.value),
            f"{name} is held at {held.value}, of {limits}",
        )
        require(
            not feature.told and bool(feature.hazard), f"{name} moves the machine, so it is asked about, and no value"
        )

    def test_what_is_read_has_its_unit_and_lies_in_its_range(self, bench: MachineBench) -> None:
        """Each of them is read, and nothing moves."""
        with Stage(bench) as stage:
            stage.ready()
            before = stage.truth
            for each in stage.facts.features.values():
                if each.is_readable:
                    readings = stage.do(Read((each.id,), agreed=True))
                    require(each.id in readings, f"{each.id} was not told by the twin")
                    self._is_sound(each, readings[each.id])
            require(stage.truth == before and not stage.twin.taken(), "reading has moved it")

    @staticmethod
    def _is_sound(feature: Feature, reading: Reading) -> None:
        value, name = reading.value, feature.id
        require(reading.unit == feature.unit, f"{name} was read in {reading.unit!r}, not in {feature.unit!r}")
        number = feature.kind is FeatureKind.NUMBER
        sound = isinstance(value, KINDS[feature.kind]) and not (number and isinstance(value, bool))
        require(sound, f"{name} was read as {value!r}: that is no {feature.kind.value}")
        if number:
            require(math.isfinite(float(value)), f"{name} was read as {value}")
            inside = feature.range is None or feature.range.holds(float(value))
            require(inside, f"{name} was read as {value}, outside {feature.range}")

    def test_what_it_lacks_is_refused_with_nothing_sent(self, bench: MachineBench) -> None:
        """What is not in the table, what can only be read, and what can only be done."""
        with opened(bench) as (rotator, twin):
            features = rotator.features.values()
            unreadable = [LACKING, *(each.id for each in features if not each.is_readable)]
            unwritable = [LACKING, *(each.id for each in features if not each.is_writable)]
            for name in unreadable:
                error = refused(twin, partial(rotator.read, [name]), CommandRefused, f"reading {name}")
                require(getattr(error, "reason", "") == "unsupported", f"reading {name}: {error}")
            for name in unwritable:
                error = refused(twin, partial(rotator.write, name, 1.0), CommandRefused, f"writing {name}")
                require(getattr(error, "reason", "") == "unsupported", f"writing {name}: {error}")

    def test_a_value_beyond_its_range_is_refused_with_nothing_sent(self, bench: MachineBench) -> None:
        """The error says the value and the limit, and is a ValueError too."""
        with opened(bench) as (rotator, twin):
            for each in rotator.features.values():
                limit = math.inf if each.range is None else each.range.high
                if not each.is_writable or not math.isfinite(limit):
                    continue
                beyond = round(limit + 7.0, 2)
                error = refused(twin, partial(rotator.write, each.id, beyond), ValueError, each.id)
                require(isinstance(error, OutOfRange), f"{each.id}: {type(error).__name__} {error}")
                require(f"{beyond:g}" in str(error) and f"{limit:g}" in str(error), f"{each.id}: {error}")

    def test_what_is_written_is_read_back(self, bench: MachineBench) -> None:
        """The machine itself says what it took, and says it again when it is asked; nothing moves."""
        with opened(bench) as (rotator, twin):
            before = twin.truth()
            for each in rotator.features.values():
                if each.is_readable and each.is_writable:
                    self._is_taken(rotator, each)
                elif each.is_writable and each.kind is not FeatureKind.HELD:  # that moves it
                    self._is_sent(rotator, twin, each)
            require(twin.truth() == before and not twin.taken(), "writing has moved it")

    def _is_taken(self, rotator: Rotator, feature: Feature) -> None:
        name = feature.id
        was = rotator.read([name])[name].value
        for value in (self._other(feature, was), was):
            told = rotator.write(name, value)
            self._is_sound(feature, told)
            require(self._same(feature, told.value, value), f"{name}: {value!r} was written, and {told.value!r} told")
            again = rotator.read([name])[name].value
            require(self._same(feature, again, value), f"{name}: {value!r} was written, and {again!r} is read")

    def _is_sent(self, rotator: Rotator, twin: Twin, feature: Feature) -> None:
        """What can't be asked for reaches the machine, and its answer says that it was taken."""
        limits = feature.range
        values: tuple[Value, ...] = (True,) if feature.kind is FeatureKind.MOMENTARY else ()
        if feature.kind is FeatureKind.SWITCH:
            values = True, False
        elif limits is not None and math.isfinite(limits.high - limits.low):
            values = limits.low, limits.high
        for value in values:
            before = twin.received()
            told = rotator.write(feature.id, value)
            require(twin.received() > before, f"{feature.id}: {value!r} was written, and nothing reached the machine")
            self._is_sound(feature, told)
            require(self._same(feature, told.value, value), f"{feature.id}: {value!r} was written, {told.value!r} told")

    @staticmethod
    def _other(feature: Feature, was: Value) -> Value:
        """Return another value than the present one."""
        if feature.kind is FeatureKind.SWITCH:
            return not was
        limits = feature.range
        if feature.kind is not FeatureKind.NUMBER or limits is None or not math.isfinite(limits.high - limits.low):
            return was
        low, high = limits.low, limits.high
        return low + (high - low) * (0.25 if float(was) > (low + high) / 2.0 else 0.75)

    @staticmethod
    def _same(feature: Feature, one: Value, other: Value) -> bool:
        if feature.kind is not FeatureKind.NUMBER:
            return one == other
        span = 1.0 if feature.range is None else feature.range.high - feature.range.low
        return math.isclose(float(one), float(other), rel_tol=NEAR, abs_tol=NEAR * span if math.isfinite(span) else 0.0)

    def test_nothing_is_read_in_motion_that_may_not_be(self, bench: MachineBench) -> None:
        """A question at the wrong time may cost the motion: it is refused by who asks."""
        with Stage(bench) as stage:
            stage.found()
            future = stage.station.submit(Goto(*stage.target(*FIRST_DEG), "contract"))
            stage.until(lambda: stage.truth.moving, 30.0, "it moves")
            told = [each for each in stage.facts.features.values() if each.is_readable and not each.cost.while_moving]
            asked = {
                each.id: stage.station.submit(Read((each.id,), agreed=True)) for each in told
            }  # one motion is enough for all
            stage.until(lambda: all(each.done() for each in asked.values()), STEP_S * 2.0, "each of them was answered")
            for name, each in asked.items():
                error = each.exception()
                require(isinstance(error, BirdcageError), f"reading {name} in motion was not refused")
                require(getattr(error, "reason", "") == Reason.MOVING, f"reading {name} in motion: {error}")
            stage.refused(Read((LACKING,)), CommandRefused, within_s=STEP_S * 2.0)
            stage.until(future.done, 240.0, "it arrived")
            future.result(0)
