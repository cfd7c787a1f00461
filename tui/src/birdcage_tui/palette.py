"""The palette, made from the table of commands."""

from __future__ import annotations

from functools import partial
from typing import cast

from textual.command import DiscoveryHit, Hit, Hits, Provider

from birdcage_tui.commands import COMMANDS, Command
from birdcage_tui.host import Host


class CommandProvider(Provider):
    """Every command by its title; what cannot be done now stays in the list and says why."""

    def _line(self, command: Command) -> str:
        reason = command.refused(cast(Host, self.app).view())
        return f"{command.shown}  {command.help}" + ("" if reason is None else f" Not now: {reason}")

    def _do(self, command: Command) -> None:
        cast(Host, self.app).action_command(command.name)

    async def discover(self) -> Hits:
        """Yield all, before anything is typed."""
        for command in COMMANDS:
            yield DiscoveryHit(command.title, partial(self._do, command), help=self._line(command))

    async def search(self, query: str) -> Hits:
        """Yield what matches."""
        matcher = self.matcher(query)
        for command in COMMANDS:
            score = matcher.match(f"{command.title} {command.name}")
            if score > 0:
                yield Hit(score, matcher.highlight(command.title), partial(self._do, command), help=self._line(command))
