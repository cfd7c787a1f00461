"""The tuner's menu, `DVB>`: a BCM4515 behind the LNB (docs/reference/g2-commands.md, *DVB>*)."""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.protocol.g2.diseqc import Diseqc
from birdcage.protocol.g2.tuner_values import (
    read_agc,
    read_channel,
    read_identity,
    read_lock,
    read_network,
    read_snr_db,
    read_volts,
)
from birdcage.protocol.trk.reading import find, garbage, printed
from birdcage.protocol.trk.room import Room
from birdcage.rotator.feature import Value
from birdcage.rotator.values import RssiReading

MOST_READS = 1000
_RSSI = re.compile(r"Reads:(\d+)\s+RSSI\[avg:\s*(\d+)\s+cur:\s*(\d+)\]")
_ALIKE, _ALIKE_COUNTS = 4, 50
"""Average and last read may differ so much: further apart, one of them has lost or won a digit on its way."""
_READ_S = 0.1
"""A generous guess of what one read of `rssi n` takes; only a deadline depends on it."""
_STREAM_S = 3.0
"""The longest wait for the lines of a stream, beside a second for each; no source says how often they come."""
_REPORT_S = 10.0
_TABLE_S = 60.0


class Tuner(Room):
    """Signal strength, lock, the channel, and DiSEqC."""

    menu: ClassVar[str] = "dvb"

    @property
    def diseqc(self) -> Diseqc:
        """LNB and switches on the cable."""
        return Diseqc(self.console)

    def rssi(self, reads: int = 10) -> RssiReading:
        """Read the signal strength, averaged over 1 to 1000 reads, in counts; the shell is deaf meanwhile."""
        if not 1 <= reads <= MOST_READS:
            raise ValueError(f"iterations must lie from 1 to {MOST_READS}, not {reads}")
        reply = self._run(f"rssi {reads}", takes_s=reads * _READ_S)
        reading = RssiReading(*(int(number) for number in find(reply, _RSSI).groups()))
        low, high = sorted((reading.average, reading.current))
        if high > _ALIKE * low + _ALIKE_COUNTS:
            raise garbage(reply)
        return reading

    def supply_13_volts(self) -> None:
        """Feed the LNB with 13 V (`lnbdc odu`): vertical polarisation. After a start it is 18 V, horizontal."""
        self._run("lnbdc odu")

    def agc(self, samples: int = 1) -> tuple[dict[str, Value], ...]:
        """Read gain control, SNR and network so often (`agc`, a stream); fewer when they come slowly."""
        return self._sample("agc", read_agc, samples, _STREAM_S + samples)

    def snr_db(self) -> float:
        """Read the signal-to-noise ratio in dB (`snr`, a stream)."""
        return self._sample("snr", read_snr_db, 1, _STREAM_S)[0]

    def network(self) -> str:
        """Read which network is heard (`nid`, a stream), as `0x101A`, or `none` (`FFFF`)."""
        return self._sample("nid", read_network, 1, _STREAM_S)[0]

    def lnb_volts(self) -> float:
        """Read the supply of the LNB in volts (`lnbv`, a stream): 13 or 18, about."""
        return self._sample("lnbv", read_volts, 1, _STREAM_S)[0]

    def identity(self) -> dict[str, Value]:
        """Read chip and firmware (`config`)."""
        return read_identity(self._run("config").lines)

    def channel(self) -> dict[str, Value]:
        """Read the channel's parameters (`dis`)."""
        return read_channel(self._run("dis").lines)

    def lock_status(self) -> dict[str, Value]:
        """Read the lock status with its counts (`ls`), also as printed (`lock_status`)."""
        lines = self._run("ls", takes_s=_REPORT_S).lines
        return {**read_lock(lines), **printed("lock_status", lines)}

    def quick_lock_status(self) -> dict[str, Value]:
        """Read the short lock status (`qls`)."""
        return read_lock(self._run("qls").lines)

    def statistics(self) -> tuple[str, ...]:
        """Read the statistics of all reads (`stats`), as printed."""
        return self._run("stats").lines

    def diagnostics(self) -> tuple[str, ...]:
        """Read the diagnostics of each transponder (`diag`), as printed."""
        return self._run("diag", takes_s=_REPORT_S).lines

    def frequencies(self) -> tuple[str, ...]:
        """Read the list of the tuner's frequencies (`freqs`), as printed."""
        return self._run("freqs").lines

    def build_table(self, *, extended: bool = False) -> tuple[str, ...]:
        """Build the table of transponders anew (`table`, `tablex`) and return it as printed; may take a minute."""
        return self._run("tablex" if extended else "table", takes_s=_TABLE_S).lines

    def select(self, transponder: int) -> tuple[str, ...]:
        """Tune to a transponder by its number (`t <n>`); return what it prints. ValueError for a negative one."""
        if transponder < 0:
            raise ValueError(f"a transponder has a number from 0 on, not {transponder}")
        return self._run(f"t {transponder}").lines

    def set_parameter(self, number: int, value: int) -> tuple[str, ...]:
        """Change a parameter of the channel (`e <n> <v>`); `dis` lists them. Return what it prints."""
        return self._run(f"e {number} {value}").lines
