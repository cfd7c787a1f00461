"""What is assumed of a dish of which nothing is known but that its console is of this family.

A subclass of `FirmwareProtocol` has this until it says better: `model` and `dialect` are class attributes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from birdcage.base.errors import PositionUnknown
from birdcage.base.reason import Reason
from birdcage.console.dialect import UNKNOWN_TOKEN, ConsoleDialect
from birdcage.protocol.family import AXIS_NAMES, MOTOR_TROUBLES
from birdcage.protocol.unhomed import is_unhomed, unreadable
from birdcage.rotator.axis import Axis, Role
from birdcage.rotator.facts import CableTurn, Facts, Readback, SearchSwitch, SecondMove
from birdcage.rotator.feature import END_TV_SEARCH, Cost, Feature, FeatureKind, FeaturePage, Value, Writer
from birdcage.rotator.feature_table import FeatureRow, FeatureTable
from birdcage.rotator.ladder import END_OF_MOVE, POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.origin import by_origin
from birdcage.rotator.values import Position

_ASSUMED_SPEED_DEG_S = 5.0
_ASSUMED_ACCELERATION_DEG_S2 = 5.0
"""Slower than any dish whose speed was measured, so that no motion is thought to be over before it is."""
_STEP_DEG = 0.01
"""As its console takes angles."""


def _end_tv_search(dish: Any, _done: Value) -> dict[str, Value]:  # noqa: ANN401 - a FirmwareProtocol
    dish.kill_search()
    return {END_TV_SEARCH: True}


def end_tv_search(*, lines: int, menu: str | None = None, asked: str = "") -> FeatureRow:
    """Return the row of a dish whose TV search is ended while it runs, by `kill_search`, which sends `asked`."""
    return FeatureRow(
        Feature(
            END_TV_SEARCH,
            "End the TV search",
            kind=FeatureKind.MOMENTARY,
            writer=Writer.AT_ONCE,
            cost=Cost(lines, menu),
            page=FeaturePage.SETTINGS,
            group="TV search",
            asked=asked,
        ),
        write=_end_tv_search,
    )


GENERIC_FEATURES = FeatureTable(end_tv_search(lines=2))
"""Every class says how its search is ended (`kill_search`), and nothing else is known of it."""

GENERIC_FACTS = Facts(
    name="dish",
    firmware="generic",
    baud=57600,
    axes=(
        Axis("azimuth", Role.AZ, 0.0, 360.0, _ASSUMED_SPEED_DEG_S, _ASSUMED_ACCELERATION_DEG_S2, _STEP_DEG),
        Axis("elevation", Role.EL, 15.0, 90.0, _ASSUMED_SPEED_DEG_S, _ASSUMED_ACCELERATION_DEG_S2, _STEP_DEG),
    ),
    cable=None,
    turn=CableTurn.UNKNOWN,
    second_same=SecondMove.UNKNOWN,
    second_other=SecondMove.UNKNOWN,
    stop_ladder=(
        Rung(
            means=StopMeans.RETARGET,
            ends=frozenset({MoveKind.SINGLE}),
            proven=False,
            sentence="a new target just ahead of the dish; no stop is known for it",
        ),
        replace(END_OF_MOVE, sentence="it stops at its target"),
        POWER_SWITCH,
    ),
    slew=None,
    search_switch=SearchSwitch.UNTIL_POWER_UP,
    homing_s=None,
    boot_s=900.0,
    readback=Readback.ALWAYS,
    power_switch="power switch",
    features=GENERIC_FEATURES.features,
    origin=by_origin(
        inferred="""
        baud azimuth.min_deg azimuth.max_deg azimuth.speed_deg_s azimuth.acceleration_deg_s2 azimuth.step_deg
        elevation.min_deg elevation.max_deg elevation.speed_deg_s elevation.acceleration_deg_s2 elevation.step_deg
        second_same second_other stop_ladder boot_s power_switch
        """
    ),
)
"""Floor and baud are the published defaults (`docs/reference/published-interface.md`, *BirdcageAntenna*), a whole turn
and the zenith are assumed; its boot is as long as the longest of the family. No cable range is known: whoever knows of
one sets it in `model`, or in the settings."""

GENERIC_DIALECT = ConsoleDialect(
    troubles=MOTOR_TROUBLES,
    axis_names=AXIS_NAMES,
    prompts=dict.fromkeys(("root", "mot", "motor", "nvs"), UNKNOWN_TOKEN),
    root_marks=frozenset({"nvs"}),
    root_hints=frozenset({"mot", "motor", "nvs", "os", "reboot", "stow"}),
    submenu_marks={"mot": frozenset({"a", "g"}), "motor": frozenset({"a", "g"}), "nvs": frozenset({"d", "e", "s"})},
    refusals=(
        (re.compile(r"\b(invalid|unknown|unrecognized|bad) command\b", re.IGNORECASE), Reason.UNKNOWN_COMMAND),
        (
            re.compile(r"\b(invalid|bad|illegal)\b.*\b(parameter|argument|value|motor|angle)\b", re.IGNORECASE),
            Reason.BAD_PARAMETER,
        ),
        (re.compile(r"\b(out of range|outside|limit exceeded)\b", re.IGNORECASE), Reason.BAD_PARAMETER),
        (
            re.compile(r"^\s*(error|failed)\b|\bSTALLED\b|\bHome Failure\b|\bnot (calibrated|homed)\b", re.IGNORECASE),
            Reason.FAILED,
        ),
    ),
)
"""Its prompts are learnt. The menus are those that two consoles of the family or more have; each root lists `nvs`."""

_ANGLE = re.compile(
    r"(?:\b(AZ|EL|(SK)) =\s+|\bAngle\[([012])\]\s*=\s*)([-+]?\d+(?:\.\d+)?)(?!\S)(?(2)|(?=\s+[A-Za-z]|\s*$))"
)
"""`AZ = 180.00 EL = 45.00 SK = 90.00`, on one line or more, or `Angle[0] = 180.00` for each axis.

What no word follows, noise has cut in two; after the skew a number may follow as it is.
"""
_LABELS = {"AZ": 0, "EL": 1, "SK": 2, "0": 0, "1": 1, "2": 2}
_PLAUSIBLE = (-720.0, 720.0), (-90.0, 180.0), (-360.0, 360.0)
"""Wider than any dish turns: what lies outside is a misread number, not an angle."""


def position_in(lines: Iterable[str]) -> Position:
    """Return the angles that `a` printed, in either form of the family; skew None if none was printed.

    PositionUnknown (`unhomed`) for an axis that does not know where it is, UnreadablePosition unless azimuth and
    elevation were printed as angles.
    """
    printed = tuple(lines)
    angles: dict[int, float] = {}
    for match in _ANGLE.finditer(" ".join(printed)):
        angles.setdefault(_LABELS[match[1] or match[3]], float(match[4]))
    if any(map(is_unhomed, angles.values())):
        raise PositionUnknown("The dish is not homed, so it does not know where it points.", reason=Reason.UNHOMED)
    plausible = all(low <= angles.get(axis, 0.0) <= high for axis, (low, high) in enumerate(_PLAUSIBLE))
    if not plausible or not {0, 1} <= set(angles):
        raise unreadable(
            f"The dish answered `a` with {' / '.join(printed)!r}, not with an azimuth and an elevation.", printed
        )
    return Position(angles[0], angles[1], angles.get(2))
