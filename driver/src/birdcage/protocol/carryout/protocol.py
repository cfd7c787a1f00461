"""Winegard Carryout of 2003, firmware HandEra HAL 1.00.065 (`docs/reference/carryout-2003.md`)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Unpack

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, NoReply, PositionUnknown
from birdcage.base.reason import Reason
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.raw import Typed
from birdcage.console.session_hooks import SessionHooks
from birdcage.protocol.carryout.commands import COMMANDS
from birdcage.protocol.carryout.dialect import DIALECT, NVS, TARGET
from birdcage.protocol.carryout.features import CEILING, FEATURES
from birdcage.protocol.carryout.going import EL_MAX_ROW, GotoAnswer, ceiling_of, go_line, judge_go
from birdcage.protocol.carryout.hazards import HAZARDS
from birdcage.protocol.carryout.model import CARRYOUT_2003
from birdcage.protocol.carryout.own_settings import CarryoutOwnSettings
from birdcage.protocol.carryout.records import RecordReader
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.own_settings import OwnSettings, row_id
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.values import Position, Survey, Taken

if TYPE_CHECKING:
    from birdcage.link.link import Link

_GOING_S = 60.0
"""How long a go-to may print on before its prompt: only a deadline depends on it."""
_ASK_S = 5.0


class CarryoutProtocol(FirmwareProtocol):
    """Its console: menu `target` sends both axes (`g`) and tells where they are while they move, never at rest."""

    name: ClassVar[str] = "carryout"
    model: Facts = CARRYOUT_2003
    dialect: ClassVar[ConsoleDialect] = DIALECT
    motor_menu: ClassVar[str] = TARGET
    feature_table: ClassVar[FeatureTable] = FEATURES
    hazards: ClassVar[HazardTable] = HAZARDS
    commands: ClassVar[tuple[CommandDoc, ...]] = COMMANDS

    def __init__(self) -> None:
        super().__init__()
        self._slew: Typed | None = None
        self._records = RecordReader()
        self._heard: Position | None = None

    def attach(self, link: Link, clock: Clock, **hooks: Unpack[SessionHooks]) -> None:
        """Speak over an open link, and overhear its live records."""
        super().attach(link, clock, **hooks)
        self._heard = None
        self._records.forget()
        self.console.overhear(self._hear)

    def _hear(self, data: bytes) -> None:
        for record in self._records.feed(data):
            self._heard = Position(record.az_deg, record.el_deg)

    def heard_position(self) -> Position | None:
        """Return the last live record, once. How a record ends, and whether lines part them, is not known."""
        heard, self._heard = self._heard, None
        return heard

    def initialize(
        self, callback: Callable[[str], None] | None = None, *, timeout_s: float = CARRYOUT_2003.boot_s
    ) -> None:
        """Wait until it answers, and go into the menu `target`. It homes and searches by itself at power-up.

        NoReply after `timeout_s`; reason `wrong_firmware` at once for a dish that is plainly another.
        """
        tell = callback or (lambda _line: None)
        began = self.clock.monotonic()
        while True:
            try:
                self.console.synchronize()
                break
            except NoReply as silence:
                elapsed = self.clock.monotonic() - began
                if elapsed >= timeout_s or silence.reason == Reason.WRONG_FIRMWARE:
                    raise
                tell(f"{elapsed:3.0f} s: no prompt yet ({silence.reason}). The dish may still be homing.")
                self.console.listen(self.clock.monotonic() + _ASK_S)
        self.enter_motor_menu()

    def enter_motor_menu(self) -> None:
        """Enter `target`."""
        self.console.enter(TARGET)

    def _read_position(self, busy_s: float) -> Position:  # noqa: ARG002 - there is no such question
        """Raise PositionUnknown: no command tells where it is at rest."""
        raise PositionUnknown("This dish does not tell where it points.", reason=Reason.UNTOLD)

    def _send_move(self, motor_id: int, degrees: float, busy_s: float) -> Taken:  # noqa: ARG002
        """Raise CommandRefused (`unsupported`): `g` sends both axes."""
        raise self._lacks(f"sending one axis to {degrees:.2f}°")

    def stop_lines(self, az_deg: float, el_deg: float) -> tuple[str, ...]:  # noqa: ARG002
        """Return nothing: what a second go-to does while it moves is not known."""
        return ()

    def abort_lines(self) -> tuple[str, ...]:
        """Return a bare Enter: it moves nothing, and ends a combined move of relatives."""
        return ("",)

    def begin_slew(self, az_deg: float, el_deg: float, skew_deg: float | None) -> None:  # noqa: ARG002 - it has none
        """Send `g <az> <el>`, and return at once."""
        line = go_line(az_deg, el_deg)
        self.console.enter(TARGET)
        self._records.forget()
        self._heard = None  # what comes from now on is of this move
        self._slew = self.console.type_line(line, takes_s=_GOING_S, permit=self.permit)

    def slew_is_over(self) -> bool:
        """Return whether the prompt came since `begin_slew`; CommandRefused, once, when the dish refused it.

        Whether the prompt comes with the end of the move or at its beginning no source says.
        """
        slew = self._slew
        if slew is None:
            return True
        if not slew.is_over:
            return False
        self._slew = None
        if slew.reply is not None:
            answer, _last = judge_go(slew.reply.lines)
            refusal = self.console.refusal(slew.reply)
            if answer is GotoAnswer.REFUSED and refusal is not None:
                raise refusal
        return True

    @property
    def own_settings(self) -> OwnSettings:
        """The settings memory, as that of any machine."""
        return CarryoutOwnSettings(lambda: self.console)

    def survey(self) -> Survey:
        """Read the greatest elevation that it takes: nothing else is told by a known command."""
        try:
            ceiling_deg = self.read_ceiling()
        except CommandRefused as refused:
            if refused.reason == Reason.WRONG_MENU:
                raise
            return Survey()
        told = {} if ceiling_deg is None else {row_id(EL_MAX_ROW): f"{ceiling_deg:g}"}
        features = {} if ceiling_deg is None else {CEILING: ceiling_deg}
        return Survey(settings=told, features=features, el_max_deg=ceiling_deg)

    def read_ceiling(self) -> float | None:
        """Read the greatest elevation that it takes (`nvs`, `e 102`), in degrees; None when none is to be seen."""
        return ceiling_of(self.console.run(NVS, f"e {EL_MAX_ROW}").lines)

    def kill_search(self) -> None:
        """Raise CommandRefused (`unsupported`): no command for that is known."""
        raise self._lacks("ending its TV search")
