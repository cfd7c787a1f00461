"""A dish that starts by itself: homes, prints its log meanwhile, and then searches for TV satellites."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.rotator.facts import SearchSwitch
from birdcage.station.board import Board
from birdcage.station.mover import Mover
from birdcage.station.state import Activity, Link, Search

LOG_LINES = 3
"""So many lines from a dish that does not answer are a log; fewer may be late answers."""
UNREADABLE = "\N{REPLACEMENT CHARACTER}"


class Starting:
    """For a dish that can be homed by its power alone; of any other only its boot marks tell."""

    def __init__(self, board: Board, antenna: BirdcageAntenna, mover: Mover) -> None:
        self._board, self._antenna, self._mover = board, antenna, mover
        self._heard = 0

    def hear(self, line: str, *, met: bool) -> None:
        """Take in an unsolicited line; a log that streams while nothing answers is shown."""
        if self._antenna.rotator.facts.homing_s is not None or self._board.state.link.state is Link.UP:
            return
        if UNREADABLE in line or (met and self._antenna.rotator.is_answer(line)):
            return
        self._heard += 1
        if self._heard >= (LOG_LINES if met else 1):
            self._mover.activity(Activity.INITIALIZING, line.strip())

    def ended(self) -> None:
        """A boot mark came: where the search can't be switched off for good, it begins now."""
        if self._antenna.rotator.facts.search_switch is SearchSwitch.UNTIL_POWER_UP:
            self._board.change(search=Search.RUNNING)

    def answers(self) -> None:
        """The dish answers: what it printed until now is done."""
        self._heard = 0
