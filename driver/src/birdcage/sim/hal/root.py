"""The root menu: the submenus, `stow` and `reboot` (`docs/reference/travler.md`, *Prompts and menus*)."""

from __future__ import annotations

from birdcage.sim.hal.board import HalBoard
from birdcage.sim.hal.menu import HalMenu
from birdcage.sim.shell import Enter, Pause, Script, quitting


class HalRootMenu(HalMenu):
    """Enters submenus. What `q` does here is a setting."""

    def __init__(self, board: HalBoard, submenus: tuple[str, ...]) -> None:
        super().__init__(board, board.settings.prompt_root)
        self._submenus = submenus
        self.help_lines = (*submenus, "reboot", "stow", "q")
        self.commands |= {"q": self._quit, "reboot": self._reboot, "stow": self._stow}

    def run(self, words: list[str]) -> Script:
        """Carry out one line; the name of a submenu enters it."""
        if words[0] in self._submenus:
            yield Enter(words[0])
        else:
            yield from super().run(words)

    def _quit(self, args: list[str]) -> Script:  # noqa: ARG002
        yield from quitting(self.board.settings.root_q, self.unknown)

    def _reboot(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.host.restart()
        yield ""

    def _stow(self, args: list[str]) -> Script:  # noqa: ARG002
        """Turn to the back and fold flat (written); in this order, what it prints, and whether it waits: assumed."""
        board = self.board
        if not all(axis.homed for axis in board.dish.axes):
            yield f"{board.settings.unhomed_text}\n"
            return
        board.put(2, board.dish.axes[2].data.home_deg)
        for index, angle in enumerate(board.stow_deg):
            board.put(index, angle)
        while board.settings.stow_blocks and board.turn.busy:
            yield Pause(max(board.turn.end_s() - board.now_s, 0.01))
