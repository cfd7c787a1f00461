"""The values that mean elements may have, whatever the format."""

from __future__ import annotations

import math
from dataclasses import replace

from birdcage.base.text import clean
from birdcage.sky.elements import ElementSet
from birdcage.sky.formats.parse_result import Unreadable

FASTEST_REV_DAY = 18.0
"""An orbit along the ground takes 17.07 revolutions a day; a satellite in its last hours comes close to that."""

LARGEST_ID = 999_999_999
"""CCSDS 502.0-B: a catalogue number has up to nine digits."""


def checked(elements: ElementSet) -> ElementSet:
    """Return the elements, their texts clean. Raise Unreadable, naming the OMM keyword, for what is of no orbit."""
    if not 0 <= elements.norad_id <= LARGEST_ID:
        raise Unreadable(f"catalogue number {elements.norad_id} has more than nine digits", "NORAD_CAT_ID")
    if not 0.0 <= elements.eccentricity < 1.0:
        raise Unreadable(f"eccentricity {elements.eccentricity:g} is not from 0 to below 1", "ECCENTRICITY")
    if not 0.0 <= elements.inclination_deg <= 180.0:
        raise Unreadable(f"inclination {elements.inclination_deg:g} is not from 0 to 180 degrees", "INCLINATION")
    if not 0.0 < elements.mean_motion_rev_day <= FASTEST_REV_DAY:
        raise Unreadable(
            f"mean motion {elements.mean_motion_rev_day:g} is not from 0 to {FASTEST_REV_DAY:g} revolutions a day",
            "MEAN_MOTION",
        )
    for what, angle_deg, keyword in (
        ("right ascension of the node", elements.raan_deg, "RA_OF_ASC_NODE"),
        ("argument of perigee", elements.argument_of_perigee_deg, "ARG_OF_PERICENTER"),
        ("mean anomaly", elements.mean_anomaly_deg, "MEAN_ANOMALY"),
    ):
        if not -360.0 <= angle_deg <= 360.0:
            raise Unreadable(f"{what} {angle_deg:g} is not an angle within 360 degrees", keyword)
    for what, value, keyword in (
        ("drag term", elements.bstar, "BSTAR"),
        ("first derivative of the mean motion", elements.mean_motion_dot, "MEAN_MOTION_DOT"),
        ("second derivative of the mean motion", elements.mean_motion_ddot, "MEAN_MOTION_DDOT"),
    ):
        if not math.isfinite(value):
            raise Unreadable(f"{what} is not a number", keyword)
    name = " ".join(clean(elements.name).split()) or str(elements.norad_id)
    return replace(elements, name=name, international_designator=clean(elements.international_designator))
