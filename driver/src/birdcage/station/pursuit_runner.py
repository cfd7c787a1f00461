"""Drives a pursuit between the station's exchanges: who may move the dish when, and what ends or interrupts it."""

from __future__ import annotations

import math
from collections.abc import Generator
from contextlib import suppress
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError, CommandRefused, Held, LeaseDenied, MotionRefused, Stopped
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.station import pursuit_words as words
from birdcage.station.events import End
from birdcage.station.interruption import Interruption
from birdcage.station.parts import Parts
from birdcage.station.pursuit_contexts import context_for, controller_that_suits, refuse
from birdcage.station.pursuit_reporter import PursuitReporter
from birdcage.station.pursuit_state import Phase, Pursuit
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.step_runner import StepRunner
from birdcage.tracking.steps import Step, StepResult

if TYPE_CHECKING:
    from birdcage.station.requests import Pursue
    from birdcage.tracking.plan import Plan
    from birdcage.tracking.pursuit_context import PursuitContext, StageNotice

POLL_S = 0.2
"""How often a pursuit that cannot go on looks whether it can."""
ENDED = "The pursuit was ended."
QUIET = (Phase.WAITING, Phase.YIELDED)
"""Where nothing of the pursuit's moves, nor is about to."""


class PursuitRunner:
    """One pursuit at a time. `due` and `tick` belong to the station's loop, the rest to its desk and its alarms."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._store, self._antenna, self._control = parts, parts.store, parts.antenna, parts.control
        self._mover, self._stopper = parts.mover, parts.stopper
        self._runner = StepRunner(parts)
        parts.signals.interrupted.connect(self.interrupted)
        parts.signals.waits.connect(self.suit_dish)
        self.speeds = self._runner.speeds
        """Those of the dish that a pursuit has changed."""
        self._run: Generator[Step, StepResult, None] | None = None
        self._context: PursuitContext | None = None
        self._reporter = PursuitReporter(parts.store, parts.antenna)
        self._interruption: Interruption | None = None
        self._leads = False
        """Whether it has taken the lease since it began or went on."""
        self._number = 0
        self._poll_at = 0.0

    @property
    def _now_s(self) -> float:
        return self._runner.now_s

    @property
    def _live(self) -> Pursuit | None:
        return self._reporter.live

    # What faces ask for

    def take_on(self, request: Pursue) -> int:
        """Begin a pursuit, or give the one under way another plan; return its number.

        MotionRefused (`unreachable`, `over`, `controller`, …), Held, LinkError: nothing has changed.
        """
        live = self._live
        if request.renews is not None and (live is None or live.number != request.renews):
            return request.renews
        refuse(request.plan, self._now_s)
        if live is not None and live.holder == request.holder and live.plan.is_same_pass(request.plan):
            self._renew(request.plan)
            return live.number
        self._parts.require_link("nothing is followed")
        context, name = context_for(request, self._store, self._antenna, self._hear)
        self._antenna.gate.require_position()
        self._control.refuse(request.holder)
        if live is not None:
            if self._leads and live.holder != request.holder:
                raise LeaseDenied(f"{live.holder} follows {live.plan.aim.name}. Take control first, or wait.")
            leads = self._leads
            self._over(words.REPLACED)
            if leads:
                self._come_to_rest()
        self._number += 1
        at = self._store.clock.monotonic()
        pursuit = Pursuit(
            self._number, request.holder, request.plan, request.options, Phase.WAITING, at, "", controller=name
        )
        self._interruption, self._context = None, context
        self._runner.forget_turn()
        self._reporter.begin(pursuit)
        self._set_out(asked=request.asked)
        return self._number

    def end(self, by: str) -> None:
        """End the pursuit, and what it has set in motion. Nothing happens when there is none."""
        if self._live is None:
            return
        leads = self._leads
        self._over(words.ended_by(by))
        if leads:
            self._come_to_rest()

    def make_way(self, holder: str) -> None:
        """Somebody is about to move the dish: a pursuit of theirs that has changed its speeds ends, and restores them.

        Else it goes on until the dish has taken the motion: see `by_hand`.
        """
        if self._runner.speeds.are_changed:
            self.by_hand(holder)
            self.restore()

    def by_hand(self, holder: str) -> None:
        """Somebody moves the dish: that ends his own pursuit. One that he has taken control from leaves it to him."""
        live = self._live
        if live is not None and live.holder == holder and (self._leads or live.phase is Phase.COUNTDOWN):
            self._over(words.by_hand(holder), keep_lease=True)
        elif live is not None and self._is_robbed(live):
            self._drop()
            self._reporter.enter(Phase.YIELDED, words.yielded(holder))

    def suit_dish(self) -> None:
        """The dish takes commands otherwise than was known: steer accordingly from the next stretch on."""
        if self._live is not None and self._context is not None:
            name, self._context.controller = controller_that_suits(self._live.options, self._antenna)
            self._reporter.change(controller=name)

    def _renew(self, plan: Plan) -> None:
        assert self._context is not None, "a live pursuit has one"
        self._context.replace(plan, self._now_s)
        self._runner.hurry = True
        self._reporter.change(plan=self._context.plan)

    # The station's loop

    @property
    def due(self) -> float | None:
        """When there is something to do, in monotonic seconds."""
        live = self._live
        if live is None:
            return None
        # What is due at once is due since ever: the present time is later than the one that the loop compares it with.
        if self._is_robbed(live):
            return -math.inf
        if self._run is not None:
            return self._runner.due if not self._control.latched else self._store.clock.monotonic() + POLL_S
        if live.phase is Phase.YIELDED and self._is_free(live):
            return -math.inf
        return self._poll_at

    @property
    def restore_due(self) -> bool:
        """Whether speeds that a pursuit has changed are to be put back now, before anything else moves."""
        live = self._live
        over = self._run is None or live is None or live.phase is not Phase.FOLLOWING
        return over and self._runner.speeds.are_changed and not self._stopper.is_pending

    def restore(self) -> None:
        """Put them back. What the dish refuses is told as a fault, and not tried again."""
        try:
            self._runner.speeds.restore()
        except (CommandRefused, MotionRefused) as refused:
            self._runner.speeds.forget()
            self._parts.signals.speed_stuck(str(refused))

    def tick(self) -> None:
        """Go on with the pursuit, as far as one exchange."""
        live = self._live
        if live is None or self.stopped():
            return
        self._poll_at = self._store.clock.monotonic() + POLL_S
        if self._run is None:
            self._see_whether_to_go_on(live)
        elif self._is_robbed(live):
            self._yield(live)
        else:
            self._go_on(live)

    def stopped(self) -> bool:
        """Take in that STOP, or a fault, has latched meanwhile; return whether the pursuit is over. Sends nothing."""
        live, held = self._live, self._store.state.held
        if live is None:
            return True
        if not self._control.latched or held is None:
            return False
        if held.reason is not HeldReason.STOP and live.phase is Phase.INTERRUPTED:
            return False
        if held.reason not in (HeldReason.STOP, HeldReason.FAULT):
            # While it waited: a latch that closes for what became of somebody else's motion.
            self._interrupt(held.reason, live)
            return False
        self._over(words.held(held, self._store.state.fault))
        return True

    def interrupted(self, reason: HeldReason) -> None:
        """The dish is out of sight, has restarted, or the clock has stepped: it stays still. Sends nothing."""
        live = self._live
        if reason is HeldReason.FAULT:
            self._runner.speeds.forget()
        if live is None or live.phase is Phase.INTERRUPTED or (reason is HeldReason.LINK and live.phase in QUIET):
            return
        self._interrupt(reason, live)

    def _interrupt(self, reason: HeldReason, live: Pursuit) -> None:
        state, now = self._store.state, self._store.clock.monotonic()
        self._interruption = Interruption.now(reason, now, self._stopper.count, state, self._antenna)
        self._drop()
        self._reporter.enter(Phase.INTERRUPTED, words.interrupted(reason, live.options))

    def shut(self) -> None:
        """The station ends: put speeds back as far as that can be done."""
        if self._live is not None:
            self._over("birdcage has ended.")
        if self._runner.speeds.are_changed and self._store.state.link.state is LinkPhase.UP:
            with suppress(BirdcageError):
                self._runner.speeds.restore()

    def _set_out(self, *, asked: bool) -> None:
        """Begin, or go on: the activity joins the plan at this moment."""
        from birdcage.tracking.pursuit_steps import pursue

        live, context = self._live, self._context
        assert live is not None, "one has just begun, or goes on"
        assert context is not None, "a live pursuit has one"
        context.asked, self._leads = asked, False
        self._runner.begin(live.holder)
        self._run = pursue(context, self._now_s)
        self._advance(None)

    def _advance(self, answer: StepResult | None) -> None:
        run = self._run
        assert run is not None, "somebody drives it"
        try:
            step = next(run) if answer is None else run.send(answer)
        except StopIteration:
            if self._run is run:
                self._over(words.DONE)
            return
        if self._run is run:
            self._runner.take(step)

    def _go_on(self, live: Pursuit) -> None:
        runner, run = self._runner, self._run
        if runner.needs_wire and not self._may_talk(live):
            return
        try:
            try:
                answer = runner.carry_out()
            except MotionRefused as refused:
                if refused.reason != Reason.SECTOR or not runner.looks_anew():
                    raise
                return
        except MotionRefused as refused:
            if self._run is run:
                self._over(str(refused))
            return
        except (CommandRefused, Stopped) as error:
            if self._run is run and error.reason not in (Reason.STALL, Reason.CLOSING) and not self._control.latched:
                self._over(str(error))
                return
            raise
        if answer is None or self._run is not run or self.stopped():
            return
        if answer.seen_s is not None and live.phase is Phase.FOLLOWING and self._context is not None:
            self._reporter.sample(self._context, answer.seen_s, self._now_s)
        self._advance(answer)

    def _may_talk(self, live: Pursuit) -> bool:
        """Return whether the pursuit's next words may go out; else it is in another phase now."""
        if self._store.state.link.state is not LinkPhase.UP:
            self.interrupted(HeldReason.LINK)
            return False
        if self._store.state.holder not in (None, live.holder):
            self._yield(live)
            return False
        if self._runner.moves:
            try:
                self._control.admit(live.holder)
            except (Held, MotionRefused) as refused:
                self._over(str(refused))
                return False
            self._leads = True
        return True

    def _yield(self, live: Pursuit) -> None:
        streamed = live.phase is Phase.FOLLOWING
        self._drop()
        self._reporter.enter(Phase.YIELDED, words.yielded(self._store.state.holder))
        if streamed:
            self._come_to_rest()

    def _is_robbed(self, live: Pursuit) -> bool:
        """Return whether somebody else has control of a dish that the pursuit moves, or is about to."""
        about_to = self._leads or (self._run is not None and live.phase is Phase.COUNTDOWN)
        return about_to and self._store.state.holder not in (None, live.holder)

    @staticmethod
    def _over_at(live: Pursuit) -> float:
        return live.plan.legs[-1].end_s

    def _is_free(self, live: Pursuit) -> bool:
        state = self._store.state
        return state.holder in (None, live.holder) and state.link.state is LinkPhase.UP and not self._control.latched

    def _see_whether_to_go_on(self, live: Pursuit) -> None:
        if self._now_s >= self._over_at(live):
            self._over(words.too_late(live))
        elif live.phase is Phase.YIELDED:
            if self._is_free(live):
                self._set_out(asked=False)
        else:
            self._see_whether_all_is_well(live)

    def _see_whether_all_is_well(self, live: Pursuit) -> None:
        state, cut = self._store.state, self._interruption
        if self._control.latched:
            options = live.options
            if cut is None or not options.resume or not cut.is_as_before(state, options.resume_within_s):
                az_deg, el_deg = live.plan.sky.at(self._now_s)
                self._control.announce(live.holder, az_deg % 360.0, el_deg)
                return
            try:
                self._stopper.release(cut.stops)
            except Held:
                return
            if cut.cable_deg is not None:
                self._antenna.gate.remember_cable(cut.cable_deg)
        state = self._store.state
        at_rest = state.activity is Activity.IDLE and state.position is not None and state.position_lost is None
        if state.link.state is LinkPhase.UP and state.fault is None and at_rest:
            self._interruption = None
            self._set_out(asked=False)

    def _hear(self, notice: StageNotice) -> None:
        """The activity enters a stage."""
        live = self._live
        streamed = live is not None and live.phase is Phase.FOLLOWING
        at = None if notice.next_at_s is None else datetime.fromtimestamp(notice.next_at_s, UTC)
        phase = Phase[notice.stage.name]
        why = notice.why if live is None else words.as_steered(notice.why, phase, live.controller)
        self._reporter.enter(phase, why, notice.next_what, at)
        if live is not None and self._live is not None and self._live.phase is Phase.FOLLOWING:
            self._mover.activity(Activity.FOLLOWING, "")
        elif streamed:
            self._settle()

    def _drop(self) -> None:
        """Drop the run of the activity; what it has sent goes on."""
        run, self._run, self._leads = self._run, None, False
        if run is not None and not getattr(run, "gi_running", False):
            run.close()

    def _over(self, why: str, *, keep_lease: bool = False) -> None:
        live, leads = self._live, self._leads
        assert live is not None, "only a live one ends"
        self._drop()
        self._interruption = None
        if leads and not keep_lease:
            self._control.give_back(live.holder)
        self._reporter.enter(Phase.OVER, why)
        if live.phase is Phase.FOLLOWING and not keep_lease and not self._control.latched:
            self._settle()

    def _settle(self) -> None:
        """Watch the dish come to rest where the stream has led it."""
        self._mover.await_stream_end()

    def _come_to_rest(self) -> None:
        """Stop what the pursuit has set in motion, and hold nothing."""
        if self._control.latched or self._store.state.link.state is not LinkPhase.UP:
            return
        if self._antenna.strategy.ends_soon(self._store.clock):
            self._settle()
            return
        self._mover.fail(End.STOPPED, ENDED, Stopped(ENDED))
        self._antenna.strategy.end_motion(self._store.clock)
        self._settle()
