"""One Orbit Mean-Elements Message (CCSDS 502.0-B section 4) as keywords and values, whatever it was written in."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.sky.elements import ElementSet
from birdcage.sky.formats.limits import checked
from birdcage.sky.formats.numbers import decimal, epoch, integer
from birdcage.sky.formats.parse_result import Unreadable

SGP4_XP = 4
"""The ephemeris type of elements for another theory than SGP4."""

_MUST_BE = (
    ("CENTER_NAME", ("EARTH",)),
    ("REF_FRAME", ("TEME",)),
    ("TIME_SYSTEM", ("UTC",)),
    ("MEAN_ELEMENT_THEORY", ("SGP4", "SGP/SGP4", "SGP")),
)
"""Left out of CSV and JSON by every provider, where they are then meant."""

_NEEDED = (
    "EPOCH",
    "MEAN_MOTION",
    "ECCENTRICITY",
    "INCLINATION",
    "RA_OF_ASC_NODE",
    "ARG_OF_PERICENTER",
    "MEAN_ANOMALY",
    "BSTAR",
)


def _filled(fields: Mapping[str, object], key: str) -> object:
    """Return the value, None if it is left out or empty."""
    value = fields.get(key)
    return None if isinstance(value, str) and not value.strip() else value


def elements_of(fields: Mapping[str, object], source: str) -> ElementSet:
    """Return the elements. Raise Unreadable, naming the keyword, for what is missing, no number, or not for SGP4."""
    for key in _NEEDED:
        if _filled(fields, key) is None:
            raise Unreadable(f"{key} is {'empty' if key in fields else 'missing'}", key)
    for key, allowed in _MUST_BE:
        value = _filled(fields, key)
        if value is not None and str(value).strip().upper() not in allowed:
            raise Unreadable(f"{key} is {value!r}; birdcage reads {' or '.join(allowed[:2])}", key)
    number, revolution, kind = (
        integer(value, key) if (value := _filled(fields, key)) is not None else 0
        for key in ("NORAD_CAT_ID", "REV_AT_EPOCH", "EPHEMERIS_TYPE")
    )
    if kind == SGP4_XP:
        raise Unreadable("made for SGP4-XP (ephemeris type 4), which birdcage does not compute", "EPHEMERIS_TYPE")
    dot, ddot = (
        decimal(value, key) if (value := _filled(fields, key)) is not None else 0.0
        for key in ("MEAN_MOTION_DOT", "MEAN_MOTION_DDOT")
    )
    return checked(
        ElementSet(
            name=str(_filled(fields, "OBJECT_NAME") or number or "unnamed").strip(),
            norad_id=number,
            epoch=epoch(fields["EPOCH"]),
            inclination_deg=decimal(fields["INCLINATION"], "INCLINATION"),
            raan_deg=decimal(fields["RA_OF_ASC_NODE"], "RA_OF_ASC_NODE"),
            eccentricity=decimal(fields["ECCENTRICITY"], "ECCENTRICITY"),
            argument_of_perigee_deg=decimal(fields["ARG_OF_PERICENTER"], "ARG_OF_PERICENTER"),
            mean_anomaly_deg=decimal(fields["MEAN_ANOMALY"], "MEAN_ANOMALY"),
            mean_motion_rev_day=decimal(fields["MEAN_MOTION"], "MEAN_MOTION"),
            bstar=decimal(fields["BSTAR"], "BSTAR"),
            mean_motion_dot=dot,
            mean_motion_ddot=ddot,
            international_designator=str(_filled(fields, "OBJECT_ID") or "").strip(),
            revolution=revolution,
            source=source,
        )
    )
