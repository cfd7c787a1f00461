"""The analogue menu, `ADC>` (docs/reference/g2-commands.md, *ADC>*): raw levels, and the board's identity.

`bdid`, `bdrevid` and the line of `scan` are quoted (noted). What `rssi` and `m` print around their number is assumed.
"""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.sweep import adc_scan
from birdcage.sim.shell import Listen, Pause, Script

READ_S = 0.05
MONITOR_S = 0.2


class AdcMenu(G2Menu):
    """Levels before the tuner."""

    prompt = "ADC>"
    help_lines = (
        "help [<command>]",
        "bdid - Board ID",
        "bdrevid - Board revision",
        "m - Monitor RSSI",
        "q",
        "rssi - Read RSSI",
        "scan - Scan AZ with RSSI",
    )

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {
            "bdid": self._board_id,
            "bdrevid": self._revision,
            "m": self._monitor,
            "rssi": self._rssi,
            "scan": self._scan,
        }

    def _board_id(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "STATIONARY\n"

    def _revision(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "A\n"

    def _rssi(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Pause(READ_S)
        yield f"{self.board.adc_counts()}\n"

    def _monitor(self, args: list[str]) -> Script:  # noqa: ARG002
        key = None
        while not key:
            yield f"\rRSSI: {self.board.adc_counts():4d}"
            key = yield Listen(MONITOR_S)
        yield "\n"

    def _scan(self, args: list[str]) -> Script:
        yield from adc_scan(self.board, args) or self.bad_parameter()
