"""What is taken of a relative of the Carryout G2 until a source says better (docs/reference/g2-kin.md)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from birdcage.rotator.axis import Axis, Role
from birdcage.rotator.facts import CableTurn, Facts, Handling, Readback, SearchSwitch, SecondMove, SilentSlew
from birdcage.rotator.ladder import POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.origin import by_origin

_SPEED_DEG_S, _ACCELERATION_DEG_S2 = 10.0, 20.0
"""No source tells. A G2 is several times as fast: waits as long as these make are the safe ones."""
HOMING_S = 15.0
"""The longest that one axis takes: as on a G2."""
JUST_AHEAD = Rung(
    means=StopMeans.RETARGET,
    ends=frozenset({MoveKind.SINGLE}),
    proven=False,
    sentence="a new target just ahead of the dish; no stop is documented for this firmware",
)
"""Of one that may tell where it is: that is asked only when it is met."""
_STEP_DEG = 0.01
"""Their consoles are sent hundredths."""
_DOCUMENTED = "name firmware baud azimuth.min_deg azimuth.max_deg azimuth.step_deg elevation.step_deg"
_INFERRED = """
    azimuth.speed_deg_s azimuth.acceleration_deg_s2 azimuth.overshoot_deg
    elevation.min_deg elevation.max_deg
    elevation.speed_deg_s elevation.acceleration_deg_s2 elevation.overshoot_deg
    turn slew.least_deg second_same second_other stop_ladder search_switch homing_s boot_s readback power_switch
    has_motor_power has_stow has_own_settings cable_known moves_one_axis sends_together never_homes tells_version
    drives_on
"""


def kin_axis(name: str, role: Role, low_deg: float, high_deg: float, **more: Any) -> Axis:  # noqa: ANN401 - as `Axis`
    """Return an axis whose speed is not known."""
    return Axis(name, role, low_deg, high_deg, _SPEED_DEG_S, _ACCELERATION_DEG_S2, _STEP_DEG, speed_known=False, **more)


AZIMUTH = kin_axis("azimuth", Role.AZ, 0.0, 360.0)
ELEVATION = kin_axis("elevation", Role.EL, 18.0, 65.0)


def telling(facts: Facts) -> Facts:
    """Return the facts of one that was seen to tell where it is: then each axis is sent by itself, as on a G2.

    One that does not tell is sent both in a row, and nothing else before that is over by its time.
    """
    return replace(
        facts,
        readback=Readback.ALWAYS,
        moves_one_axis=True,
        slew=None,
        second_same=SecondMove.UNKNOWN,
        second_other=SecondMove.UNKNOWN,
    )


def kin_facts(name: str, firmware: str, *, documented: str = "", **more: Any) -> Facts:  # noqa: ANN401 - as `Facts`
    """Return the facts of one of them. `documented` names those of its own that a source has; the rest is inferred."""
    known = f"{_DOCUMENTED} {documented}".split()
    inferred = " ".join(fact for fact in _INFERRED.split() if fact not in known)
    given: dict[str, Any] = {
        "axes": (AZIMUTH, ELEVATION),
        "second_same": SecondMove.QUEUE,
        "second_other": SecondMove.QUEUE,
        "search_switch": SearchSwitch.NOT_KNOWN,
        "homing_s": HOMING_S,
        "stop_ladder": (JUST_AHEAD, POWER_SWITCH),
    }
    return Facts(
        name=name,
        firmware=firmware,
        baud=115200,
        cable=None,
        cable_known=False,
        turn=CableTurn.UNKNOWN,
        slew=SilentSlew(0.0),
        moves_one_axis=False,
        boot_s=180.0,
        readback=Readback.NEVER,
        power_switch="power switch",
        handling=Handling(coax="Its coax may carry 13 or 18 V: connect no 5 V LNA or bias tee to it."),
        origin=by_origin(documented=" ".join(known), inferred=inferred),
        **(given | more),
    )
