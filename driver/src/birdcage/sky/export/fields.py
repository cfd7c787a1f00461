"""A pass as plain values, the same for JSON and CSV."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.sky.age import error_values, expected_error
from birdcage.sky.doppler import doppler_hz
from birdcage.sky.downlinks_words import downlink_values
from birdcage.sky.pass_row import PassRow

if TYPE_CHECKING:
    from birdcage.sky.downlinks_hearing import FeedHearing

Heard = Callable[[int, str], "FeedHearing | None"]
"""Which downlink of a satellite is listened to, by number and name."""
SIGNAL = ("mode", "polarization", "symbol_rate_baud", "pipeline", "date", "doubtful")
"""What a pass tells of the downlink that is heard, each with `downlink_` before it."""


def iso(when: datetime) -> str:
    """Return a time as ISO 8601 in UTC, to the millisecond."""
    when = when.astimezone(UTC) + timedelta(microseconds=500)  # what follows cuts off
    return f"{when.isoformat(timespec='milliseconds').removesuffix('+00:00')}Z"


def values_of(
    row: PassRow, freq_hz: float | None = None, heard: Heard | None = None, now: datetime | None = None
) -> dict[str, object]:  # fmt: skip
    """Return a row's values by name: degrees, seconds, kilometres, Hz; None for what there is not.

    With a frequency, the Doppler shift of a downlink at AOS, TCA and LOS comes with it. `heard` says which
    downlink of a satellite is listened to; how old that is, is told as of `now`, else as of the pass.
    """
    passing, found = row.passing, row.reach
    stays = passing.always_up
    always_reached = stays and bool(found.intervals) and not found.lost
    values: dict[str, object] = {
        "name": passing.name,
        "norad_id": passing.norad_id,
        "aos": iso(passing.aos),
        "tca": iso(passing.tca),
        "los": iso(passing.los),
        "aos_azimuth_deg": round(passing.aos_azimuth_deg, 4),
        "tca_azimuth_deg": round(passing.tca_azimuth_deg, 4),
        "los_azimuth_deg": round(passing.los_azimuth_deg, 4),
        "max_elevation_deg": round(passing.max_elevation_deg, 4),
        "duration_s": None if stays else round(passing.duration_s, 3),
        "reach": []
        if always_reached
        else [{"start": iso(stretch.start), "end": iso(stretch.end)} for stretch in found.intervals],
        "reach_s": None if always_reached else round(found.total_s, 3),
        "max_reach_elevation_deg": None if found.best_el_deg is None else round(found.best_el_deg, 4),
        "refraction": "none",
        "not_reached_because": list(found.words()),
        "already_up": passing.already_up,
        "still_up": passing.still_up,
        "sunlit_share": round(row.sunlit_share, 3),
        "sun_separation_deg": None if row.sun is None else round(row.sun.separation_deg, 2),
        "sun_separation_at": None if row.sun is None else iso(row.sun.at),
        "aos_range_km": round(row.at_aos.range_km, 1),
        "tca_range_km": round(row.at_tca.range_km, 1),
        "los_range_km": round(row.at_los.range_km, 1),
        "favourite": row.favourite,
        "epoch": iso(row.elements.epoch),
        "epoch_age_s": round(row.epoch_age_s),
        "elements": row.elements.source,
        **error_values(expected_error(row.elements, passing.tca, row.at_tca.range_km)),
    }
    sent = None if heard is None else heard(passing.norad_id, passing.name)
    values |= _signal(sent, passing.aos if now is None else now)
    values |= {"always_up": stays, "always_in_reach": always_reached}
    if freq_hz is not None:
        for name, distance in (("aos", row.at_aos), ("tca", row.at_tca), ("los", row.at_los)):
            values[f"{name}_doppler_hz"] = round(doppler_hz(freq_hz, distance.range_rate_km_s), 1)
    return values


def _signal(heard: FeedHearing | None, now: datetime) -> dict[str, object]:
    known = {} if heard is None else downlink_values(heard.downlink, now)
    freq_hz = None if heard is None else heard.center_hz
    return {"downlink_hz": freq_hz, **{f"downlink_{name}": known.get(name) for name in SIGNAL}}
