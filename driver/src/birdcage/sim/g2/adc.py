"""The analogue menu, `ADC>` (reference section 7.3): raw levels, and the board's identity.

`bdid`, `bdrevid` and the line of `scan` are quoted [S1]. What `rssi` and `m` print around their number is [I], and so
is the path of `scan` on a homed dish: 10 degrees onward in steps of one. Its hang on an unhomed one is [S1].
"""

from __future__ import annotations

from birdcage.sim.chance import seeded
from birdcage.sim.g2.board import INT_MAX, Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Die, Listen, Pause, Script

SCAN_STEPS, SCAN_STEP_CDEG = 10, 100
READ_S = 0.05
MONITOR_S = 0.2
NOISE_COUNTS = 1.5
LOCK_COUNTS = 30.0
"""So far above the floor the tuner is taken to lock. [I]"""


class Adc(G2Menu):
    """Levels before the tuner."""

    prompt = "ADC>"
    help_lines = ("help [<command>]", "bdid", "bdrevid", "m", "q", "rssi", "scan")

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        self.commands |= {
            "bdid": self._board_id,
            "bdrevid": self._revision,
            "m": self._monitor,
            "rssi": self._rssi,
            "scan": self._scan,
        }
        self._rng = seeded("adc", board.settings.seed)

    def _board_id(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "STATIONARY\n"

    def _revision(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "A\n"

    def _rssi(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Pause(READ_S)
        yield f"{self._counts()}\n"

    def _monitor(self, args: list[str]) -> Script:  # noqa: ARG002
        key = None
        while not key:
            yield f"\rRSSI: {self._counts():4d}"
            key = yield Listen(MONITOR_S)
        yield "\n"

    def _scan(self, args: list[str]) -> Script:  # noqa: ARG002
        board = self.board
        axis = board.dish.axes[0]
        if not axis.homed:
            if board.settings.unhomed_scan == "deadlock":
                yield Die()
            yield f"Step to Position AZ angle error: {INT_MAX}\n"
            return
        step = SCAN_STEP_CDEG / 100.0
        if axis.count(board.now_s)[0] + SCAN_STEPS * step > axis.data.high_deg:
            step = -step
        for index in range(SCAN_STEPS + 1):
            if index:
                axis.retarget(board.now_s, axis.ordered_deg() + step)
            yield Pause(max(axis.end_s() - board.now_s, 0.0) + READ_S)
            cdeg = round(axis.count(board.now_s)[0] * 100) % 36000
            lock = self._above_floor() > LOCK_COUNTS
            snr = 8 if lock else 0
            yield (
                f"Motor:0 Angle:{cdeg} RSSI:{self._counts()} Lock:{int(lock)} SNR:{snr} Scan Delta:{SCAN_STEP_CDEG}\n"
            )

    def _above_floor(self) -> float:
        now_s = self.board.now_s
        az, el = self.board.dish.shafts(now_s)
        return self.board.level(now_s, az, el) - self.board.settings.rssi_floor

    def _counts(self) -> int:
        settings = self.board.settings
        return round(self._rng.gauss(settings.adc_floor + self._above_floor() * settings.adc_scale, NOISE_COUNTS))
