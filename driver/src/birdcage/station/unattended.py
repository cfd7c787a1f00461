"""Has the owner's command asked whether the dish may move unattended, and keeps what it said."""

from __future__ import annotations

from birdcage.station.events import NotNowChanged
from birdcage.station.not_now import ANSWER_S, NotNow, NotNowAnswer
from birdcage.station.state_store import StateStore

LOOK_S = 0.1
"""How often it is looked whether it has ended."""
LINGER_S = 10.0
"""How long it is asked on after somebody last wanted to know."""


class UnattendedGuard:
    """Asked before each unattended motion, and every few seconds during one. The station's thread."""

    def __init__(self, store: StateStore, not_now: NotNow | None) -> None:
        """Without a command everything may move."""
        self._store, self._not_now = store, not_now
        self._running: NotNowAnswer | None = None
        self._look_at = 0.0
        self._until = 0.0
        """Until when somebody wants to know."""
        self._ask_at = 0.0
        self._good_until = 0.0
        """Until when the last *go on* counts."""

    def allows(self) -> bool:
        """Return whether the dish may move now though no person has just asked for it; have it asked from now on."""
        if self._not_now is None:
            return True
        now = self._store.clock.monotonic()
        self._until = now + LINGER_S
        return not self._store.state.not_now and now < self._good_until

    @property
    def shelter(self) -> tuple[float, float] | None:
        """Where the dish goes on *not now*, true azimuth and elevation; None: it stays where it comes to rest."""
        return None if self._not_now is None else self._not_now.park

    @property
    def objection(self) -> str:
        """Why not, as a sentence; empty if it may move, or no answer has come yet."""
        return self._store.state.not_now

    def due(self, now: float, *, moves: bool) -> float | None:
        """Return when there is something to do; `moves`: something moves unattended now, or is about to.

        Monotonic seconds; None if there is no command, or no need to ask it.
        """
        if self._running is not None:
            return self._look_at
        wanted = self._not_now is not None and (moves or now < self._until)
        return self._ask_at if wanted else None

    def tick(self) -> None:
        """Start the command, or take its answer."""
        now = self._store.clock.monotonic()
        if self._not_now is None:
            return
        if self._running is None:
            self._ask_at = now + self._not_now.every_s
            self._running = self._not_now.ask(self._not_now.command)
        self._look_at = now + LOOK_S
        if self._running.over:
            answer, self._running = self._running, None
            self._take(answer, now)

    def _take(self, answer: NotNowAnswer, now: float) -> None:
        assert self._not_now is not None, "a command has answered"
        if answer.status == 0:
            self._good_until = now + self._not_now.every_s + 2.0 * ANSWER_S
            self._tell("")
        elif answer.status is None:
            self._tell("Not now: the command of station.not_now can't be started.")
        elif answer.status < 0:
            self._tell(f"Not now: the command of station.not_now gave no answer in {ANSWER_S:g} s.")
        else:
            why = answer.first_line.strip().rstrip(".")
            self._tell(f"Not now: {why}." if why else "Not now, says the command of station.not_now.")

    def _tell(self, sentence: str) -> None:
        if sentence != self._store.state.not_now:
            self._store.change(not_now=sentence)
            self._store.tell(NotNowChanged(*self._store.stamp(), sentence))
