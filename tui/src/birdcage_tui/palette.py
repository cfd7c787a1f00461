"""The palette, made from the table of commands. It leaves row 1 alive, as the dialogs do."""

from __future__ import annotations

from functools import partial
from typing import cast

from textual import events
from textual.app import ComposeResult
from textual.command import CommandList, CommandPalette, DiscoveryHit, Hit, Hits, Provider

from birdcage_tui.commands import COMMANDS, Command
from birdcage_tui.host import Host
from birdcage_tui.layer import Layer
from birdcage_tui.status import TopRow


class Palette(CommandPalette, Layer[None]):
    """Textual's palette under row 1: status and the mouse's STOP are never covered."""

    ID = "--command-palette"
    """Textual looks for it, to open no second one."""

    def compose(self) -> ComposeResult:
        """Row 1, then what Textual has."""
        yield TopRow()
        yield from super().compose()

    def on_mount(self, _: events.Mount) -> None:
        """Fill row 1, and let the footer know that one types, once the field has the focus."""
        self.call_after_refresh(cast(Host, self.app).paint)

    def _action_command_list(self, action: str) -> None:
        """Move in the list. Pages of one that is not drawn yet, or has no row here, cannot be turned."""
        if "page" not in action or self.query_one(CommandList).scrollable_content_region:
            super()._action_command_list(action)


class CommandProvider(Provider):
    """Every command by its title; what cannot be done now stays in the list and says why."""

    def _line(self, command: Command) -> str:
        reason = command.refused(cast(Host, self.app).view())
        return f"{command.shown}  {command.help}" + ("" if reason is None else f" Not now: {reason}")

    _chosen = False

    def _do(self, command: Command) -> None:
        """Do it, once for each palette: Textual would do it for a second Enter or click as well."""
        if not self._chosen:
            self._chosen = True
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
