"""The line that a person typed and that has no answer yet: waited for, ended by Enter, or given up."""

from __future__ import annotations

import math
from concurrent.futures import Future
from dataclasses import dataclass

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.motion import DishMotion
from birdcage.base.errors import BirdcageError, CommandRefused, LinkError, NoReply, Stopped
from birdcage.base.reason import Reason
from birdcage.rotator.raw import RawAnswer, RawExchange, RawLines
from birdcage.rotator.verdict import Verdict
from birdcage.station.boot_log import BootLogKeeper
from birdcage.station.dish_reader import DishReader
from birdcage.station.raw import RawReply
from birdcage.station.raw_effects import RawEffects
from birdcage.station.state import LinkPhase
from birdcage.station.state_store import StateStore
from birdcage.station.stopper import Stopper

LONGEST_S = 60.0
"""How long a line may print on before Enter ends it, unless it is known to take longer."""
STREAM_QUIET_S = 5.0
"""How long a stream may pause."""
PROMPT_S = 0.3
"""How long an answer that is due at once is waited for when somebody else wants the console."""


@dataclass(slots=True)
class SentLine:
    """What went out, who waits for it, and what to put back should the dish refuse it."""

    raw: RawLines
    typed: RawExchange
    text: str
    verdict: Verdict
    future: Future[object]
    model: DishMotion | None
    model_before: DishMotion | None

    @property
    def ends_at(self) -> float:
        """When Enter ends it at the latest, in monotonic seconds."""
        return self.typed.sent + max(LONGEST_S, self.verdict.takes_s)


class LineUnderWay:
    """At most one. Its future is resolved when the answer came, or when something else ended it."""

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, stopper: Stopper, reader: DishReader, effects: RawEffects
    ) -> None:
        self._store, self._antenna = store, antenna
        self._stopper, self._reader, self._effects = stopper, reader, effects
        self._line: SentLine | None = None
        self.answered_at = -math.inf
        """When the last answer came, in monotonic seconds."""

    def begin(self, line: SentLine) -> None:
        """A line has gone out. There is no other."""
        self._line = line

    def due(self) -> float | None:
        """Return when to look at it; None when there is none."""
        line = self._line
        if line is None:
            return None
        if line.typed.answer is not None:
            return line.typed.sent
        # What talks may go on to its end, what is silent had its time.
        pause_s = STREAM_QUIET_S if line.verdict.streams else line.raw.delay_s
        return min(line.ends_at, max(line.typed.due, line.typed.heard_at + pause_s))

    def tick(self) -> None:
        """Take the answer, or end what has no end. NoReply when neither came in time."""
        line = self._line
        if line is None:
            return
        if (answer := line.typed.answer) is not None:
            self._answered(line, answer)
        elif self._store.clock.monotonic() >= line.ends_at:
            self._end_by_key(line)
        else:
            raise self._unanswered(line)

    def make_way(self) -> None:
        """End it, for something else that needs the wire. CommandRefused while the dish is at work on it."""
        line = self._line
        if line is None:
            return
        if line.verdict.takes_s > 0 and not line.verdict.streams and self._store.clock.monotonic() < line.typed.due:
            raise CommandRefused(f"The dish is still at `{line.text}`. Wait, or STOP.", reason=Reason.BUSY)
        self.finish()

    def finish(self) -> None:
        """Have its answer: by itself where that is due, else by Enter."""
        line = self._line
        if line is None:
            return
        if not line.verdict.streams:
            left_s = line.typed.due - self._store.clock.monotonic()
            try:
                answer = line.typed.wait(left_s if line.verdict.homes else min(left_s, PROMPT_S))
            except BaseException as error:
                self._failed(line, error)
                raise
            if answer is not None:
                self._answered(line, answer)
                return
        self._end_by_key(line)

    def shut(self) -> None:
        """The station ends: nothing that a person started may print on without end."""
        line, self._line = self._line, None
        if line is None:
            return
        if line.typed.answer is None and self._antenna.is_connected and self._store.state.link.state is LinkPhase.UP:
            try:
                line.typed.end()
            except LinkError as error:
                line.future.set_exception(error)
                return
        line.future.set_exception(Stopped("The station has ended.", reason=Reason.CLOSING))

    def homing_ends(self) -> None:
        """Whatever keeps the shell busy with homing is over: STOP gets through again."""
        if self._antenna.moving.busy is not None:
            self._antenna.moving.keep_busy(None)
            self._stopper.resume()

    # How it is done: nothing below is called from outside.

    def _end_by_key(self, line: SentLine) -> None:
        try:
            line.typed.end()
            answer = line.typed.wait(line.raw.delay_s)
        except BaseException as error:
            self._failed(line, error)
            raise
        if answer is None:
            raise self._unanswered(line)
        self._answered(line, answer, by_key=line.raw.has_prompt)

    def _unanswered(self, line: SentLine) -> NoReply:
        silence = line.typed.give_up()
        self._failed(line, silence)
        return silence

    def _failed(self, line: SentLine, error: BaseException) -> None:
        self._line = None
        self.homing_ends()
        line.future.set_exception(
            error if isinstance(error, BirdcageError) else Stopped("The station has failed.", reason=Reason.CLOSING)
        )

    def _answered(self, line: SentLine, answer: RawAnswer, *, by_key: bool = False) -> None:
        self._line, self.answered_at = None, self._store.clock.monotonic()
        self._reader.elsewhere = answer.place != line.raw.home
        self.homing_ends()
        if answer.refused and line.model is not None:
            self._antenna.moving.take_back(line.model, line.model_before)
        if not answer.refused:
            self._effects.taken(line.verdict)
        self._effects.hear(answer.boot_lines, line.verdict)
        if line.verdict.restarts and answer.boot_lines:
            BootLogKeeper(self._store).asked_for(answer.lines)
        took_s = self.answered_at - line.typed.sent
        line.future.set_result(
            RawReply(line.text, answer.lines, answer.place, answer.prompt, took_s, ended_by_key=by_key)
        )
