"""The rooms of the G2's console, as properties of its dialect: `dish.tuner.snr_db()`."""

from __future__ import annotations

from birdcage.protocol.g2.adc import Adc
from birdcage.protocol.g2.drivers import Drivers
from birdcage.protocol.g2.eeprom import Eeprom
from birdcage.protocol.g2.latlon import LatLon
from birdcage.protocol.g2.motors import Motors
from birdcage.protocol.g2.peak import Peak
from birdcage.protocol.g2.pins import Dipswitches, Gpio
from birdcage.protocol.g2.stepper import Stepper
from birdcage.protocol.g2.system import System
from birdcage.protocol.g2.tuner import Tuner
from birdcage.protocol.trk.nvs import TrkNvsProtocol


class G2Menus(TrkNvsProtocol):
    """One property a menu. Each raises LinkError when no port is open."""

    @property
    def tuner(self) -> Tuner:
        """`DVB>`: signal, lock, channel, DiSEqC."""
        return Tuner(self.console)

    @property
    def motors(self) -> Motors:
        """`MOT>`: what the motors tell."""
        return Motors(self.console)

    @property
    def stepper(self) -> Stepper:
        """`STEP>`: the motors in microsteps."""
        return Stepper(self.console)

    @property
    def drivers(self) -> Drivers:
        """`A3981>`: the drivers of both motors."""
        return Drivers(self.console)

    @property
    def adc(self) -> Adc:
        """`ADC>`: raw levels, and which board it is."""
        return Adc(self.console)

    @property
    def dipswitch(self) -> Dipswitches:
        """`DIPSWITCH>`: the switches under the cover."""
        return Dipswitches(self.console)

    @property
    def gpio(self) -> Gpio:
        """`GPIO>`: the pins of the processor."""
        return Gpio(self.console)

    @property
    def eeprom(self) -> Eeprom:
        """`EE>`: the processor's own memory."""
        return Eeprom(self.console)

    @property
    def latlon(self) -> LatLon:
        """`LATLON>`: the place, from two satellites."""
        return LatLon(self.console)

    @property
    def peak(self) -> Peak:
        """`PEAK>`: both polarisations, and the switch."""
        return Peak(self.console)

    @property
    def system(self) -> System:
        """`OS>`: who the dish is."""
        return System(self.console)
