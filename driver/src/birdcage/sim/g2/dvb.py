"""The tuner menu, `DVB>` (reference section 7.6): the part whose replies are known."""

from __future__ import annotations

from datetime import timedelta

from birdcage.sim.chance import seeded
from birdcage.sim.g2.board import Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Pause, Script
from birdcage.sim.sky import Sky

MOST_READS = 1000


class Dvb(G2Menu):
    """Signal strength."""

    prompt = "DVB>"
    help_lines = ("help [<command>]", "lnbdc <odu>", "q", "rssi <reads>")

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        self.commands |= {"rssi": self._rssi, "lnbdc": self._lnbdc}
        self._sky = Sky(board.settings)
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
        machine, clock = self.board.machine, self.board.machine.clock
        when = clock.utc() - timedelta(seconds=(clock.monotonic() - machine.now) * clock.rate)
        az_deg, el_deg = self.board.dish.shafts(machine.dish_s)
        return self._sky.reading(when, az_deg + self.board.settings.heading, el_deg, self._rng)

    def _lnbdc(self, args: list[str]) -> Script:
        # 13 V instead of 18 V: nobody measured what that does to the level, so here it does nothing.
        if args != ["odu"]:
            yield from self.bad_parameter()
