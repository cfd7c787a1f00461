"""The motor menu `MOT>` of the Carryout G2 and its kin: moves, where it points, homing."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import ClassVar

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.console.events import Reply
from birdcage.protocol.family import angle_text
from birdcage.protocol.firmware import STALLED
from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.protocol.trk.answers import ANGLE, MoveAnswer, angles_in, position_of
from birdcage.rotator.values import Position, Taken

_OTHER_ANGLES = re.compile(r"\bAZ\s*=.*\bEL\s*=")
"""How a Trav'ler prints where it is (docs/reference/travler.md, *Position*); no damage makes it of such an answer."""


class TrkProtocol(FirmwareProtocol):
    """A console with the prompts `TRK>` and `MOT>`. A subclass says the rest, its `initialize` among it."""

    motor_menu: ClassVar[str] = "mot"
    move_answer: ClassVar[MoveAnswer] = ANGLE
    """How it says where it was sent."""

    def connect(self, port: str, baudrate: int = 115200) -> None:
        """Open the port (8N1) exclusively, at 115200 baud unless told otherwise (docs/reference/g2.md, *Line*)."""
        super().connect(port, baudrate)

    def _await_prompt(self, tell: Callable[[str], None], timeout_s: float) -> None:
        """Wait until the console answers: a booting dish does not. NoReply after `timeout_s`."""
        started, before = self.clock.monotonic(), ""
        while True:
            try:
                self.console.synchronize()
                return
            except NoReply as silence:
                elapsed = self.clock.monotonic() - started
                if elapsed >= timeout_s or silence.reason == before == Reason.WRONG_FIRMWARE:
                    raise
                before = silence.reason
                tell(f"{elapsed:3.0f} s: no prompt yet ({silence.reason}). The dish may still be booting.")

    def enter_motor_menu(self) -> None:
        """Enter `mot`. NoReply (`wrong_firmware`) when the dish refuses it twice: each of them has this menu."""
        try:
            self.console.enter("mot")
        except CommandRefused as once:
            if once.reason != Reason.UNKNOWN_COMMAND:
                raise
            try:
                self.console.enter("mot")  # the line may have been damaged on its way
            except CommandRefused as twice:
                if twice.reason != Reason.UNKNOWN_COMMAND:
                    raise
                raise self._another_firmware() from twice

    def _another_firmware(self) -> NoReply:
        return NoReply(self.dialect.stranger.format(prompt=self.console.prompt), reason=Reason.WRONG_FIRMWARE)

    def glance(self) -> Position:
        """Read both axes with one `a` within a stream of moves; a late answer is never taken for a later one's."""
        try:
            return self._position_in(self.console.hurry("mot", "a", asks=True))
        except CommandRefused as refused:
            self._tell_unread(refused)

    def _read_position(self, busy_s: float) -> Position:
        """Read both axes with one `a` (docs/reference/g2-motors.md, *Position*)."""
        self.enter_motor_menu()
        reply = self.console.run("mot", "a", busy_s=busy_s)
        if not reply.lines:
            # Whatever it knows, `a` prints two lines: this was the answer to an Enter that was still under way.
            self.console.mistrust()
        return self._position_in(reply)

    def _position_in(self, reply: Reply) -> Position:
        if set(angles_in(reply.lines)) != {0, 1} and _OTHER_ANGLES.search(" ".join(reply.lines)):
            raise self._another_firmware()
        position, self.printed_deg = position_of(reply.lines)
        return position

    def _send_move(self, motor_id: int, degrees: float, busy_s: float) -> Taken:
        line = self._move_line(motor_id, degrees)
        reply = self.console.run("mot", line, busy_s=busy_s, permit=self.permit, judged=False)
        return self._take_move(motor_id, degrees, reply)

    def steer_motor(self, motor_id: int, degrees: float) -> Taken:
        """Send one axis to an absolute angle, as one of a stream: each is taken to replace the one before.

        Source: docs/reference/g2-motors.md, *Moving*.
        """
        self._check_range(motor_id, degrees)
        line = self._move_line(motor_id, degrees)
        return self._take_move(motor_id, degrees, self.console.hurry("mot", line, permit=self.permit, judged=False))

    def _take_move(self, motor_id: int, degrees: float, reply: Reply) -> Taken:
        """Read the answer to a move. No refusal is known of any of them: without its angle only the position tells."""
        refusal = self.console.refusal(reply)
        if refusal is not None and STALLED.search(str(refusal)):
            raise refusal
        answer = self.move_answer
        printed, turns = answer.told(motor_id, reply.lines), motor_id == self.model.azimuth.index
        if printed is not None and not answer.confirms(printed, degrees, turns=turns):
            # It moves, and where to is not sure.
            raise NoReply(
                f"The dish answered `{reply.command}` with an angle of {answer.shown(printed)}°.",
                reason=Reason.GARBAGE,
            )
        return Taken(sure=printed is not None, said=" / ".join(reply.lines), took_s=self.console.took_s)

    @staticmethod
    def _move_line(motor_id: int, degrees: float) -> str:
        return f"a {motor_id} {degrees:.2f}"

    def stop_lines(self, az_deg: float, el_deg: float) -> tuple[str, ...]:
        """Retarget both axes: no stop is documented for any of them (docs/reference/g2.md, *What it can do*)."""
        return tuple(f"a {motor} {angle_text(deg)}" for motor, deg in enumerate((az_deg, el_deg)))

    def home_motor(self, motor_id: int) -> None:
        """Find one axis' reference by stall. Blocks the shell for up to `model.homing_s`; can't be stopped.

        Source: docs/reference/g2-motors.md, *Homing*.
        """
        self.model.numbered[motor_id]  # KeyError for a motor that it has not
        longest_s = self.model.homing_s
        assert longest_s is not None, "each of them homes by command"
        try:
            self.console.run("mot", f"h {motor_id}", takes_s=longest_s, permit=self.permit)
        finally:
            self.may_have_homed()  # also where its answer was lost
