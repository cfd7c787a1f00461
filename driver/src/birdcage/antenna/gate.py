"""The one gate that every motion passes, whoever asks. Works in the dish's own frame."""

from __future__ import annotations

import math
from copy import copy
from dataclasses import dataclass, replace

from birdcage.antenna.mapped_way import mapped_points
from birdcage.antenna.turning import LONGEST_SURE_DEG, AzimuthWay, azimuth_way, is_safe_at_any_turn
from birdcage.base.errors import BelowFloor, MotionRefused, PositionUnknown
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.base.no_go import NoGoSector
from birdcage.base.reason import Reason
from birdcage.rotator.facts import CableTurn, Facts
from birdcage.rotator.values import Position


@dataclass(frozen=True, slots=True)
class MotionBounds:
    """What limits motion beyond the dish itself: the user's settings and what was read from the dish."""

    el_min_deg: float | None = None
    el_max_deg: float | None = None
    floor_deg: float = -math.inf
    """The lowest elevation that the caller's configuration allows; the higher of floor and limit counts."""
    cable_min_deg: float | None = None
    cable_max_deg: float | None = None
    sectors: tuple[NoGoSector, ...] = ()
    """In the dish's own degrees."""
    az_offset_deg: float = 0.0
    el_offset_deg: float = 0.0
    """Added to the angles in sentences and to `limit_deg`: whoever asked speaks true degrees."""


UNTOLD = Reason.UNTOLD
"""Why the position is not known of a dish that does not report it, before its first move is over."""
NO_DIRECTION = Reason.NO_DIRECTION
"""Why it is not known of a machine that has no azimuth and elevation, and no mapping that makes some (yet)."""


class MotionGate:
    """Judges targets. Holds what is known of the position; unknown is refused."""

    def __init__(self, model: Facts, bounds: MotionBounds | None = None) -> None:
        self.model = model
        self.bounds = bounds or MotionBounds()
        self.position: Position | None = None
        self.unknown_reason = Reason.UNREAD
        self.cable_deg: float | None = None
        self.last_cable_deg = 0.0
        """The turn of the cable when it was last known: STOP may come while the position is in doubt."""
        self.remembers_cable = False
        """Whether the turn of the cable is an earlier program's count, and not from a homing that this one saw."""
        self.released: set[int] = set()
        """Axes whose motors were released since they were homed: what they report may not be where they are."""

    def update(self, **changes: object) -> None:
        """Replace fields of the bounds."""
        self.bounds = replace(self.bounds, **changes)  # type: ignore[arg-type]

    def see(self, position: Position) -> None:
        """Take in a position that was read; a counted cable turns with it (readings lie under half a turn apart).

        PositionUnknown (`released`) while an axis was not homed since its motor was released.
        """
        if self.released:
            self.forget(Reason.RELEASED)
            raise self._unknown()
        if self.model.turn is CableTurn.REPORTED:
            self.cable_deg, self.remembers_cable = position.azimuth, False
            position = replace(position, azimuth=wrap_360(position.azimuth))
        elif self.cable_deg is not None and self.position is not None:
            self.cable_deg += shortest_turn(self.position.azimuth, position.azimuth)
        self.last_cable_deg = self.last_cable_deg if self.cable_deg is None else self.cable_deg
        self.position = position

    def count_cable(self) -> None:
        """Begin to count: the dish has just found its reference, so its cable stands at its azimuth (`Wrap: 0`)."""
        counts = self.model.cable is not None and self.model.turn is not CableTurn.REPORTED
        if self.position is not None and counts:
            self.cable_deg, self.remembers_cable = shortest_turn(0.0, self.position.azimuth), False

    def remember_cable(self, cable_deg: float) -> None:
        """Go on with a count that was begun earlier."""
        self.cable_deg, self.remembers_cable = cable_deg, True

    def forget(self, reason: Reason) -> None:
        """Forget the position; `reason` says why no motion is sent until it is known again."""
        self.position, self.unknown_reason, self.cable_deg = None, reason, None
        self.remembers_cable = False

    def release(self) -> None:
        """Take in that the motors were released: only homing tells where the axes are."""
        self.released = {self.model.azimuth.index, self.model.elevation.index}
        self.forget(Reason.RELEASED)

    def found_reference(self, index: int) -> None:
        """Take in that an axis was homed."""
        self.released.discard(index)

    @property
    def el_limits_deg(self) -> tuple[float, float]:
        """The lowest and the highest elevation allowed, whoever asks: a caller's own floor may lie higher."""
        axis, low, high = self.model.elevation, self.bounds.el_min_deg, self.bounds.el_max_deg
        return axis.min_deg if low is None else low, axis.max_deg if high is None else high

    def nearest_el_deg(self, el_deg: float) -> float:
        """Return the elevation nearest to this one that the caller may be sent to."""
        low, high = self.el_limits_deg
        return min(max(el_deg, low, self.bounds.floor_deg), high)

    def check(self, az_deg: float | None, el_deg: float | None) -> None:
        """Raise `MotionRefused` unless the dish may go there from where it stands; None leaves that axis be."""
        position = self.check_limits(az_deg, el_deg)
        self._check_sectors(
            position, az_deg if az_deg is not None else position.azimuth,
            el_deg if el_deg is not None else position.elevation,
        )  # fmt: skip

    def check_axis(self, index: int, deg: float) -> None:
        """Raise `MotionRefused` unless this one axis may go there, from where the dish stands."""
        if index == self.model.azimuth.index:
            self.check(deg, None)
        else:
            self.check(None, deg)

    def check_target(self, az_deg: float, el_deg: float) -> None:
        """Raise `MotionRefused` unless the dish may stand there, whichever way it comes.

        For a motion that begins only when the present one is over: `check` judges its way then.
        """
        self.check_limits(az_deg, el_deg)
        for sector in self.bounds.sectors:
            if el_deg < sector.el_below_deg and sector.overlaps(az_deg, 0.0):
                raise self._in_the_way(sector, az_deg, el_deg, el_deg)

    def check_skew(self, deg: float) -> None:
        """Raise `MotionRefused` unless the dish has a skew axis that may stand at this angle, wherever it is now."""
        axis = self.model.skew
        if axis is None:
            raise MotionRefused(f"The {self.model.name} has no skew axis. Nothing was sent.", reason=Reason.UNSUPPORTED)
        if not math.isfinite(deg):
            raise MotionRefused(
                f"The skew asked for is {deg}, which is not an angle. Nothing was sent.", reason=Reason.NOT_A_NUMBER
            )
        limit = min(max(deg, axis.min_deg), axis.max_deg)
        if limit != deg:
            raise MotionRefused(
                f"Skew {deg:.2f}° is {abs(deg - limit):.2f}° beyond the limit of {limit:.2f}°. Nothing was sent.",
                reason=Reason.SKEW_LIMIT, limit_deg=limit, by_deg=abs(deg - limit),
            )  # fmt: skip

    def require_direction(self) -> None:
        """Raise `PositionUnknown` (`no_direction`) of a machine that has no azimuth and elevation."""
        if self.model.no_direction:
            self.forget(NO_DIRECTION)
            raise self._unknown()

    def require_position(self) -> None:
        """Raise `PositionUnknown`, which says what to do, where it is not known."""
        if self.position is None:
            raise self._unknown()

    def check_limits(self, az_deg: float | None, el_deg: float | None) -> Position:
        """Return the position; MotionRefused when it is not known, or when an axis or the cable does not allow it.

        Sectors are left out: it depends on the way whether they forbid it.
        """
        for name, value in (("azimuth", az_deg), ("elevation", el_deg)):
            if value is not None and not math.isfinite(value):
                raise MotionRefused(
                    f"The {name} asked for is {value}, which is not an angle. Nothing was sent.",
                    reason=Reason.NOT_A_NUMBER,
                )
        self.require_direction()
        start = self.position or self._first_start(az_deg, el_deg)
        if az_deg is not None:
            self._check_azimuth(start, az_deg)
        if el_deg is not None:
            self._check_elevation(el_deg)
        return start

    def _first_start(self, az_deg: float | None, el_deg: float | None) -> Position:
        """Return what counts as the start of a first move of a dish that does not tell where it is: its target.

        MotionRefused where there is a no-go sector: its way may pass through it. PositionUnknown of any other dish, or
        where it could turn its cable too far.
        """
        if self.unknown_reason is not UNTOLD or az_deg is None or el_deg is None or self.model.cable is not None:
            raise self._unknown()
        if self.bounds.sectors:
            raise MotionRefused(
                "This dish does not tell where it points, so its way may pass through a no-go sector. Nothing was "
                "sent. Take the sectors out for this one move, watch the dish, and put them back.",
                reason=Reason.SECTOR,
            )
        return Position(az_deg, el_deg)

    def judge(self, az_deg: float | None, el_deg: float | None) -> MotionRefused | None:
        """Return which limit a motion would break, as far as that can be said; for raw lines, which pass no gate.

        Any thread. While the position is not known, only the range of each axis counts.
        """
        gate = copy(self)  # the owner may forget the position meanwhile
        gate.bounds = replace(gate.bounds, az_offset_deg=0.0, el_offset_deg=0.0)  # raw lines speak the dish's degrees
        if gate.position is None:
            gate.position, gate.cable_deg = Position(az_deg or 0.0, el_deg or 0.0), None
            gate.bounds = replace(gate.bounds, sectors=(), cable_min_deg=None, cable_max_deg=None)
        try:
            gate.check(az_deg, el_deg)
        except MotionRefused as refused:
            return refused
        return None

    def cable_turns(self, az_deg: float) -> tuple[float, ...]:
        """Return the turns of the cable that reach `az_deg`, nearest first; only with a known cable angle."""
        return () if self.cable_deg is None or self.position is None else self.way_to(az_deg).turns

    def way_to(self, az_deg: float) -> AzimuthWay:
        """Return how the azimuth will turn to `az_deg` from the last position that was read."""
        here = az_deg if self.position is None else self.position.azimuth
        if self.model.mapping is not None:
            return AzimuthWay(shortest_turn(here, az_deg))
        return azimuth_way(self.model, here, az_deg, self.cable_deg, self.cable_limits)

    @property
    def cable_limits(self) -> tuple[float, float] | None:
        """The range of the cable: the dish's, narrowed by the user's."""
        cable = self.model.cable
        if cable is None:
            return None
        low, high = self.bounds.cable_min_deg, self.bounds.cable_max_deg
        return (
            cable.min_deg if low is None else max(cable.min_deg, low),
            cable.max_deg if high is None else min(cable.max_deg, high),
        )

    def _unknown(self) -> PositionUnknown:
        why = {
            Reason.UNREAD: "the position of the dish has not been read yet. Wait a moment.",
            Reason.UNHOMED: "the dish is not homed, so it does not know where it points. Home it first.",
            Reason.UNSYNCED: "the dish is not synced. Say where it points: `birdcage sync AZ EL`.",
            Reason.UNREADABLE: "the dish's position reply can't be read. Home it; the console shows the reply.",
            Reason.RELEASED: "the motors were released, so the position is unknown. Home the dish.",
            UNTOLD: "this dish does not tell where it points. Send it somewhere first, by its full direction.",
            Reason.RAW_COMMAND: "a raw command may have moved the dish. Read the position again.",
        }
        if self.unknown_reason is NO_DIRECTION:
            return PositionUnknown(f"{self.model.no_direction} Nothing was sent.", reason=NO_DIRECTION)
        sentence = why.get(self.unknown_reason, self.unknown_reason)
        return PositionUnknown(f"No motion: {sentence}", reason=self.unknown_reason)

    def _check_azimuth(self, start: Position, az_deg: float) -> None:
        axis = self.model.azimuth
        for limit, by in ((axis.min_deg, axis.min_deg - az_deg), (axis.max_deg, az_deg - axis.max_deg)):
            if by > 0:
                plus = self.bounds.az_offset_deg
                raise MotionRefused(
                    f"Azimuth {az_deg + plus:.2f}° is {by:.2f}° beyond the limit of {limit + plus:.2f}°. "
                    "Nothing was sent.",
                    reason=Reason.AZ_LIMIT, limit_deg=limit + plus, by_deg=by,
                )  # fmt: skip
        limits = self.cable_limits
        if limits is None:
            return
        if self.cable_deg is not None and not self.cable_turns(az_deg):
            limit, by = self._beyond(self.cable_deg + self.way_to(az_deg).deg, limits)
            raise MotionRefused(
                f"Azimuth {self._true_az(az_deg):.2f}° would turn the cable {by:.2f}° beyond its stop at "
                f"{limit:+.2f}° (it stands at {self.cable_deg:+.2f}°). Nothing was sent{self._round_about(az_deg)}.",
                reason=Reason.WRAP, limit_deg=limit, by_deg=by,
            )  # fmt: skip
        if self.cable_deg is None and not is_safe_at_any_turn(self.model, start.azimuth, az_deg, limits):
            raise MotionRefused(
                f"The cable may turn from {limits[0]:+.2f}° to {limits[1]:+.2f}° only, and its turn is unknown. "
                "Home the dish from birdcage, which then counts the turn. Nothing was sent.",
                reason=Reason.WRAP,
            )

    def _round_about(self, az_deg: float) -> str:
        """Return by which azimuth the dish gets there the other way round, which it does not take by itself."""
        limits, cable = self.cable_limits, self.cable_deg
        if limits is None or cable is None:
            return ""
        there = cable + self.way_to(az_deg).deg
        for way in (there + 360.0 - cable, there - 360.0 - cable):
            if limits[0] <= cable + way <= limits[1] and abs(way) <= 2 * LONGEST_SURE_DEG:
                here = 0.0 if self.position is None else self.position.azimuth
                return (
                    f": by way of azimuth {self._true_az((here + way / 2.0) % 360.0):.0f}° it turns the other way round"
                )
        return ""

    @staticmethod
    def _beyond(turn_deg: float, limits: tuple[float, float]) -> tuple[float, float]:
        low_by, high_by = limits[0] - turn_deg, turn_deg - limits[1]
        return (limits[0], low_by) if low_by > high_by else (limits[1], high_by)

    def _check_elevation(self, el_deg: float) -> None:
        plus = self.bounds.el_offset_deg
        low, high = self.el_limits_deg
        low = max(low, self.bounds.floor_deg)
        if (by := low - el_deg) > 0:
            floor = low + plus
            raise BelowFloor(
                f"Elevation {el_deg + plus:.2f}° is {by:.2f}° below the floor of {floor:.2f}°. Nothing was sent.",
                limit_deg=floor, by_deg=by,
            )  # fmt: skip
        if (by := el_deg - high) > 0:
            ceiling = high + plus
            raise MotionRefused(
                f"Elevation {el_deg + plus:.2f}° is {by:.2f}° above the limit of {ceiling:.2f}°. Nothing was sent.",
                reason=Reason.EL_LIMIT, limit_deg=ceiling, by_deg=by,
            )  # fmt: skip

    def _check_sectors(self, start: Position, az_deg: float, el_deg: float) -> None:
        """Refuse a motion that cuts a sector: the axes may move together or in turn, so the whole box counts."""
        if not self.bounds.sectors:
            return
        if self.model.mapping is not None:
            self._check_sectors_along(start, az_deg, el_deg)
            return
        lowest = min(start.elevation, el_deg)
        short_deg = shortest_turn(start.azimuth, az_deg)
        if abs(short_deg) < self.model.azimuth.step_deg and el_deg >= start.elevation:
            return  # straight up is the way out of a sector
        way = self.way_to(az_deg)
        for sector in self.bounds.sectors:
            if lowest >= sector.el_below_deg:
                continue
            if sector.overlaps(start.azimuth, way.deg):
                raise self._in_the_way(sector, az_deg, el_deg, lowest)
            if way.other_deg is not None and sector.overlaps(start.azimuth, way.other_deg):
                raise self._in_the_way(sector, az_deg, el_deg, lowest, round_about=True)

    def _check_sectors_along(self, start: Position, az_deg: float, el_deg: float) -> None:
        """Refuse a way along a machine's own arc that leads through a sector, or ends in one."""
        points = [point for _, point in mapped_points(self.model, start, az_deg, el_deg)]
        for sector in self.bounds.sectors:
            within = [
                point.elevation for point in points
                if point.elevation < sector.el_below_deg and sector.overlaps(point.azimuth, 0.0)
            ]  # fmt: skip
            if within:
                raise self._in_the_way(sector, az_deg, el_deg, min(within))

    def _in_the_way(
        self, sector: NoGoSector, az_deg: float, el_deg: float, lowest_deg: float, *, round_about: bool = False
    ) -> MotionRefused:
        plus = self.bounds.el_offset_deg
        below, by = sector.el_below_deg + plus, sector.el_below_deg - lowest_deg
        where = (
            f"the no-go sector from azimuth {self._true_az(sector.az_from_deg):.0f}° to "
            f"{self._true_az(sector.az_to_deg):.0f}° below {below:.0f}°"
            f"{f' ({sector.reason})' if sector.reason else ''}"
        )
        target = f"{self._true_az(az_deg):.2f}°/{el_deg + plus:.2f}°"
        if el_deg < sector.el_below_deg and sector.overlaps(az_deg, 0.0):
            sentence = f"{target} lies in {where}, {by:.2f}° too low. Nothing was sent."
        elif round_about:
            sentence = (
                f"The turn of the cable is unknown: the dish may go to {target} the other way round, through "
                f"{where}, {by:.2f}° too low. Nothing was sent: home the dish, or go up first, then across, then down."
            )
        elif self.model.mapping is not None:
            sentence = f"The way to {target} leads through {where}, {by:.2f}° too low. Nothing was sent."
        else:
            sentence = (
                f"The way to {target} passes through {where}, {by:.2f}° too low, as both axes turn at once or in any "
                "order. Nothing was sent: go up first, then across, then down."
            )
        return MotionRefused(sentence, reason=Reason.SECTOR, limit_deg=below, by_deg=by)

    def _true_az(self, az_deg: float) -> float:
        plus = self.bounds.az_offset_deg
        return (az_deg + plus) % 360.0 if plus else az_deg
