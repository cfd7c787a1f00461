"""The stock firmware of the SatNOGS controller, for stepper motors (docs/reference/easycomm.md)."""

from __future__ import annotations

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.easycomm.knobs import EasycommSettings
from birdcage.sim.easycomm.mechanics import StepperDish
from birdcage.sim.easycomm.tokens import number_after, pair
from birdcage.sim.firmware import FirmwareHost
from birdcage.sim.shell import Pause, Script

VERSION = "SatNOGS-v2.2"
NO_ERROR, HOMING_ERROR, WATCHDOG_ERROR = 1, 4, 16
IDLE, POINTING, ERROR = 1, 4, 8
REBOOT_S = 2.0
SPEEDS = "VU", "VD", "VL", "VR"
"""Velocities in thousandths of deg/s. Its loop for steppers turns by targets alone, so they only change the mode."""


class StockBoard:
    """The controller. It reads whole lines by how they begin, and nothing while it homes."""

    def __init__(self, settings: EasycommSettings, host: FirmwareHost, dish: StepperDish) -> None:
        self.settings, self.dish = settings, dish
        self.error = NO_ERROR
        self.config = [0.0] * 9
        """Gains of both axes, park position, and whether a velocity was asked for last: `CR 1` to `CR 9`."""
        self._host, self._machine = host, host.machine

    @property
    def now_s(self) -> float:
        """Dish time."""
        return self._machine.dish_s

    def run(self, line: str) -> Script:
        """Carry out one line; what it does not know it ignores."""
        if self.error == WATCHDOG_ERROR and line[:2] not in ("GS", "GE", "RB"):
            return  # its watchdog has taken over, and knows only these
        if line.startswith("AZ EL"):
            yield self._position()
        elif line.startswith("AZ"):
            if line == "AZ" and self.settings.bare_az == "answer":
                yield f"AZ{self._told(0):.1f}\n"
            else:
                self._set(line)
        elif line == "EL" and self.settings.bare_az == "answer":
            yield f"EL{self._told(1):.1f}\n"
        elif line[:2] in SPEEDS:
            self.config[8] = 1.0
        elif line.startswith("SA SE"):
            yield self._position()
            self._aim(self._told(0), self._told(1))
        elif line.startswith("RESET"):
            yield self._position()
            yield from self._home()
        elif line.startswith("PARK"):
            yield self._position()
            self._aim(self.config[6], self.config[7])
        elif line.startswith("RST"):
            self.error = WATCHDOG_ERROR
            for axis in self.dish.axes:
                axis.halt(self.now_s)
        elif line.startswith("RB"):
            yield Pause(REBOOT_S)
            self._host.restart()
        else:
            yield self._told_of(line)

    def boot(self, *, home: bool) -> Script:
        """Home as soon as it has power; it prints nothing."""
        self.error = NO_ERROR
        self.config = [0.0] * 9
        if home:
            yield from self._home()

    def _home(self) -> Script:
        """Run both axes to their switches, and read nothing meanwhile."""
        axes = self.dish.axes
        if self.error != NO_ERROR:
            return  # only its power clears that
        ends_s = max(axis.home(self.now_s) for axis in axes)
        yield Pause(ends_s - self.now_s)
        found = [axis.homing_done(self.now_s) for axis in axes]
        if self.settings.home_fails or not all(found):
            self.error = HOMING_ERROR
            for axis in axes:
                axis.halt(self.now_s)
                axis.homed = False
            return
        yield Pause(self.settings.settle)

    def _told_of(self, line: str) -> str:
        """Answer what only asks, and take a setting."""
        if line.startswith("VE"):
            return f"VE{VERSION}\n"
        if line.startswith("GS"):
            moving = self.dish.moving(self.now_s)
            return f"GS{ERROR if self.error != NO_ERROR else POINTING if moving else IDLE}\n"
        if line.startswith("GE"):
            return f"GE{self.error}\n"
        if line.startswith("IP") and line[2:3] in [*"012345678"]:
            return f"IP{line[2]},{self._measured(int(line[2]))}\n"
        if line.startswith("CR ") and line[3:4] in [*"123456789"]:
            index = int(line[3])
            kept = self.config[index - 1]
            return f"{index},{kept:.0f}\n" if index == 9 else f"{index},{kept:.2f}\n"
        if line.startswith("CW") and line[2:3] in [*"12345678"] and (value := number_after(line[3:], ",")) is not None:
            self.config[int(line[2]) - 1] = value
        return ""

    def _measured(self, index: int) -> str:
        rates = [axis.count(self.now_s)[1] for axis in self.dish.axes]
        ends = [int(axis.shaft(self.now_s) <= 0.0) for axis in self.dish.axes]
        told = [f"{self._told(motor):.2f}" for motor in (0, 1)]
        inside = f"{self.settings.temperature:.0f}"
        return (inside, f"{ends[0]}", f"{ends[1]}", *told, "0", "0", *(f"{rate:.2f}" for rate in rates))[index]

    def _axis(self, motor: int) -> AxisMechanics:
        return self.dish.axes[motor]

    def _told(self, motor: int) -> float:
        return self._axis(motor).count(self.now_s)[0]

    def _position(self) -> str:
        return pair(self._told(0), self._told(1))

    def _set(self, line: str) -> None:
        """Take `AZ<deg> EL<deg>`: without a number it is 0, with a letter unchanged; nothing checks a limit."""
        first, *others = line.split(" ")
        self._aim(_angle(first, "AZ"), _angle(others[0], "EL") if others else None)

    def _aim(self, az_deg: float | None, el_deg: float | None) -> None:
        if self.error != NO_ERROR:
            return
        self.config[8] = 0.0
        if az_deg is not None:
            self._axis(0).retarget(self.now_s, az_deg)
        if el_deg is not None:
            self._axis(1).retarget(self.now_s, el_deg)


def _angle(word: str, command: str) -> float | None:
    """Return the angle that a word sets; None where it sets none."""
    if not word.startswith(command) or any(each.isalpha() for each in word[len(command) :]):
        return None
    return number_after(word, command) or 0.0
