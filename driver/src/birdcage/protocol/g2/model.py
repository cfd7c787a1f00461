"""The Carryout G2 as data: what it is, and how its console looks.

Source: docs/reference/g2.md, *Menus* and *What it can do*; docs/reference/g2-motors.md.
"""

from __future__ import annotations

from birdcage.base.beam import CountedBeam, Reflector
from birdcage.console.dialect import ConsoleDialect
from birdcage.protocol import plugs
from birdcage.protocol.family import AXIS_NAMES, MOTOR_TROUBLES
from birdcage.protocol.g2.features import CONSOLE_ONLY, features_of
from birdcage.protocol.g2.own_settings import KNOWN
from birdcage.protocol.nvs import DISABLE_TRACKER, MAX_ELEVATION, MIN_ELEVATION, row_label
from birdcage.protocol.trk.dialect import REFUSALS
from birdcage.rotator.axis import Axis, CableRange, Role
from birdcage.rotator.facts import (
    CableTurn,
    Facts,
    Handling,
    Readback,
    SearchSetting,
    SearchSwitch,
    SecondMove,
    Setting,
)
from birdcage.rotator.ladder import POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.origin import by_origin
from birdcage.rotator.own_settings import row_id
from birdcage.rotator.sweep import OwnSweep

REFLECTOR = Reflector(0.3048, 0.3048, CountedBeam(6.4, 6.3, 12.45e9))
"""12 inches round (`12-IN G2` in its boot log). The width was scanned in counts, on satellites that stand alone
(docs/reference/g2-signal.md, *Beam*)."""

AZIMUTH = Axis("azimuth", Role.AZ, 0.0, 360.0, 65.0, 400.0, 360.0 / 40000, overshoot_deg=0.06)
ELEVATION = Axis("elevation", Role.EL, 18.0, 65.0, 45.0, 400.0, 360.0 / 24960, overshoot_deg=0.06)
FEATURES = features_of(AZIMUTH, ELEVATION)

CARRYOUT_G2 = Facts(
    name="Carryout G2",
    firmware="g2",
    baud=115200,
    axes=(AZIMUTH, ELEVATION),
    cable=CableRange(-423.33, 23.33),
    turn=CableTurn.UNKNOWN,
    second_same=SecondMove.UNKNOWN,
    second_other=SecondMove.UNKNOWN,
    stop_ladder=(
        Rung(
            means=StopMeans.RETARGET,
            ends=frozenset({MoveKind.SINGLE, MoveKind.STOW}),
            proven=False,
            sentence="a new target just ahead of the dish; no stop is documented for this firmware",
        ),
        Rung(
            means=StopMeans.RELEASE,
            ends=frozenset({MoveKind.SINGLE, MoveKind.STOW}),
            proven=False,
            sentence="the motors are released; the dish may fall under its own weight",
            loses_position=True,
            needs_consent=True,
        ),
        Rung(
            means=StopMeans.KEY,
            ends=frozenset({MoveKind.SWEEP}),
            proven=False,
            sentence="a key; the firmware may read it only at the end of its sweep",
        ),
        POWER_SWITCH,
    ),
    slew=None,
    search_switch=SearchSwitch.FOR_GOOD,
    homing_s=15.0,
    boot_s=180.0,
    has_motor_power=True,
    has_stow=True,
    sweep=OwnSweep(
        axes=(AZIMUTH.name, ELEVATION.name),
        least_step_deg=0.01,
        most_span_deg=170.0,
        most_transponders=32,
        way_known=False,
    ),
    readback=Readback.ALWAYS,
    power_switch="12 V switch",
    reflector=REFLECTOR,
    handling=Handling(coax="Its coax carries 13 or 18 V: connect no 5 V LNA or bias tee to it."),
    tells_version=True,
    type_field="Antenna ID",
    floor_settings=(Setting(row_id(MIN_ELEVATION), row_label(MIN_ELEVATION)),),
    ceiling_settings=(Setting(row_id(MAX_ELEVATION), row_label(MAX_ELEVATION)),),
    search_setting=SearchSetting(
        row_id(DISABLE_TRACKER), row_label(DISABLE_TRACKER), "Disable Tracker Proc", off="TRUE", on="FALSE"
    ),
    features=FEATURES.features,
    has_own_settings=True,
    settings_known=KNOWN,
    console_only=CONSOLE_ONLY,
    settings_name="nvs",
    connectors=(plugs.CARRYOUT_G2,),
    adapters=(plugs.SH_U11, plugs.ESP32),
    origin=by_origin(
        documented="""
            name firmware baud power_switch search_switch turn homing_s
            azimuth.min_deg azimuth.max_deg azimuth.speed_deg_s azimuth.acceleration_deg_s2
            azimuth.step_deg elevation.min_deg elevation.max_deg elevation.speed_deg_s
            elevation.acceleration_deg_s2 elevation.step_deg cable.min_deg cable.max_deg
            has_motor_power has_stow has_own_settings readback tells_version
            type_field settings_name cable_known moves_one_axis sends_together never_homes
            reflector.width_m reflector.height_m
        """,
        measured="""
            azimuth.overshoot_deg elevation.overshoot_deg
            reflector.counted.az_deg reflector.counted.el_deg reflector.counted.at_hz
        """,
        inferred="""
            second_same second_other stop_ladder boot_s sweep.least_step_deg sweep.most_span_deg sweep.most_transponders
            sweep.way_known sweep.whole_span drives_on
        """,
    ),
)

DIALECT = ConsoleDialect(
    troubles=MOTOR_TROUBLES,
    axis_names=AXIS_NAMES,
    prompts={
        "root": "TRK>",
        "mot": "MOT>",
        "dvb": "DVB>",
        "nvs": "NVS>",
        "os": "OS>",
        "a3981": "A3981>",
        "adc": "ADC>",
        "dipswitch": "DIPSWITCH>",
        "eeprom": "EE>",
        "gpio": "GPIO>",
        "latlon": "LATLON>",
        "peak": "PEAK>",
        "step": "STEP>",
    },
    root_marks=frozenset({"mot", "dvb", "a3981"}),
    submenu_marks={"mot": frozenset({"a", "g", "h"})},
    own_marks=frozenset({"azscan", "azscanwxp", "elminmaxhome", "lnbdc"}),
    stranger=(
        "This dish does not answer like a Carryout G2 (prompt `{prompt}`). `birdcage detect` names it: a Trav'ler is "
        "--firmware hal205, an older one --firmware hal000. Nothing was moved."
    ),
    refusals=REFUSALS,
)
