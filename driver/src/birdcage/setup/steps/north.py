"""Step 10: which way the base looks."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.base.config.edit import Value
from birdcage.setup import north
from birdcage.setup.step import Choice, Field, NoSuchChoice
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.typed import number, optional_number, yes
from birdcage.station.requests import Goto, Jog


class NorthStep(Step):
    """Typed, by the Sun, or by a compass."""

    name = "north"
    title = "North"
    page = "control"

    def evidence(self) -> str:
        """Say what the offset means, once it was set."""
        return self._consequence() if self.bench.kept(self.name) else ""

    def _consequence(self) -> str:
        own = self.bench.settings.alignment
        text = f"az offset {own.az_offset_deg:+.2f} deg: the dish's 0 is at {own.az_offset_deg % 360.0:.2f} true"
        return f"{text}; el offset {own.el_offset_deg:+.2f} deg" if own.el_offset_deg else text

    def words(self) -> tuple[str, ...]:
        """Show the Sun now, and what a compass would read."""
        dish = self.bench.state.dish
        words = [dish.handling.north] if dish is not None and dish.handling.north else []
        up = False
        try:
            az_deg, el_deg = north.sun_now(self.bench)
            up = el_deg > 0.0
            words.append(f"Sun now at {az_deg:.2f}° true, elevation {el_deg:.2f}°.")
            turn = north.declination(self.bench)
            if turn is not None and up:
                east = f"{abs(turn):.1f}° {'E' if turn >= 0 else 'W'}"
                words.append(f"A compass needle would read {(az_deg - turn) % 360.0:.1f}° there (declination {east}).")
        except north.NotYet as missing:
            words.append(str(missing))
        reason = north.ready_for_sun(self)
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
        if standing and not north.ready_for_sun(self):
            ways += [
                Choice("mark", "enter", "The dish looks at the Sun now: mark",
                       fields=(Field("el", "keep the el offset too", "", "y or n", "n"),)),
                Choice("sun", "u", "Turn to where the Sun should be", moves=True, far=True),
            ]  # fmt: skip
        marks = any(way.name == "mark" for way in ways)
        if standing:
            turn = north.declination(self.bench)
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
            self.begin(self._move(Goto(*north.usable_sun(self.bench), self.bench.holder)), "turning to the Sun")
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
        az_deg, el_deg = north.usable_sun(self.bench)
        seen = north.resting_position(self.bench)
        el_off = el_deg - seen.dish_el_deg
        if abs(el_off) > north.FAR_DEG:
            raise north.NotYet(
                f"The dish stands at elevation {seen.dish_el_deg:.1f}° and the Sun at {el_deg:.1f}°: it does not "
                "point at the Sun. Is the feed's shadow in mid-dish?"
            )
        how = f"by the Sun at {az_deg:.2f}/{el_deg:.2f}; el off by {el_off:+.2f} deg, {'' if keep_el else 'not '}kept"
        self._set(north.az_offset_deg(az_deg, seen.dish_az_deg), round(el_off, 2) if keep_el else None, how)

    def _compass(self, values: Mapping[str, str]) -> None:
        reading = number(values, "reading_deg", "compass along the dish", 0.0, 360.0)
        turn = optional_number(values, "declination_deg", "declination", -180.0, 180.0)
        known = north.declination(self.bench)
        turn = known if turn is None else turn
        if turn is None:
            raise NoSuchChoice("Declination unknown here. Type it (east is +), from a map.")
        seen = north.resting_position(self.bench)
        typed = known is None or abs(turn - known) > 0.05
        changes: dict[str, Value] = {"place.declination_deg": turn} if typed else {}
        offset = north.az_offset_deg(reading + turn, seen.dish_az_deg)
        self._set(offset, None, f"by compass {reading:.1f} with declination {turn:+.1f} deg", changes)

    def _set(self, az: float, el: float | None, how: str, more: Mapping[str, Value] | None = None) -> None:
        changes: dict[str, Value] = {**(more or {}), "alignment.az_offset_deg": az}
        if el is not None:
            changes["alignment.el_offset_deg"] = el
        own = self.bench.settings.alignment
        if own.ca_deg or own.an_deg or own.aw_deg:
            # They were fitted together with the offsets that go now, and to a base that stood otherwise.
            changes |= dict.fromkeys(f"alignment.{name}" for name in ("active", "ca_deg", "an_deg", "aw_deg"))
            how += "; the tilt of the last calibration is dropped"
        self.bench.write(changes)
        self.begin(self._apply(how), "telling the station")

    def _apply(self, how: str) -> Plan:
        yield self.bench.apply()
        over = self.bench.overridden("alignment.az_offset_deg", "alignment.el_offset_deg")
        self.bench.done(self.name, f"{self._consequence()} ({how}){over}")
