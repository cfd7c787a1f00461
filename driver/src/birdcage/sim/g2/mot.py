"""The motor menu, `MOT>` (docs/reference/g2-commands.md, *MOT>*): all 25 commands, each in a file of its kind."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from birdcage.sim.g2 import mot_info, mot_moves, mot_reference, sweep
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Script
from birdcage.sim.trk import homing, moves

TELLING: dict[str, Callable[[G2Board], Script]] = {
    "elminmaxhome": mot_info.el_limits,
    "l": mot_info.motors,
    "life": mot_info.life,
    "ma": mot_info.accelerations,
    "motorlife": mot_info.motor_life,
    "mv": mot_info.speeds,
    "p": mot_info.steps,
    "v": mot_info.velocities,
}
"""Commands that take no argument."""
ASKING: dict[str, Callable[[G2Board, list[str]], Script | None]] = {
    "a": moves.angle,
    "azscan": sweep.azscan,
    "azscanwxp": sweep.azscanwxp,
    "ela2s": mot_info.el_to_steps,
    "els2a": mot_info.steps_to_el,
    "g": mot_moves.both,
    "h": homing.homing,
    "motorboth": mot_moves.test_both,
    "pid": mot_info.gains,
    "sd": mot_moves.stall_test,
    "sp": mot_reference.set_position,
    "sw": mot_reference.set_wrap,
    "vms": mot_moves.velocity,
    "w": mot_reference.wrap_manager,
}
"""Commands that read arguments, and return None for bad ones."""


class MotMenu(G2Menu):
    """Angles, homing, current."""

    prompt = "MOT>"
    help_lines = (
        "help [<command>]",
        "a [<motor> <angle>] - Show or set angle",
        "azscan [az_rel] [el_rel] [delay] - AZ sweep with RSSI",
        "azscanwxp [motor] [span_deg] [res_cdeg] [num_xponders] - AZ sweep with transponder cycling",
        "e - Engage motors",
        "ela2s <deg> - Elevation angle to steps",
        "elminmaxhome - Elevation limits and home",
        "els2a <steps> - Elevation steps to angle",
        "g <az> <el> - Go to angles",
        "h <motor> - Home motor, * for both",
        "l - List motors",
        "life - Motor life",
        "ma - Max acceleration",
        "motorboth - Move both motors",
        "motorlife - Motor life in full",
        "mv - Max velocity",
        "p - Step positions",
        "pid [motor] [Kp] [Kv] [Ki] - Gains",
        "q",
        "r - Release motors",
        "sd [motor] [direction] [timeout] - Stall detection",
        "sp [motor] [pos] - Set position",
        "sw [motor] [pos] - Set wrap position",
        "v - Velocities",
        "vms [motor] [deg_per_rev] [ms] - Velocity move",
        "w [motor] [ON/OFF] - Wrap manager",
    )

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {name: partial(self._tell, command) for name, command in TELLING.items()}
        self.commands |= {name: partial(self._ask, command) for name, command in ASKING.items()}
        self.commands |= {"e": self._engage, "r": self._release}

    def _tell(self, command: Callable[[G2Board], Script], args: list[str]) -> Script:
        yield from self.bad_parameter() if args else command(self.board)

    def _ask(self, command: Callable[[G2Board, list[str]], Script | None], args: list[str]) -> Script:
        yield from command(self.board, args) or self.bad_parameter()

    def _engage(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.dish.engage(self.board.now_s)
        yield ""

    def _release(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.dish.release(self.board.now_s)
        yield ""
