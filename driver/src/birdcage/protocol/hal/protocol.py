"""Winegard Trav'lers, firmwares HAL 2.05.003 and 0.0.00 (`docs/reference/travler.md`): one class, a table of each."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Unpack

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, PositionUnknown
from birdcage.base.reason import Reason
from birdcage.console.raw import Typed
from birdcage.console.session_hooks import SessionHooks
from birdcage.protocol.family import angle_text
from birdcage.protocol.hal.answers import parse_position, parse_setting
from birdcage.protocol.hal.boot import BootWatch
from birdcage.protocol.hal.commands import COMMANDS
from birdcage.protocol.hal.dialect import DIALECTS
from birdcage.protocol.hal.features import FEATURES
from birdcage.protocol.hal.hazards import HAZARDS
from birdcage.protocol.hal.model import MOVE_TIMES, OLDER_TRAVLER, TRAVLER, TRAVLER_PRO
from birdcage.protocol.hal.own_settings import HalOwnSettings
from birdcage.protocol.hal.pages import all_pages
from birdcage.protocol.hal.variant import HAL000, HAL205, NVS, PRO, HalVariant
from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.rotator.facts import Facts
from birdcage.rotator.own_settings import OwnSettings, row_id
from birdcage.rotator.values import Position, Survey, Taken

if TYPE_CHECKING:
    from birdcage.link.link import Link

_QUEUED_S = MOVE_TIMES.seconds(455.0) + 2.0
"""How long a move may wait for the motor before it, should the prompt wait with it
(`docs/reference/travler.md`, *Moving*)."""
_SLEW_S = sum(MOVE_TIMES.seconds(way) for way in (455.0, TRAVLER.elevation.max_deg - TRAVLER.elevation.min_deg)) + 2.0
"""The longest that a combined move takes."""
_STOW_S = 60.0
"""How long `stow` may keep the shell: no source says whether it does. Only a deadline depends on it."""


class HalProtocol(FirmwareProtocol):
    """The Trav'lers' consoles: a menu of moves, one in which the TV search is ended; prompts are learnt."""

    variant: ClassVar[HalVariant]
    """In what this one differs from the others: a subclass has it and its `model`, and the rest from tables."""

    def __init_subclass__(cls) -> None:
        """Give a class that has a `variant` of its own what the tables have of it."""
        super().__init_subclass__()
        if "variant" in vars(cls):
            variant = cls.variant
            cls.name, cls.motor_menu = variant.firmware, variant.motor
            cls.boot_marks = cls.log_marks = variant.boot_marks
            cls.dialect, cls.feature_table = DIALECTS[variant.firmware], FEATURES[variant.firmware]
            cls.hazards, cls.commands = HAZARDS[variant.firmware], COMMANDS[variant.firmware]

    def __init__(self) -> None:
        self._slew: Typed | None = None
        self._boot = BootWatch(self.boot_marks)
        self._hear: Callable[[str], None] = lambda _text: None

    def attach(self, link: Link, clock: Clock, **hooks: Unpack[SessionHooks]) -> None:
        """Speak over an open link; see `FirmwareProtocol.attach`."""
        on_line = hooks.get("on_line")
        watch = self._boot = BootWatch(self.boot_marks)

        def hear(text: str) -> None:
            watch.hear(text, clock.monotonic())
            if on_line is not None:
                on_line(text)

        self._slew = None
        self._hear = hear
        hooks["on_line"] = hear
        super().attach(link, clock, **hooks)

    def initialize(self, callback: Callable[[str], None] | None = None, *, timeout_s: float = TRAVLER.boot_s) -> None:
        """Wait for the end of the boot, end the TV search, and go into the motor menu.

        From power-up the boot log streams until a line holds one of `boot_marks`; a dish that has been up, or that
        searches, answers at once. Ending a search that does not run is harmless. NoReply after `timeout_s`: a
        shell that stays silent for so long is deadlocked, which only a power cycle ends; reason `wrong_firmware` at
        once for a dish that is plainly another.
        """
        tell = callback or (lambda _line: None)
        self._boot.wait(self.console, self.is_homed, tell, timeout_s)
        if self.variant.search_told:
            tell("The dish answers. Ending its TV search.")
            self.kill_search()
            tell("The TV search is over. It begins again at the next power-up.")
            return
        tell("The dish answers. Sending the line that may end a TV search.")
        try:
            self.kill_search()
        except CommandRefused as refused:
            if refused.reason == Reason.WRONG_MENU:
                raise
            tell(f"A TV search, should it run, was not ended. {refused}")
        else:
            tell("The dish took the line. No source says that it ends a TV search of this dish.")

    def enter_motor_menu(self) -> None:
        """Enter the menu of moves."""
        self.console.enter(self.motor_menu)

    def is_homed(self) -> bool:
        """Return whether the dish tells where it is."""
        try:
            self.get_position()
        except PositionUnknown:
            return False
        return True

    def _read_position(self, busy_s: float) -> Position:  # noqa: ARG002 - the prompt never waits for a motor
        """Read all axes with one `a` (`docs/reference/travler.md`, *Position*)."""
        return parse_position(self.console.run(self.motor_menu, "a").lines)

    def _send_move(self, motor_id: int, degrees: float, busy_s: float) -> Taken:
        # What it answers no source tells: all that is no refusal counts as taken.
        line = f"a {motor_id} {angle_text(degrees)}"
        reply = self.console.run(self.motor_menu, line, takes_s=max(busy_s, _QUEUED_S), permit=self.permit)
        return Taken(sure=True, said=" / ".join(reply.lines), took_s=self.console.took_s)

    def stop_lines(self, az_deg: float, el_deg: float) -> tuple[str, ...]:  # noqa: ARG002
        """Return nothing: a new target is queued behind the one under way (`docs/reference/travler.md`, *Moving*)."""
        return ()

    def abort_lines(self) -> tuple[str, ...]:
        """Two bare Enters: the first ends the slew, and may be swallowed by that; the second brings the prompt."""
        return ("", "")

    def begin_slew(self, az_deg: float, el_deg: float, skew_deg: float | None) -> None:
        """Send `g <az> <el> <sk>` (`docs/reference/travler.md`, *Moving*), and return at once."""
        if skew_deg is None:
            raise CommandRefused(
                "The dish did not report its skew, which a combined move needs. Nothing was sent.",
                reason=Reason.UNSUPPORTED,
            )
        line = f"g {angle_text(az_deg)} {angle_text(el_deg)} {angle_text(skew_deg)}"
        self.console.enter(self.motor_menu)
        self._slew = self.console.type_line(line, takes_s=_SLEW_S, permit=self.permit)

    def slew_is_over(self) -> bool:
        """Return whether the prompt came since `begin_slew`; CommandRefused, once, when the dish refused the slew.

        Some firmware may give its prompt at once (no source says).
        """
        slew = self._slew
        if slew is None:
            return True
        if not slew.is_over:
            return False
        self._slew = None
        for line in slew.reply.lines if slew.reply is not None else ():
            if any(mark in line for mark in self.boot_marks):
                self._hear(line)  # it has restarted meanwhile: its log passes for the answer
        refusal = self.console.refusal(slew.reply) if slew.reply is not None else None
        if refusal is not None:
            raise refusal
        return True

    def stow(self) -> None:
        """Fold the dish flat (`docs/reference/travler.md`, *Stow*). Nothing that is known stops it."""
        self.console.run(self.variant.home, "stow", takes_s=_STOW_S, permit=self.permit)

    @property
    def own_settings(self) -> OwnSettings:
        """The settings memory, as that of any machine."""
        return HalOwnSettings(self, self.model.settings_known)

    def survey(self) -> Survey:
        """Read the rows of the lowest elevations: nothing else is told by a known command."""
        lowest_in = self.variant.lowest
        try:
            rows = {index: self.read_nvs(index) for index in sorted(lowest_in.values())}
        except CommandRefused as refused:
            if refused.reason == Reason.WRONG_MENU:
                raise
            return Survey()  # a dish without these rows, or without this menu: its model's limits hold
        lowest = rows[lowest_in["floor"]]
        least_deg = -90.0 if self.variant.row_may_lower else self.model.elevation.min_deg
        usable = lowest is not None and self.model.elevation.max_deg > float(lowest) > least_deg
        return Survey(
            settings={row_id(index): value for index, value in rows.items() if value is not None},
            features={name: float(text) for name, index in lowest_in.items() if (text := rows[index]) is not None},
            el_min_deg=float(lowest) if lowest is not None and usable else None,
        )

    def read_nvs(self, index: int) -> str | None:
        """Read one row of the settings memory, as printed (`docs/reference/travler.md`, *Settings*); None: no value."""
        return parse_setting(index, self.console.run(NVS, f"e {index}").lines)

    def settings_table(self) -> tuple[str, ...]:
        """Read what `nvs`, `d` shows (`docs/reference/travler.md`, *Settings*), all pages of it.

        CommandRefused (`unsupported`) when it shows nothing.
        """
        try:
            lines = all_pages(self._settings_page) if self.variant.pages else self._settings_page()
        except CommandRefused as refused:
            if refused.reason != Reason.UNKNOWN_COMMAND:
                raise
            lines = ()
        if not lines:
            raise self._lacks("listing its settings")
        return lines

    def _settings_page(self) -> tuple[str, ...]:
        return self.console.run(NVS, "d", takes_s=10.0).lines

    def kill_search(self) -> None:
        """End the TV search until the next power-up (`docs/reference/travler.md`, *Start and search*).

        On HAL 2.05 `ngsearch`, `s`, `q`; on HAL 0.0.00 `os`, `kill Search`, `q`. Then go to the motor menu, also where
        the dish refuses it (CommandRefused).
        """
        try:
            self.console.enter(self.variant.search)
            self._end_search()
        except CommandRefused:
            self.enter_motor_menu()
            raise
        self.console.leave_one()
        self.enter_motor_menu()

    def _end_search(self) -> None:
        try:
            self.console.exchange(self.variant.end_search)
        except CommandRefused as refused:
            if refused.reason != Reason.FAILED:
                raise  # `failed` is said of a search that does not run

    def restore_search(self) -> None:
        """Raise CommandRefused (`unsupported`): the next power-up does it."""
        begins = "it begins by itself at the next power-up" if self.variant.search_told else "a power-up may begin it"
        raise CommandRefused(
            f"The {self.model.name} has no command that begins its TV search: {begins}.", reason=Reason.UNSUPPORTED
        )


class HAL205Protocol(HalProtocol):
    """The Trav'ler with HAL 2.05: menu `motor`, search ended by `ngsearch`, `s`, `q`."""

    variant = HAL205
    model: Facts = TRAVLER


class HAL000Protocol(HalProtocol):
    """The older Trav'ler with HAL 0.0.00: menu `mot`, search ended by `os`, `kill Search`, `q`."""

    variant = HAL000
    model: Facts = OLDER_TRAVLER


class TravlerProProtocol(HalProtocol):
    """The Trav'ler Pro: all that moves lies behind the tunnel `odu`, which nothing is known to leave."""

    variant = PRO
    model: Facts = TRAVLER_PRO

    def abort_lines(self) -> tuple[str, ...]:
        """One bare Enter: a second one right behind it would come too fast, and be lost."""
        return ("",)
