"""The tuner menu, `DVB>` (docs/reference/g2-commands.md, *DVB>*): signal, streams, and the pages of its help.

`rssi` is quoted (noted). That `agc`, `snr`, `nid` and `lnbv` print until a key comes, and what about, is noted; their
lines are assumed. Which command stands on which page of the help is noted as far as the notes tell it for `man`,
else assumed.
"""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.chance import seeded
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.diseqc import DiseqcCommands
from birdcage.sim.g2.dvb_channel import DvbChannel
from birdcage.sim.g2.dvb_report import DvbReport
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.tuner import VERTICAL_V
from birdcage.sim.shell import Listen, Pause, Script

MOST_READS = 1000
FIRST_PAGE = (
    "help [<command>]",
    "agc - RF/IF AGC, SNR and NID",
    "config - tuner hardware and firmware",
    "def - restore defaults",
    "diag - transponder diagnostics",
    "dis - display channel parameters",
    "e <n> <value> - edit channel parameter",
    "freqs - tuner frequency list",
    "lnbdc <odu> - LNB DC",
    "lnbv - LNB voltage",
    "ls - lock status",
    "man - more commands",
    "msw [<n>] - multi-switch",
    "nid - network id",
    "pwr [<0|1>] - power",
    "q",
    "qls - quick lock status",
    "range - signal range",
    "rssi <reads> - RSSI average",
    "shuf - shuffle transponders",
    "snr - SNR level",
    "srch - start search",
    "t <n> - select transponder",
    "table - generate transponder table",
)
SECOND_PAGE = (
    "srch_mode [<n>] - auto search mode",
    "stats - satellite read statistics",
    "tablex - extended transponder table",
    "tabto [<ms>] - table timeout",
    "to [<ms>] - timeout",
    "di2conf - DiSEqC LNB config",
    "di2cs <port> - DiSEqC committed switch",
    "di2id - DiSEqC LNB hardware id",
    "di2rcs - DiSEqC read committed switch",
    "di2sc - DiSEqC switch control",
    "di2stat - DiSEqC LNB status",
    "ovraddr [<hex>] - DiSEqC override address",
    "pretx [<ms>] - DiSEqC pre-transmit delay",
    "rrto [<ms>] - DiSEqC receive reply timeout",
    "send <hex> ... - DiSEqC packet",
    "tdthresh [<counts>] - DiSEqC tone detect threshold",
)


class DvbMenu(G2Menu):
    """Signal strength, streams, and everything that its parts add."""

    prompt = "DVB>"
    help_lines = FIRST_PAGE + SECOND_PAGE

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        channel = DvbChannel(self)
        diseqc = DiseqcCommands(self)
        self.commands |= {
            **channel.commands,
            **DvbReport(self).commands,
            **diseqc.commands,
            "agc": self._stream(self._agc),
            "def": self._defaults(channel, diseqc),
            "lnbdc": self._lnbdc,
            "lnbv": self._stream(self._volts),
            "man": self._manual,
            "nid": self._stream(lambda: f"NID: {board.tuner.read(board.now_s).network:04X}"),
            "rssi": self._rssi,
            "snr": self._stream(lambda: f"SNR: {board.tuner.read(board.now_s).snr_db:.1f}"),
        }
        self._rng = seeded("dvb", board.settings.seed)

    @property
    def first_page(self) -> tuple[str, ...]:
        """What `?` lists."""
        return FIRST_PAGE

    def _manual(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "".join(f"{line}\n" for line in SECOND_PAGE)

    def _rssi(self, args: list[str]) -> Script:
        reads = int(args[0]) if len(args) == 1 and args[0].isdecimal() else 0
        if not 1 <= reads <= MOST_READS:
            yield from self.bad_parameter()
            return
        values = []
        for _ in range(reads):
            yield Pause(self.board.settings.rssi_read_s)
            values.append(self.board.tuner.read(self.board.now_s).rssi)
        average = round(sum(values) / reads)
        yield f"{self.board.settings.rssi_lead}\nReads:{reads} RSSI[avg: {average} cur: {values[-1]}]\n"

    def _stream(self, line: Callable[[], str]) -> Callable[[list[str]], Script]:
        def run(args: list[str]) -> Script:  # noqa: ARG001
            key = None
            while not key:
                yield f"{line()}\n"
                key = yield Listen(self.board.settings.stream_s)

        return run

    def _agc(self) -> str:
        """The stronger the signal, the less gain. The figures are assumed."""
        heard = self.board.tuner.read(self.board.now_s)
        above = heard.rssi - self.board.settings.rssi_floor
        return (
            f"RF AGC: {2000 - 4 * above:.0f} IF AGC: {1500 - 2 * above:.0f} "
            f"SNR: {heard.snr_db:.1f} NID: {heard.network:04X}"
        )

    def _volts(self) -> str:
        return f"LNB Voltage: {self._rng.gauss(self.board.tuner.lnb_volts, 0.05):.1f}"

    def _lnbdc(self, args: list[str]) -> Script:
        if args != ["odu"]:
            yield from self.bad_parameter()
            return
        self.board.tuner.lnb_volts = VERTICAL_V

    def _defaults(self, channel: DvbChannel, diseqc: DiseqcCommands) -> Callable[[list[str]], Script]:
        def run(args: list[str]) -> Script:  # noqa: ARG001
            channel.restore()
            diseqc.restore()
            self.board.tuner.restore()
            yield "DVB defaults restored\n"

        return run
