"""The rotators as data (`docs/reference/easycomm.md`): of the class, the widest; of each firmware, its own."""

from __future__ import annotations

from dataclasses import replace

from birdcage.easycomm.features import FEATURES, RP2040_IDS, STOCK_IDS
from birdcage.easycomm.wire import AZIMUTH, ELEVATION
from birdcage.rotator.axis import Axis, CableRange, Role, TurnBy
from birdcage.rotator.facts import CableTurn, Facts, Handling, Readback, SearchSwitch, SecondMove
from birdcage.rotator.ladder import POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.origin import by_origin
from birdcage.rotator.wiring import Connector, Drawing

BAUD = 19200
"""Of the stock controller. A USB port takes any."""
RP2040_BOOT_S, STOCK_BOOT_S = 20.0, 100.0
STOP_S = 6.0
"""A stepper at full speed takes 2 s to brake, and 3 s to come back."""
STOCK_HOMING_S = 80.0
"""A whole turn at its speed, and 12 s that it waits then."""

CONTROLLER = Connector(
    "easycomm",
    "SatNOGS rotator",
    "USB, at the board of the controller",
    Drawing.USB,
    "USB CDC (/dev/ttyACM0); the baud rate does not count. By RS-485, the stock firmware speaks 19200 baud 8N1",
    (),
    "The README of the SatNOGS-Basestation project, and the sources of the stock firmware.",
    (
        "Point it north and level before it gets power: azimuth 0 is where it points then (RP2040).",
        "No adapter, no pairs to swap.",
        "The motors have a supply of their own: USB alone answers, and turns nothing.",
    ),
)
AIMS = "its own STOP aims both axes where they stand"


def _own_stop(sentence: str) -> tuple[Rung, ...]:
    command = Rung(
        means=StopMeans.COMMAND, ends=frozenset({MoveKind.SINGLE}), proven=True, sentence=sentence, lasts_s=STOP_S
    )
    return command, POWER_SWITCH


def _turn_round(flag: str) -> str:
    return (
        f"In its firmware's config.h, flip {flag}, then build and flash it. An older version of it reverses only the "
        "reading by that: there, also swap the two wires of the motor. If only one of the two is reversed, the axis "
        "runs away from its target. For the first move, keep the swing clear and a hand at the switch of the motor "
        "supply."
    )


FACTS = Facts(
    name="SatNOGS rotator",
    firmware="easycomm",
    baud=BAUD,
    axes=(
        Axis(AZIMUTH, Role.AZ, 0.0, 360.0, 12.6, 30.0, 0.05, overshoot_deg=0.05, turn_by=TurnBy.HOST),
        Axis(ELEVATION, Role.EL, 0.0, 90.0, 24.4, 60.0, 0.05, overshoot_deg=0.05),
    ),
    cable=CableRange(-360.0, 360.0),
    turn=CableTurn.REPORTED,
    second_same=SecondMove.RETARGET,
    second_other=SecondMove.RETARGET,
    stop_ladder=_own_stop(f"{AIMS}; the steppers of a stock one at full speed pass that by up to 13° and come back"),
    slew=None,
    search_switch=SearchSwitch.NEVER_SEARCHES,
    homing_s=STOCK_HOMING_S,
    zero_at_power_up=(AZIMUTH,),
    boot_s=RP2040_BOOT_S,
    readback=Readback.ALWAYS,
    drives_on=True,
    sends_together=True,
    power_switch="motor supply",
    tells_version=True,
    features={each: feature for each, feature in FEATURES.features.items() if each in RP2040_IDS},
    rotctld_name="SatNOGS rotator",
    connectors=(CONTROLLER,),
    handling=Handling(
        clearance="An RP2040 turns up to two turns: leave the cable of the antenna slack for both. A stock one runs "
        "both axes to their switches when it gets power.",
        north="It has no mark. Azimuth 0 of an RP2040 is where it points when it gets power: point it north first. "
        "That of a stock one is where its switch is.",
    ),
    origin=by_origin(
        documented="""
            name firmware baud azimuth.min_deg azimuth.max_deg elevation.min_deg elevation.max_deg azimuth.step_deg
            elevation.step_deg azimuth.speed_deg_s elevation.speed_deg_s turn second_same second_other stop_ladder
            search_switch homing_s zero_at_power_up readback cable.min_deg cable.max_deg tells_version boot_s
            drives_on
        """,
        inferred="""
            azimuth.acceleration_deg_s2 elevation.acceleration_deg_s2 azimuth.overshoot_deg elevation.overshoot_deg
            power_switch has_motor_power has_stow has_own_settings cable_known moves_one_axis sends_together
        """,
    ),
)
"""Of the class, before one was met: the widest that either has, so homing, too."""
RP2040_FACTS = replace(
    FACTS,
    homing_s=None,
    never_homes=True,
    stop_ladder=_own_stop(AIMS),
    handling=Handling(
        clearance="It turns up to two turns: leave the cable of the antenna slack for both. It levels its elevation by "
        "motor when it gets power.",
        north="It has no mark: azimuth 0 is where it points when it gets power. Point it north first.",
        reversed_remedies={AZIMUTH: _turn_round("kAzInvert"), ELEVATION: _turn_round("kElInvert")},
    ),
)
"""The RP2040 base station: 16 RPM by 40:15 and 55:40 at a duty of 35 %, and a dead-band of 0.05°."""
STOCK_FACTS = replace(
    FACTS.with_axes(
        replace(FACTS.azimuth, speed_deg_s=13.33, acceleration_deg_s2=6.0, step_deg=0.01, overshoot_deg=0.0),
        replace(FACTS.elevation, speed_deg_s=13.33, acceleration_deg_s2=6.0, step_deg=0.01, overshoot_deg=0.0),
    ),
    cable=CableRange(0.0, 360.0),
    zero_at_power_up=(),
    boot_s=STOCK_BOOT_S,
    stop_ladder=_own_stop(f"{AIMS}; a stepper at full speed passes that by up to 13° and comes back"),
    handling=Handling(
        clearance="It runs both axes to their switches when it gets power, by up to a whole turn. Nothing stops that.",
        north="It has no mark: azimuth 0 is where its switch is. Turn its base until it points north there.",
    ),
    features={each: feature for each, feature in FEATURES.features.items() if each in STOCK_IDS},
)
"""The stock controller with steppers: 3200 and 1600 of 86400 steps, and switches at 0."""
