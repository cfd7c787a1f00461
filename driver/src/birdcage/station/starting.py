"""A dish that starts by itself: homes, prints its log meanwhile, and then searches for TV satellites."""

from __future__ import annotations

import re

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.console.places import is_of_help
from birdcage.protocol.model import SearchSwitch
from birdcage.station.board import Board
from birdcage.station.mover import Mover
from birdcage.station.state import Activity, Link, Search

LOG_LINES = 3
"""So many lines from a dish that does not answer are a log; fewer may be late answers."""
UNREADABLE = "\N{REPLACEMENT CHARACTER}"
_ANSWER = re.compile(r"=\s*\S|^\s*\S(\s|$)|>\s*$")
"""A value, the echo of a command, or a prompt: an answer that comes late, and no log."""


class Starting:
    """For a dish that can be homed by its power alone; of any other only its boot marks tell."""

    def __init__(self, board: Board, antenna: BirdcageAntenna, mover: Mover) -> None:
        self._board, self._antenna, self._mover = board, antenna, mover
        self._heard = 0

    def hear(self, line: str, *, met: bool) -> None:
        """Take in an unsolicited line; a log that streams while nothing answers is shown."""
        if self._antenna.protocol.model.homing_s is not None or self._board.state.link.state is Link.UP:
            return
        if UNREADABLE in line or (met and self._is_answer(line)):
            return
        self._heard += 1
        if self._heard >= (LOG_LINES if met else 1):
            self._mover.activity(Activity.INITIALIZING, line.strip())

    def _is_answer(self, line: str) -> bool:
        """Return whether it is of an answer, late or in pieces: a value, an echo, a prompt, a list of commands."""
        return _ANSWER.search(line) is not None or is_of_help(line, self._antenna.protocol.dialect)

    def ended(self) -> None:
        """A boot mark came: where the search can't be switched off for good, it begins now."""
        if self._antenna.protocol.model.search_switch is SearchSwitch.UNTIL_POWER_UP:
            self._board.change(search=Search.RUNNING)

    def answers(self) -> None:
        """The dish answers: what it printed until now is done."""
        self._heard = 0
