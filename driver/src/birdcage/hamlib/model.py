"""What is known of a rotator behind a rotctld before its server is asked, and what its answers make of it."""

from __future__ import annotations

from dataclasses import replace

from birdcage.hamlib.features import FEATURES
from birdcage.hamlib.replies import ServerState
from birdcage.rotator.axis import Axis, CableRange, Role, TurnBy
from birdcage.rotator.facts import CableTurn, Facts, Readback, SearchSwitch, SecondMove
from birdcage.rotator.ladder import POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.origin import by_origin

LOOK_EVERY_S = 1.0
"""How often a position is asked for at most: a controller on a slow serial line needs a good part of that."""
HORIZON_DEG, ZENITH_DEG = 0.0, 90.0
_SINGLE = frozenset({MoveKind.SINGLE})

FACTS = Facts(
    name="rotctld rotator",
    firmware="rotctl",
    baud=0,
    axes=(
        Axis("azimuth", Role.AZ, 0.0, 360.0, 2.0, 2.0, 0.1, speed_known=False),
        Axis("elevation", Role.EL, HORIZON_DEG, ZENITH_DEG, 2.0, 2.0, 0.1, speed_known=False),
    ),
    cable=None,
    cable_known=False,
    turn=CableTurn.UNKNOWN,
    second_same=SecondMove.RETARGET,
    second_other=SecondMove.RETARGET,
    stop_ladder=(
        Rung(means=StopMeans.COMMAND, ends=_SINGLE, proven=True, sentence="`S` stops both axes"),
        Rung(
            means=StopMeans.RETARGET, ends=_SINGLE, proven=False,
            sentence="a `P` just ahead of where it is replaces its target",
        ),
        POWER_SWITCH,
    ),
    drives_on=True,  # not known: then it is stopped
    slew=None,
    sends_together=True,
    search_switch=SearchSwitch.NEVER_SEARCHES,
    homing_s=None,
    never_homes=True,
    boot_s=0.0,
    readback=Readback.ALWAYS,
    least_look_interval_s=LOOK_EVERY_S,
    power_switch="power switch of the rotator",
    features=FEATURES.features,
    origin=by_origin(
        documented="name firmware baud readback search_switch sends_together never_homes turn cable cable_known",
        inferred="second_same second_other boot_s azimuth.min_deg azimuth.max_deg elevation.min_deg elevation.max_deg "
        "azimuth.speed_deg_s elevation.speed_deg_s azimuth.acceleration_deg_s2 elevation.acceleration_deg_s2 "
        "azimuth.step_deg elevation.step_deg least_look_interval_s drives_on",
    ),
)  # fmt: skip
"""`docs/reference/rotctl.md`, *Facts*."""


def facts_of(state: ServerState | None) -> Facts:
    """Return the facts of a rotator whose server tells this of it; None of one that tells nothing.

    An azimuth that it tells a range of is the turn of its cable, as in Hamlib's own clients; without one it is sent
    round its circle, and turns as it likes.
    """
    if state is None:
        return replace(FACTS, features={})
    facts, origin = FACTS, dict(FACTS.origin)
    if state.has_azimuths:
        assert state.min_az_deg is not None
        assert state.max_az_deg is not None
        azimuth = replace(facts.azimuth, turn_by=TurnBy.HOST)
        cable = CableRange(state.min_az_deg, state.max_az_deg)
        facts = replace(facts, cable=cable, cable_known=True, turn=CableTurn.REPORTED).with_axes(azimuth)
        origin |= by_origin(documented="cable.min_deg cable.max_deg turn")
    if state.has_elevations:
        assert state.min_el_deg is not None
        assert state.max_el_deg is not None
        low, high = max(state.min_el_deg, -ZENITH_DEG), min(state.max_el_deg, ZENITH_DEG)
        facts = facts.with_axes(replace(facts.elevation, min_deg=low, max_deg=high))
        origin |= by_origin(documented="elevation.min_deg elevation.max_deg")
    return replace(facts, origin=origin)


def on_cable(az_deg: float, cable: CableRange | None) -> float:
    """Return an azimuth that was told as the turn of the cable: a whole turn off where only that lies within it."""
    if cable is None or cable.min_deg - SLACK_DEG <= az_deg <= cable.max_deg + SLACK_DEG:
        return az_deg
    turns = [az_deg + turn for turn in (-360.0, 360.0) if cable.min_deg <= az_deg + turn <= cable.max_deg]
    return turns[0] if turns else az_deg


SLACK_DEG = 2.0
"""So far beyond the end of its range a rotator may stand, and still tell its turn."""
