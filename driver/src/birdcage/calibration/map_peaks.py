"""What the arc in a map tells of north and tilt, as measurements that a calibration takes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.calibration.peak import MeasuredPeak
from birdcage.sky.targets.model import SlotTarget

if TYPE_CHECKING:
    from birdcage.skymap.arc_lesson import ArcLesson


def peaks_of_map(found: ArcLesson) -> tuple[MeasuredPeak, ...]:
    """Return a peak for each slot that was measured; one of unknown time is left out.

    Slots stand still, so the time of the nearest direction is theirs.
    """
    return tuple(
        MeasuredPeak(
            each.utc, SlotTarget(each.seen.slot).name, each.seen.az_deg, each.seen.el_deg, each.dish_az_deg,
            each.dish_el_deg, each.sigma_deg, "rssi",
        )
        for each in found.slots
        if each.utc is not None
    )  # fmt: skip
