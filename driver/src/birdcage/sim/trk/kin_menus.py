"""The menus of a relative of the G2: what sources tell of them, and help lines that are assumed."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.shell import Enter, Menu, Pause, Script, quitting
from birdcage.sim.trk import moves
from birdcage.sim.trk.homing import homing
from birdcage.sim.trk.kin_board import KinBoard
from birdcage.sim.trk.limits import motor, number
from birdcage.sim.trk.menu import TrkMenu
from birdcage.sim.trk.nvs import TrkNvsMenu

WHAT = {"mot": "Motor Control", "nvs": "Non-Volatile Storage"}


class KinRootMenu(TrkMenu[KinBoard]):
    """Enters submenus."""

    def __init__(self, board: KinBoard) -> None:
        super().__init__(board)
        self.prompt, self._menus = board.settings.root_prompt, board.settings.menu_words
        self.help_lines = ("help [<command>]", *(f"Enter <{name}> - {WHAT[name]}" for name in self._menus), "q")
        self.commands |= {"q": self._quit}

    def run(self, words: list[str]) -> Script:
        """Carry out one line; the name of a submenu enters it."""
        if words[0] in self._menus:
            yield Enter(words[0])
        else:
            yield from super().run(words)

    def _quit(self, args: list[str]) -> Script:  # noqa: ARG002
        yield from quitting(self.board.settings.root_q, lambda: self.unknown(["q"]))


class KinMotMenu(TrkMenu[KinBoard]):
    """`a <motor> <angle>`, and `h`: no other command of it is known."""

    prompt = "MOT>"
    help_lines = ("help [<command>]", "a <motor> <angle> - Go to angle", "h <motor> - Home motor, * for both", "q")

    def __init__(self, board: KinBoard) -> None:
        super().__init__(board)
        self.commands |= {"a": self._angle, "h": self._home}

    def _angle(self, args: list[str]) -> Script:
        if not args:
            yield from self._bare()
            return
        settings = self.board.settings
        if settings.lag_max_s and settings.lag_ack == "at_once":
            yield from self._later(args)
            return
        yield Pause(self.board.lag_s())
        yield from moves.angle(self.board, args) or self.bad_parameter()
        self._note(args)

    def _home(self, args: list[str]) -> Script:
        yield Pause(self.board.lag_s())
        yield from homing(self.board, args) or self.bad_parameter()

    def _bare(self) -> Script:
        match self.board.settings.bare_a:
            case "angles":
                yield from moves.show(self.board)
            case "target":
                yield f"Angle = {self.board.sent_deg:.2f}\n"
            case "error":
                yield from self.bad_parameter()
            case _:
                yield ""

    def _later(self, args: list[str]) -> Script:
        """Answer at once, and begin to move after the lag."""
        index, wanted = motor(args[0]), number(args[1]) if len(args) == 2 else None
        if index is None or wanted is None:
            yield from self.bad_parameter()
            return
        board = self.board

        def begin() -> None:
            for _ in moves.angle(board, args) or ():
                pass

        board.machine.at_dish(board.now_s + board.lag_s(), begin)
        self._note(args)
        yield moves.taken(board, index, wanted)

    def _note(self, args: list[str]) -> None:
        wanted = number(args[1]) if len(args) == 2 and args[0] == "0" else None
        self.board.sent_deg = self.board.sent_deg if wanted is None else wanted


MENUS: dict[str, Callable[[KinBoard], Menu]] = {"root": KinRootMenu, "mot": KinMotMenu, "nvs": TrkNvsMenu}


def kin_menus(board: KinBoard) -> dict[str, Menu]:
    """Return every menu by the word that enters it."""
    return {name: MENUS[name](board) for name in ("root", *board.settings.menu_words)}
