"""STOP: its first bytes from the caller's thread, its ladder and its proof on the station's.

`docs/architecture.md`, *The journey of Space*.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import replace

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.strategy.strategy import MotionStrategy, StopAction
from birdcage.base.errors import BirdcageError, CommandRefused, Held, LinkError, NoReply, PositionUnknown, Stopped
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import StopMeans
from birdcage.station.control import Control
from birdcage.station.dish_reader import DishReader
from birdcage.station.events import End, StopConfirmed, StopSent
from birdcage.station.mover import Mover
from birdcage.station.state import Activity, Pointing, StopReport, TvSearch
from birdcage.station.state_store import StateStore
from birdcage.station.stop_pending import (
    BUSY_WITH,
    GOES_ON,
    LEARNT,
    OTHERS,
    RELEASED,
    PendingStop,
    StopReach,
    unplanned,
)
from birdcage.station.stop_times import MOST_REPEATS, StopTimes
from birdcage.station.stop_words import search_ended

COALESCE_S = 0.2
"""Presses that follow this closely are one STOP."""
POLL_S = 0.05


class Stopper:
    """Latches, sends, repeats until answered, and reports what was really done."""

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, control: Control, mover: Mover, reader: DishReader
    ) -> None:
        self._store, self._antenna, self._control = store, antenna, control
        self._mover, self._reader = mover, reader
        self._times = StopTimes(antenna, store.clock)
        self._calls: deque[tuple[StopReport, StopAction, HeldReason, str]] = deque()
        self.count = 0
        """How often STOP was called: what was asked for before the last call no longer holds."""
        # Reentrant: a signal handler may call STOP on top of the STOP that it interrupted.
        self._lock = antenna.moving.lock
        self._pending: PendingStop | None = None
        self._last_call = -math.inf
        self.due: float | None = None
        self.reach = StopReach.NOT

    @property
    def _strategy(self) -> MotionStrategy:
        return self._antenna.strategy

    @property
    def is_pending(self) -> bool:
        """Whether the dish is still being followed to its rest."""
        return self._pending is not None

    def call(self, by: str, reason: HeldReason = HeldReason.STOP, *, detail: str = "", leaving: bool = False) -> None:
        """Latch, and write the first bytes. Any thread; never waits for the dish, or for a disk.

        A program that is `leaving` stops what moves; it does not hold the dish for those that come after.
        """
        with self._lock:
            self._control.latched = True
            self.count += 1
            now = self._store.clock.monotonic()
            if now - self._last_call < COALESCE_S:
                return
            self._last_call = now
            action = done = self._action()
            try:
                if action.order is not None:
                    self._antenna.rotator.stop_now(action.order)
            except LinkError as error:
                done = StopAction(StopMeans.NO_LINK, f"Nothing could be sent: cut the power of the dish. {error}")
            self.reach = self._reach(done)
            self._calls.append((StopReport(by, now, done.means, None, done.sentence), action, reason, detail))
            if not leaving:
                self._control.keep(by, self._store.clock.utc(), reason, detail)

    def _action(self) -> StopAction:
        """Return what to do at once, by what is known of the dish."""
        state = self._store.state
        if not self._antenna.rotator.is_open:
            return StopAction(StopMeans.NO_LINK, "No link to the dish: nothing could be sent. Cut its power.")
        if (kind := self._antenna.moving.busy) is not None:
            none = f"{BUSY_WITH[kind]} cannot be stopped from here: cut the power of the dish."
            return self._strategy.while_busy(kind) or StopAction(StopMeans.NONE, none)
        if state.activity is Activity.STOWING:
            # Where it goes is the firmware's own business: only two readings tell where to aim.
            return StopAction(StopMeans.LOOK, "No STOP is documented for stowing: looking where it goes, to aim.")
        if self._reader.elsewhere and not self._strategy.anywhere:
            return StopAction(StopMeans.LOOK, "The console is not in the motor menu: going there to look, and to aim.")
        return self._at_once()

    def _at_once(self) -> StopAction:
        by = unplanned(self._store.state, self._antenna.model, motor_runs=self._antenna.moving.motor_runs)
        return self._strategy.at_once(by, self._store.clock)

    def _reach(self, action: StopAction) -> StopReach:
        if action.means.is_sent or (action.order is not None and self._strategy.anywhere):
            return StopReach.SENT
        if action.means.is_undecided:
            return StopReach.LOOKING if action.means is StopMeans.LOOK else StopReach.CHECKING
        return StopReach.ENDS if action.means is StopMeans.WAIT else StopReach.NOT

    def release(self, stops_seen: int) -> None:
        """Let go of the latch, unless STOP was called after the release was asked for: then Held."""
        self.take_calls()  # a STOP that is released has ended what it stopped
        with self._lock:
            if self.count != stops_seen:
                raise Held("STOP came after this release: the dish stays HELD.")
            self._last_call = -math.inf  # the next STOP is a new one, however soon it comes
            self._control.release()
        if (pending := self._pending) is not None:
            # What moves from now on is not STOP's to judge, and not to be retargeted by it.
            self._finish(pending, None, "Released before the dish was seen at rest.", rests=False)
            self._mover.activity(Activity.UNKNOWN, "")

    def take_calls(self) -> None:
        """Publish the STOPs that were called since, on the station's thread."""
        while self._calls:
            report, action, reason, detail = self._calls.popleft()
            order, shown = action.order, self._store.state.motion
            self._control.hold(report.by, reason, detail=detail, keep=False)  # the call has done that
            self._mover.fail(
                End.STOPPED, f"STOP by {report.by}", Stopped(f"STOP by {report.by}: the motion was given up.")
            )
            self._publish(report, sent=True)
            self._strategy.lose_track(self._store.clock)
            if report.means is StopMeans.NO_LINK:
                self._publish(replace(report, confirmed=False), sent=False)
                if order is None:
                    continue  # there was no port; where it took nothing it is tried again
            slowest = self._may_crawl(report.means)
            self._mover.activity(Activity.STOPPING, "")
            if report.means is StopMeans.LOOK and order is None:
                self._antenna.moving.forget()  # by the time that it can be aimed for, it is long outdated
            now = self._store.clock.monotonic()
            repeats = self._pending.sent if self._pending is not None else 0
            self._pending = PendingStop(
                report=report, sent=repeats + (order is not None), answered=order is None, still_from=None,
                deadline=now + self._times.lasts_s(report.means, slowest=slowest), slowest=slowest, order=order,
                action_is_complete=not (action.means.is_sent or action.means is StopMeans.RELEASE),
                unsent=action if report.means is StopMeans.NO_LINK else None,
                target=shown or (None if self._pending is None else self._pending.target),
            )  # fmt: skip
            self.due = now

    def resume(self) -> None:
        """Homing is over: follow up a STOP that was called meanwhile."""
        if self._pending is not None:
            self.due = self._store.clock.monotonic()

    def sweep_goes_on(self) -> None:
        """A sweep has told another reading since STOP: after the time that it may take, that did not end it."""
        pending, now = self._pending, self._store.clock.monotonic()
        if pending is not None and pending.report.confirmed is None and now > pending.deadline:
            pending.report = replace(pending.report, confirmed=False, sentence=GOES_ON)
            self._publish(pending.report, sent=False)

    def tick(self) -> None:
        """Wait for the answer, repeat without one, then watch the dish come to rest."""
        pending = self._pending
        if pending is None or self._antenna.moving.busy is not None:
            self.due = None
            return
        try:
            self._follow_up(pending)
        except BirdcageError as error:
            if self._pending is pending and not isinstance(error, Stopped):
                # Whoever reconnects comes first from here on; the latch holds whatever the dish does.
                failed = "The link failed before the dish was seen at rest: if it moves, cut its power."
                self._finish(pending, False, failed, rests=False)
            raise

    def _follow_up(self, pending: PendingStop) -> None:
        if not pending.answered:
            pending.answered = self._answered(pending)
            if self._pending is not pending:
                return  # STOP was called again meanwhile
            if not pending.answered:
                self._repeat(pending)
                return
            if self._climbs_untried(pending):
                return
            self._see_whether_it_waits(pending)
            lasts_s = self._times.lasts_s(pending.report.means, slowest=pending.slowest)
            pending.deadline = max(pending.deadline, self._store.clock.monotonic() + lasts_s)
        if not pending.action_is_complete:
            pending.action_is_complete = True
            self._complete(pending)
        asked = self._store.clock.monotonic()
        self.due = self._antenna.rotator.next_look(asked)
        if self.due > asked:
            return
        pointing = self._reader.position()
        if self._pending is not pending:
            return
        now = self._store.clock.monotonic()
        self.due = self._antenna.rotator.next_look(now + POLL_S)
        if pointing is None or pointing.modelled:  # two that were not read agree, and prove nothing
            released = bool(self._antenna.gate.released)
            self._finish(pending, None, RELEASED if released else self._strategy.unseen)
        elif pending.still_from is None:
            pending.still_from, pending.still_asked = pointing, asked
        elif not self._reader.is_still(pointing, pending.still_from):
            earlier, pending.still_from = pending.still_from, pointing
            since, pending.still_asked = pending.still_asked, asked
            self._still_moving(pending, earlier, pointing, since)
        elif self._rests(pending, pending.still_from, asked):
            # A late answer tells nothing of the dish, nor does one that stands where it was going.
            if pending.report.means in LEARNT and now <= pending.deadline and pending.ended_short(pointing):
                self._learn(pending.report.means, works=True)
            self._finish(
                pending, now <= pending.deadline or pending.report.means.is_undecided,
                f"{pending.note}Stands still at {pointing.az_text}/{pointing.el_deg:.2f}°, "
                f"{now - pending.report.at:.1f} s after STOP.",
            )  # fmt: skip
        if self._pending is pending and pending.still_from is not None:
            # An answer that is asked for a little too soon proves nothing, and keeps the wire from one that would.
            proof_at = self._times.proof_at(pending, pending.still_from)
            round_trip_s = self._antenna.rotator.line.round_trip_s or 0.0
            self.due = proof_at if now + POLL_S < proof_at < now + round_trip_s else self.due

    def _rests(self, pending: PendingStop, still_from: Pointing, asked: float) -> bool:
        """Return whether the readings have agreed for long enough when the last one was `asked` for."""
        return asked >= self._times.proof_at(pending, still_from) and self._strategy.is_there(self._store.clock)

    def _learn(self, means: StopMeans, *, works: bool) -> None:
        """Keep what a dish in motion has shown of a rung."""
        if works:
            self._strategy.found_to_work(means)
        else:
            self._strategy.found_to_fail(means)
        self._store.change(unplanned_stop=self._strategy.unplanned)

    def _complete(self, pending: PendingStop) -> None:
        means = pending.report.means
        if means is StopMeans.RELEASE:
            self._release(pending)
            return
        try:
            self._strategy.answered(means)
            if means is StopMeans.SEARCH:
                self._antenna.maintenance.end_search()
                self._store.change(search=TvSearch.OFF_UNTIL_POWER_UP)
                self._antenna.rotator.make_ready()
            lasts_s = self._times.lasts_s(means, slowest=pending.slowest)
            pending.deadline = max(pending.deadline, self._store.clock.monotonic() + lasts_s)
            pending.note = search_ended(self._antenna.model) if means is StopMeans.SEARCH else ""
        except CommandRefused as refused:
            pending.note = f"The TV search was not ended: {refused} "

    def _may_crawl(self, means: StopMeans) -> bool:
        """Return whether the dish may move at an unknown speed: in a motion not sent from here."""
        if self._pending is not None and self._pending.slowest:
            return True
        return means.is_undecided and self._store.state.activity in OTHERS

    def _answered(self, pending: PendingStop) -> bool:
        try:
            answers = self._antenna.rotator.settle(self._times.answer_s(pending))
        except NoReply:
            return False
        pending.hear(answers)
        return bool(answers)

    def _climbs_untried(self, pending: PendingStop) -> bool:
        """Send what is next where the machine says that it has no STOP command; return whether something is."""
        if not pending.unknown or pending.report.means is not StopMeans.COMMAND:
            return False
        self._learn(StopMeans.COMMAND, works=False)
        action = self._at_once()
        if action.order is None:
            return False
        self._send(pending, action, self._store.clock.monotonic())
        self.due = self._store.clock.monotonic()
        return True

    def _see_whether_it_waits(self, pending: PendingStop) -> None:
        """A dish that was found to wait for its motors before it reads on takes no new target: let its move end."""
        waits = self._antenna.motion is not None and not self._strategy.answers_in_motion
        if waits and pending.report.means is StopMeans.LOOK:
            self._look_on(pending, self._at_once())

    def _look_on(self, pending: PendingStop, action: StopAction) -> None:
        """Say what is done instead of what was sent first."""
        pending.report = replace(pending.report, means=action.means, sentence=action.sentence)
        self._store.change(last_stop=pending.report)
        self.reach = self._reach(action)

    def _repeat(self, pending: PendingStop) -> None:
        if pending.sent >= MOST_REPEATS:
            rung = self._strategy.next_rung(pending.report.means)
            if rung is not None and rung.means is StopMeans.RELEASE:
                self._release(pending)
                return
            if rung is not None and rung.means is StopMeans.COMMAND:
                action, now = self._strategy.commanded(), self._store.clock.monotonic()
                pending.sent, self.due = 0, now
                self._send(pending, action, now)
                return
            self._finish(pending, False, "STOP was sent five times and not answered: cut the power of the dish.")
            return
        pending.sent += 1
        if pending.order is not None:
            self._antenna.rotator.stop_now(pending.order)
        if pending.unsent is not None:
            self._look_on(pending, pending.unsent)
            pending.unsent = None
        self.due = self._store.clock.monotonic()

    def _still_moving(self, pending: PendingStop, earlier: Pointing, pointing: Pointing, since: float) -> None:
        """The dish was seen to move at some time `since` the earlier reading was asked for."""
        now = self._store.clock.monotonic()
        if pending.report.means.is_undecided:
            action = self._strategy.on_sight(earlier.dish, earlier.at, pointing.dish, pointing.at)
            self._antenna.moving.forget()  # it goes otherwise than it was modelled
            if action.order is None:
                self._look_on(pending, action)
                pending.deadline = now + self._times.lasts_s(action.means, slowest=pending.slowest)
                return
            self._send(pending, action, now)
        elif self._strategy.closes_in(earlier.dish, pointing.dish):
            pending.deadline = max(pending.deadline, now + 1.0)  # slower than modelled, but on its way to rest
        elif since > pending.deadline and pending.report.confirmed is None:
            self._climb(pending, earlier, pointing, now)

    def _climb(self, pending: PendingStop, earlier: Pointing, pointing: Pointing, now: float) -> None:
        """The dish goes on: try what its ladder has next."""
        if pending.report.means in LEARNT:
            self._learn(pending.report.means, works=False)
        rung = self._strategy.next_rung(pending.report.means)
        if rung is not None and rung.means is not StopMeans.RELEASE:
            action = self._strategy.on_sight(earlier.dish, earlier.at, pointing.dish, pointing.at)
            self._antenna.moving.forget()  # it goes otherwise than it was modelled
            if action.order is not None:
                self._send(pending, action, now)
                return
        pending.report = replace(
            pending.report, confirmed=False, sentence=f"{pending.note}The dish goes on: cut its power."
        )
        self._publish(pending.report, sent=False)
        if rung is not None and rung.means is StopMeans.RELEASE:
            self._release(pending)

    def _send(self, pending: PendingStop, action: StopAction, now: float) -> None:
        """Send another thing than what was sent first."""
        pending.order = action.order
        if pending.order is not None:
            self._antenna.rotator.stop_now(pending.order)
        self.reach = StopReach.SENT
        pending.report = replace(pending.report, means=action.means, sentence=action.sentence)
        pending.deadline = now + self._times.lasts_s(action.means, slowest=pending.slowest)
        pending.answered = pending.action_is_complete = False
        pending.sent += 1

    def _release(self, pending: PendingStop) -> None:
        """Climb the last rung: only if the user enabled it."""
        self._antenna.maintenance.release_motors()
        self._reader.unknown(PositionUnknown("STOP released the motors.", reason=Reason.RELEASED))
        pending.report = replace(pending.report, means=StopMeans.RELEASE, confirmed=None)
        self._finish(pending, None, "The motors were released. The dish's position is not known: home it.")

    def motors_were_released(self) -> None:
        """Nothing is left to be stopped: a person has taken the current off the motors."""
        if self._pending is not None:
            self._finish(self._pending, None, RELEASED)

    def _finish(self, pending: PendingStop, confirmed: bool | None, sentence: str, *, rests: bool = True) -> None:
        """Look no more; `rests`: what was modelled is over."""
        earlier = pending.report.confirmed
        if self.reach.is_open:
            self.reach = StopReach.AT_REST if confirmed or sentence == RELEASED else StopReach.NOT
        self._pending, self.due = None, None
        if rests:
            self._antenna.moving.end()
        self._store.change(motion=None)
        moves = self._antenna.reckoning.moves_until > self._store.clock.monotonic()
        self._mover.activity(Activity.UNKNOWN if moves else Activity.IDLE, "")
        report = replace(pending.report, confirmed=confirmed if earlier is None else earlier, sentence=sentence)
        self._publish(report, sent=False)

    def _publish(self, report: StopReport, *, sent: bool) -> None:
        self._store.change(last_stop=report)
        at, utc = self._store.stamp()
        self._store.tell(StopSent(at, utc, report) if sent else StopConfirmed(at, utc, report))
