"""What a G2 tells and lets be set besides its position: all that its menus tell (docs/reference/g2-commands.md).

Each command stands once, with its cost and the features that its answer tells.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.g2.drivers import FAULT, OK
from birdcage.protocol.g2.motors import CEILING, FLOOR, HOME
from birdcage.protocol.g2.reading import per_axis, printed
from birdcage.protocol.motors import AZIMUTH, ELEVATION, MOTORS, by_name
from birdcage.protocol.nvs import DISABLE_TRACKER, MAX_ELEVATION, MIN_ELEVATION, NvsRow, row_label
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import (
    ENABLE_LNA,
    EVEN_LEVEL,
    LOCK,
    NETWORK,
    ODD_LEVEL,
    RSSI,
    SETTINGS,
    SNR,
    TRANSPONDER,
    TV_SEARCH,
    VERSION,
    Cost,
    Feature,
    FeatureKind,
    HealthMark,
    Range,
    Value,
    Writer,
    speed_of,
)
from birdcage.rotator.feature_table import FeatureRow, FeatureTable

if TYPE_CHECKING:
    from birdcage.protocol.g2.protocol import CarryoutG2Protocol

RSSI_READS = 10
_EVERY_S = 5.0
"""How long a menu is left alone between two reads of the same."""
_A3981, _ADC, _DIPSWITCH, _DVB, _GPIO, _MOT, _PEAK, _STEP = (
    Cost(1, menu, _EVERY_S) for menu in ("a3981", "adc", "dipswitch", "dvb", "gpio", "mot", "peak", "step")
)
_STREAM = Cost(2, "dvb", _EVERY_S)
"""A line, and what ends it."""
_CONSTANT = Cost(1, "dvb", 600.0)
"""What does not change while the dish has power: one look now and then is enough."""
_WITH_Q = Cost(3, "dvb", _EVERY_S)
"""A `q` in a line: the console makes sure first that it is in a submenu."""
_FROM_0 = Range(0.0, math.inf)
_TOGGLES = (
    "Each reading switches the LNB supply to 18 V and to 13 V. Which of them stays afterwards is not known. Anything "
    "else on that cable may be damaged."
)
_SEARCH_HAZARD = (
    "This saves NVS 20 in the dish's flash memory, after a backup of all its settings, and counts from the next "
    "power-up on. Off: it no longer homes by itself then, so home it at each power-up. On: it homes and searches then: "
    "it moves by itself."
)


def angle_of(row: NvsRow) -> float:
    """Return the angle in force that a setting holds, in degrees. NoReply (`garbage`) where it is no number."""
    try:
        value = float(row.current)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise NoReply(
            f"The dish showed {row.current!r} in NVS row {row.index}, which is no angle.", reason=Reason.GARBAGE
        )
    return value


def speeds_of(speeds: Mapping[int, float]) -> dict[str, Value]:
    """Return the greatest speeds as features, from those by motor."""
    return per_axis("speed", by_name(speeds))


def supplied(dish: CarryoutG2Protocol) -> dict[str, Value]:
    """Feed the LNB with 13 V."""
    dish.enable_lna()
    return {ENABLE_LNA: True}


def channel_of(dish: CarryoutG2Protocol) -> dict[str, Value]:
    """Return what the tuner is tuned to (`dis`)."""
    return dish.tuner.channel()


def tuned(dish: CarryoutG2Protocol, transponder: int) -> dict[str, Value]:
    """Tune to a transponder: odd ones are sent vertical, at 13 V, even ones horizontal, at 18 V."""
    dish.tuner.select(transponder)
    return {TRANSPONDER: float(transponder)}


def tv_search_of(row: NvsRow) -> dict[str, Value]:
    """Return whether it searches from the next power-up on, by what is saved in the row."""
    return {TV_SEARCH: row.saved != "TRUE"}


def _told(
    cost: Cost, ask: Callable[[CarryoutG2Protocol], Mapping[str, Value]], *features: Feature
) -> tuple[FeatureRow, ...]:
    """Return the rows of all that one command tells; it is sent once, whichever of them are read."""
    return tuple(FeatureRow(replace(each, cost=cost), ask) for each in features)


def _one(cost: Cost, ask: Callable[[CarryoutG2Protocol], Value], feature: Feature) -> FeatureRow:
    """Return the row of what a command of its own tells."""
    return FeatureRow(replace(feature, cost=cost), lambda dish: {feature.id: ask(dish)})


def _printed(cost: Cost, ask: Callable[[CarryoutG2Protocol], Iterable[str]], name: str, label: str) -> FeatureRow:
    """Return the row of an answer of several lines, as printed."""
    return FeatureRow(replace(_lines(name, label), cost=cost), lambda dish: printed(name, ask(dish)))


def _text(name: str, label: str) -> Feature:
    return Feature(name, label, kind=FeatureKind.TEXT)


def _lines(name: str, label: str) -> Feature:
    return Feature(name, label, kind=FeatureKind.LINES)


def _counts(name: str, label: str) -> Feature:
    return Feature(name, label, "counts", range=_FROM_0)


def _angle(name: str, label: str) -> Feature:
    return Feature(name, label, "deg", range=Range(-90.0, 90.0))


def _polarised(name: str, label: str) -> Feature:
    return replace(_counts(name, label), read_hazard=_TOGGLES)


def _levels(dish: CarryoutG2Protocol) -> dict[str, Value]:
    """Hear both polarisations in turn (`rssits`), which switches the LNB's supply."""
    even, odd = dish.peak.rssi()
    return {EVEN_LEVEL: float(even), ODD_LEVEL: float(odd)}


def _each(feature: Feature) -> tuple[Feature, ...]:
    """Return a feature for each axis, which its label names as `{}`."""
    return tuple(
        replace(feature, id=f"{feature.id}.{axis}", label=feature.label.format(axis)) for axis in (AZIMUTH, ELEVATION)
    )


def _driver(axis: Axis) -> Feature:
    mark = HealthMark(f"{axis.role.name.lower()} driver", good=(OK,))
    return replace(_text(f"driver.{axis.name}", f"Driver of the {axis.name} motor ({OK} or {FAULT})"), health=mark)


def _speeds(dish: CarryoutG2Protocol) -> dict[str, Value]:
    return speeds_of(dish.read_speeds())


def _speed(axis: Axis) -> FeatureRow:
    """Return the row of the greatest speed of an axis."""
    feature = Feature(
        speed_of(axis.name), f"Greatest {axis.name} speed", "deg/s", FeatureKind.NUMBER,
        Range(axis.step_deg, axis.speed_deg_s), Writer.UNTIL_RESTART, cost=Cost(2, "step"),
    )  # fmt: skip
    motor = MOTORS[axis.name]
    return FeatureRow(feature, _speeds, lambda dish, value: speeds_of(dish.set_speed(motor, float(value))))


_TV_SEARCH = FeatureRow(
    Feature(
        TV_SEARCH, "TV search at power-up", "", FeatureKind.SWITCH, None, Writer.FROM_POWER_UP, _SEARCH_HAZARD,
        Cost(4, "nvs"),
    ),
    lambda dish: tv_search_of(dish.read_nvs(DISABLE_TRACKER)),
    lambda dish, on: tv_search_of(dish.save_search(disabled=not on)),
)  # fmt: skip
_TRANSPONDER = FeatureRow(
    Feature(
        TRANSPONDER, "Transponder that the tuner listens to", range=Range(1.0, 32.0), writer=Writer.UNTIL_RESTART,
        cost=_DVB, note="Odd ones are vertical, at 13 V, even ones horizontal, at 18 V.",
    ),
    channel_of,
    lambda dish, number: tuned(dish, int(number)),
)  # fmt: skip
_LNA = FeatureRow(
    Feature(
        ENABLE_LNA, "Supply of 13 V for the LNB", kind=FeatureKind.MOMENTARY, writer=Writer.AT_ONCE,
        hazard="This switches the LNB supply from 18 V to 13 V: the polarisation becomes vertical. No command back to "
        "18 V is known; a power cycle of the dish brings it back. Anything else on that cable may be damaged.",
        cost=Cost(1, "dvb"),
    ),
    write=lambda dish, _value: supplied(dish),
)  # fmt: skip
_SIGNAL = (
    _TRANSPONDER,
    _LNA,
    _one(Cost(1, "dvb"), lambda dish: float(dish.get_rssi(RSSI_READS).average),
         replace(_counts(RSSI, "Signal strength"), samples=RSSI_READS)),
    _one(_STREAM, lambda dish: dish.tuner.snr_db(), Feature(SNR, "Signal-to-noise ratio", "dB")),
    _one(_STREAM, lambda dish: dish.tuner.lnb_volts(),
         Feature("lnb_supply", "Supply of the LNB", "V", range=Range(0.0, 30.0), health=HealthMark("LNB"))),
    _one(_STREAM, lambda dish: dish.tuner.network(), _text(NETWORK, "Network heard, or none")),
    *_told(_STREAM, lambda dish: dish.tuner.agc()[0],
           Feature("rf_agc", "Gain control, RF", "counts"), Feature("if_agc", "Gain control, IF", "counts")),
    *_told(_DVB, lambda dish: dish.tuner.lock_status(),
           Feature(LOCK, "Tuner has locked", kind=FeatureKind.SWITCH),
           Feature("tuner_reads", "Reads of the tuner", range=_FROM_0),
           Feature("tuner_no_signal", "Reads without a signal", range=_FROM_0),
           Feature("tuner_glitches", "Reads with a glitch", range=_FROM_0),
           _lines("lock_status", "Lock status, as printed")),
    _one(_ADC, lambda dish: dish.adc.rssi_counts(), _counts("raw_rssi", "Raw level before the tuner")),
)  # fmt: skip
_TUNER = (
    *_told(_DVB, channel_of,
           Feature("frequency", "Frequency behind the LNB", "MHz"), Feature("symbol_rate", "Symbol rate", "ksps"),
           _text("polarisation", "Polarisation (H or V)"), _lines("channel", "Parameters of the channel, as printed")),
    _printed(_WITH_Q, lambda dish: dish.tuner.frequencies(), "frequencies", "Frequencies of the tuner, as printed"),
    _printed(_DVB, lambda dish: dish.tuner.statistics(), "tuner_statistics", "Statistics of reads, as printed"),
    *_told(_CONSTANT, lambda dish: dish.tuner.identity(),
           _text("tuner_chip", "Chip of the tuner"), _text("tuner_revision", "Revision of the tuner"),
           _text("tuner_firmware", "Firmware of the tuner"), _text("tuner_strap", "Strap of the tuner"),
           _lines("tuner", "Versions of the tuner, as printed")),
    _one(_DVB, lambda dish: dish.tuner.diseqc.address(), _text("diseqc_address", "DiSEqC address")),
    _one(_DVB, lambda dish: dish.tuner.diseqc.pre_transmit_ms(),
         Feature("diseqc_pre_transmit", "DiSEqC silence before a message", "ms")),
    _one(_DVB, lambda dish: dish.tuner.diseqc.reply_timeout_ms(),
         Feature("diseqc_reply_timeout", "DiSEqC wait for an answer", "ms")),
    _one(_DVB, lambda dish: dish.tuner.diseqc.tone_threshold_counts(),
         _counts("diseqc_tone_threshold", "DiSEqC threshold of the tone")),
    _one(_PEAK, lambda dish: dish.peak.switch_status(),
         Feature("switch_status", "Bits of an EchoStar switch, 0 for none", range=Range(0.0, 15.0))),
    *_told(_PEAK, _levels,
           _polarised(EVEN_LEVEL, "Level of even transponders (18 V, horizontal)"),
           _polarised(ODD_LEVEL, "Level of odd transponders (13 V, vertical)")),
)  # fmt: skip
_MOTORS = (
    *_told(_MOT, lambda dish: dish.motors.states(), *_each(_text("motor", "State of the {} motor"))),
    *_told(_A3981, lambda dish: dish.drivers.torque(), *_each(_text("torque", "Torque of the {} motor (HIGH or LOW)"))),
    *_told(_A3981, lambda dish: dish.drivers.current_mode(), *_each(_text("current_mode", "Current mode, {} motor"))),
    *_told(_A3981, lambda dish: dish.drivers.step_mode(), *_each(_text("step_mode", "Step mode, {} motor"))),
    *_told(_A3981, lambda dish: dish.drivers.step_size(),
           *_each(Feature("step_size", "Step, {} motor", "sixteenths", range=Range(1.0, 16.0)))),
    *_told(_STEP, lambda dish: dish.stepper.max_accelerations(),
           *_each(Feature("acceleration", "Greatest {} acceleration", "deg/s²"))),
    *_told(_MOT, lambda dish: dish.motors.velocities(), *_each(Feature("velocity", "Present {} speed", "deg/s"))),
    *_told(_MOT, lambda dish: dish.motors.steps(), *_each(Feature("steps", "Raw {} position", "microsteps"))),
    *_told(_MOT, lambda dish: dish.motors.gains(),
           *_each(Feature("kp", "Gain Kp, {}")), *_each(Feature("kv", "Gain Kv, {}")),
           *_each(Feature("ki", "Gain Ki, {}"))),
    *_told(_STEP, lambda dish: dish.stepper.gains(),
           *_each(Feature("step_kp", "Gain Kp of STEP, {}")),
           *_each(Feature("step_kv", "Gain Kv of STEP, {}"))),
    _printed(_MOT, lambda dish: dish.motors.life(), "life", "Use of the motors, as printed"),
    _printed(_MOT, lambda dish: dish.motors.life_details(), "motor_life", "Use of the motors in detail, as printed"),
)  # fmt: skip
_IDENTITY = (
    *_told(Cost(1, "os"), lambda dish: dish.system.identity(),
           _text(VERSION, "Firmware version"), _text("antenna_id", "Antenna ID"), _text("system_id", "System ID"),
           _text("mcu_package", "Package of the processor"), _text("mcu_revision", "Silicon revision of the processor"),
           _text("mcu_mask_set", "Mask set of the processor"), Feature("mcu_flash", "Program flash", "KB"),
           Feature("mcu_ram", "Memory of the processor", "KB"), Feature("mcu_core_clock", "Core clock", "MHz"),
           Feature("mcu_bus_clock", "Bus clock", "MHz"), Feature("flash_base", "Address of the flash"),
           Feature("flash_size", "Size of the flash", "bytes")),
    _one(_ADC, lambda dish: dish.adc.board_id(), _text("board_id", "Board")),
    _one(_ADC, lambda dish: dish.adc.board_revision(), _text("board_revision", "Revision of the board")),
    *_told(_DIPSWITCH, lambda dish: dish.dipswitch.read(),
           _text("dip_switches", "DIP switches"), Feature("dip_code", "Satellites chosen by the DIP switches")),
    _printed(_GPIO, lambda dish: dish.gpio.printed(), "pins", "Pins of the processor, as printed"),
)  # fmt: skip
_SETTINGS = (
    _one(Cost(1, "nvs"), lambda dish: angle_of(dish.read_nvs(MIN_ELEVATION)),
         _angle(FLOOR, f"Lowest elevation ({row_label(MIN_ELEVATION)})")),
    _one(Cost(1, "nvs"), lambda dish: angle_of(dish.read_nvs(MAX_ELEVATION)),
         _angle(CEILING, f"Highest elevation ({row_label(MAX_ELEVATION)})")),
    *_told(_MOT, lambda dish: dish.motors.elevation_limits(), _angle(HOME, "Elevation after homing")),
    _TV_SEARCH,
    _printed(Cost(1, "nvs"), lambda dish: dish.settings_table(), SETTINGS, "All settings (NVS)"),
)  # fmt: skip


def features_of(azimuth: Axis, elevation: Axis) -> FeatureTable:
    """Return the table of a G2 with these axes.

    Reading any of it changes nothing on the dish, but for what has a `read_hazard`. What needs an argument, switches
    something else or keeps the shell for long is a method of its menu (`G2Menus`).
    """
    drivers = _told(_A3981, lambda dish: dish.drivers.faults(), _driver(azimuth), _driver(elevation))
    speeds = (_speed(azimuth), _speed(elevation))
    return FeatureTable(*_SIGNAL, *_TUNER, *drivers, *speeds, *_MOTORS, *_IDENTITY, *_SETTINGS)
