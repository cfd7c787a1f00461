"""The menus of the stand-in dish: what each line prints and does.

A command is a generator. It yields text to say, a time (absolute, in seconds) to wait until, or `KEY` with how long to
wait for a key at most; the shell sends back whether one was pressed.
"""

from __future__ import annotations

import math
import random
from collections.abc import Generator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .habits import MENUS
from .nvs import Nvs

if TYPE_CHECKING:
    from .mechanics import Mechanics


@dataclass(frozen=True)
class Key:
    """Wait for a key, so long at most."""

    longest_s: float


class Dead(Exception):
    """The shell has ended: only a power cycle brings it back."""


class Restart(Exception):
    """The dish starts anew."""


Deeds = Generator[str | float | Key, bool, None]
HELP = {
    "root": "Enter <mot> - Motors\nEnter <dvb> - DVB Tuner\nEnter <nvs> - Settings\nEnter <os> - System\n"
    "Enter <a3981> <adc> <dipswitch> <eeprom> <gpio> <latlon> <peak> <step>\nhelp [<command>]\nreboot\nstow\nq\n",
    "mot": "a [<id>] [<angle>] - Go to Angle > now\nazscan [<az>] [<el>] [<delay>] - AZ sweep with RSSI\n"
    "azscanwxp - AZ sweep with transponder cycling\ne - engage\nela2s\nelminmaxhome\nels2a\ng <az> <el>\nh <id>\nl\n"
    "life\nma\nmotorboth\nmotorlife\nmv\np\npid\nr\nsd\nsp\nsw\nv\nvms\nw\nq - quit\n",
    "dvb": "agc\nconfig\ndis\nfreqs\nlnbdc odu\nlnbv\nls\nman\nqls\nrssi <n>\nsnr\nstats\nt <n>\nq\n",
    "nvs": "d [<index>] - display\ne <index> [<value>] - edit\ns - save\nq\n",
    "os": "id\nreboot\nq\n",
    "step": "e\nma\nmv\np\npid\nr\nv\nq\n",
}
IDENTITY = """NXP Kinetis K60 ARM Cortex-M4
  Package:       144-pin
  Silicon Rev:   2.4
  Mask Set:      4N22D
  P-Flash:       512 KB
  RAM:           128 KB
  Core Clock:    96 MHz (CCLK)
  Bus Clock:     48 MHz (BCLK)
  System ID:     TWELINCH
  Antenna ID:    12-IN G2
  Software:      02.02.48
  Flash Base:    0x00010000 (65536)
  Flash Size:    458752 bytes (448 KB)
"""
PLAIN = {
    ("a3981", "cm"): "AZ AUTO EL AUTO\n", ("a3981", "diag"): "AZ DIAG: OK EL DIAG: OK\n",
    ("a3981", "reset"): "", ("a3981", "sm"): "AZ AUTO EL AUTO\n", ("a3981", "ss"): "AZ 1 EL 1\n",
    ("adc", "bdid"): "STATIONARY\n", ("adc", "bdrevid"): "A\n", ("adc", "rssi"): "236\n",
    ("dipswitch", "dipswitch"): "val:ffffff01\napp_dipswitch:101\n",
    ("dvb", "config"): "ID 0x4515 Rev B0 FW v113.37 strap 0x25018\n", ("dvb", "lnbdc odu"): "",
    ("dvb", "qls"): "Lock: 0\n", ("dvb", "ls"): "Lock: 0 SNR: 0.0\n", ("dvb", "stats"): "reads: 10\n",
    ("dvb", "dis"): "freq 12224000 symrate 20000\n", ("dvb", "freqs"): "1: 12224000\n2: 12239000\n",
    ("dvb", "di2conf"): "RxReplyTimeout\n", ("dvb", "ovraddr"): "0x11\n", ("dvb", "pretx"): "15 ms\n",
    ("dvb", "rrto"): "210 ms\n", ("dvb", "tdthresh"): "110 (0.16 counts/mV)\n", ("os", "id"): IDENTITY,
    ("mot", "l"): "0=AZIMUTH 1=ELEVATION\n", ("mot", "life"): "AZ 12 EL 10\n", ("mot", "motorlife"): "AZ 12 EL 10\n",
    ("mot", "ma"): "Max Accel [0] = 400.00\nMax Accel [1] = 400.00\n", ("mot", "pid"): "Kp=250 Kv=50 Ki=0\n",
    ("peak", "ts"): "SW Status: 0b101 5\n", ("peak", "rssits"): "Even_sig = 489, Odd_sig = 235\n",
    ("step", "ma"): "Accel[0] = 44\nAccel[1] = 28\n", ("step", "pid"): "Kp=250 Kv=50\n",
}  # fmt: skip
STREAMS = {
    ("dvb", "agc"): "AGC: 1873 SNR: 0.0 NID: FFFF\r", ("dvb", "lnbv"): "LNB 13.1 V\r",
    ("dvb", "nid"): "NID: FFFF\r", ("dvb", "snr"): "SNR: 0.0\r", ("adc", "m"): "RSSI: 236\r",
}  # fmt: skip


class Console:
    """Which menu it is in, and what a line does there."""

    def __init__(self, mechanics: Mechanics, nvs: Nvs, rng: random.Random) -> None:
        self.menu = "root"
        self.nvs, self._mechanics, self._rng = nvs, mechanics, rng
        self._habits = mechanics.habits
        self.root_q = 0
        """How often a `q` was carried out at the root."""

    def run(self, line: str) -> Deeds:
        """Carry out one line."""
        words = line.split()
        menu, first = self.menu, words[0] if words else ""
        if not words:
            return
        if (menu, line) in STREAMS:
            yield from self._stream(STREAMS[menu, line])
        elif first in ("?", "help") or (menu, first) == ("dvb", "man"):
            yield HELP.get(menu, "?\nq\n")
        elif first == "q":
            yield self._quit()
        elif menu == "root":
            yield self._root(line)
        elif menu == "nvs":
            yield self.nvs.run(words, line)
        elif menu == "mot":
            yield from self._motors(words)
        elif menu == "step":
            yield self._step(words)
        elif (menu, first) == ("adc", "scan") and not all(self._mechanics.homed):
            raise Dead
        elif menu == "os" and first == "reboot":
            raise Restart
        elif (menu, first) == ("dvb", "rssi") and len(words) == 2 and words[1].isdigit():
            yield from self._rssi(int(words[1]))
        else:
            yield PLAIN.get((menu, " ".join(words)), self._unknown())

    def _unknown(self) -> str:
        return f"{self._habits.unknown_text}\n" if self._habits.unknown_text else ""

    def _quit(self) -> str:
        if self.menu != "root":
            self.menu = "root"
            return ""
        self.root_q += 1
        if self._habits.root_q == "dies":
            raise Dead
        return self._unknown() if self._habits.root_q == "unknown" else ""

    def _root(self, line: str) -> str:
        if line in MENUS[1:]:
            self.menu = line
            return ""
        if line == "reboot":
            raise Restart
        if line == "stow":
            self._mechanics.stow()
            return ""
        return self._unknown()

    def _stream(self, text: str) -> Deeds:
        while True:
            yield text
            if (yield Key(0.1)):
                yield "\n"
                return

    def _rssi(self, reads: int) -> Deeds:
        yield self._mechanics.now() + 0.01 * reads
        level = 400 + self._rng.randint(-1, 4)
        yield f"{self._rng.randint(1, 9)} 7\nReads:{reads} RSSI[avg: {level} cur: {level + 1}]\n"

    def _step(self, words: list[str]) -> str:
        motors = self._mechanics.motors
        counts = 40000 / 360, 24960 / 360
        match words:
            case ["mv"]:
                return "".join(f"Max Vel [{i}] = {round(motors[i].max_speed * counts[i])}\n" for i in (0, 1))
            case ["mv", "0" | "1" as axis, speed] if speed.isdigit() and int(speed) > 0:
                motors[int(axis)].max_speed = int(speed) / counts[int(axis)]
                return ""
            case _:
                return PLAIN.get(("step", " ".join(words)), self._unknown())

    def _motors(self, words: list[str]) -> Deeds:
        mechanics = self._mechanics
        match words:
            case ["a"]:
                if self._habits.query_blocks:
                    yield mechanics.rests_at
                yield mechanics.printed()
            case ["a", "0" | "1" as axis, angle] if _number(angle) is not None:
                yield from mechanics.move(int(axis), angle)
            case ["g", az, el] if _number(az) is not None and _number(el) is not None:
                yield from self._go(float(az), float(el))
            case ["h", "0" | "1" | "*" as axis]:
                yield from mechanics.home((0, 1) if axis == "*" else (int(axis),))
            case ["r" | "e"]:
                mechanics.power(on=words[0] == "e")
            case ["mv"]:
                yield "".join(f"Max Vel [{i}] = {mechanics.motors[i].max_speed:.2f}\n" for i in (0, 1))
            case ["v"]:
                yield "Vel [0] = 0.00\nVel [1] = 0.00\n"
            case ["p"]:
                yield "".join(f"Pos [{i}] = {mechanics.steps(i)}\n" for i in (0, 1))
            case ["elminmaxhome"]:
                yield "Min: {} Max: {} Home: {}\n".format(*(self.nvs.ram[row] for row in (101, 102, 103)))
            case _:
                yield PLAIN.get(("mot", " ".join(words)), self._unknown())

    def _go(self, az: float, el: float) -> Deeds:
        """Both axes at once; any key ends it."""
        mechanics = self._mechanics
        for axis, angle in enumerate((az, el)):
            if refusal := mechanics.refuses(axis, angle):
                yield refusal
                return
        mechanics.send(0, az)
        mechanics.send(1, el)
        if (yield Key(max(mechanics.rests_at - mechanics.now(), 0.0))):
            mechanics.halt()


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
