"""The Winegard Trav'lers as data (`docs/reference/travler.md`): one of them, and in what the others differ."""

from __future__ import annotations

from dataclasses import replace

from birdcage.base.beam import Reflector
from birdcage.protocol import plugs
from birdcage.protocol.hal.dialect import DIALECTS
from birdcage.protocol.hal.features import FEATURES
from birdcage.protocol.hal.own_settings import KNOWN
from birdcage.protocol.hal.variant import HAL000, HAL205, PRO, HalVariant
from birdcage.protocol.nvs import row_label
from birdcage.rotator.axis import Axis, CableRange, MeasuredTimes, Role
from birdcage.rotator.facts import CableTurn, Facts, Handling, Readback, SearchSwitch, SecondMove, Setting, SilentSlew
from birdcage.rotator.ladder import END_OF_MOVE, POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.origin import by_origin
from birdcage.rotator.own_settings import row_id

MOVE_TIMES = MeasuredTimes(((0.5, 0.3), (1.0, 0.5)), from_deg=2.0, scale_s=3.23, per_deg=0.84, less_s=0.48)
"""The measured law (`docs/reference/travler.md`, *Times*); the same for azimuth and elevation, assumed for the skew."""

_SPEED_DEG_S = 20.0
"""The greatest speed that the times imply, over a full turn; it counts only where times do not."""
_ACCELERATION_DEG_S2 = 20.0
_STEP_DEG = 0.01

SKEW = Axis("skew", Role.SKEW, 0.0, 180.0, _SPEED_DEG_S, _ACCELERATION_DEG_S2, _STEP_DEG, times=MOVE_TIMES)
"""The axis that turns the feed. Its range is documented nowhere: 0 to 180 degrees is an assumption."""

REFLECTOR = Reflector(0.8382, 0.5842)
"""33 x 23 inches, the long side level, as for feeds side by side along the arc: an assumption, as is that the skew axis
turns the feed alone (`docs/decisions/0032-beam-of-dish-and-feed.md`)."""

HANDLING = Handling(
    clearance="Nothing taller than 8 in (20 cm) may stand within 32.5 in (83 cm) of the centre of its base.",
    weight="It weighs 45 lb (20 kg): fix its base before it moves.",
    coax="Its coax carries 12 to 18 V: connect no 5 V LNA or bias tee to it.",
    north="BACK on its base is azimuth 0: turn it to true north, or measure it.",
    home_remedies={
        "elevation": (
            "At the indoor unit press POWER, hold ENTER for 2 s (User Menu), choose INSTALLATION, then Calibrate EL, "
            "and confirm at its hard stop. Then switch the dish off and on."
        )
    },
    stow_by_hand=(
        "Last resort, to fold it by hand: cut its power. Put a 5/16 in socket with a 6 in extension into the auxiliary "
        "drive hole, and turn clockwise, slowly. Before the arm comes down, it must face the rear label. Done wrongly, "
        "this damages the motor."
    ),
    supply="Its indoor unit takes 48 to 52 V DC in some papers, 12 V DC in others: go by its label.",
)
"""From the papers of the SK-1000 and its owners (`docs/safety.md`)."""

_ABORT = Rung(
    means=StopMeans.ABORT,
    ends=frozenset({MoveKind.COMBINED, MoveKind.SEARCH}),
    proven=True,
    sentence="any byte ends a combined move",
    anywhere=True,
)


def _floor_settings(variant: HalVariant) -> tuple[Setting, ...]:
    return tuple(Setting(row_id(index), row_label(index)) for index in sorted(variant.lowest.values()))


TRAVLER = Facts(
    name="Trav'ler",
    firmware=HAL205.firmware,
    baud=57600,
    axes=(
        Axis("azimuth", Role.AZ, 0.0, 360.0, _SPEED_DEG_S, _ACCELERATION_DEG_S2, _STEP_DEG, times=MOVE_TIMES),
        Axis("elevation", Role.EL, *HAL205.el_deg, _SPEED_DEG_S, _ACCELERATION_DEG_S2, _STEP_DEG, times=MOVE_TIMES),
        SKEW,
    ),
    cable=CableRange(0.0, 455.0),
    turn=CableTurn.UNKNOWN,
    second_same=SecondMove.QUEUE,
    second_other=SecondMove.QUEUE,
    stop_ladder=(
        _ABORT,
        END_OF_MOVE,
        POWER_SWITCH,
    ),
    slew=SilentSlew(5.0),
    search_switch=SearchSwitch.UNTIL_POWER_UP,
    homing_s=None,
    boot_s=900.0,
    has_stow=True,
    readback=Readback.ALWAYS,
    power_switch="power switch",
    reflector=REFLECTOR,
    handling=HANDLING,
    floor_settings=_floor_settings(HAL205),
    features=FEATURES[HAL205.firmware].features,
    has_own_settings=True,
    settings_known=KNOWN[HAL205.firmware],
    settings_name="nvs",
    rotctld_name="Winegard Trav'ler RS-485 Rotor",
    connectors=(plugs.TRAVLER,),
    adapters=(plugs.DTECH,),
    origin=by_origin(
        documented="""
            name firmware baud search_switch
            azimuth.min_deg azimuth.max_deg azimuth.step_deg
            elevation.min_deg elevation.max_deg elevation.step_deg skew.step_deg
            cable.min_deg cable.max_deg second_same second_other stop_ladder
            has_stow has_own_settings readback settings_name rotctld_name cable_known moves_one_axis
            sends_together never_homes
            reflector.width_m reflector.height_m
        """,
        measured="azimuth.times elevation.times",
        inferred="""
            azimuth.speed_deg_s azimuth.acceleration_deg_s2 azimuth.overshoot_deg
            elevation.speed_deg_s elevation.acceleration_deg_s2 elevation.overshoot_deg
            skew.min_deg skew.max_deg skew.speed_deg_s skew.acceleration_deg_s2 skew.overshoot_deg skew.times
            slew.least_deg turn boot_s power_switch has_motor_power tells_version drives_on
        """,
    ),
)
"""The Trav'ler LG-2112.

Its cable ends "usually" at 360 or 455 degrees, changes its turn by itself, and is told in no known form: the turn is
unknown. Its boot is as long as the
longest of the family (10 to 15 minutes with a search).
"""

OLDER_TRAVLER = replace(
    TRAVLER,
    name="older Trav'ler",
    firmware=HAL000.firmware,
    features=FEATURES[HAL000.firmware].features,
    settings_known=KNOWN[HAL000.firmware],
)
"""The same dish with HAL 0.0.00: what its papers measured and warn of was told of this one."""

_PRO_INFERRED = """
    baud azimuth.times elevation.times azimuth.step_deg elevation.step_deg skew.step_deg cable.min_deg cable.max_deg
    has_stow search_switch has_own_settings readback second_same second_other stop_ladder rotctld_name cable_known
    moves_one_axis sends_together never_homes settings_name least_line_interval_s drives_on
"""
TRAVLER_PRO = replace(
    TRAVLER,
    name="Trav'ler Pro",
    firmware=PRO.firmware,
    any_baud=True,
    least_line_interval_s=DIALECTS[PRO.firmware].gap_after("", PRO.motor),
    stop_ladder=(
        replace(_ABORT, proven=False, sentence="any byte, which ends a combined move of the other Trav'lers"),
        END_OF_MOVE,
        POWER_SWITCH,
    ),
    axes=(TRAVLER.azimuth, replace(TRAVLER.elevation, min_deg=PRO.el_deg[0], max_deg=PRO.el_deg[1]), SKEW),
    features=FEATURES[PRO.firmware].features,
    floor_settings=_floor_settings(PRO),
    settings_known=KNOWN[PRO.firmware],
    reflector=None,
    handling=Handling(),
    connectors=(plugs.TRAVLER_PRO,),
    adapters=(),
    rotctld_name="Winegard Trav'ler Pro Rotor",
    origin={
        name: who
        for name, who in {**TRAVLER.origin, **by_origin(inferred=_PRO_INFERRED)}.items()
        if not name.startswith("reflector.")
    },
)
"""The Trav'ler Pro (SK2DISH): 12 to 75 degrees; higher it stalls, and may lock up.

Its speeds were never measured: those of the other Trav'lers stand for it, as its motors take the same commands
(`docs/reference/travler-pro.md`).
"""
