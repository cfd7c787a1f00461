"""The Carryout of 2003 as data (`docs/reference/carryout-2003.md`). Little is known, most by two programs."""

from __future__ import annotations

from dataclasses import replace

from birdcage.protocol import plugs
from birdcage.protocol.carryout.dialect import BAUD
from birdcage.protocol.carryout.features import FEATURES
from birdcage.protocol.carryout.going import AZ_SPAN_DEG, EL_MAX_ROW, EL_SPAN_DEG
from birdcage.protocol.carryout.own_settings import KNOWN
from birdcage.protocol.nvs import row_label
from birdcage.rotator.axis import Axis, Role
from birdcage.rotator.facts import CableTurn, Facts, Handling, Readback, SearchSwitch, SecondMove, Setting, SilentSlew
from birdcage.rotator.ladder import END_OF_MOVE, POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.origin import by_origin
from birdcage.rotator.own_settings import row_id

_SPEED_DEG_S = 5.0
"""Not known. A scan program asks for three steps of 1 degree a second, and gives the first way 5 s: no slower than 3
deg/s then. Motion is judged by time, so too slow a figure is the safe one."""
_ACCELERATION_DEG_S2 = 5.0
_STEP_DEG = 0.01
"""Its records count in hundredths."""

CARRYOUT_2003 = Facts(
    name="Carryout of 2003",
    firmware="carryout",
    baud=BAUD,
    axes=(
        Axis("azimuth", Role.AZ, *AZ_SPAN_DEG, _SPEED_DEG_S, _ACCELERATION_DEG_S2, _STEP_DEG),
        Axis("elevation", Role.EL, *EL_SPAN_DEG, _SPEED_DEG_S, _ACCELERATION_DEG_S2, _STEP_DEG),
    ),
    cable=None,
    turn=CableTurn.UNKNOWN,
    second_same=SecondMove.QUEUE,
    second_other=SecondMove.QUEUE,
    stop_ladder=(
        Rung(
            means=StopMeans.ABORT,
            ends=frozenset({MoveKind.COMBINED}),
            proven=False,
            sentence="a bare Enter, which ends a combined move of relatives of this dish",
            anywhere=True,
        ),
        replace(END_OF_MOVE, ends=frozenset({MoveKind.COMBINED}), sentence="it stops at its target"),
        POWER_SWITCH,
    ),
    slew=SilentSlew(0.0),
    search_switch=SearchSwitch.NOT_KNOWN,
    homing_s=None,
    boot_s=900.0,
    readback=Readback.MOVING,
    cable_known=False,
    moves_one_axis=False,
    power_switch="12 V switch",
    ceiling_settings=(Setting(row_id(EL_MAX_ROW), row_label(EL_MAX_ROW)),),
    features=FEATURES.features,
    has_own_settings=True,
    settings_known=KNOWN,
    settings_name="nvs",
    connectors=(plugs.CARRYOUT_2003,),
    adapters=(plugs.DTECH,),
    handling=Handling(
        coax="Its coax carries 12 to 18 V: connect no 5 V LNA or bias tee to it.",
    ),
    origin=by_origin(
        documented="""
            name firmware baud azimuth.min_deg azimuth.max_deg azimuth.step_deg elevation.min_deg elevation.max_deg
            elevation.step_deg readback power_switch settings_name
        """,
        inferred="""
            azimuth.speed_deg_s azimuth.acceleration_deg_s2 azimuth.overshoot_deg
            elevation.speed_deg_s elevation.acceleration_deg_s2 elevation.overshoot_deg
            turn second_same second_other stop_ladder slew.least_deg search_switch boot_s
            has_motor_power has_stow has_own_settings cable_known moves_one_axis sends_together never_homes
            tells_version drives_on
        """,
    ),
)
"""What a second go-to does while it moves is not known: taken is that it waits, so none is sent before the first is
over by its time. How far its cable turns is not known either."""
