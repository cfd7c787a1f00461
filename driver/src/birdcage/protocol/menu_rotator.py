"""A firmware's console as a machine: what stands between the seam and the languages with prompts and menus."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused
from birdcage.console.places import is_of_help
from birdcage.link.link import Link
from birdcage.protocol.firmware import FirmwareProtocol
from birdcage.protocol.menu_raw import MenuRaw
from birdcage.protocol.motors import AZIMUTH, ELEVATION, MOTORS, SKEW, told
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import Feature, Reading, Value
from birdcage.rotator.feature_table import FeatureTable, Stamp, middle_of
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.rotator.own_settings import OwnSettings
from birdcage.rotator.raw import RawLines
from birdcage.rotator.rotator import LineStatus
from birdcage.rotator.sweep import SweepOrder, SweptReading
from birdcage.rotator.values import Look, Survey, Taken

_ANSWER = re.compile(r"=\s*\S|^\s*\S(\s|$)|>\s*$")
"""A value, the echo of a command, or a prompt: an answer that comes late, and no log."""


def _dial(clock: Clock) -> Callable[[str, int], Link]:
    from birdcage.link.opening import open_link

    return lambda address, baud: open_link(address, baud=baud, clock=clock)


class MenuRotator:
    """A `Rotator` over a `FirmwareProtocol`, which does the work."""

    def __init__(self, protocol: FirmwareProtocol) -> None:
        self.protocol = protocol
        self.raw: RawLines | None = MenuRaw(protocol)
        self._facts: Facts = protocol.model
        self._table: FeatureTable = protocol.feature_table
        self._hooks = Hooks()
        self.is_simulated = False
        self.own_settings: OwnSettings | None = protocol.own_settings

    @property
    def facts(self) -> Facts:
        """See `Rotator`."""
        return self._facts

    @facts.setter
    def facts(self, facts: Facts) -> None:
        # Its own check of an angle goes by them too.
        self._facts = self.protocol.model = facts

    @property
    def is_open(self) -> bool:
        """See `Rotator`."""
        return self.protocol.is_connected

    @property
    def clock(self) -> Clock:
        """See `Rotator`."""
        return self.protocol.console.clock

    @property
    def line(self) -> LineStatus:
        """See `Rotator`."""
        return self.protocol.console

    @property
    def printed_deg(self) -> float:
        """See `Rotator`."""
        return self.protocol.printed_deg

    def open(self, address: str, baud: int | None, clock: Clock, hooks: Hooks) -> None:
        """See `Rotator`."""
        link = (hooks.dial or _dial(clock))(address, baud or self.facts.baud)
        self.is_simulated = link.demo
        protocol, self._hooks = self.protocol, hooks
        protocol.permit, protocol.on_busy, protocol.on_facts = hooks.permit, hooks.on_busy, hooks.on_facts
        protocol.on_restart = hooks.on_restart

        def hear(text: str) -> None:
            if protocol.says_restart(text):
                hooks.on_restart(text)
            elif (trouble := protocol.dialect.trouble_in(text)) is not None:
                hooks.on_trouble(trouble)
            else:
                hooks.on_line(text)

        protocol.attach(
            link, clock, delay_s=hooks.delay_s, wake=hooks.wake, on_wake=hooks.on_wake, on_line=hear,
            on_prompt=hooks.on_prompt,
        )  # fmt: skip

    def close(self, within_s: float) -> None:
        """See `Rotator`."""
        self.protocol.disconnect(within_s=within_s)

    def begin(self, tell: Callable[[str], None]) -> None:
        """See `Rotator`."""
        self.protocol.initialize(tell)
        self.protocol.enter_motor_menu()

    def meet(self) -> None:
        """See `Rotator`."""
        self.protocol.meet()
        self.protocol.heard_position()  # what came until now may have waited in the line for long

    def make_ready(self) -> None:
        """See `Rotator`."""
        self.protocol.enter_motor_menu()

    def catch_up(self) -> None:
        """See `Rotator`."""
        self.protocol.console.clear_up()

    def survey(self) -> Survey:
        """See `Rotator`."""
        return self.protocol.survey()

    def look(self, *, hurry: bool = False, busy_s: float = 0.0) -> Look:
        """See `Rotator`."""
        return told(self.protocol.glance() if hurry else self.protocol.read_position(busy_s=busy_s))

    def send(self, to: Mapping[str, float], *, hurry: bool = False, busy_s: float = 0.0) -> Taken:
        """See `Rotator`."""
        ((axis, deg),) = to.items()
        if hurry:
            return self.protocol.steer_motor(MOTORS[axis], deg)
        return self.protocol.move_motor(MOTORS[axis], deg, busy_s=busy_s)

    def begin_slew(self, to: Mapping[str, float]) -> None:
        """See `Rotator`."""
        self.protocol.begin_slew(to[AZIMUTH], to[ELEVATION], to.get(SKEW))

    def slew_is_over(self) -> bool:
        """See `Rotator`."""
        return self.protocol.slew_is_over()

    def stop_now(self, order: StopOrder) -> None:
        """See `Rotator`."""
        protocol = self.protocol
        match order.by:
            case StopBy.RETARGET:
                lines = protocol.stop_lines(order.aim_deg[AZIMUTH], order.aim_deg[ELEVATION])
            case StopBy.ABORT:
                lines = protocol.abort_lines()
            case StopBy.KNOCK:
                lines = ("",)
            case StopBy.COMMAND:
                lines = protocol.halt_lines()
        protocol.interject(lines)

    def settle(self, within_s: float) -> tuple[CommandRefused | None, ...]:
        """See `Rotator`."""
        console = self.protocol.console
        return tuple(map(console.refusal, console.settle(within_s)))

    def listen(self, until: float) -> None:
        """See `Rotator`."""
        if not self._tell():  # that came while something else was asked
            self.protocol.console.listen(until)
            self._tell()

    def _tell(self) -> bool:
        heard = self.protocol.heard_position()
        if heard is not None:
            self._hooks.on_look(told(heard))
        return heard is not None

    def is_answer(self, text: str) -> bool:
        """See `Rotator`."""
        return _ANSWER.search(text) is not None or is_of_help(text, self.protocol.dialect)

    def home(self, axis: str) -> None:
        """See `Rotator`."""
        self.protocol.home_motor(MOTORS[axis])

    def stow(self) -> None:
        """See `Rotator`."""
        self.protocol.stow()

    def sweep(self, order: SweepOrder, hear: Callable[[SweptReading | None], None]) -> None:
        """See `Rotator`."""
        self.protocol.sweep_axis(order, hear)

    def release_motors(self, permit: Callable[[], None]) -> None:
        """See `Rotator`."""
        self.protocol.release_motors(permit=permit)

    def engage_motors(self) -> None:
        """See `Rotator`."""
        self.protocol.engage_motors()

    @property
    def features(self) -> Mapping[str, Feature]:
        """See `Rotator`."""
        return self._facts.features

    def read(self, ids: Iterable[str]) -> Mapping[str, Reading]:
        """See `Rotator`."""
        return self._table.read(self.protocol, self._facts.name, ids, self._stamp)

    def write(self, feature: str, value: Value) -> Reading:
        """See `Rotator`."""
        return self._table.write(self.protocol, self._facts.name, feature, value, self._stamp)

    @property
    def _stamp(self) -> Stamp:
        return middle_of(self.clock, lambda: self.line.took_s)
