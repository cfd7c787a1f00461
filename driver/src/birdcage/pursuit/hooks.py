"""Command lines of the user's that run at moments of a pass.

A command line is split into words as a POSIX shell does (`shlex`, on Windows too: write `C:/tools/rec.exe`, or put
backslashes between single quotes), and no shell takes part: `sh -c '...'` where one is wanted. It gets the facts in its
environment (`BIRDCAGE_EVENT` and so on) and as a line of JSON on stdin; what it says goes to a sink, line by line.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.config.tracking_sections import HookSettings
from birdcage.base.user_command import GRACE_S, UserCommand
from birdcage.pursuit.follower import told_reach_end
from birdcage.pursuit.made_files import told_path
from birdcage.pursuit.pass_facts import Event, PassFacts, facts_of
from birdcage.pursuit.pass_listener import LivePass, PassFile, PassListener, PassRemark

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan

LATE_S = 30.0
"""A TCA that was missed by more is left out: its moment is over."""


@dataclass(frozen=True, slots=True)
class HookLine:
    """Something that a hook said, or that is to be said of it."""

    utc: datetime
    event: Event
    name: str
    """Of the satellite."""
    text: str


Sink = Callable[[HookLine], None]


class PassHooks:
    """Call `step` every now and then, on one thread; nothing here waits for a command but `close`."""

    def __init__(self, settings: HookSettings, sink: Sink, clock: Clock, *, grace_s: float = GRACE_S) -> None:
        """`sink` is called on any thread: it appends to a queue and returns."""
        self._settings, self._sink, self._clock, self._grace_s = settings, sink, clock, grace_s
        self._facts: PassFacts | None = None
        self._done: set[Event] = set()
        self._begun = False
        """Whether its start came in time, with a hook or without."""
        self._runs: list[UserCommand] = []

    def plan(self, facts: PassFacts | None) -> None:
        """Run the hooks of this pass at their times; None: there is none any more.

        The same pass planned anew keeps what has run. A pass that is given up after its start runs `at_reach_end` at
        once, as what was begun has to be ended; one that is given up before runs nothing.
        """
        before = self._facts
        if before is not None and (facts is None or not facts.is_same_pass(before)):
            if self._begun and "reach_end" not in self._done:
                self._run("reach_end", before)
            self._done.clear()
            self._begun = False
        self._facts = facts

    def step(self) -> float:
        """Start what is due, and return when to come again: monotonic seconds, `inf` for not before the next `plan`."""
        self._runs = [each for each in self._runs if not each.over]
        facts = self._facts
        if facts is None:
            return math.inf
        now_s = self._clock.utc().timestamp()
        next_s = math.inf
        for event, at_s in self._times(facts):
            if event in self._done:
                continue
            if now_s < at_s:
                next_s = min(next_s, at_s)
                continue
            self._done.add(event)
            if self._worth(event, facts, now_s, at_s):
                self._run(event, facts)
        if math.isinf(next_s):
            return math.inf
        # At most a second, as the time of day may be set meanwhile.
        return self._clock.monotonic() + min((next_s - now_s) / self._clock.rate, 1.0)

    @property
    def running(self) -> bool:
        """Whether a command still runs."""
        return any(not each.over for each in self._runs)

    def close(self, timeout_s: float = 0.0) -> bool:
        """End what still runs: asked to, killed when the grace is over; wait for that no longer than `timeout_s`.

        False where something takes longer: that is killed in time also when this program has gone meanwhile. No further
        hook is started: an end hook would be ended with the rest.
        """
        self._facts = None
        for each in self._runs:
            each.end()
        until = self._clock.monotonic() + timeout_s
        slow = [each for each in self._runs if not each.wait(max(until - self._clock.monotonic(), 0.0))]
        for each in slow:
            each.leave()
        return not slow

    def _times(self, facts: PassFacts) -> list[tuple[Event, float]]:
        times: list[tuple[Event, float]] = [("reach_start", facts.reach_start.timestamp() - self._settings.pre_s)]
        if facts.tca is not None:
            times.append(("tca", facts.tca.timestamp()))
        if facts.reach_end is not None:
            times.append(("reach_end", facts.reach_end.timestamp() + self._settings.post_s))
        return times

    def _worth(self, event: Event, facts: PassFacts, now_s: float, at_s: float) -> bool:
        """Whether it is not too late: a pass may be chosen when half of it is over, or after a long sleep."""
        if event == "reach_start":
            self._begun = facts.reach_end is None or now_s < facts.reach_end.timestamp()
            return self._begun
        return now_s - at_s <= LATE_S if event == "tca" else self._begun

    def _run(self, event: Event, facts: PassFacts) -> None:
        settings = self._settings
        command = {"reach_start": settings.at_reach_start, "tca": settings.at_tca, "reach_end": settings.at_reach_end}[
            event
        ]
        if command is None:
            return

        def say(text: str) -> None:
            self._sink(HookLine(self._clock.utc(), event, facts.name, text))

        told, line = facts.environment(event), facts.json_line(event)
        run = UserCommand(command, told, line, say, deadline_s=settings.deadline_s, grace_s=self._grace_s)
        self._runs.append(run)


class HookListener(PassListener):
    """Runs the user's hooks in every pass, and tells what they say as remarks, or as files where they name one."""

    label = "hooks of [hooks]"

    def __init__(
        self, settings: HookSettings, tell: Callable[[PassRemark], None], clock: Clock,
        made: Callable[[PassFile], None] = lambda _file: None,
    ) -> None:  # fmt: skip
        """`tell` and `made` are called on any thread: they append to a queue and return."""
        self._settings, self._tell, self._clock, self._made = settings, tell, clock, made
        self._hooks = PassHooks(settings, self._said, clock)
        self._plan: Plan | None = None

    def begins(self, live: LivePass) -> None:
        """Take over the settings of now: within a pass, what was begun is ended as it was begun."""
        if live.settings.hooks != self._settings:
            self._hooks.close(0.0)
            self._settings = live.settings.hooks
            self._hooks = PassHooks(self._settings, self._said, self._clock)
        self.changes(live)

    def changes(self, live: LivePass) -> None:
        """Run them by the newest plan."""
        if live.plan is not self._plan:
            self._plan = live.plan
            facts = facts_of(live.plan, live.observer)
            if facts is not None:
                self._hooks.plan(facts)

    def ends(self) -> None:
        """Run the last one of a pass that was given up."""
        plan, self._plan = self._plan, None
        end = None if plan is None else told_reach_end(plan)
        # One that came to its end keeps its last hook, which may run some time after that.
        if end is None or self._clock.utc() < end:
            self._hooks.plan(None)

    def step(self) -> float:
        """Start what is due."""
        return self._hooks.step()

    @property
    def busy(self) -> bool:
        """Whether a command still runs."""
        return self._hooks.running

    def close(self) -> None:
        """End what still runs, without waiting: what takes longer is killed in time."""
        self._hooks.close(0.0)

    def _said(self, line: HookLine) -> None:
        path = told_path(line.text)
        if path is not None:
            self._made(PassFile(line.name, line.utc, path))
            return
        self._tell(PassRemark(line.name, line.utc, f"{line.event}: {line.text}"))
