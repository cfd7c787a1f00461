"""What the log of passes keeps of each: head, samples, remarks. Plain values, as they go into the files."""

from __future__ import annotations

from dataclasses import dataclass, fields
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.pursuit.follower import told_reach_end

if TYPE_CHECKING:
    from birdcage.station.pursuit_state import Pursuit


@dataclass(frozen=True, slots=True)
class PassHead:
    """One pass that was followed, without how it ended. Unknown is None."""

    pursuit: int
    """The station's own number of the pursuit, from 1 at each start of the program."""
    name: str
    kind: str
    """As `birdcage.sky.targets`: `satellite`, `slot`, `body`, `star`, `fixed`."""
    norad_id: int | None
    frequency_hz: float | None
    aos: datetime | None
    """None, as `los`, for what does not pass."""
    los: datetime | None
    reach_start: datetime | None
    reach_end: datetime | None
    max_el_deg: float | None
    """The highest elevation within reach."""
    started: datetime
    controller: str
    latency_s: float | None
    """As measured last."""
    forecast_rms_deg: float | None
    """What the plan promised of the dish alone, as `error_deg` of the samples is."""
    forecast_max_deg: float | None
    demo: bool
    """Whether the dish was a simulated one."""
    site: str
    elements_epoch: datetime | None
    time_offset_s: float


@dataclass(frozen=True, slots=True)
class PassSample:
    """One look, true degrees, and the signal at that time where there is one."""

    utc: datetime
    target_az_deg: float
    target_el_deg: float
    planned_az_deg: float
    planned_el_deg: float
    commanded_az_deg: float
    commanded_el_deg: float
    reported_az_deg: float
    reported_el_deg: float
    error_deg: float
    loss_db: float | None
    signal: float | None = None
    """The mean of `signal_n` readings."""
    unit: str | None = None
    signal_scatter: float | None = None
    """Standard deviation of one of them; None for fewer than two."""
    signal_n: int | None = None
    """How many were heard since the sample before: 0 for one that stands there still. None of an older log."""
    snr_db: float | None = None
    """What the dish's own receiver has told since the sample before."""


@dataclass(frozen=True, slots=True)
class MadeFile:
    """A file or a folder that a hook has told of."""

    utc: datetime
    """When it told of it last."""
    path: str
    size_bytes: int | None
    """When it was looked at last: of a folder, all that is in it. None if it was not there."""
    files: int | None
    """How many files that is."""


@dataclass(frozen=True, slots=True)
class Remark:
    """A line of text at a time of the pass: what a hook printed."""

    utc: datetime
    text: str


HEAD = tuple(field.name for field in fields(PassHead))
SAMPLE = tuple(field.name for field in fields(PassSample))
"""The columns of a CSV file, and of `birdcage log --csv`."""


def head_of(pursuit: Pursuit, started: datetime, *, demo: bool, site: str) -> PassHead:
    """Return what a pursuit tells of its pass. The epoch of the elements is not in it."""
    plan = pursuit.plan
    passing, stretches, forecast = plan.passing, plan.reach.intervals, plan.forecast
    return PassHead(
        pursuit=pursuit.number,
        name=plan.aim.name,
        kind=plan.aim.kind,
        norad_id=plan.aim.norad_id,
        frequency_hz=plan.aim.frequency_hz,
        aos=None if passing is None else passing.aos,
        los=None if passing is None else passing.los,
        reach_start=stretches[0].start if stretches else None,
        reach_end=(told_reach_end(plan) if plan.goes_on else stretches[-1].end) if stretches else None,
        max_el_deg=plan.reach.best_el_deg,
        started=started,
        controller=pursuit.controller,
        latency_s=pursuit.latency_s,
        forecast_rms_deg=None if forecast is None else forecast.rms_deg,
        forecast_max_deg=None if forecast is None else forecast.max_deg,
        demo=demo,
        site=site,
        elements_epoch=None,
        time_offset_s=plan.aim.time_offset_s,
    )


def stamp(utc: datetime) -> str:
    """Return a time as the files have it: UTC to the millisecond."""
    return utc.astimezone(UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def stored(value: object) -> object:
    """Return a value as the database has it."""
    if isinstance(value, datetime):
        return stamp(value)
    return int(value) if isinstance(value, bool) else value
