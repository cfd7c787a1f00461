"""The pursuit as a task: carries out a plan, and tells how well the dish points."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.base.errors import LeaseDenied
from birdcage.station.parts import Parts
from birdcage.station.pursuit_contexts import context_for, controller_that_suits, refuse
from birdcage.station.pursuit_reporter import PursuitReporter
from birdcage.station.pursuit_state import DONE, Phase, Pursuit
from birdcage.station.task import Report, Task
from birdcage.station.task_state import TaskPhase
from birdcage.station.tasks.host import TaskHost
from birdcage.station.tasks.run import TaskRun, utc_of
from birdcage.tracking.steps import StepResult, Steps

if TYPE_CHECKING:
    from birdcage.station.requests import Pursue
    from birdcage.tracking.plan import Plan
    from birdcage.tracking.pursuit_context import StageNotice

UNREAD = "The dish does not tell where it rests. birdcage assumes it is where it was sent."
PHASES = {Phase.WAITING: TaskPhase.WAITING, Phase.COUNTDOWN: TaskPhase.COUNTDOWN}
"""The stages of a pursuit in which it does not run yet."""


class PursuitTask(Task):
    """One pursuit. Its steps count down by themselves: they know when the dish has to leave."""

    kind = "pursuit"
    counts_down = False
    done_words = DONE
    resume_words = "Release it to resume while the pass lasts."

    def __init__(self, request: Pursue, parts: Parts, reporter: PursuitReporter, number: int) -> None:
        """MotionRefused (`controller`) where the controller that was asked for must not steer this dish."""
        self.holder, options = request.holder, request.options
        self.resumes, self.resume_within_s = options.resume, options.resume_within_s
        self._store, self._reporter = parts.store, reporter
        self.context, name = context_for(request, parts.store, parts.antenna, self._hear)
        at = parts.store.clock.monotonic()
        self._pursuit = Pursuit(
            number, request.holder, request.plan, options, Phase.WAITING, at, "", controller=name
        )  # fmt: skip

    def bind(self, report: Report) -> None:
        """Begin to tell."""
        self._report = report
        self._reporter.begin(self._pursuit)

    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Join the plan at this moment."""
        from birdcage.tracking.pursuit_steps import pursue

        self.context.asked = asked
        return pursue(self.context, now_s)

    @property
    def live(self) -> Pursuit:
        """The pursuit as it is told."""
        live = self._reporter.live
        assert live is not None, "this is asked of one that is not over"
        return live

    @property
    def streams(self) -> bool:
        """Whether it follows."""
        live = self._reporter.live
        return live is not None and live.phase is Phase.FOLLOWING

    @property
    def ends_at_s(self) -> float:
        """The end of its last leg."""
        return self.live.plan.legs[-1].end_s

    def goes_to(self, now_s: float) -> tuple[float, float]:
        """Return where the target is."""
        az_deg, el_deg = self.live.plan.sky.at(now_s)
        return az_deg % 360.0, el_deg

    def replace(self, plan: Plan, now_s: float) -> None:
        """Go on by another plan of the same pass."""
        self.context.replace(plan, now_s)
        self._reporter.change(plan=self.context.plan)

    def suit(self, parts: Parts) -> None:
        """The dish takes commands otherwise than was known: steer accordingly from the next leg on."""
        name, self.context.controller = controller_that_suits(self.live.options, parts.antenna)
        self._reporter.change(controller=name)

    def heard(self, answer: StepResult, now_s: float) -> None:
        """Tell how well the dish points, after each reading while it follows."""
        if answer.seen_s is not None and self.streams:
            self._reporter.sample(self.context, answer.seen_s, now_s)

    def entered(self, phase: TaskPhase, why: str, *, is_done: bool) -> None:  # noqa: ARG002 - `why` says it
        """Tell of what the host has decided."""
        self._reporter.enter(Phase[phase.name], why)

    def _hear(self, notice: StageNotice) -> None:
        """The steps enter a stage."""
        at, phase = utc_of(notice.next_at_s), Phase[notice.stage.name]
        unread = phase is Phase.FOLLOWING and self.live.controller == "modelled"
        why = f"{notice.why} {UNREAD}" if unread else notice.why
        self._reporter.enter(phase, why, notice.next_what, at)
        self._report(PHASES.get(phase, TaskPhase.RUNNING), why, notice.next_what, at)


class Pursuits:
    """Takes on what faces want followed: a new pursuit, or a better plan for the one under way."""

    def __init__(self, parts: Parts, host: TaskHost) -> None:
        self._parts, self._host = parts, host
        self._reporter = PursuitReporter(parts.store, parts.antenna)
        self._number = 0
        parts.signals.waits.connect(self._suit_dish)

    @property
    def _run(self) -> tuple[TaskRun, PursuitTask] | None:
        run = self._host.find(PursuitTask.kind)
        return None if run is None or not isinstance(run.task, PursuitTask) else (run, run.task)

    def take_on(self, request: Pursue) -> int:
        """Begin a pursuit, or give the one under way another plan; return its number.

        MotionRefused (`unreachable`, `over`, `controller`, …), Held, LinkError: nothing has changed.
        """
        parts, found = self._parts, self._run
        live = None if found is None else found[1].live
        now_s = parts.store.clock.utc().timestamp()
        if request.renews is not None and (live is None or live.number != request.renews):
            return request.renews
        refuse(request.plan, now_s)
        if found is not None and live is not None and live.holder == request.holder:
            run, task = found
            if live.plan.is_same_pass(request.plan):
                task.replace(request.plan, now_s)
                run.hurry()
                return live.number
        parts.require_link("nothing is followed")
        task = PursuitTask(request, parts, self._reporter, self._number + 1)
        parts.antenna.gate.require_position()
        parts.control.refuse(request.holder)
        if found is not None and live is not None and found[0].leads and live.holder != request.holder:
            raise LeaseDenied(f"{live.holder} follows {live.plan.aim.name}. Take control first, or wait.")
        self._number += 1
        self._host.begin(task, asked=request.asked)
        return self._number

    def end(self, by: str) -> None:
        """End the pursuit, and what it has set in motion. Nothing happens when there is none."""
        self._host.end(PursuitTask.kind, by)

    def _suit_dish(self) -> None:
        if (found := self._run) is not None:
            found[1].suit(self._parts)
