"""What a G2 tells of its electronics: who it is, its motor drivers, switches, pins and converter.

Source: docs/reference/g2-commands.md.
"""

from __future__ import annotations

from dataclasses import replace

from birdcage.protocol.g2.drivers import FAULT, OK
from birdcage.protocol.g2.feature_rows import Question, counts, each, in_lines, one, text, told, under
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import VERSION, Feature, FeaturePage, HealthMark, Range
from birdcage.rotator.feature_table import FeatureRow

_PAGE = FeaturePage.HARDWARE


def _driver(axis: Axis) -> Feature:
    mark = HealthMark(f"{axis.role.name.lower()} driver", good=(OK,))
    return replace(text(f"driver.{axis.name}", f"Driver of the {axis.name} motor ({OK} or {FAULT})"), health=mark)


_IDENTITY = (
    *told(Question("os", "id", min_interval_s=0.0), lambda dish: dish.system.identity(),
          text(VERSION, "Firmware version"), text("antenna_id", "Antenna ID"), text("system_id", "System ID"),
          text("mcu_package", "Package of the processor"), text("mcu_revision", "Silicon revision of the processor"),
          text("mcu_mask_set", "Mask set of the processor"), Feature("mcu_flash", "Program flash", "KB"),
          Feature("mcu_ram", "Memory of the processor", "KB"), Feature("mcu_core_clock", "Core clock", "MHz"),
          Feature("mcu_bus_clock", "Bus clock", "MHz"), Feature("flash_base", "Address of the flash"),
          Feature("flash_size", "Size of the flash", "bytes")),
    one(Question("adc", "bdid"), lambda dish: dish.adc.board_id(), text("board_id", "Board")),
    one(Question("adc", "bdrevid"), lambda dish: dish.adc.board_revision(),
        text("board_revision", "Revision of the board")),
)  # fmt: skip
_DRIVERS = (
    *told(Question("a3981", "st"), lambda dish: dish.drivers.torque(),
          *each(text("torque", "Torque of the {} motor (HIGH or LOW)"))),
    *told(Question("a3981", "cm"), lambda dish: dish.drivers.current_mode(),
          *each(text("current_mode", "Current mode, {} motor"))),
    *told(Question("a3981", "sm"), lambda dish: dish.drivers.step_mode(),
          *each(text("step_mode", "Step mode, {} motor"))),
    *told(Question("a3981", "ss"), lambda dish: dish.drivers.step_size(),
          *each(Feature("step_size", "Step, {} motor", "sixteenths", range=Range(1.0, 16.0)))),
)  # fmt: skip
_SWITCHES = told(
    Question("dipswitch", "dipswitch"), lambda dish: dish.dipswitch.read(),
    text("dip_switches", "DIP switches"), Feature("dip_code", "Satellites chosen by the DIP switches"),
)  # fmt: skip
_PINS = in_lines(
    Question("gpio", "regs"), lambda dish: dish.gpio.printed(), "pins", "Pins of the processor, as printed"
)
_ADC = one(
    Question("adc", "rssi"), lambda dish: dish.adc.rssi_counts(), counts("raw_rssi", "Raw level before the tuner")
)
_USE = (
    in_lines(Question("mot", "life"), lambda dish: dish.motors.life(), "life", "Use of the motors, as printed"),
    in_lines(Question("mot", "motorlife"), lambda dish: dish.motors.life_details(), "motor_life",
             "Use of the motors in detail, as printed"),
)  # fmt: skip


def hardware(azimuth: Axis, elevation: Axis) -> tuple[FeatureRow, ...]:
    """Return the rows of a dish with these axes."""
    faults = told(Question("a3981", "diag"), lambda dish: dish.drivers.faults(), _driver(azimuth), _driver(elevation))
    return (
        *under(_PAGE, "Identity", *_IDENTITY),
        *under(_PAGE, "Drivers", *faults, *_DRIVERS),
        *under(_PAGE, "DIP switches", *_SWITCHES),
        *under(_PAGE, "Pins", _PINS),
        *under(_PAGE, "ADC", _ADC),
        *under(_PAGE, "Use", *_USE),
    )
