"""Keeps a receiver on a satellite's frequency and listens to its level, on a thread of its own."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable

from birdcage.base.clock import Clock
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.base.errors import ConfigError
from birdcage.base.wake import Wake
from birdcage.radio.now import RadioNow
from birdcage.radio.opening import caller
from birdcage.radio.receiver import Receiver
from birdcage.radio.tuning import Tuning
from birdcage.radio.wire import Connect

LEAD_S = 60.0
"""How long before reach the receiver is taken: until then it is its owner's."""
CLOSE_S = 0.7
"""How long closing may wait for LOS to be heard: an answer that is out, a call, an answer, each in a hurry."""


class ReceiverRunner:
    """`start` runs it on a daemon thread, on which `publish` is called; tests call `step` instead."""

    def __init__(
        self,
        settings: RadioSettings,
        clock: Clock,
        publish: Callable[[RadioNow], None] = lambda _now: None,
        *,
        connect: Connect | None = None,
    ) -> None:
        self._clock, self._publish = clock, publish
        self._hurry, self._wake = Wake(), Wake()
        self._wanted: Tuning | None = None
        self._tuning: Tuning | None = None
        self._listening = self._listens = False
        """Whether its level is wanted while no pass is on, and whether it is read."""
        self._thread: threading.Thread | None = None
        self._receiver: Receiver | None = None
        self._problem = ""
        self._heard = True
        if settings.rigctld is None:
            return
        try:
            where, call = caller(settings.rigctld, clock, self._hurry, connect)
        except ConfigError as error:
            self._problem = str(error)
        else:
            self._receiver = Receiver(settings, clock, where, call, publish)

    @property
    def now(self) -> RadioNow:
        """What is known of the receiver; any thread may ask."""
        if self._receiver is None or self._problem:
            return RadioNow(sentence=self._problem)
        return self._receiver.now

    def follow(self, tuning: Tuning | None) -> None:
        """Tune for this pass from a minute before it; None lets go of the receiver, and ends a recording, at once.

        The same pass planned anew goes on without a break. Any thread; never waits.
        """
        self._wanted = tuning
        self._wake.set()

    def listen(self, *, on: bool) -> None:
        """Read its level while no pass is on, or leave it alone then. Any thread; never waits."""
        self._listening = on
        self._wake.set()

    @property
    def serves_pass(self) -> bool:
        """Whether a pass has it or will, or LOS is owed to one. Any thread."""
        return self._wanted is not None or (self._receiver is not None and self._receiver.owes)

    def step(self) -> float:
        """Do what is due, and return when to come again: monotonic seconds, `inf` for not before the next `follow`."""
        tuning, receiver = self._wanted, self._receiver
        if receiver is None:
            return math.inf
        if tuning is not self._tuning:
            if tuning is None or self._tuning is None or not tuning.is_same_pass(self._tuning):
                receiver.another_pass()
            self._tuning = tuning
        at_s = self._clock.utc().timestamp()
        coming = tuning if tuning is not None and at_s < tuning.end_s else None
        if coming is not None and at_s >= coming.start_s - LEAD_S:
            if self._listens:
                self._listens = False
                receiver.another_pass()
            return receiver.work(coming, at_s)
        due = self._between_passes(receiver, coming, at_s)
        if coming is None:
            return due
        # At most a second, as the time of day may be set meanwhile.
        return min(due, self._clock.monotonic() + min((coming.start_s - LEAD_S - at_s) / self._clock.rate, 1.0))

    def _between_passes(self, receiver: Receiver, coming: Tuning | None, at_s: float) -> float:
        """Listen if somebody wants that, LOS first where it is owed; else leave the receiver alone."""
        if self._listening and not receiver.owes:
            if not self._listens:
                self._listens = True
                receiver.listen_anew()
            return receiver.listen()
        self._listens = False
        due = receiver.rest(at_s)
        if math.isinf(due):
            receiver.idle(coming)
            if self._listening:
                return self._clock.monotonic()
        return due

    def start(self) -> None:
        """Run on a thread of its own."""
        self._thread = threading.Thread(target=self._run, name="radio", daemon=True)
        self._thread.start()

    def close(self, within_s: float = CLOSE_S) -> bool:
        """Tell LOS where it is owed, and hang up; False if it may not have been heard within the time."""
        self._hurry.set()
        self._wake.set()
        if self._thread is not None:
            self._thread.join(within_s)
            return not self._thread.is_alive() and self._heard
        self._end()
        return self._heard

    def _run(self) -> None:
        try:
            while not self._hurry.is_set():
                due = self.step()
                self._clock.wait(None, due, self._wake)
                self._wake.clear()
        except Exception as fault:  # noqa: BLE001 - a traceback from here would land in the middle of a screen
            self._problem = f"Tuning stopped, a bug in birdcage: {fault!r}"
        self._end()
        if self._problem:
            self._publish(self.now)

    def _end(self) -> None:
        self._heard = self._receiver is None or self._receiver.finish()
        self._hurry.close()
        self._wake.close()
