"""The tuner menu, `DVB>` (reference section 7.6): the part whose replies are known, and the streams.

That `agc`, `snr`, `nid` and `lnbv` print until a key comes, and what about, is [S1]; their lines are [I]. The network
is `FFFF`, none, always.
"""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.chance import seeded
from birdcage.sim.g2.board import Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.tuner import VERTICAL_V
from birdcage.sim.shell import Listen, Pause, Script

MOST_READS = 1000
SNR_COUNTS = 15.0
"""Counts above the floor for each dB of SNR. [I]"""


class Dvb(G2Menu):
    """Signal strength."""

    prompt = "DVB>"
    help_lines = ("help [<command>]", "agc", "lnbdc <odu>", "lnbv", "nid", "q", "rssi <reads>", "snr")

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        self.commands |= {
            "agc": self._stream(self._agc),
            "lnbdc": self._lnbdc,
            "lnbv": self._stream(self._volts),
            "nid": self._stream(lambda: "NID: FFFF"),
            "rssi": self._rssi,
            "snr": self._stream(lambda: f"SNR: {self._snr():.1f}"),
        }
        self._rng = seeded("dvb", board.settings.seed)

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
        return self.board.tuner.read(self.board.now_s).rssi

    def _stream(self, line: Callable[[], str]) -> Callable[[list[str]], Script]:
        def run(args: list[str]) -> Script:  # noqa: ARG001
            key = None
            while not key:
                yield f"{line()}\n"
                key = yield Listen(self.board.settings.stream_s)

        return run

    def _agc(self) -> str:
        above = self._reading() - self.board.settings.rssi_floor
        return f"RF AGC: {2000 - 4 * above:.0f} IF AGC: {1500 - 2 * above:.0f} SNR: {self._snr():.1f} NID: FFFF"

    def _volts(self) -> str:
        return f"LNB Voltage: {self._rng.gauss(self.board.tuner.lnb_volts, 0.05):.1f}"

    def _snr(self) -> float:
        return max(0.0, (self._reading() - self.board.settings.rssi_floor) / SNR_COUNTS)

    def _lnbdc(self, args: list[str]) -> Script:
        if args != ["odu"]:
            yield from self.bad_parameter()
            return
        self.board.tuner.lnb_volts = VERTICAL_V
