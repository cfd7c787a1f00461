"""The motion under way: one value, behind the lock that STOP's own thread takes."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from birdcage.antenna.motion import DishMotion
from birdcage.base.errors import CommandRefused, Held, MotionRefused, Stopped
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import MoveKind


class MotionState:
    """What a machine does, as far as this program knows it. Written by the thread that owns the antenna.

    A motion is begun, becomes better known, and is ended or forgotten. `lock` is held for each of these steps, and by
    STOP from its decision to its bytes: what it aims by does not change meanwhile. Nothing that holds the link's write
    lock may take it: STOP takes both, this one first.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.model: DishMotion | None = None
        """The motion as modelled; None at rest, and where nothing is known of it. Set by the methods below only."""
        self.seen_at_rest = -math.inf
        """When it was last seen at rest since its last motion was begun, ended or forgotten; monotonic seconds."""
        self._busy: MoveKind | None = None
        self.taken = 0
        """How many motions the machine has taken, at least in one axis."""
        self.motor_runs = False
        """Whether a motor was set running without a target, and the machine was not seen at rest since its STOP."""
        self.is_kept = False
        """Whether nothing of the motion was let out yet: a STOP that is latched now keeps all of it."""
        self._before: DishMotion | None = None
        """What was under way when the one that is kept was begun."""

    @property
    def busy(self) -> MoveKind | None:
        """What the machine is so busy with that nothing sent gets through to it; None normally."""
        return self._busy

    @property
    def rests_until_let_out(self) -> bool:
        """Whether nothing of the motion was let out yet, and none was under way before it."""
        return self.is_kept and self._before is None

    @contextmanager
    def begin(self, planned: DishMotion) -> Iterator[DishMotion | None]:
        """Model a motion while its lines go out, and yield the one before.

        What was modelled before comes back if the machine takes none of them. Once a part has gone out (`half_sent`),
        the motion stays: it is STOP's to follow.
        """
        taken = self.taken
        # Before the first byte: a STOP that comes after that byte must know what to stop.
        with self.lock:
            before = self._before = self.assume(planned)
            self.is_kept = True
        try:
            yield before
        except (Stopped, CommandRefused, MotionRefused, Held) as error:
            if self.taken == taken and error.reason not in (Reason.CLOSING, Reason.HALF_SENT):
                self.take_back(planned, before)
            raise
        finally:
            self.is_kept = False

    def assume(self, model: DishMotion | None) -> DishMotion | None:
        """Take something for the motion under way; return what was until now."""
        with self.lock:
            before, self.model = self.model, model
            if before is not model:
                self.seen_at_rest = -math.inf
            return before

    def take_back(self, model: DishMotion | None, before: DishMotion | None) -> None:
        """What was assumed did not begin: the machine does what it did. Nothing if more is known meanwhile."""
        with self.lock:
            if self.model is model:
                self.model = before

    def correct(self, better: Callable[[DishMotion], DishMotion]) -> DishMotion | None:
        """Know the same motion better, by a reading or from when it began; return it. None at rest."""
        with self.lock:
            if self.model is not None:
                self.model = better(self.model)
            return self.model

    def end(self) -> None:
        """The machine rests."""
        self.motor_runs = False
        self.assume(None)

    def see_at_rest(self, at: float) -> None:
        """A reading at monotonic seconds has shown that it rests, with nothing under way."""
        with self.lock:
            if self.model is None:
                self.seen_at_rest = at

    def forget(self) -> None:
        """It goes otherwise than modelled, or where it goes is no longer known: STOP has to look first."""
        with self.lock:
            self.assume(None)
            self.seen_at_rest = -math.inf

    def keep_busy(self, kind: MoveKind | None) -> None:
        """Note what the machine is busy with from now on; None: it listens again."""
        with self.lock:
            self._busy = kind
