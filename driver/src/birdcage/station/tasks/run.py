"""One task between its begin and its end: its lease, countdown, interruptions, and what ends it."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from datetime import UTC, datetime, timedelta

from birdcage.base.errors import BirdcageError, CommandRefused, Held, MotionRefused, Stopped
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.station.interruption import Interruption
from birdcage.station.parts import Parts
from birdcage.station.speed_restorer import SpeedRestorer
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.step_runner import StepRunner
from birdcage.station.task import Task
from birdcage.station.task_state import TaskPhase, TaskState
from birdcage.station.tasks import words
from birdcage.tracking.steps import PointAt, StepResult, Steps

POLL_S = 0.2
"""How often a task that cannot go on looks whether it can."""
COUNTDOWN_S = 5.0
"""Before motion that no person has just asked for (`docs/decisions/0017-the-pursuit-and-the-lease.md`)."""
BEYOND = (Reason.LIMIT, Reason.AZ_LIMIT, Reason.EL_LIMIT, Reason.FLOOR, Reason.WRAP, Reason.SECTOR)
"""Why the gate does not let the dish go somewhere, however it stands."""
QUIET = (TaskPhase.WAITING, TaskPhase.YIELDED)
"""Where nothing of a task's moves, nor is about to."""


class TaskRun:
    """For the host alone, which is told of each change by `on_change`."""

    def __init__(
        self, parts: Parts, task: Task, number: int, speeds: SpeedRestorer, on_change: Callable[[TaskRun], None],
        future: Future[object] | None = None,
    ) -> None:  # fmt: skip
        """`future` is resolved at its end: with the task's result, or with what kept it from one."""
        self._parts, self._store, self._antenna, self._control = parts, parts.store, parts.antenna, parts.control
        self.task, self._on_change, self._future = task, on_change, future
        self._runner = StepRunner(parts, task.holder, speeds)
        self._runner.sweeping.on_part = self._show
        self._steps: Steps | None = None
        self._interruption: Interruption | None = None
        self.leads = False
        """Whether it has taken the lease since it began or went on."""
        self._moves_at_s = float("-inf")
        """When its first motion may begin, by the clock's UTC: after a countdown."""
        self._counted = True
        """Whether that countdown is over, or none was needed."""
        self._poll_at = 0.0
        self._asks = False
        """Whether it waits for the owner's command to say that the dish may move."""
        self._objected = False
        """Whether that has said *not now*, and the task goes on when it no longer does."""
        self._streamed = False
        at = self._store.clock.monotonic()
        self.state = TaskState(number, task.kind, task.holder, TaskPhase.WAITING, at, "")
        task.bind(self._report)

    @property
    def is_live(self) -> bool:
        """Whether it is not over."""
        return self.state.phase is not TaskPhase.OVER

    @property
    def streams(self) -> bool:
        """Whether it keeps the dish in motion now."""
        return self._steps is not None and self.task.streams

    @property
    def keeps_speeds(self) -> bool:
        """Whether the speeds that it has changed stay so now."""
        return self._steps is not None and self.task.keeps_speeds

    def hurry(self) -> None:
        """End a wait of its steps: what they wait for has changed."""
        self._runner.hurry = True

    # The station's loop

    def due(self, now: float) -> float | None:
        """Return when there is something to do: `now` (monotonic) for at once; None while it waits for the mover."""
        if self._is_robbed() or self._is_objected() or (self.state.phase is TaskPhase.YIELDED and self._is_free()):
            return now
        if self._steps is None:
            return self._poll_at
        if self._control.latched:
            return now + POLL_S
        if not self._counted and self._runner.moves:
            clock = self._store.clock
            return now + max(0.0, self._moves_at_s - self._runner.now_s) / clock.rate
        due = self._runner.due(now)
        return max(due, self._poll_at) if self._asks and due is not None else due

    def tick(self) -> None:
        """Go on, as far as one exchange."""
        if self.stopped():
            return
        self._poll_at = self._store.clock.monotonic() + POLL_S
        if self._steps is None:
            self._see_whether_to_go_on()
        elif self._is_robbed():
            self._yield()
        elif self._is_objected():
            self._object()
        else:
            self._go_on()

    def stopped(self) -> bool:
        """Take in that STOP, or a fault, has latched meanwhile; return whether the task is over. Sends nothing."""
        held, phase = self._store.state.held, self.state.phase
        if not self.is_live:
            return True
        if not self._control.latched or held is None:
            return False
        if held.reason is not HeldReason.STOP and phase is TaskPhase.INTERRUPTED:
            return False
        if held.reason not in (HeldReason.STOP, HeldReason.FAULT):
            # While it waited: a latch that closes for what became of somebody else's motion.
            self._interrupt(held.reason)
            return False
        why = words.held(held, self._store.state.fault)
        self.over(f"{why} {self.task.cut_words}".rstrip())
        return True

    def interrupted(self, reason: HeldReason) -> None:
        """The dish is out of sight, has restarted, or the clock has stepped: it stays still. Sends nothing."""
        if self.state.phase is TaskPhase.INTERRUPTED or (reason is HeldReason.LINK and self.state.phase in QUIET):
            return
        self._interrupt(reason)

    def _interrupt(self, reason: HeldReason) -> None:
        state, now = self._store.state, self._store.clock.monotonic()
        self._interruption = Interruption.now(reason, now, self._parts.stopper.count, state, self._antenna)
        self._drop()
        self._enter(TaskPhase.INTERRUPTED, words.interrupted(reason, self.task))
        if not self.task.goes_on:
            self.over(words.interrupted(reason, self.task))

    # Its steps

    def set_out(self, *, asked: bool) -> None:
        """Begin, or go on: `asked` if a person has just asked for that."""
        self._objected = False
        self.leads, self._counted = False, asked or not self.task.counts_down
        self._runner.begin()
        self._steps = self.task.steps(self._runner.now_s, asked=asked)
        if self.task.counts_down:
            self._enter(TaskPhase.RUNNING if asked else TaskPhase.WAITING, "")
        self._advance(None)

    def _advance(self, answer: StepResult | None) -> None:
        steps = self._steps
        assert steps is not None, "somebody drives it"
        try:
            step = next(steps) if answer is None else steps.send(answer)
        except StopIteration:
            if self._steps is steps:
                self.over(self.task.end_words, is_done=True)
            return
        except BirdcageError as error:  # of what it waits for beside the dish
            if self._steps is steps:
                self.over(str(error), error=error)
            return
        if self._steps is not steps:
            return
        self._runner.take(step)
        state = self.state
        if (*(self.task.progress or (None, None)), self.task.found) != (state.done, state.of, state.found):
            self._show()
        if not self._counted and self._runner.moves and self.state.phase is not TaskPhase.COUNTDOWN:
            self._moves_at_s = self._runner.now_s + COUNTDOWN_S
            at = self._store.clock.utc() + timedelta(seconds=COUNTDOWN_S)
            self._enter(TaskPhase.COUNTDOWN, "The dish is about to move.", self.task.kind, at)

    def _go_on(self) -> None:
        runner, steps = self._runner, self._steps
        if not self._counted and runner.moves:
            if runner.now_s < self._moves_at_s:
                return
            self._counted = True
            self._enter(TaskPhase.RUNNING, "")
        if runner.needs_wire and not self._may_talk():
            return
        try:
            try:
                answer = runner.carry_out()
            except MotionRefused as refused:
                if isinstance(runner.step, PointAt) and runner.step.optional and refused.reason in BEYOND:
                    answer = StepResult(runner.now_s)
                elif refused.reason is not Reason.SECTOR or not runner.looks_anew():
                    raise
                else:
                    return
        except MotionRefused as refused:
            if self._steps is steps:
                self.over(str(refused), error=refused)
            return
        except (CommandRefused, Stopped) as error:
            if self._steps is steps and not self._is_anothers(error):
                self.over(str(error), error=error)
                return
            raise
        except BirdcageError as error:
            if self._steps is steps and not self.task.goes_on:
                self.over(str(error), error=error)
            raise
        if answer is None or self._steps is not steps or self.stopped():
            return
        self.task.heard(answer, runner.now_s)
        self._advance(answer)

    def _is_anothers(self, error: BirdcageError) -> bool:
        """Return whether somebody else acts on what was raised, and ends the task by that."""
        if self._control.latched or error.reason in (Reason.STALL, Reason.CLOSING):
            return True
        return isinstance(error, CommandRefused) and error.trouble is not None and not self.task.goes_on

    def _may_talk(self) -> bool:
        """Return whether the task's next words may go out; else it is in another phase now."""
        if self._store.state.link.state is not LinkPhase.UP:
            self.interrupted(HeldReason.LINK)
            return False
        if self._store.state.holder not in (None, self.task.holder):
            self._yield()
            return False
        if self._runner.moves:
            self._asks = self.task.is_unattended and not self._parts.guard.allows()
            if self._asks:
                if self._parts.guard.objection:
                    self._object()
                return False
            try:
                self._control.admit(self.task.holder)
            except (Held, MotionRefused) as refused:
                self.over(str(refused), error=refused)
                return False
            self.leads = True
        return True

    def _see_whether_to_go_on(self) -> None:
        if self._runner.now_s >= self.task.ends_at_s:
            yielded_to = self.state.why if self.state.phase is TaskPhase.YIELDED else ""
            self.over(words.too_late(self.task.kind, yielded_to=yielded_to))
        elif self.state.phase is TaskPhase.YIELDED:
            if self._is_free():
                self.set_out(asked=False)
        else:
            self._see_whether_all_is_well()

    def _see_whether_all_is_well(self) -> None:
        state, cut, task = self._store.state, self._interruption, self.task
        if self._control.latched:
            if cut is None or not task.resumes or not cut.is_as_before(state, task.resume_within_s):
                self._control.announce(task.holder, *(task.goes_to(self._runner.now_s) or (None, None)))
                return
            try:
                self._parts.stopper.release(cut.stops)
            except Held:
                return
            if cut.cable_deg is not None:
                self._antenna.gate.remember_cable(cut.cable_deg)
        state = self._store.state
        at_rest = state.activity is Activity.IDLE and state.position is not None and state.position_lost is None
        if state.link.state is LinkPhase.UP and state.fault is None and at_rest:
            self._interruption = None
            self.set_out(asked=False)

    # Who has control

    def _yield(self) -> None:
        self.give_way(words.yielded(self._store.state.holder), come_to_rest=self.task.streams)

    def give_way(self, why: str, *, come_to_rest: bool = False) -> None:
        """Somebody else has control: leave the dish to them."""
        self._drop()
        if not self.task.goes_on:
            self.over(why)
            return
        self._enter(TaskPhase.YIELDED, why)
        if come_to_rest:
            self.come_to_rest()

    def _is_objected(self) -> bool:
        """Return whether the owner's command has said *not now* while the task moves the dish, or is about to."""
        about_to = self.leads or (self._steps is not None and self.state.phase is TaskPhase.COUNTDOWN)
        return about_to and self.task.is_unattended and bool(self._parts.guard.objection)

    def _object(self) -> None:
        """Leave the dish alone until the command no longer objects."""
        moves, self._objected, self._asks = self.leads, True, False
        self.give_way(self._parts.guard.objection, come_to_rest=moves)
        if self.task.gives_back:
            self._control.give_back(self.task.holder)

    def _is_robbed(self) -> bool:
        """Return whether somebody else has control of a dish that the task moves, or is about to."""
        about_to = self.leads or (self._steps is not None and self.state.phase is TaskPhase.COUNTDOWN)
        return about_to and self._store.state.holder not in (None, self.task.holder)

    def _is_free(self) -> bool:
        state = self._store.state
        mine = state.holder in (None, self.task.holder)
        if not mine or state.link.state is not LinkPhase.UP or self._control.latched:
            return False
        return not self._objected or self._parts.guard.allows()

    # What is told, and how it ends

    def _report(self, phase: TaskPhase, why: str, next_what: str, next_at: datetime | None) -> None:
        """The task tells of a stage of its own."""
        streamed, self._streamed = self._streamed, self.task.streams
        self._show(phase, why, next_what, next_at)
        if self._streamed:
            self._parts.mover.activity(Activity.FOLLOWING, "")
        elif streamed:
            self._settle()

    def _enter(
        self, phase: TaskPhase, why: str, next_what: str = "", next_at: datetime | None = None, *, is_done: bool = False
    ) -> None:
        self._streamed = False
        self.state = replace(self.state, is_done=is_done)
        self.task.entered(phase, why, is_done=is_done)
        self._show(phase, why, next_what, next_at)

    def _show(
        self, phase: TaskPhase | None = None, why: str = "", next_what: str = "", next_at: datetime | None = None
    ) -> None:
        """Show how far it is; with a phase, that it is in this one from now on."""
        done, of = self.task.progress or (None, None)
        self.state = replace(self.state, done=done, of=of, found=self.task.found)
        if phase is not None:
            since = self._store.clock.monotonic()
            self.state = replace(
                self.state, phase=phase, why=why, since=since, next_what=next_what, next_at=next_at
            )  # fmt: skip
        self._on_change(self)

    def _drop(self) -> None:
        """Drop its steps; what they have sent goes on."""
        steps, self._steps, self.leads = self._steps, None, False
        if steps is not None and not getattr(steps, "gi_running", False):
            steps.close()
        self._runner.drop()

    def over(
        self, why: str, *, keep_lease: bool = False, is_done: bool = False, error: BirdcageError | None = None
    ) -> None:
        """It ends here: done, or for the reason given."""
        streamed, leads = self.task.streams, self.leads
        self._drop()
        self._interruption = None
        if leads and self.task.gives_back and not keep_lease:
            self._control.give_back(self.task.holder)
        self._enter(TaskPhase.OVER, why, is_done=is_done)
        if streamed and not keep_lease and not self._control.latched:
            self._settle()
        if self._future is not None and not self._future.done():
            if is_done:
                self._future.set_result(self.task.result())
            else:
                self._future.set_exception(error or Stopped(why))

    def _settle(self) -> None:
        """Watch the dish come to rest where the stream has led it."""
        self._parts.mover.await_stream_end()

    def come_to_rest(self) -> None:
        """Stop what the task has set in motion, and hold nothing."""
        self._parts.come_to_rest(words.ended(self.task.kind))


def utc_of(at_s: float | None) -> datetime | None:
    """Return a time in POSIX seconds as UTC."""
    return None if at_s is None else datetime.fromtimestamp(at_s, UTC)
