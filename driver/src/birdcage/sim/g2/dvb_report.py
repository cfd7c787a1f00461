"""The part of `DVB>` that tells about the tuner: what it is, whether it locks, and what it has counted.

Source: docs/reference/g2-commands.md, *DVB>*.

The words of `config` are those of the boot log (noted); that `ls` counts reads, no-signal and glitches and lists
networks is noted. Every line around them is assumed.
"""

from __future__ import annotations

from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.tuner import NO_NETWORK
from birdcage.sim.shell import Pause, Script
from birdcage.sim.trk.menu import Command

RANGE_READS = 20
PORTS = 4


class DvbReport:
    """Identity, lock, statistics and power."""

    def __init__(self, menu: G2Menu) -> None:
        self._menu = menu
        self._board = menu.board
        self._multi_switch = 0
        self.commands: dict[str, Command] = {
            "config": self._config,
            "diag": self._diagnostics,
            "ls": self._lock_status,
            "msw": self._switch,
            "pwr": self._power,
            "qls": self._quick_lock,
            "range": self._range,
            "stats": self._statistics,
        }
        menu.board.at_power_on.append(self._forget)

    def _forget(self) -> None:
        self._multi_switch = 0

    def _config(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "BCM4515 ID 0x4515 Rev B0, FW v113.37, strap 0x25018\n"

    def _diagnostics(self, args: list[str]) -> Script:  # noqa: ARG002
        tuner = self._board.tuner
        for number in tuner.order:
            yield Pause(self._board.settings.tuner_read_s)
            heard, channel = tuner.survey(number, self._board.now_s), tuner.channels[number]
            yield (
                f"Transponder {number}\n"
                f"  Frequency: {channel.frequency_khz} kHz Symbol Rate: {channel.symbol_rate_ksps} ksps "
                f"Polarity: {channel.polarity}\n"
                f"  RSSI: {heard.rssi} Lock: {int(heard.locked)} SNR: {heard.snr_db:.1f} NID: {heard.network:04X}\n"
            )

    def _lock_status(self, args: list[str]) -> Script:  # noqa: ARG002
        heard = self._board.tuner.read(self._board.now_s)
        tally = self._board.tuner.tally
        yield f"Lock: {int(heard.locked)}\n"
        yield f"Total reads: {tally.reads} No signal: {tally.no_signal} Glitches: {tally.glitches}\n"
        nameless = tally.reads - sum(tally.networks.values())
        networks = [*sorted(tally.networks.items()), *([(NO_NETWORK, nameless)] if nameless else [])]
        yield "NID table:\n" + "".join(f"  {network:04X} {count}\n" for network, count in networks)

    def _quick_lock(self, args: list[str]) -> Script:  # noqa: ARG002
        heard = self._board.tuner.read(self._board.now_s)
        yield f"Lock: {int(heard.locked)} SNR: {heard.snr_db:.1f}\n"

    def _range(self, args: list[str]) -> Script:  # noqa: ARG002
        values = []
        for _ in range(RANGE_READS):
            yield Pause(self._board.settings.tuner_read_s)
            values.append(self._board.tuner.read(self._board.now_s).rssi)
        yield f"Range: min {min(values)} max {max(values)} span {max(values) - min(values)}\n"

    def _statistics(self, args: list[str]) -> Script:  # noqa: ARG002
        tally = self._board.tuner.tally
        yield f"Reads: {tally.reads} Locks: {tally.reads - tally.no_signal} Glitches: {tally.glitches}\n"
        yield f"RSSI min: {tally.lowest} max: {tally.highest}\n"

    def _switch(self, args: list[str]) -> Script:
        if len(args) > 1 or (args and args[0] not in map(str, range(PORTS + 1))):
            yield from self._menu.bad_parameter()
            return
        self._multi_switch = int(args[0]) if args else self._multi_switch
        yield f"Multi-switch: {self._multi_switch}\n"

    def _power(self, args: list[str]) -> Script:
        if args not in ([], ["0"], ["1"]):
            yield from self._menu.bad_parameter()
            return
        tuner = self._board.tuner
        tuner.on = args == ["1"] if args else tuner.on
        yield f"Tuner power: {'ON' if tuner.on else 'OFF'}\n"
