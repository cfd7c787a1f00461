"""A sweep that the machine makes by itself: judged whole before anything is sent, and followed reading by reading."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.antenna.gate import MotionGate
from birdcage.base.errors import MotionRefused
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.base.reason import Reason
from birdcage.rotator.sweep import OwnSweep, SweepOrder, SweptReading
from birdcage.rotator.values import MOTOR_AZIMUTH, Position

if TYPE_CHECKING:
    from birdcage.antenna.antenna import BirdcageAntenna

BEYOND_DEG = 2.0
"""A reading further outside of the range that was judged is damaged, or the dish goes where it should not."""
SURE = 2
"""So many of them in a row are no damage."""
TURNS = range(-2, 3)


class AxisSweep:
    """For the thread that owns the antenna. Axes go by their motor numbers, angles are those of the dish."""

    def __init__(self, antenna: BirdcageAntenna) -> None:
        self._antenna = antenna

    @property
    def _gate(self) -> MotionGate:
        return self._antenna.gate

    def check(self, motor: int, start: Position, span_deg: float, step_deg: float, transponders: int) -> None:
        """Raise MotionRefused unless the dish may sweep from there. Sends nothing.

        Where it is not known which way it turns, the range counts on either side of its start.
        """
        sweep = self._sweep_of(motor, span_deg, step_deg, transponders)
        self._gate.require_position()
        asked = sweep.asked_deg(span_deg, step_deg)
        low = 0.0 if sweep.way_known else -asked
        try:
            if motor == MOTOR_AZIMUTH:
                self._check_azimuth(start, low, asked)
            else:
                for el_deg in (start.elevation + low, start.elevation + asked):
                    self._gate.check_limits(None, el_deg)
            self._check_sectors(motor, start, low, asked)
        except MotionRefused as refused:
            if sweep.way_known:
                raise
            why = (
                f"It is not known which way the dish turns when it sweeps by itself: {asked:g}° must be free on both "
                f"sides of where it begins. {refused} A smaller span, or a sweep by steps, needs less."
            )
            raise MotionRefused(
                why, reason=refused.reason, limit_deg=refused.limit_deg, by_deg=refused.by_deg
            ) from refused

    def run(
        self, motor: int, span_deg: float, step_deg: float, transponders: int,
        hear: Callable[[Position, float], None], astray: Callable[[], None],
    ) -> int:  # fmt: skip
        """Sweep from where the dish stands now; returns when it says that it is over, with how many lines were unread.

        `hear` is told where the dish was, and the level. `astray` is called when it leaves the range that was judged.
        PositionUnknown where an axis is not homed, MotionRefused as `check`: nothing is sent then.
        """
        self._antenna.get_position()
        start = self._gate.position
        assert start is not None, "it was read just now"
        self.check(motor, start, span_deg, step_deg, transponders)
        sweep = self._sweep_of(motor, span_deg, step_deg, transponders)
        asked = sweep.asked_deg(span_deg, step_deg)
        low = -BEYOND_DEG if sweep.way_known else -asked - BEYOND_DEG
        unread = outside = 0

        def take(reading: SweptReading | None) -> None:
            nonlocal unread, outside
            if reading is None:
                unread += 1
                return
            begun_deg = start.azimuth if motor == MOTOR_AZIMUTH else start.elevation
            way_deg = shortest_turn(begun_deg, reading.deg) if motor == MOTOR_AZIMUTH else reading.deg - begun_deg
            if not low <= way_deg <= asked + BEYOND_DEG:
                unread, outside = unread + 1, outside + 1
                if outside == SURE:
                    astray()
                return
            outside = 0
            if motor == MOTOR_AZIMUTH:
                hear(replace(start, azimuth=wrap_360(reading.deg)), reading.level)
            else:
                hear(replace(start, elevation=reading.deg), reading.level)

        self._antenna.rotator.sweep(SweepOrder(self._axis_name(motor), asked, step_deg, transponders), take)
        return unread

    def _axis_name(self, motor: int) -> str:
        return self._gate.model.numbered[motor].name

    def _sweep_of(self, motor: int, span_deg: float, step_deg: float, transponders: int) -> OwnSweep:
        """Return what is known of its sweep; MotionRefused where it has none like this."""
        model = self._gate.model
        sweep = model.sweep
        if sweep is None or model.mapping is not None:
            raise MotionRefused(f"{model.no_sweep} Nothing was sent.", reason=Reason.UNSUPPORTED)
        wrong = ""
        if self._axis_name(motor) not in sweep.axes:
            wrong = f"The {model.name} does not sweep its {self._axis_name(motor)} by itself."
        elif (asked := sweep.asked_deg(span_deg, step_deg)) > sweep.most_span_deg:
            wrong = f"A span of {asked:g}° with its last step is more than the {sweep.most_span_deg:g}° allowed."
        elif abs(step_deg / sweep.least_step_deg - round(step_deg / sweep.least_step_deg)) > 1e-6 or step_deg <= 0:
            wrong = f"A step of {step_deg:g}° is no multiple of {sweep.least_step_deg:g}°."
        elif not 1 <= transponders <= sweep.most_transponders:
            wrong = f"{transponders} transponders are out of range. Give 1 to {sweep.most_transponders}."
        if wrong:
            raise MotionRefused(f"{wrong} Nothing was sent.", reason=Reason.BAD_PARAMETER)
        return sweep

    def _check_azimuth(self, start: Position, low: float, high: float) -> None:
        """Judge the range of the axis, and the turn of its cable: for each turn that it may have, if it is unknown."""
        gate, axis = self._gate, self._gate.model.azimuth
        if axis.max_deg - axis.min_deg < 360.0:
            for az_deg in (start.azimuth + low, start.azimuth + high):
                gate.check_limits(az_deg, None)
        limits, cable = gate.cable_limits, gate.model.cable
        if limits is None or cable is None:
            return
        if gate.cable_deg is not None:
            turns = [gate.cable_deg + gate.way_to(start.azimuth).deg]
        else:
            turns = [turn for k in TURNS if cable.min_deg <= (turn := start.azimuth + 360.0 * k) <= cable.max_deg]
        for turn in turns:
            by, limit = max((limits[0] - turn - low, limits[0]), (turn + high - limits[1], limits[1]))
            if by > 0:
                known = "stands" if gate.cable_deg is not None else "may stand"
                raise MotionRefused(
                    f"The sweep could turn the cable {by:.2f}° beyond its stop at {limit:+.2f}° (where it begins the "
                    f"cable {known} at {turn:+.2f}°). Nothing was sent.",
                    reason=Reason.WRAP, limit_deg=limit, by_deg=by,
                )  # fmt: skip

    def _check_sectors(self, motor: int, start: Position, low: float, high: float) -> None:
        bounds = self._gate.bounds
        turns = (low, high) if motor == MOTOR_AZIMUTH else (0.0,)
        lowest = start.elevation + (0.0 if motor == MOTOR_AZIMUTH else low)
        for sector in bounds.sectors:
            if lowest < sector.el_below_deg and any(sector.overlaps(start.azimuth, turn) for turn in turns):
                below, by = sector.el_below_deg + bounds.el_offset_deg, sector.el_below_deg - lowest
                reason = f" ({sector.reason})" if sector.reason else ""
                raise MotionRefused(
                    f"The sweep could lead through the no-go sector below {below:.0f}°{reason}, {by:.2f}° too low. "
                    "Nothing was sent.",
                    reason=Reason.SECTOR, limit_deg=below, by_deg=by,
                )  # fmt: skip
