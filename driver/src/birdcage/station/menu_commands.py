"""The commands of each place: what is documented, and what the machine told once it was asked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from birdcage.rotator.raw import CommandDoc, RawLines
from birdcage.station.raw import MenuCommand


class MenuCommands:
    """Asked once a place. `of` is for any thread."""

    def __init__(self, raw: RawLines | None) -> None:
        self._raw = raw
        self._told: Mapping[str | None, tuple[CommandDoc, ...]] = {}

    def was_told(self, menu: str | None) -> bool:
        """Return whether the machine has already told the commands of this menu."""
        return menu in self._told

    def learn(self, menu: str | None, commands: Iterable[CommandDoc]) -> None:
        """Take in what the machine listed."""
        self._told = {**self._told, menu: tuple(commands)}

    def of(self, menu: str | None) -> tuple[MenuCommand, ...]:
        """Return the commands of a menu: the documented ones, then what only the machine knows."""
        if self._raw is None:
            return ()
        told = {command.name: command for command in self._told.get(menu, ())}
        listed = {command.name: command for command in self._raw.commands(menu)}
        commands = []
        for name, documented in (listed | {name: told[name] for name in told if name not in listed}).items():
            dish = told.get(name)
            # The dish's own words first; what is documented has more of them.
            usage = dish.usage if dish is not None and dish.usage != name else documented.usage
            text = dish.help if dish is not None and dish.help else documented.help
            commands.append(MenuCommand(menu, name, usage, text, told_by_dish=dish is not None))
        return tuple(commands)
