"""The commands of each menu: what the reference lists, and what the dish told once it was asked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from birdcage.protocol.command_list import CommandDoc, parse_help
from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.station.raw import MenuCommand


class MenuCommands:
    """Asked once a menu. `of` is for any thread."""

    def __init__(self, protocol: FirmwareProtocol) -> None:
        self._protocol = protocol
        self._told: Mapping[str, tuple[CommandDoc, ...]] = {}

    def was_told(self, menu: str) -> bool:
        """Return whether the dish has already told the commands of this menu."""
        return menu in self._told

    def asks(self, menu: str) -> tuple[str, ...]:
        """Return the lines that bring the help of a menu."""
        return self._protocol.help_lines.get(menu, ("?",))

    def learn(self, menu: str, lines: Iterable[str]) -> None:
        """Take in what the dish printed."""
        self._told = {**self._told, menu: parse_help(menu, lines)}

    def of(self, menu: str) -> tuple[MenuCommand, ...]:
        """Return the commands of a menu: the documented ones, then what only the dish knows."""
        told = {command.name: command for command in self._told.get(menu, ())}
        listed = {command.name: command for command in self._protocol.commands if command.menu == menu}
        commands = []
        for name, documented in (listed | {name: told[name] for name in told if name not in listed}).items():
            dish = told.get(name)
            # The dish's own words first; the reference has more of them.
            usage = dish.usage if dish is not None and dish.usage != name else documented.usage
            text = dish.help if dish is not None and dish.help else documented.help
            commands.append(MenuCommand(menu, name, usage, text, told_by_dish=dish is not None))
        return tuple(commands)
