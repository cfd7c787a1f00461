"""What every step is made of."""

from __future__ import annotations

from collections.abc import Generator, Mapping
from concurrent.futures import Future
from typing import ClassVar

from birdcage.base.errors import BirdcageError, Held
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.setup.context import SetupContext
from birdcage.setup.step import Choice, Mark, StepView
from birdcage.station.requests import AcknowledgeFault, Release
from birdcage.station.state import FaultReason

Plan = Generator[Future[object] | None, object, None]
"""Work that takes time: yields a future to wait for, or None to be looked at again later."""

LONGEST_S = 120.0
"""Nothing that a step asks for takes longer, in seconds."""


class Step:
    """One step. The engine asks it for a view, hands it the choices, and calls `tick` often."""

    name: ClassVar[str]
    title: ClassVar[str]
    page: ClassVar[str] = ""

    def __init__(self, bench: SetupContext) -> None:
        self.bench = bench
        self.failure = ""
        """Why the last try did not work."""
        self.busy = ""
        self._plan: Plan | None = None
        self._future: Future[object] | None = None
        self._until = 0.0
        self._had_lease = False
        self._stumbled = False
        """Whether `failure` comes from looking round."""

    # What a step says of itself; each overrides what it needs.

    @property
    def proven(self) -> bool | None:
        """Whether the dish itself shows that it is done; None when it does not tell."""
        return None

    def evidence(self) -> str:
        """Say in one line what is known."""
        kept = self.bench.kept(self.name)
        return kept.evidence if kept else ""

    def words(self) -> tuple[str, ...]:
        """Say what it does."""
        return ()

    def choices(self) -> tuple[Choice, ...]:
        """Name the answers that there are now."""
        return ()

    def take(self, choice: str, values: Mapping[str, str]) -> None:
        """Do what was chosen, or begin it. BirdcageError for what can't be used."""
        raise NotImplementedError

    def look(self) -> None:
        """Notice what happened by itself."""

    # What the engine asks for.

    @property
    def mark(self) -> Mark:
        """How far it is."""
        if self.failure:
            return Mark.FAILED
        proven, kept = self.proven, self.bench.kept(self.name)
        if self.busy:
            return Mark.TODO  # half-way, the dish may look as if it were done
        if proven or (proven is None and kept is not None and kept.done):
            return Mark.DONE
        return Mark.SKIPPED if kept is not None and kept.skipped else Mark.TODO

    def view(self, number: int) -> StepView:
        """Return what to draw."""
        return StepView(
            number, self.name, self.title, self.mark, self.failure or self.evidence(), self.words(),
            () if self.busy else self.choices(), self.busy, self.page,
        )  # fmt: skip

    def choose(self, choice: str, values: Mapping[str, str]) -> None:
        """Take an answer that is among the choices."""
        self.failure = ""
        self.take(choice, values)

    def begin(self, plan: Plan, busy: str) -> None:
        """Start work that takes time; `busy` says what is under way."""
        self._plan, self._future, self.busy = plan, None, busy
        self._had_lease = self.bench.state.holder == self.bench.holder
        self._go_on()

    def tick(self) -> None:
        """Go on with what is under way, and look round."""
        if self._plan is not None:
            self._go_on()
        else:
            self._look_round()

    def _look_round(self) -> None:
        try:
            self.look()
        except BirdcageError as error:
            self.failure, self._stumbled = str(error), True
        else:
            # What could not be kept a moment ago has been kept now.
            self.failure, self._stumbled = "" if self._stumbled else self.failure, False

    def _go_on(self) -> None:
        """Carry the plan as far as it goes without waiting."""
        result: object = None
        error: BirdcageError | None = None
        if self._future is not None:
            if self._future.done():
                error, result = self._outcome(self._future)
            elif self.bench.now < self._until:
                return
            else:
                error = BirdcageError(f"Not done within {LONGEST_S:.0f} s.", reason=Reason.TIMEOUT)
        self._step(error, result)

    @staticmethod
    def _outcome(future: Future[object]) -> tuple[BirdcageError | None, object]:
        try:
            return None, future.result(0)
        except BirdcageError as error:
            return error, None

    def _step(self, error: BirdcageError | None, result: object) -> None:
        plan = self._plan
        assert plan is not None, "only the current action goes on"
        try:
            self._future = plan.send(result) if error is None else plan.throw(error)
            self._until = self.bench.now + LONGEST_S
        except StopIteration:
            self._end()
        except BirdcageError as failed:
            self._end()
            self.failure = str(failed)

    def _end(self) -> None:
        self._plan, self._future, self.busy = None, None, ""
        if not self._had_lease:
            self.bench.give_back()

    # Shared by the steps that move, or wait for the dish.

    def release_choice(self) -> tuple[Choice, ...]:
        """Offer to acknowledge a fault and to let go of HELD, where there is one."""
        fault, held = self.bench.state.fault, self.bench.state.held
        if fault is not None:
            return (Choice("release", "r", f"I have read it, go on: {fault.what}"),)
        return (Choice("release", "r", f"Release ({held.why} by {held.by or 'somebody'})"),) if held is not None else ()

    def trouble(self) -> tuple[str, ...]:
        """Say what keeps the dish from moving."""
        state = self.bench.state
        if state.fault is not None:
            return (f"{state.fault.what}. {state.fault.meaning} {state.fault.remedy}",)
        if state.held is not None:
            return (f"{state.held.sentence} Nothing moves until you release it.",)
        if state.motion_refused_because is not None:
            return (state.motion_refused_because,)
        return () if self.bench.is_up else (f"The dish does not answer: {state.link.detail or 'no link'}. See step 1.",)

    def release(self) -> Plan:
        """Acknowledge and release; nothing moves by it."""
        # Both are asked for now: a STOP that comes later is none that this releases.
        asked = [self.bench.ask(AcknowledgeFault(self.bench.holder)), self.bench.ask(Release(self.bench.holder))]
        yield from asked

    def release_after_restart(self) -> Plan:
        """Let go of what the dish's own search or a restart has latched; a person's STOP holds."""
        state = self.bench.state
        if state.held is not None and (state.held.reason is HeldReason.STOP or state.held.earlier):
            raise Held(f"{state.held.sentence} Release it first.")
        if state.fault is not None and state.fault.reason not in (
            FaultReason.MOVED,
            FaultReason.REBOOT,
            FaultReason.UNHOMED,
        ):
            raise Held(f"Acknowledge the fault first: {state.fault.what}.", reason=Reason.FAULT)
        yield from self.release()
