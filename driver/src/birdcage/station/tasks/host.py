"""Hosts every task: begins, drives, interrupts and ends them, and keeps them for the program that comes after."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future
from contextlib import suppress

from birdcage.base.errors import BirdcageError, CommandRefused, LeaseDenied, MotionRefused, Stopped
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.station.events import TaskChanged
from birdcage.station.parts import Parts
from birdcage.station.speed_restorer import SpeedRestorer
from birdcage.station.state import LinkPhase
from birdcage.station.task import Task
from birdcage.station.task_state import TaskPhase, TaskValue
from birdcage.station.tasks import words
from birdcage.station.tasks.drive import DriveTask
from birdcage.station.tasks.kept import TaskFile
from birdcage.station.tasks.run import TaskRun


class TaskHost:
    """`due` and `tick` belong to the station's loop, the rest to its requests and its alarms.

    One task moves the dish; those of other holders wait until they may go on. A new task replaces that of its kind.
    """

    def __init__(self, parts: Parts, file: TaskFile) -> None:
        self._parts, self._store, self._control = parts, parts.store, parts.control
        self._file = file
        self._runs: tuple[TaskRun, ...] = ()
        self._number = 0
        self._closing = False
        self.speeds = SpeedRestorer(parts.store, parts.antenna, parts.reader)
        """Those of the dish that a task has changed."""
        parts.signals.interrupted.connect(self.interrupted)
        parts.store.change(kept_task=file.kept)

    # What faces ask for

    def begin(self, task: Task, *, asked: bool = True, future: Future[object] | None = None) -> TaskRun:
        """Begin a task. LinkError, Held, MotionRefused, LeaseDenied: nothing has changed."""
        self._parts.require_link("nothing is begun")
        self._control.refuse(task.holder)
        before = self.find(task.kind)
        if before is not None and before.leads and before.task.holder != task.holder:
            raise LeaseDenied(f"{before.task.holder} has control. Take control first, or wait.")
        for run in self._runs:
            # Two tasks of one holder would both have control, and pull the dish to and fro.
            moves = run.leads or run.state.phase is TaskPhase.COUNTDOWN
            if run is before or (moves and run.task.holder == task.holder):
                self._end(run, words.replaced(run.task.kind, task.kind))
        self._number += 1
        run = TaskRun(self._parts, task, self._number, self.speeds, self._changed, future)
        self._runs += (run,)
        run.set_out(asked=asked)
        return run

    def begin_kind(self, kind: str, values: Mapping[str, TaskValue], holder: str, *, asked: bool) -> TaskRun:
        """Begin a task by its kind. CommandRefused: there is none, or it does not take these values."""
        try:
            task = self._parts.settings.tasks[kind](**{**values, "holder": holder})
        except KeyError:
            kinds = ", ".join(self._parts.settings.tasks) or "none"
            raise CommandRefused(f"There is no task called {kind}: {kinds}.", reason=Reason.UNKNOWN) from None
        except TypeError as error:
            raise CommandRefused(f"The {kind} can't begin: {error}.", reason=Reason.BAD_PARAMETER) from None
        return self.begin(task, asked=asked)

    def resume(self) -> TaskRun:
        """Take up what the program before this one did not finish. CommandRefused (`absent`) if there is nothing."""
        run = self.begin(self._file.again())
        self._file.kept = None
        self._store.change(kept_task=None)
        return run

    def drive(self, holder: str, az: int, el: int) -> None:
        """Keep the dish going in a direction, from now on or still."""
        run = self.find(DriveTask.kind)
        if run is not None and isinstance(run.task, DriveTask) and run.task.holder == holder:
            run.task.hold(az, el)
        else:
            self.begin(DriveTask(self._parts.antenna, self._store.clock, holder, az, el))

    def drop_kept(self) -> None:
        """What the program before this one did not finish is not taken up any more."""
        self._file.drop()
        self._store.change(kept_task=None)

    def find(self, kind: str) -> TaskRun | None:
        """Return the task of a kind that is not over."""
        return next((run for run in self._runs if run.task.kind == kind), None)

    def end(self, kind: str, by: str) -> None:
        """End the task of a kind, and what it has set in motion. Nothing happens when there is none."""
        if (run := self.find(kind)) is not None:
            self._end(run, words.ended_by(by))

    def end_all_of(self, holder: str) -> None:
        """End every task of a holder, and what it has set in motion."""
        for run in self._runs:
            if run.task.holder == holder:
                self._end(run, words.ended_by(holder))

    @staticmethod
    def _end(run: TaskRun, why: str) -> None:
        leads = run.leads
        run.over(why)
        if leads:
            run.come_to_rest()

    def make_way(self, holder: str) -> None:
        """Somebody is about to move the dish: a task of theirs that has changed its speeds ends, and restores them.

        So does one that runs a motor, with STOP.

        Else it goes on until the dish has taken the motion: see `by_hand`.
        """
        if self.speeds.are_changed or self._parts.antenna.moving.motor_runs:
            self.by_hand(holder)
        if self.speeds.are_changed:
            self.restore()

    def by_hand(self, holder: str) -> None:
        """Somebody moves the dish: that ends their own task. One that has lost control to them leaves it to them."""
        for run in self._runs:
            about_to = run.leads or run.state.phase is TaskPhase.COUNTDOWN
            if run.task.holder == holder and about_to:
                run.over(words.by_hand(holder), keep_lease=True)
            elif about_to and self._store.state.holder not in (None, run.task.holder):
                run.give_way(words.yielded(holder))

    @property
    def moves_unattended(self) -> bool:
        """Whether a task moves the dish, or is about to, that may do so with no person near."""
        return any(run.task.is_unattended and (run.leads or run.state.phase is TaskPhase.COUNTDOWN)
                   for run in self._runs)  # fmt: skip

    # The station's loop

    def due(self, now: float) -> float | None:
        """Return when there is something to do, in monotonic seconds; None if nothing waits for a time."""
        times = (run.due(now) for run in self._runs)
        return min((time for time in times if time is not None), default=None)

    def tick(self) -> None:
        """Go on with the task that is due, the one that has control first."""
        now = self._store.clock.monotonic()
        for run in sorted(self._runs, key=lambda run: not run.leads):
            due = run.due(now)
            if due is not None and due <= now:
                run.tick()
                return

    @property
    def restore_due(self) -> bool:
        """Whether speeds that a task has changed are to be put back now, before anything else moves."""
        if not self.speeds.are_changed or self._parts.stopper.is_pending:
            return False
        return not any(run.keeps_speeds for run in self._runs)

    def restore(self) -> None:
        """Put them back. What the dish refuses is told as a fault, and not tried again."""
        try:
            self.speeds.restore()
        except (CommandRefused, MotionRefused) as refused:
            self.speeds.forget()
            self._parts.signals.speed_stuck(str(refused))

    def stopped(self) -> None:
        """Take in that STOP, or a fault, has latched meanwhile. Sends nothing."""
        for run in self._runs:
            run.stopped()

    def interrupted(self, reason: HeldReason) -> None:
        """The dish is out of sight, has restarted, or the clock has stepped: it stays still. Sends nothing."""
        if reason is HeldReason.FAULT:
            self.speeds.forget()
        for run in self._runs:
            run.interrupted(reason)

    def shut(self) -> None:
        """The station ends: put speeds back as far as that can be done."""
        self._closing = True
        for run in self._runs:
            run.over(words.CLOSED, error=Stopped(words.CLOSED, reason=Reason.CLOSING))
        self._file.close()
        if self.speeds.are_changed and self._store.state.link.state is LinkPhase.UP:
            with suppress(BirdcageError):
                self.speeds.restore()

    def _changed(self, run: TaskRun) -> None:
        """Show a task, tell of it, and keep it for the program that comes after."""
        if not run.is_live:
            self._runs = tuple(other for other in self._runs if other is not run)
        shown = tuple(other.state for other in self._runs)
        self._store.change(tasks=shown)
        self._store.tell(TaskChanged(*self._store.stamp(), run.state))
        if run.is_live:
            self._file.keep(run.task, self._store.clock.utc())
        elif not self._closing:  # what was ended in order by the end of the program is taken up again by the next
            self._file.forget(run.task)
