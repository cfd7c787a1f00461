"""Step 10: which way the base looks."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime

from birdcage.base.alignments import north_settings
from birdcage.base.config import PlaceSettings
from birdcage.base.config.edit import Value
from birdcage.base.errors import BirdcageError
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.setup.context import SetupContext
from birdcage.setup.step import Choice, Field, NoSuchChoice
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.typed import number, optional_number, yes
from birdcage.sky.magnetic import declination_deg
from birdcage.sky.sun import sun
from birdcage.station.requests import Goto, Jog
from birdcage.station.state import Activity, Pointing

LONGEST_CLOCK_S = 10.0
"""A clock further off than this moves the Sun by more than 0.04 degrees."""
FAR_DEG = 10.0
"""Dish and Sun further apart in elevation than this: the shadow is not in mid-dish."""
EARLIEST = datetime(2025, 1, 1, tzinfo=UTC)
"""A machine without a battery wakes up long before this."""


class NotYet(BirdcageError):
    """North can't be set this way now; the message says what is missing."""

    reason = Reason.NOT_YET


def az_offset_deg(true_az_deg: float, dish_az_deg: float) -> float:
    """Return what is added to the dish's azimuth to get the true one, in -180 to 180."""
    return round(shortest_turn(dish_az_deg, true_az_deg), 2) + 0.0


def _sun_now(bench: SetupContext) -> tuple[float, float]:
    """Return the Sun's true azimuth and elevation now. NotYet while the place is unknown."""
    place = bench.settings.place
    if place.latitude_deg is None or place.longitude_deg is None:
        raise NotYet("No location set. Set it in step 9.")
    return sun(bench.utc, place.latitude_deg, place.longitude_deg)


def _usable_sun(bench: SetupContext) -> tuple[float, float]:
    """Return the Sun as a mark to measure by. NotYet: place or clock unknown, or the Sun below the dish's floor."""
    az_deg, el_deg = _sun_now(bench)
    offset_s = bench.settings.setup.clock_offset_s
    if bench.utc < EARLIEST:
        raise NotYet(f"This machine's clock says {bench.utc:%Y-%m-%d}: set it, then compare it in step 9.")
    if offset_s is None:
        raise NotYet("The clock is unchecked. Compare it, or trust it, in step 9.")
    if abs(offset_s) > LONGEST_CLOCK_S:
        raise NotYet(f"This machine's clock was {offset_s:+g} s off: set it, then compare again in step 9.")
    floor = bench.state.el_min_deg
    if el_deg < (0.0 if floor is None else floor):
        where = "below the horizon" if el_deg < 0 else f"at {el_deg:.1f}°, below the dish's floor"
        raise NotYet(f"The Sun is {where}: wait, or use another way.")
    ceiling = bench.state.el_max_deg
    if ceiling is not None and el_deg > ceiling:
        raise NotYet(f"The Sun is at {el_deg:.1f}°, above the dish's ceiling: wait, or use another way.")
    return az_deg, el_deg


def _resting_position(bench: SetupContext) -> Pointing:
    """Return where the dish stands. NotYet: not known, not read just now, or it moves."""
    position = bench.position
    if position is None:
        lost = bench.state.position_lost
        raise NotYet(f"The dish's direction is unknown{f' ({lost})' if lost else ''}: {bench.step_4} it, step 4.")
    if bench.state.motion is not None or bench.state.activity is not Activity.IDLE:
        raise NotYet("The dish is moving. Wait until it rests.")
    return position


def _declination(bench: SetupContext) -> float | None:
    """Return the magnetic declination of the place, as typed or by the model; None when it is not known."""
    place: PlaceSettings = bench.settings.place
    if place.declination_deg is not None:
        return place.declination_deg
    if place.latitude_deg is None or place.longitude_deg is None:
        return None
    return declination_deg(bench.utc, place.latitude_deg, place.longitude_deg, place.height_m)


def _ready_for_sun(step: Step) -> str:
    """Say why the Sun can't be used now; empty when it can."""
    try:
        _usable_sun(step.bench)
    except NotYet as missing:
        return str(missing)
    return ""


def north_words(bench: SetupContext) -> str:
    """Say what the offsets in force mean."""
    own = bench.settings.alignment
    text = f"az offset {own.az_offset_deg:+.2f} deg: the dish's 0 is at {own.az_offset_deg % 360.0:.2f} true"
    return f"{text}; el offset {own.el_offset_deg:+.2f} deg" if own.el_offset_deg else text


def set_north(
    bench: SetupContext, az_deg: float, el_deg: float | None, how: str, more: Mapping[str, Value] | None = None
) -> Plan:
    """Write the offsets, with `more` settings, have the station take them, and keep the step as done by `how`.

    `el_deg` of None leaves the elevation's as it is.
    """
    changes, remark = north_settings(bench.settings.alignment, az_deg, el_deg)
    bench.write({**(more or {}), **changes})
    yield bench.apply()
    over = bench.overridden("alignment.az_offset_deg", "alignment.el_offset_deg")
    bench.done(NorthStep.name, f"{north_words(bench)} ({how}{remark}){over}")


class NorthStep(Step):
    """Typed, by the Sun, or by a compass."""

    name = "north"
    title = "North"
    page = "control"

    def evidence(self) -> str:
        """Say what the offset means, once it was set."""
        return north_words(self.bench) if self.bench.kept(self.name) else ""

    def words(self) -> tuple[str, ...]:
        """Show the Sun now, and what a compass would read."""
        dish = self.bench.state.dish
        words = [dish.handling.north] if dish is not None and dish.handling.north else []
        up = False
        try:
            az_deg, el_deg = _sun_now(self.bench)
            up = el_deg > 0.0
            words.append(f"Sun now at {az_deg:.2f}° true, elevation {el_deg:.2f}°.")
            turn = _declination(self.bench)
            if turn is not None and up:
                east = f"{abs(turn):.1f}° {'E' if turn >= 0 else 'W'}"
                words.append(f"A compass needle would read {(az_deg - turn) % 360.0:.1f}° there (declination {east}).")
        except NotYet as missing:
            words.append(str(missing))
        reason = _ready_for_sun(self)
        if not reason:
            words.append("Move the dish until the feed's shadow lies in mid-dish, then mark. Keep away from the focus.")
            position = self.bench.position
            if position is not None:
                words.append(f"The dish counts AZ {position.dish_az_deg:.2f} EL {position.dish_el_deg:.2f} now.")
        elif reason not in words:
            words.append(reason)
        if not up and self.bench.position is not None:
            words.append("By compass: stand behind the dish, and read the bearing it looks along.")
        return (*words, *self.trouble())

    def choices(self) -> tuple[Choice, ...]:
        """Offer the ways that are open."""
        own = self.bench.settings.alignment
        offsets = (
            Field("az_offset_deg", "az offset", "deg", "true minus the dish's own", f"{own.az_offset_deg:g}"),
            Field("el_offset_deg", "el offset", "deg", "empty: as it is"),
        )
        ways: list[Choice] = [*self.release_choice()]
        standing = self.bench.position is not None
        if standing and not _ready_for_sun(self):
            ways += [
                Choice("mark", "enter", "The dish looks at the Sun now: mark",
                       fields=(Field("el", "keep the el offset too", "", "y or n", "n"),)),
                Choice("sun", "u", "Turn to where the Sun should be", moves=True, far=True),
            ]  # fmt: skip
        marks = any(way.name == "mark" for way in ways)
        if standing:
            turn = _declination(self.bench)
            step = (Field("d_az_deg", "az", "deg", "clockwise is +", "0"), Field("d_el_deg", "el", "deg", "", "0"))
            ways += [
                Choice("jog", "j", "Move it a little", moves=True, fields=step),
                Choice("compass", "c" if marks else "enter", "By compass", fields=(
                    Field("reading_deg", "compass along the dish", "deg", "magnetic, where it looks now"),
                    Field("declination_deg", "declination", "deg", "east is +", "" if turn is None else f"{turn:.1f}"),
                )),
            ]  # fmt: skip
        return (*ways, Choice("typed", "t", "Type the offset", fields=offsets))

    def take(self, choice: str, values: Mapping[str, str]) -> None:
        """Measure, move, or take what was typed."""
        if choice == "release":
            self.begin(self.release(), "releasing")
        elif choice == "sun":
            self.begin(self._move(Goto(*_usable_sun(self.bench), self.bench.holder)), "turning to the Sun")
        elif choice == "jog":
            d_az = optional_number(values, "d_az_deg", "az", -180.0, 180.0) or 0.0
            d_el = optional_number(values, "d_el_deg", "el", -90.0, 90.0) or 0.0
            self.begin(self._move(Jog(d_az, d_el, self.bench.holder)), "moving")
        elif choice == "mark":
            self._mark(keep_el=yes(values, "el", "keep the el offset too"))
        elif choice == "compass":
            self._compass(values)
        else:
            az = number(values, "az_offset_deg", "az offset", -360.0, 360.0)
            el = optional_number(values, "el_offset_deg", "el offset", -90.0, 90.0)
            self._set(az, el, "typed")

    def _move(self, request: Goto | Jog) -> Plan:
        yield self.bench.ask(request)

    def _mark(self, *, keep_el: bool) -> None:
        az_deg, el_deg = _usable_sun(self.bench)
        seen = _resting_position(self.bench)
        el_off = el_deg - seen.dish_el_deg
        if abs(el_off) > FAR_DEG:
            raise NotYet(
                f"The dish stands at elevation {seen.dish_el_deg:.1f}° and the Sun at {el_deg:.1f}°: it does not "
                "point at the Sun. Is the feed's shadow in mid-dish?"
            )
        how = f"by the Sun at {az_deg:.2f}/{el_deg:.2f}; el off by {el_off:+.2f} deg, {'' if keep_el else 'not '}kept"
        self._set(az_offset_deg(az_deg, seen.dish_az_deg), round(el_off, 2) if keep_el else None, how)

    def _compass(self, values: Mapping[str, str]) -> None:
        reading = number(values, "reading_deg", "compass along the dish", 0.0, 360.0)
        turn = optional_number(values, "declination_deg", "declination", -180.0, 180.0)
        known = _declination(self.bench)
        turn = known if turn is None else turn
        if turn is None:
            raise NoSuchChoice("Declination unknown here. Type it (east is +), from a map.")
        seen = _resting_position(self.bench)
        typed = known is None or abs(turn - known) > 0.05
        changes: dict[str, Value] = {"place.declination_deg": turn} if typed else {}
        offset = az_offset_deg(reading + turn, seen.dish_az_deg)
        self._set(offset, None, f"by compass {reading:.1f} with declination {turn:+.1f} deg", changes)

    def _set(self, az: float, el: float | None, how: str, more: Mapping[str, Value] | None = None) -> None:
        self.begin(set_north(self.bench, az, el, how, more), "telling the station")
