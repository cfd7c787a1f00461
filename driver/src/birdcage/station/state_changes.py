"""What of a `StationState` may be replaced at once: any of its fields."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from typing import TypedDict

from birdcage.antenna.alignment import Alignment
from birdcage.base.beam import Beam
from birdcage.base.no_go import NoGoSector
from birdcage.base.reason import Reason
from birdcage.rotator.facts import CableTurn, Facts
from birdcage.rotator.feature import Reading
from birdcage.rotator.ladder import StopMeans
from birdcage.rotator.own import OwnFacts
from birdcage.station.converter import FeedConverter
from birdcage.station.network_state import NetworkState
from birdcage.station.pursuit_state import Pursuit
from birdcage.station.state import (
    Activity,
    BootLog,
    Fault,
    HeldState,
    LimitSource,
    LinkState,
    Motion,
    Pointing,
    StopReport,
    TvSearch,
)
from birdcage.station.task_state import KeptTask, TaskState


class StateChanges(TypedDict, total=False):
    """What of a `StationState` is replaced: any of its fields."""

    link: LinkState
    port: str
    demo: bool
    dish: Facts | None
    firmware_version: str | None
    position: Pointing | None
    position_lost: Reason | None
    position_text: str
    target_az_deg: float | None
    target_el_deg: float | None
    target_miss_deg: float
    target_skew_deg: float | None
    motion: Motion | None
    activity: Activity
    activity_since: float
    activity_text: str
    raw_activity: bool
    holder: str | None
    holder_until: datetime | None
    held: HeldState | None
    held_trouble: str
    fault: Fault | None
    boot_log: BootLog | None
    last_stop: StopReport | None
    unplanned_stop: StopMeans
    homed: bool | None
    search: TvSearch
    turn: CableTurn
    menu: str | None
    az_offset_deg: float
    el_offset_deg: float
    alignment: Alignment
    feed_name: str
    converter: FeedConverter | None
    own: OwnFacts
    beam: Beam | None
    stow_allowed: bool
    el_min_deg: float | None
    el_max_deg: float | None
    cable_min_deg: float | None
    cable_max_deg: float | None
    no_go_sectors: tuple[NoGoSector, ...]
    limit_sources: Mapping[str, LimitSource]
    motion_refused_because: str | None
    not_now: str
    surveyed: bool
    tasks: tuple[TaskState, ...]
    kept_task: KeptTask | None
    pursuit: Pursuit | None
    speeds_lent: Mapping[int, float]
    signal_owners: Mapping[str, str]
    warnings: Mapping[str, str]
    readings: Mapping[str, Reading]
    network: NetworkState | None
