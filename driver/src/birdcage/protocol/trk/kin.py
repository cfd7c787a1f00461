"""A relative of the Carryout G2: the first look shows whether it tells where it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Unpack

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, Held, NoReply, PositionUnknown, Stopped
from birdcage.base.reason import Reason
from birdcage.console.raw import Typed
from birdcage.console.session_hooks import SessionHooks
from birdcage.protocol.family import angle_text
from birdcage.protocol.firmware import BOOT_TIMEOUT_S
from birdcage.protocol.trk.answers import angles_in
from birdcage.protocol.trk.kin_facts import telling
from birdcage.protocol.trk.protocol import TrkProtocol
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION, Position

if TYPE_CHECKING:
    from birdcage.link.link import Link

_LOOKS = 2
"""How often it is asked where it is before it counts as one that does not tell: one answer may be damaged."""


@dataclass(frozen=True, slots=True)
class _Sent:
    """The command of a move under way."""

    motor: int
    degrees: float
    typed: Typed


class TrkKin(TrkProtocol):
    """Its `model` says that it never tells where it is. `meet` corrects that where a bare `a` is answered with angles.

    `asks_where` False: a bare `a` is known to tell nothing, and is not sent.
    """

    asks_where: ClassVar[bool] = True
    lag_s: ClassVar[float] = 0.0
    """The longest that it may wait before it executes the command of a move. `model.homing_s` has it in."""
    blank_lines: ClassVar[bool] = False
    """Whether the command of a move goes between two bare Enters."""
    _sent: tuple[_Sent, ...] = ()
    _tells: bool | None = None
    """Whether this dish tells where it is; None until it was asked."""

    def attach(self, link: Link, clock: Clock, **hooks: Unpack[SessionHooks]) -> None:
        """Speak over an open link: it may be another dish than before."""
        super().attach(link, clock, **hooks)
        self._tells = None if self.asks_where else False
        self._sent = ()

    def _is_back(self, menu: str) -> None:
        """Take in that it is at its root: one that tells where it is shows by itself what it has forgotten."""
        if self._tells is not True:
            self.may_have_homed()
            self.on_restart(f"The dish is back in menu `{menu}`, and nothing was sent that leads there.")

    def meet(self) -> None:
        """Find out whether it answers and, once, whether it tells where it is (docs/reference/g2-kin.md, *Position*).

        Asking moves nothing. What it shows counts until the port is closed, or until it was homed.
        """
        super().meet()
        if self._tells is None:
            self._tells = self._shows_where()
            if self._tells is not self.model.tells_at_rest:
                self.on_facts(telling(type(self).model) if self._tells else type(self).model)

    def _shows_where(self) -> bool:
        self.enter_motor_menu()
        for _ in range(_LOOKS):
            try:
                lines = self.console.run("mot", "a").lines
            except CommandRefused as refused:
                if refused.reason == Reason.WRONG_MENU:
                    raise
                continue
            if set(angles_in(lines)) == {0, 1}:
                return True
            self.console.mistrust()
        return False

    def _read_position(self, busy_s: float) -> Position:
        """Read both axes with one `a`. PositionUnknown (`untold`) of a dish that was seen not to answer that."""
        if self._tells is False:
            raise PositionUnknown("This dish does not tell where it points.", reason=Reason.UNTOLD)
        return super()._read_position(busy_s)

    def begin_slew(self, az_deg: float, el_deg: float, skew_deg: float | None) -> None:  # noqa: ARG002 - it has none
        """Send both axes, one command behind the other, and return at once: it does not tell when it has arrived.

        The second waits in the dish until the first was taken. Stopped (`half_sent`) where STOP came between both: the
        first has gone out, so where the dish points is not known.
        """
        self._check_range(MOTOR_AZIMUTH, az_deg)
        self._check_range(MOTOR_ELEVATION, el_deg)
        self.enter_motor_menu()
        self._sent = ()
        first = self._send_axis(MOTOR_AZIMUTH, az_deg, before=0)
        try:
            second = self._send_axis(MOTOR_ELEVATION, el_deg, before=1)
        except (Stopped, Held) as stopped:
            if stopped.reason is Reason.CLOSING:
                raise
            raise Stopped(
                "STOP came between both axes: the azimuth was sent, the elevation was not. "
                "Where the dish points is not known.",
                reason=Reason.HALF_SENT,
            ) from stopped
        if self.blank_lines:
            self.console.type_line("", takes_s=2 * self.lag_s)
        self._sent = first, second

    def _send_axis(self, motor: int, degrees: float, before: int) -> _Sent:
        """Send one axis, of which so many commands go before."""
        if self.blank_lines:
            self.console.type_line("", takes_s=before * self.lag_s)
        line = f"a {motor} {angle_text(degrees)}"
        typed = self.console.type_line(line, takes_s=(before + 1) * self.lag_s, permit=self.permit)
        return _Sent(motor, degrees, typed)

    def slew_is_over(self) -> bool:
        """Return whether both commands were answered. CommandRefused, once, when the dish refused both.

        Also where one of both answers is that an axis is in trouble: the other may still be on its way.
        NoReply where one of both was refused or not answered, or named another angle: where it goes is not known then.
        """
        now = self.clock.monotonic()
        if any(not each.typed.is_over and now < each.typed.due for each in self._sent):
            return False
        sent, self._sent = self._sent, ()
        replies = [(each, each.typed.reply) for each in sent]
        refusals = [refusal for _, reply in replies if reply and (refusal := self.console.refusal(reply))]
        troubles = [refusal for refusal in refusals if refusal.trouble is not None]
        if troubles or (refusals and len(refusals) == len(sent)):
            raise (troubles or refusals)[0]
        if refusals:
            raise NoReply(f"The dish took one axis of two. {refusals[0]}", reason=Reason.GARBAGE)
        for each, reply in replies:
            if reply is None:
                raise NoReply(f"The dish did not answer `{each.typed.line}`.", reason=Reason.SILENT)
            self._take_move(each.motor, each.degrees, reply)
        return True

    def may_have_homed(self) -> None:
        """Ask it once more where it is, when it is met next (docs/reference/g2-kin.md, *Position*)."""
        if self.asks_where and self._tells is False:
            self._tells = None  # it may not have told because it was not homed

    def initialize(self, callback: Callable[[str], None] | None = None, *, timeout_s: float = BOOT_TIMEOUT_S) -> None:
        """Wait until the console answers, then go into the motor menu. NoReply after `timeout_s`."""
        tell = callback or (lambda _line: None)
        self._await_prompt(tell, timeout_s)
        self._tell_search(tell)
        self.enter_motor_menu()

    def _tell_search(self, tell: Callable[[str], None]) -> None:
        """Say how its TV search stands."""
        tell(f"No command is known that ends the TV search of a {self.model.name}.")

    def kill_search(self) -> None:
        """Raise CommandRefused (`unsupported`): no command for that is known."""
        raise self._lacks("ending its TV search")
