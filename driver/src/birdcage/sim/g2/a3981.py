"""The motor drivers' menu, `A3981>` (docs/reference/g2-commands.md, *A3981>*).

The form of `diag` is quoted, and that `ss` returns an integer (noted); the others are made like `diag` (assumed).
"""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Script
from birdcage.sim.trk.menu import Command


class A3981Menu(G2Menu):
    """Two Allegro A3981, one a motor."""

    prompt = "A3981>"
    help_lines = (
        "help [<command>]",
        "cm - current mode",
        "diag - fault pins",
        "q",
        "reset - reset fault flags",
        "sm - step mode",
        "ss - step size",
        "st - torque",
    )

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {
            "cm": self._each("CM", lambda _: board.settings.current_mode),
            "diag": self._each("DIAG", lambda index: "FAULT" if self._fault(index) else "OK"),
            "reset": self._reset,
            "sm": self._each("SM", lambda _: board.settings.step_mode),
            "ss": self._step_size,
            "st": self._each("ST", lambda index: "HIGH" if board.dish.axes[index].moving(board.now_s) else "LOW"),
        }
        self._forget()
        board.at_power_on.append(self._forget)

    def _each(self, name: str, word: Callable[[int], str]) -> Command:
        def run(args: list[str]) -> Script:
            if args:
                yield from self.bad_parameter()
                return
            yield f"AZ {name}: {word(0)} EL {name}: {word(1)}\n"

        return run

    def _step_size(self, args: list[str]) -> Script:
        settings = self.board.settings
        if args or settings.ss_reply == "axes":
            yield from self._each("SS", lambda _: str(settings.step_size))(args)
        else:
            yield f"{settings.step_size}\n"

    def _fault(self, index: int) -> bool:
        """Whether the axis is blocked and was not reset since it was last told to move."""
        axis = self.board.dish.axes[index]
        return self.board.settings.stall_faults and axis.stalled and axis.orders != self._cleared[index]

    def _reset(self, args: list[str]) -> Script:  # noqa: ARG002
        self._cleared = [axis.orders for axis in self.board.dish.axes]
        yield ""

    def _forget(self) -> None:
        self._cleared = [-1, -1]
