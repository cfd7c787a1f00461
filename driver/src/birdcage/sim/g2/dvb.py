"""The tuner menu, `DVB>` (reference section 7.6): the part whose replies are known."""

from __future__ import annotations

from birdcage.sim.chance import seeded
from birdcage.sim.g2.board import Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Pause, Script

MOST_READS = 1000


class Dvb(G2Menu):
    """Signal strength."""

    prompt = "DVB>"
    help_lines = ("help [<command>]", "lnbdc <odu>", "q", "rssi <reads>")

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        self.commands |= {"rssi": self._rssi, "lnbdc": self._lnbdc}
        self._rng = seeded("rssi", board.settings.seed)

    def _rssi(self, args: list[str]) -> Script:
        reads = int(args[0]) if len(args) == 1 and args[0].isdecimal() else 0
        if not 1 <= reads <= MOST_READS:
            yield from self.bad_parameter()
            return
        values = []
        for _ in range(reads):
            yield Pause(self.board.settings.rssi_read_s)
            values.append(self._reading())
        average = round(sum(values) / reads)
        yield f"{self.board.settings.rssi_lead}\nReads:{reads} RSSI[avg: {average} cur: {values[-1]}]\n"

    def _reading(self) -> int:
        now_s = self.board.now_s
        level = self.board.level(now_s, *self.board.dish.shafts(now_s))
        return round(self._rng.gauss(level, self.board.settings.rssi_noise))

    def _lnbdc(self, args: list[str]) -> Script:
        # 13 V instead of 18 V: nobody measured what that does to the level, so here it does nothing.
        if args != ["odu"]:
            yield from self.bad_parameter()
