"""A class that keeps to the published interface (`docs/reference/published-interface.md`).

It is driven by the methods that are named there, and by no others
(`docs/decisions/0041-a-class-that-keeps-to-the-document.md`).

Such a class may have a port of its own, and never open our console. Only its calls are known, not its line: a motion
is watched by `get_position`, and STOP is one more `move_motor`, when the call under way has returned.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import TypeVar

from birdcage.base.clock import Clock, RealClock, WaitOutcome
from birdcage.base.errors import BirdcageError, CommandRefused, LinkError, PositionUnknown
from birdcage.protocol.firmware import FirmwareProtocol
from birdcage.protocol.generic import GENERIC_FACTS, GENERIC_FEATURES
from birdcage.protocol.menu_rotator import MenuRotator
from birdcage.protocol.motors import MOTORS, told
from birdcage.protocol.unhomed import unreadable
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.rotator.raw import RawLines
from birdcage.rotator.values import Look, Position, Taken

T = TypeVar("T")

REPLACED = ("connect", "disconnect", "is_connected", "get_position", "move_motor")
"""What a class may do in its own way by the published interface, and our dialects do by the console."""


DECIMALS = 2
"""Hundredths of a degree, as every console of the family is sent them."""


def keeps_to_the_document(machine: FirmwareProtocol) -> bool:
    """Return whether only the names of the published interface tell what a machine does.

    So it is where its class, below the one that speaks our console by a `_send_move`, has replaced one of `REPLACED`,
    or the object itself has; and where it only poses as such a class, as a mock does.
    """
    return any(_has_own(machine, name) for name in REPLACED)


def _has_own(machine: FirmwareProtocol, name: str) -> bool:
    kinds = type(machine).__mro__
    if FirmwareProtocol not in kinds or name in vars(machine):
        return True
    speaker = next(at for at, kind in enumerate(kinds) if "_send_move" in vars(kind))
    return any(name in vars(kind) for kind in kinds[:speaker])


class CallLine:
    """A `Line` by the calls of a class: how long the last one took, and when it returned."""

    place: str | None = None
    is_settled = True
    late = stray_bytes = 0

    def __init__(self, clock: Clock, delay_s: float = 0.0) -> None:
        self._clock, self.delay_s = clock, delay_s
        self.last_reply: float | None = None
        self.round_trip_s: float | None = None
        self.took_s = 0.0
        self.answered = self.asked = self.unanswered = 0
        self._began: float | None = None

    def unanswered_s(self) -> float:
        """See `Line`."""
        began = self._began
        return 0.0 if began is None else self._clock.monotonic() - began

    @contextmanager
    def call(self) -> Iterator[None]:
        """Time one call. LinkError where its port fails."""
        began = self._began = self._clock.monotonic()
        answered, self.answered = self.answered, 0
        self.asked, unanswered, self.unanswered = self.asked + 1, self.unanswered, self.unanswered + 1
        try:
            yield
        except OSError as error:
            raise LinkError(f"The port of the dish has failed: {error}") from error
        finally:
            self._began = None
        self.last_reply = self._clock.monotonic()
        self.took_s, self.answered, self.unanswered = self.last_reply - began, answered + 1, unanswered


class DocumentedRotator(MenuRotator):
    """A `Rotator` over a class that keeps to the published interface.

    Any error of its own is raised as it is, but OSError.
    """

    def __init__(self, protocol: FirmwareProtocol) -> None:
        super().__init__(protocol)
        self.raw: RawLines | None = None
        self.own_settings = None  # what it has goes by a console that is not opened here
        self._facts = _genuine(protocol.model, GENERIC_FACTS)
        self._table = _genuine(protocol.feature_table, GENERIC_FEATURES)
        self._clock: Clock = RealClock()
        self._line = CallLine(self._clock)
        self._is_attached = self._is_open = False
        self._orders: deque[StopOrder] = deque()

    @property
    def is_open(self) -> bool:
        """What the class says; if only its `connect` is its own, whether that was called."""
        if _has_own(self.protocol, "connect") and not _has_own(self.protocol, "is_connected"):
            return self._is_open
        return bool(self.protocol.is_connected)

    @property
    def clock(self) -> Clock:
        """See `Rotator`."""
        return self._clock

    @property
    def line(self) -> CallLine:
        """See `Rotator`."""
        return self._line

    @property
    def printed_deg(self) -> float:
        """See `Rotator`."""
        return _genuine(self.protocol.printed_deg, FirmwareProtocol.printed_deg)

    def open(self, address: str, baud: int | None, clock: Clock, hooks: Hooks) -> None:
        """Have the class connect, at its own rate if none is given; it speaks over our line if its port is ours."""
        self._clock, self._hooks, self._line = clock, hooks, CallLine(clock, hooks.delay_s)
        self._orders.clear()
        self._is_attached = hooks.dial is not None and not _has_own(self.protocol, "connect")
        if self._is_attached:
            super().open(address, baud, clock, hooks)
            self.protocol.permit = None  # asked here: STOP goes out by `move_motor`, too
        else:
            with self._line.call():
                self.protocol.connect(address, *(() if baud is None else (baud,)))
        self._is_open = True

    def close(self, within_s: float) -> None:
        """See `Rotator`."""
        self._is_open = False
        with suppress(BirdcageError, OSError):
            if _has_own(self.protocol, "disconnect"):
                self.protocol.disconnect()
            else:
                super().close(within_s)

    def begin(self, tell: Callable[[str], None]) -> None:
        """See `Rotator`."""
        with self._line.call():
            super().begin(tell)

    def meet(self) -> None:
        """Enter the motor menu: the class says whether the dish answers."""
        self.make_ready()

    def make_ready(self) -> None:
        """See `Rotator`."""
        with self._line.call():
            self.protocol.enter_motor_menu()

    def catch_up(self) -> None:
        """Do nothing: a call that has returned has had its answer."""

    def look(self, *, hurry: bool = False, busy_s: float = 0.0) -> Look:  # noqa: ARG002
        """See `Rotator`."""
        with self._line.call():
            said = self.protocol.get_position()
        self._line.round_trip_s = self._line.took_s
        position = Position(float(said.azimuth), float(said.elevation), said.skew)
        if not (math.isfinite(position.azimuth) and math.isfinite(position.elevation)):
            raise unreadable(f"The position told is {said}: no such angles.", [str(said)])
        return told(position)

    def send(self, to: Mapping[str, float], *, hurry: bool = False, busy_s: float = 0.0) -> Taken:  # noqa: ARG002
        """See `Rotator`."""
        if self._hooks.permit is not None:
            self._hooks.permit()
        ((axis, deg),) = to.items()
        return self._move(axis, deg)

    def _move(self, axis: str, deg: float) -> Taken:
        with self._line.call():
            said: object = self.protocol.move_motor(MOTORS[axis], round(deg, DECIMALS))
        return _genuine(said, Taken(sure=False, said="", took_s=self._line.took_s))

    def stop_now(self, order: StopOrder) -> None:
        """Keep the order for `settle`: nothing can be written into the call under way."""
        self._orders.append(order)

    def settle(self, within_s: float) -> tuple[CommandRefused | None, ...]:  # noqa: ARG002
        """Send the last target that `stop_now` took, and return of each axis whether it was refused.

        Without a target the class is asked for the position: its answer tells that no call is under way any more.
        """
        orders = [self._orders.popleft() for _ in range(len(self._orders))]
        aims = [order.aim_deg for order in orders if order.by is StopBy.RETARGET]
        if aims:
            return tuple(self._refusal(*aim) for aim in aims[-1].items())
        if not orders:
            return ()
        with self._line.call(), suppress(PositionUnknown):
            self.protocol.get_position()
        return (None,)

    def _refusal(self, axis: str, deg: float) -> CommandRefused | None:
        try:
            self._move(axis, deg)
        except CommandRefused as refused:
            return refused
        return None

    def listen(self, until: float) -> None:
        """See `Rotator`."""
        if self._is_attached:
            super().listen(until)
        elif self._clock.wait(None, until, self._hooks.wake) is WaitOutcome.INTERRUPTED and self._hooks.on_wake:
            self._hooks.on_wake()

    def is_answer(self, text: str) -> bool:
        """See `Rotator`."""
        return self._is_attached and super().is_answer(text)


def _genuine(value: object, default: T) -> T:
    return value if type(value) is type(default) else default  # a mock poses as what it stands for
