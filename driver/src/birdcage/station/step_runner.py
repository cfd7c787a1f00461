"""Carries out the steps of a task on the wire, one at a time, between the station's other exchanges."""

from __future__ import annotations

import math
from collections import deque
from concurrent.futures import Future

from birdcage.base.errors import BirdcageError, CommandRefused, MotionRefused, NoReply, PositionUnknown
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.station.arrival_hearing import ArrivalHearing
from birdcage.station.clear_way import clear_way
from birdcage.station.dish_exchanges import DishExchanges
from birdcage.station.mover import POLL_S, Job
from birdcage.station.parts import Parts
from birdcage.station.queued_mover import STILL_S
from birdcage.station.queued_stream import lags, way_deg
from birdcage.station.signal_excursion import SignalExcursion
from birdcage.station.speed_restorer import SpeedRestorer
from birdcage.station.state import Activity, Motion
from birdcage.station.sweep_exchange import SweepExchange
from birdcage.station.unsure_move import UnsureMove
from birdcage.tracking.steps import (
    CheckSweep,
    FindWay,
    Hear,
    HearAt,
    HomeAxis,
    LimitSpeeds,
    PointAt,
    ReadFeatures,
    RunMotor,
    Send,
    SlewTo,
    Step,
    StepResult,
    SweepAxis,
    TakeReferences,
    Wait,
    WriteFeature,
)
from birdcage.tracking.steps import ReadPosition as Read

MOST_LOST = 2
"""So many answers in a row may be lost or damaged while it follows; after one more, the dish counts as silent."""
ROUNDING_DEG = 0.1
"""A command this little beyond the limit of elevation means the limit: an axis overshoots by 0.06
(`docs/reference/consoles.md`, *Overshoot*)."""
MOST_LATE = 3
"""So many answers in a row that were not waited for count as one that was lost."""
ON_ITS_WAY_S = 0.15
"""On a dish whose moves queue, the next command may leave so long before the one under way ends."""

LOST, HOME_IT = "The dish no longer knows where it points.", "Home it first."
STALE_S = 1.2
"""So long after the last reading a dish whose moves queue is looked at before it gets another."""
SHOW_S = 0.1
"""How often a stream's motion is shown anew: commands come faster than anybody can see."""


class StepRunner:
    """Knows one step at a time: `take` it, then `carry_out` until it gives the answer."""

    def __init__(self, parts: Parts, holder: str, speeds: SpeedRestorer) -> None:
        self._store, self._antenna, self._signals = parts.store, parts.antenna, parts.signals
        self._reader, self._mover = parts.reader, parts.mover
        self._excursion = SignalExcursion(parts.store, parts.antenna, parts.reader, parts.watches)
        self._exchanges, self.sweeping = DishExchanges(parts), SweepExchange(parts)
        self._hearing = ArrivalHearing(parts, self._exchanges)
        self.holder, self.speeds = holder, speeds
        self.step: Step | None = None
        self.hurry = False
        """Whether a wait ends now: the plan was replaced."""
        self._stops: deque[tuple[float, float]] = deque()
        self._arrival: Future[object] | None = None
        self._long: Future[object] | None = None
        """The end of a stream's command that the mover has: until then nothing is said to the dish."""
        self._lost = self._late = 0
        self._unsure = 0
        """How many commands in a row were answered with nothing known."""
        self._az_deg: float | None = None
        """Where the azimuth was sent last, unrolled."""
        self._ends_at = 0.0
        """When the move under way ends, on a dish whose moves queue."""
        self._shown_at = -math.inf
        self._looked_for: Step | None = None
        """The command for which the dish was looked at anew."""
        self._unsure_move = UnsureMove(parts)

    @property
    def now_s(self) -> float:
        """POSIX seconds."""
        return self._store.clock.utc().timestamp()

    @property
    def needs_wire(self) -> bool:
        """Whether the step says anything to the dish."""
        return not isinstance(self.step, Wait)

    @property
    def moves(self) -> bool:
        """Whether the step may move the dish, and needs the lease."""
        return isinstance(self.step, Send | SlewTo | PointAt | LimitSpeeds | HomeAxis | SweepAxis | RunMotor)

    def due(self, now: float) -> float | None:
        """Return when to go on with the step, `now` for at once, in monotonic seconds; None while the mover has it."""
        step = self.step
        if isinstance(step, Wait):
            left_s = 0.0 if self.hurry else step.until_s - self.now_s
            return now + max(0.0, left_s) / self._store.clock.rate
        if isinstance(step, Hear):
            return self._excursion.due(now)
        arrival = self._long or self._arrival
        if arrival is not None and not arrival.done():
            return self._hearing.due() if isinstance(step, HearAt) else None
        if isinstance(step, Read):
            return self._antenna.rotator.next_look(now)
        return self._ends_at if isinstance(step, Send) else now

    def begin(self) -> None:
        """A task begins, or goes on."""
        self.step, self._arrival, self._lost, self._late = None, None, 0, 0
        self._ends_at, self._shown_at = 0.0, -math.inf
        self._long = None
        self._unsure_move.forget()
        self._unsure = 0
        self._excursion.forget()
        self._hearing.forget()

    def drop(self) -> None:
        """The task goes no further: what it has sent goes on."""
        self._exchanges.drop()

    def take(self, step: Step) -> None:
        """Take the next step on."""
        self.step, self._arrival, self.hurry = step, None, False
        if isinstance(step, SlewTo):
            self._stops = deque(step.waypoints)
        elif isinstance(step, PointAt):
            self._stops = deque([self._antenna.alignment.to_dish(step.az_deg, step.el_deg)])

    def carry_out(self) -> StepResult | None:
        """Go on with the step; return its answer when it is done.

        MotionRefused and its kin: the gate does not let it. LinkError, NoReply, CommandRefused: the dish does not
        answer, more than once in a row.
        """
        step, arrival = self.step, self._long
        if arrival is not None and self.needs_wire:
            if not arrival.done():
                return None
            self._long = None
            arrival.result(0)
        if isinstance(step, Hear):
            return self._hear(step)
        if self.needs_wire:
            self._excursion.end()
        if isinstance(step, Send):
            return self._send(step)
        if isinstance(step, SlewTo | PointAt):
            return self._slew()
        if isinstance(step, Read):
            return self._read(patient=step.patient)
        if isinstance(step, LimitSpeeds):
            return self._limit(step)
        if isinstance(step, HomeAxis | RunMotor | TakeReferences):
            self._exchanges.carry_out(step)
        elif isinstance(step, CheckSweep):
            self.sweeping.check(step)
        elif isinstance(step, FindWay):
            return clear_way(self._antenna.gate, step, self.now_s)
        elif isinstance(step, SweepAxis):
            return self._swept(step)
        elif isinstance(step, ReadFeatures | WriteFeature):
            readings = self._exchanges.features(step)
            return StepResult(self.now_s, readings=readings)
        return StepResult(self.now_s)

    def looks_anew(self) -> bool:
        """Read where the dish is before a stream's command is tried once more; False if that was done for it already.

        The gate judges the way from the last reading: that may be a second old, and its way much the longer.
        """
        step = self.step
        if not isinstance(step, Send) or step is self._looked_for:
            return False
        self._looked_for = step
        self._read()
        return True

    def unrolled(self, dish_az_deg: float) -> float:
        """Return an azimuth as the course counts it."""
        cable_deg = self._antenna.gate.cable_deg
        reference = cable_deg if cable_deg is not None else self._az_deg
        return dish_az_deg if reference is None else reference + shortest_turn(reference, dish_az_deg)

    # A stream's command

    def _send(self, step: Send) -> StepResult | None:
        model = self._antenna.model
        queues = self._antenna.strategy.one_at_a_time
        if self._unsure_move.is_open:
            return self._see_it_rest()
        if queues and not self._is_free():
            return None
        elevation, deg = step.axis == model.elevation.index, step.deg
        gate = self._antenna.gate
        if elevation:
            limit = gate.nearest_el_deg(deg)
            deg = limit if abs(limit - deg) <= ROUNDING_DEG else deg
        if queues and model.slew is not None and way_deg(self._antenna, step) > model.slew.least_deg:
            return self._send_long(step)
        if not model.moves_one_axis:
            return StepResult(self.now_s, self.now_s)  # it is there, to a step
        sent_s = self.now_s
        try:
            self._antenna.steer(step.axis, deg)
        except MotionRefused as refused:
            if not step.beyond or refused.reason != Reason.SECTOR:
                raise
            return StepResult(self.now_s)
        except (CommandRefused, NoReply) as error:
            self._bear(error)
            if error.reason is Reason.LATE and not elevation:
                self._az_deg = deg
            if not queues:
                return StepResult(self.now_s)
            self._ends_at = self._unsure_move.begin()
            return None
        self._lost = self._late = 0
        self._unsure = 0 if self._antenna.commands.answers[step.axis].sure else self._unsure + 1
        if not elevation:
            self._az_deg = deg
        if self._store.clock.monotonic() >= self._shown_at + SHOW_S:
            self._show()
        return StepResult(self.now_s, sent_s)

    def _see_it_rest(self) -> StepResult | None:
        """Look until the dish rests: where the move led it, or where it was if it never took it."""
        clock = self._store.clock
        if clock.monotonic() < self._ends_at:
            return None
        answer = self._read()
        self._ends_at = clock.monotonic() + max(STILL_S / clock.rate, 2 * POLL_S)
        if answer.seen_s is None or not self._unsure_move.rests():
            return None
        self._az_deg = answer.az_deg
        return answer

    def _is_free(self) -> bool:
        """Return whether a dish whose moves queue has at most the end of one before it."""
        motion, clock = self._antenna.motion, self._store.clock
        if motion is None:
            return True
        now = clock.monotonic()
        self._ends_at = motion.eta(clock.rate) - ON_ITS_WAY_S / clock.rate
        if now < self._ends_at:
            return False
        here = self._store.state.position
        if here is not None and now < here.told_at + STALE_S / clock.rate and not lags(here, motion, clock.rate):
            return True
        if here is not None and now < here.told_at + POLL_S:
            self._ends_at = now + POLL_S
            return False
        here = self._reader.position()  # slower than modelled, perhaps: then nothing is to wait behind it
        self._ends_at = self._store.clock.monotonic()
        if here is None:
            raise PositionUnknown(f"{LOST} {self._antenna.model.must_be_synced or HOME_IT}", reason=Reason.UNHOMED)
        return not lags(here, motion, clock.rate)

    def _send_long(self, step: Send) -> StepResult:
        """Let the mover go a way that must be stoppable while it lasts; the other axis stays where it was sent.

        It is answered when it begins, as any other: whoever steers counts its time from then on.
        """
        position, motion = self._antenna.gate.position, self._antenna.motion
        assert position is not None, "its way was measured from there"
        az_deg, el_deg = (position.azimuth, position.elevation) if motion is None else motion.rest
        to = (az_deg, step.deg) if step.axis == self._antenna.model.elevation.index else (step.deg, el_deg)
        self._go(*to)
        self._long, self._arrival = self._arrival, None
        return StepResult(self.now_s)

    def _show(self) -> None:
        """Show where it was sent, and what stops it."""
        antenna, clock, here = self._antenna, self._store.clock, self._store.state.position
        motion = antenna.motion
        if motion is None:
            return
        now = self._shown_at = clock.monotonic()
        az_deg, el_deg = antenna.alignment.to_true(*motion.rest)
        self._mover.target = az_deg, el_deg  # a jog steps from here
        power = antenna.strategy.power(motion, clock.rate)
        self._store.change(
            motion=Motion(
                here.az_deg if here else az_deg, here.el_deg if here else el_deg, az_deg, el_deg, now,
                motion.eta(clock.rate), power.seconds, power.means, stop_proven=power.proven, rests_at=power.rests_at,
                az_way_deg=motion.azimuth.slew.end_deg - motion.azimuth.read_deg,
            ),
            target_az_deg=az_deg, target_el_deg=el_deg,
        )  # fmt: skip
        self._mover.activity(Activity.FOLLOWING, "")

    def _bear(self, error: BirdcageError) -> None:
        """Bear a lost or damaged answer, for a line that is otherwise sound has them too."""
        if error.reason is Reason.LATE and self._late < MOST_LATE:
            self._late += 1
            return
        self._lost, self._late = self._lost + 1, 0
        if self._lost > MOST_LOST or (isinstance(error, CommandRefused) and error.trouble is not None):
            raise error

    def _limit(self, step: LimitSpeeds) -> StepResult:
        sent_s = self.now_s
        try:
            self.speeds.set(step.speeds_deg_s)
        except (CommandRefused, NoReply) as error:  # as a damaged answer may read, which tells the speeds
            self._bear(error)
            return StepResult(self.now_s)
        self._lost = self._late = 0
        return StepResult(self.now_s, sent_s)

    # The whole dish

    def _slew(self) -> StepResult | None:
        arrival = self._arrival
        if arrival is not None:
            if not arrival.done():
                if isinstance(self.step, HearAt) and self._hearing.due() is not None:
                    self._hearing.read(self.step.ids)
                return None
            arrival.result(0)
            self._arrival = None
        if self._stops:
            az_deg, el_deg = self._stops.popleft()
            self._go(az_deg, el_deg)
            return None
        here = self._store.state.position
        if here is None:
            return StepResult(self.now_s)
        readings = self._hearing.answer(self.step.ids) if isinstance(self.step, HearAt) else {}
        return StepResult(
            self.now_s, None, self.unrolled(here.dish_az_deg), here.dish_el_deg, self.now_s, readings,
            true_az_deg=here.az_deg, true_el_deg=here.el_deg,
        )  # fmt: skip

    def _swept(self, step: SweepAxis) -> StepResult | None:
        if self._arrival is None:
            self._arrival = self.sweeping.run(step, self.holder)
        if not self._arrival.done():
            return None
        self._arrival.result(0)
        return StepResult(self.now_s, unread=self.sweeping.unread)

    def _go(self, az_deg: float, el_deg: float) -> None:
        azimuth, gate = self._antenna.model.azimuth, self._antenna.gate
        limit = gate.nearest_el_deg(el_deg)
        el_deg = limit if abs(limit - el_deg) <= ROUNDING_DEG else el_deg
        whole = azimuth.max_deg - azimuth.min_deg >= 360.0
        true = self._antenna.alignment.to_true(az_deg % 360.0 if whole else az_deg, el_deg)
        arrival: Future[object] = Future()
        brisk = isinstance(self.step, HearAt) or (isinstance(self.step, PointAt) and self.step.brisk)
        job = Job(*true, self.holder, arrival, brisk=brisk, heard_first=isinstance(self.step, HearAt))
        self._hearing.begin(job)
        self._mover.go(job)
        self._arrival, self._az_deg = arrival, az_deg

    def _hear(self, step: Hear) -> StepResult | None:
        try:
            over = self._excursion.carry_out(step, self.now_s, at_once=self.hurry)
        except NoReply as error:
            self._bear(error)
            over = True  # it has come back, or cannot
        return StepResult(self.now_s) if over else None

    @property
    def _follows(self) -> bool:
        return self._store.state.activity is Activity.FOLLOWING

    def _read(self, *, patient: bool = False) -> StepResult:
        before_s = self.now_s
        try:
            pointing = self._reader.position(glance=self._follows and not patient)
        except NoReply as error:
            self._bear(error)
            return StepResult(self.now_s)
        self._lost = self._late = 0
        if self._follows:
            self._show()
        if pointing is None:
            raise PositionUnknown(f"{LOST} {self._antenna.model.must_be_synced or HOME_IT}", reason=Reason.UNHOMED)
        self._unsure_move.see_it_follow(pointing, self._unsure)
        now_s = self.now_s
        az_deg = self.unrolled(pointing.dish_az_deg)
        if self._az_deg is None:
            self._az_deg = az_deg
        took_s = self._antenna.rotator.line.took_s * self._store.clock.rate
        return StepResult(now_s, None, az_deg, pointing.dish_el_deg, (before_s + now_s) / 2, took_s=took_s)
