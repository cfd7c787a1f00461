"""The settings that a dish keeps itself, for one command: asked of the program that has its port, or of the dish."""

from __future__ import annotations

import signal
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.rotator.facts import Facts
    from birdcage.rotator.own_settings import OwnSettings, SettingsTable, SettingsWritten
    from birdcage.station.setting_requests import ReadSettings, SaveSettings, WriteSettings

TAKES_S = 60.0
MOST_AT_ONCE = 25
"""Rows of one request: so many are written well within the time that an answer of another program may take."""


class _Asks(Protocol):
    def __call__(self, request: ReadSettings | WriteSettings | SaveSettings) -> Any: ...  # noqa: ANN401 - as varied


@dataclass(frozen=True, slots=True)
class SettingsDesk:
    """One dish whose settings are read and changed, for as long as a command lasts."""

    facts: Facts
    own: OwnSettings
    """Of a machine that is not open: it reads lines, and says what is known."""
    port: str
    demo: bool
    holder: str
    ask: _Asks

    def read(self) -> SettingsTable:
        """Read all, and say what an earlier write has left behind."""
        from birdcage.cli.say import say
        from birdcage.station.setting_requests import ReadSettings

        table: SettingsTable = self.ask(ReadSettings())
        if self.demo:
            say("DEMO: this dish is simulated.")
        noted = {row.index for row in table.unfinished.rows} if table.unfinished is not None else set()
        for sentence in table.unfinished.sentences if table.unfinished is not None else ():
            say(sentence)
        for row in table.unsaved:
            if row.index not in noted:
                say(
                    f"Row {row.index} is changed in RAM only ({row.saved} to {row.current}), by no write that birdcage "
                    "has noted. A power cycle takes it back."
                )
        return table

    def write(self, changes: Mapping[int, str]) -> SettingsWritten:
        """Change rows in RAM, with a person's consent."""
        from birdcage.rotator.own_settings import SettingsWritten
        from birdcage.station.setting_requests import WriteSettings

        rows, backup = list(changes.items()), None
        with said_when_cut_short():
            for first in range(0, len(rows), MOST_AT_ONCE):
                part = dict(rows[first : first + MOST_AT_ONCE])
                written: SettingsWritten = self.ask(WriteSettings(part, self.holder, agreed=True))
                backup = backup or written.backup
        return SettingsWritten(backup, written.table)

    def save(self, shown: Mapping[int, str]) -> SettingsTable:
        """Write RAM to flash, with the consent of a person who was `shown` this, as `SettingsTable.to_save`."""
        from birdcage.station.setting_requests import SaveSettings

        with said_when_cut_short():
            table: SettingsTable = self.ask(SaveSettings(self.holder, agreed=True, shown=shown))
        return table


@contextmanager
def open_desk(wanted: Wanted, command: str) -> Iterator[SettingsDesk]:
    """Give the settings of the dish that is meant; `command` is who asks, as `birdcage nvs set`."""
    from birdcage.base.held import user_name
    from birdcage.cli.dish import open_dish
    from birdcage.cli.dish_features import see_at_rest
    from birdcage.cli.owners import ask_owner
    from birdcage.station.control_messages import TellStatus

    by = f"{user_name()} ({command})"
    told = ask_owner(wanted, TellStatus(), by)
    if told is not None:
        port, status = told
        facts, own = _of(status["firmware"], wanted, port)
        yield SettingsDesk(facts, own, port, bool(status["demo"]), by, lambda request: _asked(wanted, request, by))
        return
    with open_dish(wanted, survey=False) as dish:
        dish.come_up(15.0)
        see_at_rest(dish)
        facts, own = _of(dish.state.dish.firmware if dish.state.dish else None, wanted, dish.state.port)
        yield SettingsDesk(
            facts, own, dish.state.port, dish.state.demo, by, lambda request: dish.ask(request, TAKES_S)
        )  # fmt: skip


def own_settings_of(firmware: str) -> OwnSettings | None:
    """Return what reads the lines of such a machine's settings, with no port; None where it has no settings."""
    from birdcage.rotator import machines

    return machines.make(firmware).own_settings if firmware in machines.names() else None


@contextmanager
def said_when_cut_short() -> Iterator[None]:
    """Where a signal ends the command in the middle, say how to find out what became of it."""
    from birdcage.base.errors import BirdcageError
    from birdcage.cli.exits import EndedBySignal

    after = "`birdcage nvs dump` shows what became of each row."
    try:
        yield
    except KeyboardInterrupt:
        ended = EndedBySignal(signal.SIGINT)
        ended.add_note(after)
        raise ended from None
    except (BirdcageError, EndedBySignal) as error:
        error.add_note(after)
        raise


def _asked(wanted: Wanted, request: ReadSettings | WriteSettings | SaveSettings, by: str) -> Any:  # noqa: ANN401
    from birdcage.base.errors import NoReply
    from birdcage.cli.owners import ask_owner

    answer = ask_owner(wanted, request, by)
    if answer is None:
        raise NoReply(f"The program that had {wanted.port} is gone. Try again.")
    return answer[1]


def _of(firmware: str | None, wanted: Wanted, port: str) -> tuple[Facts, OwnSettings]:
    from birdcage.base.errors import CommandRefused, NoReply
    from birdcage.base.reason import Reason
    from birdcage.station.known import model_of

    facts = model_of(firmware, wanted.settings)
    if facts is None:
        raise NoReply(f"Which dish is at {port} is not known yet. Try again in a moment.")
    own = own_settings_of(facts.firmware)
    if own is None:
        raise CommandRefused(
            f"The {facts.name} has no known settings of its own. Nothing was sent.", reason=Reason.UNSUPPORTED
        )
    return facts, own
