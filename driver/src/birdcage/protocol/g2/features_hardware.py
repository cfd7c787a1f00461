"""What a G2 tells of its electronics: who it is, its motor drivers, switches, pins and converter.

Source: docs/reference/g2-commands.md.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.protocol.g2.drivers import OK
from birdcage.protocol.g2.eeprom import FIRST_ENTRIES
from birdcage.protocol.g2.feature_rows import Question, counts, each, in_lines, lines, one, text, told, under
from birdcage.protocol.g2.pin_functions import PORTS
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import VERSION, Feature, FeatureKind, FeaturePage, HealthMark, Range, Value, Writer
from birdcage.rotator.feature_table import FeatureRow

if TYPE_CHECKING:
    from birdcage.protocol.g2.protocol import CarryoutG2Protocol

CLEAR_FAULTS = "clear_driver_faults"
_PAGE = FeaturePage.HARDWARE
_ALL_OFF = "On a Carryout, all switches off (up) may mean that its TV search is disabled; it differs from dish to dish."


def cleared(dish: CarryoutG2Protocol) -> dict[str, Value]:
    """Clear the fault flags of both motor drivers."""
    dish.drivers.clear_faults()
    return {CLEAR_FAULTS: True}


def _driver(axis: Axis) -> Feature:
    mark = HealthMark(f"{axis.role.name.lower()} driver", good=(OK,))
    return replace(text(f"driver.{axis.name}", f"Driver of the {axis.name} motor"), health=mark)


_IDENTITY = (
    *told(Question("os", "id", min_interval_s=0.0), lambda dish: dish.system.identity(),
          text(VERSION, "Firmware version"), text("antenna_id", "Antenna ID"), text("system_id", "System ID"),
          text("mcu_package", "MCU package"), text("mcu_revision", "Silicon revision"),
          text("mcu_mask_set", "Mask set"), Feature("mcu_flash", "Program flash", "KB"),
          Feature("mcu_ram", "RAM", "KB"), Feature("mcu_core_clock", "Core clock", "MHz"),
          Feature("mcu_bus_clock", "Bus clock", "MHz"), Feature("flash_base", "Address of the flash"),
          Feature("flash_size", "Size of the flash", "bytes")),
    one(Question("adc", "bdid"), lambda dish: dish.adc.board_id(), text("board_id", "Board")),
    one(Question("adc", "bdrevid"), lambda dish: dish.adc.board_revision(),
        text("board_revision", "Revision of the board")),
)  # fmt: skip
_DRIVERS = (
    *told(Question("a3981", "st"), lambda dish: dish.drivers.torque(),
          *each(text("torque", "Torque of the {} motor"))),
    *told(Question("a3981", "cm"), lambda dish: dish.drivers.current_mode(),
          *each(text("current_mode", "Current mode, {} motor"))),
    *told(Question("a3981", "sm"), lambda dish: dish.drivers.step_mode(),
          *each(text("step_mode", "Step mode, {} motor"))),
    *told(Question("a3981", "ss"), lambda dish: dish.drivers.step_size(),
          *each(Feature("step_size", "Step, {} motor", "sixteenths", range=Range(1.0, 16.0)))),
)  # fmt: skip
_CLEAR = FeatureRow(
    Question("a3981", "reset", min_interval_s=0.0).about(Feature(
        CLEAR_FAULTS, "Clear driver faults", kind=FeatureKind.MOMENTARY, writer=Writer.AT_ONCE,
        hazard="This clears the fault flags: what they tell is lost, and a motor that had switched off may be driven "
        "again. Look for the cause first: a blocked dish, a cable that pulls, a driver too hot.",
    )),
    write=lambda dish, _value: cleared(dish),
)  # fmt: skip
_SWITCHES = told(
    Question("dipswitch", "dipswitch"), lambda dish: dish.dipswitch.read(),
    replace(text("dip_meaning", "DIP switches in words"), note=_ALL_OFF),
    text("dip_switches", "DIP switches, pins as read"), Feature("dip_code", "Satellites by the DIP switches"),
)  # fmt: skip
_PINS = told(
    Question("gpio", "regs"), lambda dish: dish.gpio.told(),
    *(lines(f"pins.{port.lower()}", f"Pins of port {port}") for port in PORTS),
    lines("pins", "Pins of the processor, as printed"),
)  # fmt: skip
_ADC = one(
    Question("adc", "rssi"), lambda dish: dish.adc.rssi_counts(), counts("raw_rssi", "Raw level before the tuner")
)
_EEPROM = in_lines(
    Question("eeprom", f"ee 0 to {FIRST_ENTRIES - 1}", FIRST_ENTRIES), lambda dish: dish.eeprom.first(), "eeprom",
    f"First {FIRST_ENTRIES} EEPROM entries"
)  # fmt: skip
_USE = (
    in_lines(Question("mot", "life"), lambda dish: dish.motors.life(), "life", "Use of the motors"),
    in_lines(Question("mot", "motorlife"), lambda dish: dish.motors.life_details(), "motor_life",
             "Use of the motors in detail"),
)  # fmt: skip


def hardware(azimuth: Axis, elevation: Axis) -> tuple[FeatureRow, ...]:
    """Return the rows of a dish with these axes."""
    faults = told(Question("a3981", "diag"), lambda dish: dish.drivers.faults(), _driver(azimuth), _driver(elevation))
    return (
        *under(_PAGE, "Identity", *_IDENTITY),
        *under(_PAGE, "Drivers", *faults, _CLEAR, *_DRIVERS),
        *under(_PAGE, "DIP switches", *_SWITCHES),
        *under(_PAGE, "Pins", *_PINS),
        *under(_PAGE, "ADC", _ADC),
        *under(_PAGE, "EEPROM", _EEPROM),
        *under(_PAGE, "Use", *_USE),
    )
