"""The firmware of the RP2040 base station: EasyComm, and its bench commands (docs/reference/easycomm.md)."""

from __future__ import annotations

import math
from collections.abc import Callable

from birdcage.sim.chance import seeded
from birdcage.sim.easycomm.knobs import EasycommSettings
from birdcage.sim.easycomm.mechanics import ServoDish
from birdcage.sim.easycomm.pid import DEAD_BAND_DEG, KD, KI, KP
from birdcage.sim.easycomm.servo import ServoAxis
from birdcage.sim.easycomm.tokens import number_after, pair
from birdcage.sim.firmware import FirmwareHost
from birdcage.sim.shell import Pause, Script

VERSION = "SatNOGS-RP2040-v0.2"
LIMITS = {"AZ": (-360.0, 360.0), "EL": (0.0, 180.0)}
"""It goes to the nearer end of these without a word."""
USB_S = 1.5
DASH = "\xe2\x80\x94"
"""The three bytes of a long dash, one by one: the wire is not text."""
MONITOR_S = 0.1
LEVEL_DEG, LEVEL_DUTY, LEVEL_STEP_S, LEVEL_LONGEST_S = 1.5, 0.25, 0.05, 15.0
"""How it drives its elevation level at power-up: how near, by which duty, how often it looks, for how long."""
HELP = (
    "=== Bench test commands ===", "DUTY_AZ<f>  Raw AZ motor duty (-1..1)", "DUTY_EL<f>  Raw EL motor duty (-1..1)",
    "STOP        Stop all motors", "TICKS       Encoder tick counts", "ZERO        Reset encoder counters to 0",
    "MONITOR     Toggle live tick stream (10 Hz)", "INFO        Full status dump", "GAINS       PID gains",
    "KP<f> KI<f> KD<f>  Set PID gains", "IMU         Read accelerometer", "RECAL       Re-calibrate EL from IMU",
    "=== SatNOGS/EasyComm ===", "VE  GS  GE  AZ  EL  AZ<f> EL<f>  RESET  PARK  STOP  SA  SE",
)  # fmt: skip


class Rp2040Board:
    """The controller. It handles the words of a line one by one, and ignores those that it does not know."""

    def __init__(self, settings: EasycommSettings, host: FirmwareHost, dish: ServoDish) -> None:
        self.settings, self.dish = settings, dish
        self.homed = not settings.unhomed
        """What `GE` counts by; `RESET` forgets it for good."""
        self.monitoring = 0
        """Counts the streams begun; 0 while there is none."""
        self._streams = 0
        self._host, self._machine = host, host.machine
        self._rng = seeded("imu", settings.seed)
        self._az, self._el = dish.az, dish.el
        self._words: dict[str, Callable[[], str]] = {
            "RESET": self._reset, "R": self._reset, "PARK": self._park, "SA": lambda: self._stop(self._az),
            "SE": lambda: self._stop(self._el), "S": lambda: self._stop(self._az, self._el),
            "STOP": lambda: self._stop(self._az, self._el), "VE": lambda: f"VE{VERSION}\n",
            "GS": lambda: f"GS{2 if self.off_target else 1}\n", "GE": lambda: f"GE{self.error}\n",
            "TICKS": self._ticks, "INFO": self._info, "ZERO": self._zero, "Z": self._zero, "MONITOR": self._monitor,
            "MON": self._monitor, "GAINS": self._gains, "IMU": self._imu, "RECAL": self._recal,
            "AZEL": self._position, "HELP": self._help, "?": self._help,
        }  # fmt: skip

    @property
    def now_s(self) -> float:
        """Dish time."""
        return self._machine.dish_s

    @property
    def off_target(self) -> bool:
        """Whether an axis is not where it was told to go: that is what `GS` calls moving."""
        return any(abs(axis.target_deg - axis.told(self.now_s)) > DEAD_BAND_DEG for axis in (self._az, self._el))

    @property
    def error(self) -> int:
        """The sum that `GE` tells: 1, 4 while it is not homed, 8 while a driver reports a fault."""
        return 1 + (0 if self.homed else 4) + (8 if self.settings.alert else 0)

    def run(self, line: str) -> Script:
        """Carry out the words of a line."""
        words = line.split()
        if self.settings.replies == "apart" and {word.upper() for word in words} == {"AZ", "EL"}:
            yield self._position()
            return
        for word in words:
            answer = self._answer(word)
            if answer:
                yield answer

    def boot(self, *, home: bool) -> Script:
        """Count azimuth from where it stands, drive the elevation level, and say that it is ready."""
        now = self.now_s
        self.halt()
        gains = self.dish.gains
        gains.kp, gains.ki, gains.kd = KP, KI, KD
        for axis in (self._az, self._el):
            axis.set_ticks(now, 0)
            axis.aim(now, 0.0)
            axis.drive(now, 0.0)
        yield Pause(USB_S)
        if not self.settings.imu:
            yield f"IMU not found {DASH} EL assumed 0 (place antenna horizontal)\n"
        elif home and self.settings.el_homes:
            yield from self._level()
        else:
            self._calibrate(self._tilt(20))
        self.homed = self._az.homed = self._el.homed = True
        yield f"\n== {VERSION} ready ==\n"
        yield f"IMU: {'OK (ID=0xE5)' if self.settings.imu else 'NOT FOUND (ID=0x00)'}\n"
        yield "AZ zeroed (point north before power-on)\n"
        yield "Type HELP for commands\n"

    def halt(self) -> None:
        """End the stream."""
        self.monitoring = 0

    def _level(self) -> Script:
        yield f"EL homing: IMU reads {self._tilt(10):.1f} deg, driving to horizontal...\n"
        until = self.now_s + LEVEL_LONGEST_S
        while self.now_s < until:
            tilt = self._tilt(3)
            if abs(tilt) <= LEVEL_DEG:
                self._el.drive(self.now_s, 0.0)
                self._calibrate(0.0)
                yield f"EL homed to horizontal (IMU: {tilt:.1f} deg)\n"
                return
            self._el.drive(self.now_s, -LEVEL_DUTY if tilt > 0.0 else LEVEL_DUTY)
            yield Pause(LEVEL_STEP_S)
        self._el.drive(self.now_s, 0.0)
        tilt = self._tilt(20)
        self._calibrate(tilt)
        yield f"EL homing timeout {DASH} calibrated from IMU at {tilt:.1f} deg\n"

    def _answer(self, word: str) -> str:
        upper = word.upper()
        for axis in (self._az, self._el):
            name = axis.data.name
            if (deg := number_after(word, name)) is not None:
                self._go(axis, deg)
                return ""
            if upper == f"GET_{name}":
                return self._position()
            if upper == name:
                told = f"{name}{axis.told(self.now_s):.1f}\n"
                return told if self.settings.replies == "apart" else self._position()
            if (duty := number_after(word, f"DUTY_{name}")) is not None:
                self._manual(axis, duty)
                return f"{name} duty={duty:.2f}\n"
        for gain in ("KP", "KI", "KD"):
            if (value := number_after(word, gain)) is not None:
                setattr(self.dish.gains, gain.lower(), value)
                for axis in (self._az, self._el):
                    axis.told(self.now_s)
                    axis.loop.clear(duty=False)
                return self._gains()
        return self._words[upper]() if upper in self._words else ""

    def _go(self, axis: ServoAxis, deg: float) -> None:
        """Set a target; that leaves manual mode on both axes."""
        low, high = LIMITS[axis.data.name]
        axis.aim(self.now_s, min(max(deg, low), high))
        for each in (self._az, self._el):
            each.drive(self.now_s, None)

    def _manual(self, axis: ServoAxis, duty: float) -> None:
        """Give one motor a duty; the other one keeps what its loop gave it last."""
        for each in (self._az, self._el):
            if each.duty is None:
                each.drive(self.now_s, each.loop.duty)
        axis.drive(self.now_s, duty)

    def _park(self) -> str:
        for axis in (self._az, self._el):
            self._go(axis, 0.0)
        return self._position()

    def _stop(self, *axes: ServoAxis) -> str:
        for axis in axes:
            axis.stop(self.now_s)
        return self._position()

    def _reset(self) -> str:
        """Forget that it is homed: without switches to home by, that is all it does."""
        self.homed = self._az.homed = self._el.homed = False
        return self._position()

    def _position(self) -> str:
        return pair(self._az.told(self.now_s), self._el.told(self.now_s))

    def _ticks(self) -> str:
        return f"AZ_TICKS={self._az.ticks(self.now_s)} EL_TICKS={self._el.ticks(self.now_s)}\n"

    def _ends(self) -> tuple[int, int]:
        return int(self._az.pressed(self.now_s)), int(self._el.pressed(self.now_s))

    def _info(self) -> str:
        now, alert = self.now_s, int(self.settings.alert)
        ends, homed, off = self._ends(), int(self.homed), int(self.off_target)
        return (
            f"AZ={self._az.told(now):.1f} EL={self._el.told(now):.1f}\n{self._ticks()}"
            f"AZ_HOMED={homed} EL_HOMED={homed} MOVING={off}\nAZ_END={ends[0]} EL_END={ends[1]}\n"
            f"AZ_ALERT={alert} EL_ALERT={alert}\n"
            f"MANUAL={int(self._az.duty is not None)} STATUS={1 + off} ERROR={self.error}\n"
        )

    def _zero(self) -> str:
        """Count from here: the targets stay, so an axis that its loop drives goes on to them."""
        for axis in (self._az, self._el):
            axis.set_ticks(self.now_s, 0)
        return "Encoders zeroed\n"

    def _help(self) -> str:
        return "".join(f"{line}\n" for line in HELP)

    def _gains(self) -> str:
        gains = self.dish.gains
        return f"KP={gains.kp:.3f} KI={gains.ki:.3f} KD={gains.kd:.3f}\n"

    def _monitor(self) -> str:
        if self.monitoring:
            self.monitoring = 0
            return "MONITOR OFF (send MON again to stop)\n"
        self._streams += 1
        self.monitoring = self._streams
        self._next_line(self._streams)
        return "MONITOR ON (send MON again to stop)\n"

    def _next_line(self, stream: int) -> None:
        def line() -> None:
            if self.monitoring == stream:
                ends, alert, now = self._ends(), int(self.settings.alert), self.now_s
                self._host.say(
                    f"AZ_T={self._az.ticks(now)} EL_T={self._el.ticks(now)}  AZ_END={ends[0]} EL_END={ends[1]}  "
                    f"AZ_ALR={alert} EL_ALR={alert}\n"
                )
                self._next_line(stream)

        self._machine.at_dish(self.now_s + MONITOR_S, line)

    def _tilt(self, samples: int) -> float:
        """Return the elevation that the accelerometer tells, the mean of some samples."""
        noise = self._rng.gauss(0.0, self.settings.imu_noise) / math.sqrt(samples)
        return self._el.shaft(self.now_s) + noise

    def _calibrate(self, deg: float) -> None:
        low, high = LIMITS["EL"]
        deg = min(max(deg, low), high)
        self._el.set_ticks(self.now_s, deg * self._el.ticks_per_deg)
        self._el.aim(self.now_s, deg)

    def _imu(self) -> str:
        if not self.settings.imu:
            return "IMU not found\n"
        tilt = self._tilt(1)
        x, z = math.sin(math.radians(tilt)), math.cos(math.radians(tilt))
        return f"X={x:.3f} Y=0.000 Z={z:.3f} g  EL={tilt:.1f} deg\n"

    def _recal(self) -> str:
        if not self.settings.imu:
            return f"IMU not found {DASH} cannot recalibrate\n"
        tilt = self._tilt(20)
        self._calibrate(tilt)
        return f"EL recalibrated from IMU: {tilt:.1f} deg\n"
