"""Peaking and switches, `PEAK>` (docs/reference/g2-commands.md, *PEAK>*).

The lines of `rssits` and `ts` are quoted (noted), the others assumed. `pw` and `pxy1` move the dish: they step across
the place where it stands and end at the best one that they found. The shell is deaf meanwhile, as in any command.
"""

from __future__ import annotations

from birdcage.sim.chance import seeded
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.tuner import HORIZONTAL_V, VERTICAL_V
from birdcage.sim.shell import Die, Pause, Script
from birdcage.sim.trk.limits import INT_MAX

READS = 10
TOGGLE_S = 0.3
"""How long the LNB takes to follow its voltage (assumed)."""
SMALLEST_STEP_DEG = 0.05
NAMES = ("AZ", "EL")


class PeakMenu(G2Menu):
    """Signal in both polarisations, the best direction near here, and the switch."""

    prompt = "PEAK>"
    help_lines = (
        "help [<command>]",
        "psnr - peak SNR",
        "pw - peak signal search",
        "pxy1 [<motor>] - peak one axis",
        "q",
        "rssits - RSSI with LNB toggle switch",
        "stb [<0|1>] - LNB STB",
        "ts - toggle switch status",
    )

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {
            "psnr": self._snr,
            "pw": self._both_axes,
            "pxy1": self._one_axis,
            "rssits": self._toggle,
            "stb": self._stb,
            "ts": self._switch,
        }
        self._rng = seeded("peak", board.settings.seed)
        self._forget()
        board.at_power_on.append(self._forget)

    def _forget(self) -> None:
        self._stb_on = True  # the boot log says so

    def _snr(self, args: list[str]) -> Script:  # noqa: ARG002
        best = 0.0
        for _ in range(READS):
            yield Pause(self.board.settings.tuner_read_s)
            best = max(best, self.board.tuner.read(self.board.now_s).snr_db)
        yield f"Peak SNR: {best:.1f}\n"

    def _both_axes(self, args: list[str]) -> Script:  # noqa: ARG002
        for index in (0, 1):
            if not self.board.dish.axes[index].homed:
                yield from self._unhomed(index)
                return
        for index in (0, 1):
            yield from self._sweep(index)

    def _one_axis(self, args: list[str]) -> Script:
        motor = args[0] if len(args) == 1 else "0" if not args else ""
        if motor not in ("0", "1"):
            yield from self.bad_parameter()
        elif not self.board.dish.axes[int(motor)].homed:
            yield from self._unhomed(int(motor))
        else:
            yield from self._sweep(int(motor))

    def _unhomed(self, index: int) -> Script:
        if self.board.settings.unhomed_move == "deadlock":
            yield Die()
        yield f"Step to Position {NAMES[index]} angle error: {INT_MAX}\n"

    def _sweep(self, index: int) -> Script:
        board, settings = self.board, self.board.settings
        axis, row = board.dish.axes[index], board.nvram.active
        low, high = (row[101], row[102]) if index else (axis.data.low_deg, axis.data.high_deg)
        middle = axis.count(board.now_s)[0]
        step_deg = max(settings.peak_step, SMALLEST_STEP_DEG)
        steps = int(settings.peak_reach / step_deg)
        places = [middle + step * step_deg for step in range(-steps, steps + 1)]
        found: list[tuple[int, float]] = []
        for wanted in (min(max(place, low), high) for place in places):
            yield from self._go(index, wanted)
            yield Pause(settings.tuner_read_s)
            found.append((board.tuner.read(board.now_s).rssi, axis.count(board.now_s)[0]))
        rssi, best = max(found)
        yield from self._go(index, best)
        shown = best % 360.0 if index == 0 else best
        yield f"Peak {NAMES[index]} Angle:{round(shown * 100)} RSSI:{rssi}\n"

    def _go(self, index: int, wanted_deg: float) -> Script:
        axis = self.board.dish.axes[index]
        axis.retarget(self.board.now_s, wanted_deg)
        yield Pause(max(axis.end_s() - self.board.now_s, 0.0))

    def _toggle(self, args: list[str]) -> Script:  # noqa: ARG002
        board, settings = self.board, self.board.settings
        before = board.tuner.lnb_volts
        levels = []
        for volts, floor in ((HORIZONTAL_V, settings.even_floor), (VERTICAL_V, settings.odd_floor)):
            board.tuner.lnb_volts = volts
            yield Pause(TOGGLE_S)
            above = board.tuner.level(board.now_s)[1] * settings.peak_scale
            counts = round(self._rng.gauss(floor + above, settings.rssi_noise)) if board.tuner.on else 0
            levels.append(max(counts, 0))
        board.tuner.lnb_volts = before
        yield f"Even_sig = {levels[0]}, Odd_sig = {levels[1]}\n"

    def _stb(self, args: list[str]) -> Script:
        if len(args) > 1 or args[:1] not in ([], ["0"], ["1"]):
            yield from self.bad_parameter()
            return
        if args:
            self._stb_on = args == ["1"]
        yield f"{'Enabled' if self._stb_on else 'Disabled'} LNB STB\n"

    def _switch(self, args: list[str]) -> Script:  # noqa: ARG002
        port = self.board.tuner.switch_port
        status = 1 << (port - 1) if port else 0
        yield f"SW Status: 0b{status:04b} {status}\n"
