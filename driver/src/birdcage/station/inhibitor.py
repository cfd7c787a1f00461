"""Keeps the machine awake while the dish moves, or will: a suspended program stops nothing, and follows nothing."""

from __future__ import annotations

import logging
import os
import queue
import shutil
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Protocol

from birdcage.station.events import ActivityChanged, Event, PursuitChanged, TaskChanged
from birdcage.station.pursuit_state import Phase
from birdcage.station.state import MOVING, LinkPhase
from birdcage.station.station import Station

AFTER_S = 10.0
"""How long it is held after the dish came to rest: the next motion often follows soon."""

log = logging.getLogger(__name__)


class Hold(Protocol):
    """A hold on the machine's sleep."""

    def works(self) -> bool:
        """Whether the system still honours it."""

    def let_go(self) -> None:
        """Let the machine sleep again."""


Launcher = Callable[[], Hold | None]
"""Takes a hold; None if the system has no such thing. May raise OSError."""


class Child:
    """A helper process that holds the machine awake while it lives."""

    def __init__(self, command: list[str]) -> None:
        # The child ends when its standard input does: so also when this program is killed.
        self._process = subprocess.Popen(  # noqa: S603 - the command is ours
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )

    def works(self) -> bool:
        """Whether it lives."""
        return self._process.poll() is None

    def let_go(self) -> None:
        """End it, and wait for that a second at most."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        self._process.terminate()
        try:
            self._process.wait(1.0)
        except subprocess.TimeoutExpired:
            self._process.kill()


def launch() -> Hold | None:
    """Hold by `systemd-inhibit` on Linux, `caffeinate` on macOS; None elsewhere."""
    if sys.platform == "darwin":
        name, rest = "caffeinate", ["-i", "-w", str(os.getpid())]
    else:
        why = ["--what=sleep:idle", "--who=birdcage", "--why=The dish moves", "--mode=block"]
        name, rest = "systemd-inhibit", [*why, "cat"]
    path = shutil.which(name)
    return Child([path, *rest]) if path else None


class SleepInhibitor:
    """Holds while the dish of `station` moves, or a task is not over, and `after_s` longer. On a thread of its own.

    Never for a simulated dish.

    On a system without such a thing, the log says so once.
    """

    def __init__(self, station: Station, launch: Launcher = launch, *, after_s: float = AFTER_S) -> None:
        self._station, self._launch, self._after_s = station, launch, after_s
        self._told: queue.SimpleQueue[bool | None] = queue.SimpleQueue()
        self._thread: threading.Thread | None = None
        self._hopeless = False
        self._moves = self._pursues = self._works = False
        """Whether the dish moves, a pass is waited for or followed, a task goes on: asleep, it would be missed."""
        self._raw = False
        """Whether a raw line may have begun the motion: nothing need tell when that one ends."""
        self._unsubscribe = station.subscribe(self._hear, PursuitChanged, ActivityChanged, TaskChanged)

    def close(self) -> None:
        """Let the machine sleep; waits for the helper process to end, a second at most."""
        self._unsubscribe()
        if self._thread is not None:
            self._told.put(None)
            self._thread.join(1.0)

    def _hear(self, event: Event) -> None:
        if self._station.state.demo:
            return
        if isinstance(event, PursuitChanged):
            self._pursues = event.pursuit.phase is not Phase.OVER
        elif isinstance(event, TaskChanged):
            works = bool(self._station.state.tasks)
            if works is self._works:
                return  # a map tells of each direction
            self._works = works
        elif isinstance(event, ActivityChanged):
            self._raw = event.raw
            self._moves = self._raw or event.activity in MOVING
        else:
            return
        moves = self._moves or self._pursues or self._works
        if self._thread is None:
            if not moves:
                return
            self._thread = threading.Thread(target=self._run, name="sleep inhibitor", daemon=True)
            self._thread.start()
        self._told.put(moves)

    def _still_raw(self) -> bool:
        """Return whether the dish may still move from a raw line, and STOP can reach it."""
        state = self._station.state
        return state.raw_motion and state.link.state is LinkPhase.UP

    def _run(self) -> None:
        hold: Hold | None = None
        moving: bool | None = False
        while moving is not None:
            try:
                looks = hold is not None and (self._raw or not moving)
                moving = self._told.get(timeout=self._after_s if looks else None)
            except queue.Empty:
                if self._still_raw():
                    continue
                self._end(hold)
                hold = None
                continue
            if moving and hold is None and not self._hopeless:
                hold = self._begin()
        self._end(hold)

    def _begin(self) -> Hold | None:
        try:
            hold = self._launch()
        except OSError as error:
            hold, why = None, str(error)
        else:
            why = "this system has no sleep inhibitor that birdcage knows"
        if hold is None:
            self._give_up(why)
        return hold

    def _end(self, hold: Hold | None) -> None:
        if hold is not None:
            if not hold.works():
                self._give_up("the system refused the sleep inhibitor")
            hold.let_go()

    def _give_up(self, why: str) -> None:
        self._hopeless = True
        words = f"This machine may fall asleep while the dish moves: {why}."
        log.info("%s", words)
        self._station.warn("sleep", words)
