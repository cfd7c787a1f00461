"""A simulated receiver beside a simulated dish, speaking Hamlib's network protocol as `rigctld` and SDR++ do.

It hears beacons (`birdcage.sim.beacons`) through the dish's own beam, where that truly looks, over a floor with noise.
Sun and trees in the beam raise that floor, at whatever frequency.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from birdcage.base.clock import Clock
from birdcage.sim.beacons import Beacon, read_beacons
from birdcage.sim.beam import power_toward
from birdcage.sim.chance import seeded
from birdcage.sim.device import Device
from birdcage.sim.settings import Options, SimSettings
from birdcage.sim.sky import SimSky

OK, INVALID, DEAF, UNKNOWN = "RPRT 0\n", "RPRT -1\n", "RPRT -6\n", "RPRT -11\n"
"""Codes of Hamlib (`rig_errcode_e` in its rig.h): taken; a value that it does not take; no radio; it cannot do that."""
STRENGTH_BIT = 1 << 30
HIGHEST_HZ = 3e10


@dataclass(frozen=True, slots=True)
class RigSettings(Options):
    """The receiver's options: `sim:rig?dish=ID&beacons=FILE`."""

    firmware: ClassVar[str] = "rig"

    dish: str = ""
    """The `id` of the simulated dish through whose beam it hears; without one it hears its own noise."""
    beacons: str = ""
    """The file of what there is to be heard; read when it has changed, and nothing while it is not there."""
    passband_hz: float = 20_000.0
    """What it lets through about the frequency that it is tuned to: Doppler must be right within half of it."""
    lo_hz: float = 0.0
    """Oscillator of the converter before it: it hears what lies so much higher than it is tuned to."""
    floor_db: float = -60.0
    """What it tells where nothing is sent."""
    noise_db: float = 0.3
    """Standard deviation of what it tells."""
    seed: int = 1
    """Of the noise."""


class SimReceiver:
    """The receiver. Any thread may ask."""

    def __init__(self, settings: RigSettings, clock: Clock, dish: Callable[[], Device | None]) -> None:
        self._settings, self._clock, self._dish = settings, clock, dish
        self._rng = seeded("receiver", settings.seed)
        self._lock = threading.Lock()
        self._file: tuple[int, int] | None = None
        self._beacons: tuple[Beacon, ...] = ()
        self._sky: tuple[SimSettings, SimSky] | None = None
        """Of the dish that it was last asked beside."""
        self.frequency_hz = 145e6
        """What it is tuned to."""
        self.recording = False
        """Whether it was told AOS, and not LOS since."""

    def level_db(self) -> float:
        """Return what it hears at this moment, without noise."""
        settings, dish = self._settings, self._dish()
        power = 10.0 ** (settings.floor_db / 10.0)
        if dish is None:
            return settings.floor_db
        now, beam = self._clock.utc(), dish.truth()
        now_s = now.timestamp()
        sky = self._sky_of(dish)
        power *= 1.0 + sky.warmth(now, beam.beam_az_deg, beam.beam_el_deg)
        for beacon in self._known():
            heard = beacon.at(now_s)
            if heard is None or heard.el_deg <= 0.0 or sky.trees.hides(heard.az_deg, heard.el_deg):
                continue
            off_hz = heard.frequency_hz - settings.lo_hz - self.frequency_hz
            if abs(off_hz) <= settings.passband_hz / 2.0:
                share = power_toward(
                    beam.beam_az_deg, beam.beam_el_deg, heard.az_deg, heard.el_deg, dish.settings.reflector_in
                )
                power += share * 10.0 ** (heard.level_db / 10.0)
        return 10.0 * math.log10(power)

    def _sky_of(self, dish: Device) -> SimSky:
        if self._sky is None or self._sky[0] is not dish.settings:
            self._sky = dish.settings, SimSky(dish.settings)
        return self._sky[1]

    def _known(self) -> tuple[Beacon, ...]:
        if not self._settings.beacons:
            return ()
        path = Path(self._settings.beacons)
        try:
            status = path.stat()
            file = (status.st_mtime_ns, status.st_size)
            if file != self._file:
                self._beacons, self._file = read_beacons(path), file
        except FileNotFoundError:
            self._beacons, self._file = (), None
        return self._beacons

    def answer(self, line: str) -> str:
        """Carry out one line and return what it answers, with its line ends."""
        with self._lock:
            words = line.split()
            if not words:
                return ""
            if words[0] in ("F", "\\set_freq"):
                return self._tune(words[1:])
            if words[0] in ("l", "\\get_level"):
                return self._level(words[1:])
            if words[0] in ("AOS", "LOS"):
                self.recording = words[0] == "AOS"
                return OK
            return self._fixed().get(words[0].removeprefix("\\"), UNKNOWN)

    def _tune(self, words: list[str]) -> str:
        try:
            hz = float(words[-1]) if words else 0.0
        except ValueError:
            return INVALID
        if not 0.0 < hz <= HIGHEST_HZ:
            return INVALID
        self.frequency_hz = hz
        return OK

    def _level(self, words: list[str]) -> str:
        if words[-1:] == ["?"]:
            return "STRENGTH\n"
        if words[-1:] != ["STRENGTH"]:
            return UNKNOWN
        try:
            level_db = self.level_db()
        except (OSError, ValueError):  # the file of beacons has become unreadable
            return DEAF
        return f"{level_db + self._rng.gauss(0.0, self._settings.noise_db):.1f}\n"

    def _fixed(self) -> dict[str, str]:
        """Return what is answered to questions that programs ask when they connect."""
        frequency = f"{self.frequency_hz:.0f}\n"
        mode = f"FM\n{self._settings.passband_hz:.0f}\n"
        return {
            "f": frequency, "get_freq": frequency, "m": mode, "get_mode": mode, "v": "VFOA\n", "get_vfo": "VFOA\n",
            "s": "0\nVFOA\n", "get_split_vfo": "0\nVFOA\n", "t": "0\n", "get_ptt": "0\n",
            "chk_vfo": "CHKVFO 0\n", "get_powerstat": "1\n",
            "_": "birdcage, simulated\n", "get_info": "birdcage, simulated\n", "dump_state": STATE,
        }  # fmt: skip


STATE = "".join(
    f"{line}\n"
    for line in (
        "0", "2", "0",  # version of this list, Hamlib's number of the model, region
        f"1.000000 {HIGHEST_HZ:.6f} 0x1ff -1 -1 0x1 0x1", "0 0 0 0 0 0 0",  # what it receives
        "0 0 0 0 0 0 0",  # what it sends
        "0x1ff 1", "0 0", "0x1ff 20000", "0 0",  # steps, filters
        "0", "0", "0", "0", "", "",  # RIT, XIT, IF shift, announces, preamplifiers, attenuators
        "0x0", "0x0", f"{STRENGTH_BIT:#x}", "0x0", "0x0", "0x0",  # functions, levels, parameters
    )
)  # fmt: skip
"""What Hamlib's `netrigctl` reads first, version 0 of it."""
