"""Makes a map: goes to each direction that was not heard yet, listens there at rest, and has it kept."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import partial
from statistics import fmean

from birdcage.base.errors import BirdcageError
from birdcage.base.geometry import beside
from birdcage.base.reason import Reason
from birdcage.rotator.feature import LOCK, RSSI, SNR, Reading
from birdcage.signal.source_path import SourcePath
from birdcage.skymap.drift import Drift, drift_between, fit_cross
from birdcage.skymap.map_keeper import LOW_PERCENT, MapKeeper
from birdcage.skymap.map_request import CROSS_POINTS, KIND, QUIET_PART, MapRequest
from birdcage.skymap.sky_map import MapSample
from birdcage.station.task import Report, Task
from birdcage.station.task_state import TaskPhase, TaskValue
from birdcage.tracking.steps import HearAt, LimitSpeeds, PointAt, ReadFeatures, Step, StepResult, Steps, Wait

NEWEST = 24
"""So many of the last directions are told with each change: who has missed more reads the file."""
CROSS_STEP = 0.5
"""Between two directions of a reference cross, in widths of the beam: its ends are on the floor, its flanks steep."""
COUNTDOWN_S = 5.0
LOOK_S = 60.0
"""How often a map under way looks at the battery."""
PACE = 200
"""The time left goes by so many directions."""
MOST_EL_DEG = 85.0
"""Higher up a step across the line of sight is no step of the azimuth any more."""
RESUME = "Resume it with u on F3 or `birdcage scan --resume`."


@dataclass(frozen=True, slots=True)
class _Heard:
    """What came of one direction."""

    az_deg: float
    el_deg: float
    values: Sequence[float]
    middle_s: float
    """The middle of the time of listening, POSIX seconds."""
    integration_s: float | None
    told: Mapping[str, Reading]
    """What the dish's tuner told beside the level."""


Hearing = Generator[Step, StepResult, _Heard | None]


class MapTask(Task):
    """One map, or what is left of it: the file knows which directions were heard."""

    kind = KIND
    cut_words = f"What was heard of the map is kept. {RESUME}"
    resume_words = "Release it, and the map goes on."

    def __init__(self, holder: str, keeper: MapKeeper, **values: TaskValue) -> None:
        """`values` as `MapRequest.values` has them. TypeError, which refuses the task, for others."""
        self.holder, self._keeper = holder, keeper
        self._request = request = MapRequest.of(values)
        self.homed_words = f"Home it. The map then {'repeats its reference, and ' if request.reference else ''}goes on."
        self._plan = request.plan
        self._path = SourcePath.of(request.path) if request.path else None
        self._map = keeper.open(request)
        self._heard = set(self._map.heard)
        self._beyond: set[int] = set()
        """Directions that this dish can't go to; around a target only for now."""
        self._unread: set[int] = set()
        """Directions in which nothing could be read."""
        self._cell: int | None = None
        """The one under way."""
        self._newest: deque[tuple[float, ...]] = deque(maxlen=NEWEST)
        self._at_s: deque[float] = deque(maxlen=PACE)
        """When the last directions were heard."""
        self._crosses = self._map.crosses
        self._first_cross = self._map.first_cross
        self._drift: Drift | None = None
        self._crossed_s = self._looked_s = -math.inf
        """When the reference was heard last, and when the battery was looked at; POSIX seconds."""
        self._middle_s = 1.0
        """From the command to go somewhere to the middle of the time of listening there."""
        self._why_over = ""
        self._report: Report | None = None

    @property
    def keeps_speeds(self) -> bool:
        """Whether speeds that it has changed stay so between two moves."""
        return self._request.quiet

    def bind(self, report: Report) -> None:
        """Take what tells the host of a countdown."""
        self._report = report

    def entered(self, phase: TaskPhase, why: str, *, is_done: bool) -> None:  # noqa: ARG002 - however it ended
        """Close the file when it is over; keep the console awake in pauses."""
        self._map.keep_awake(on=phase in (TaskPhase.WAITING, TaskPhase.YIELDED, TaskPhase.INTERRUPTED))
        if phase is TaskPhase.OVER:
            self._map.close()

    # Its steps

    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Wait for its time, hear the reference, and go through what is left."""
        self._unread.clear()
        self._at_s.clear()  # a pause is no pace
        if self._path is not None:
            self._beyond.clear()  # the target moves
        now_s = yield from self._wait_for_start(now_s, asked=asked)
        with self._map.ear.open():
            yield from self._set_up()
            self._crossed_s = -math.inf  # whatever came between may have moved the dish
            for cell in self._plan.sequence:
                if cell in self._heard or cell in self._beyond:
                    continue
                self._why_over = self._why_over_at(now_s)
                if self._why_over:
                    return
                self._cell = cell
                yield from self._look_around(now_s)
                yield from self._hear(cell)
                now_s = (yield Wait(0.0)).now_s
            self._cell = None
            if self._request.reference is not None and self._crosses:
                yield from self._cross(*self._request.reference)
        if self._is_whole:
            self._map.end(_utc(now_s))
        self._check_disk()

    @property
    def _is_whole(self) -> bool:
        """Whether nothing is left that a later try could hear."""
        return not self._unread and (self._path is None or not self._beyond)

    @property
    def _until_s(self) -> float:
        """When it ends even if it is not whole; 0 for never."""
        path_s = self._path.end_s if self._path is not None and len(self._path.rows) > 1 else 0.0
        return min((each for each in (self._request.until_s, path_s) if each), default=0.0)

    def _why_over_at(self, now_s: float) -> str:
        """Return why it ends before all is heard, as a sentence; empty while it goes on."""
        until_s, path = self._request.until_s, self._path
        if until_s and now_s >= until_s:
            return f"It is {_clock(until_s)}."
        if path is not None and len(path.rows) > 1 and now_s >= path.end_s:
            return "The way of the target was computed up to here."
        return ""

    def _wait_for_start(self, now_s: float, *, asked: bool) -> Generator[Step, StepResult, float]:
        """Wait until it is time, with a countdown where the person who asked for it may have gone."""
        if now_s >= self._request.start_s:
            return now_s
        self._map.keep_awake(on=True)
        if self._report is not None:
            self._report(
                TaskPhase.WAITING,
                f"The map begins at {_clock(self._request.start_s)}.",
                KIND,
                _utc(self._request.start_s),
            )
        now_s = (yield Wait(self._request.start_s - COUNTDOWN_S)).now_s
        if asked and self._report is not None:
            begins_s = max(now_s + COUNTDOWN_S, self._request.start_s)
            self._report(TaskPhase.COUNTDOWN, "The dish is about to move.", KIND, _utc(begins_s))
            now_s = (yield Wait(begins_s)).now_s
            self._report(TaskPhase.RUNNING, "", "", None)
        self._map.keep_awake(on=False)
        return now_s

    def _set_up(self) -> Steps:
        """Turn slowly, if that was asked for, and read how the receiver is set."""
        if self._request.quiet:
            yield LimitSpeeds(self._keeper.speeds_deg_s(QUIET_PART))
        if ids := self._map.settings_ids:
            yield ReadFeatures(ids)

    def _look_around(self, now_s: float) -> Steps:
        """See to what has come up: a disk that is full, a battery that is empty, a reference that is due."""
        self._check_disk()
        if now_s >= self._looked_s + LOOK_S:
            self._looked_s = now_s
            battery = self._keeper.battery()
            if battery is not None and battery.is_low(LOW_PERCENT):
                yield from self._shelter(battery.percent)
        if self._request.reference is not None and now_s >= self._crossed_s + self._request.reference_every_s:
            self._crossed_s = now_s
            yield from self._set_up()
            yield from self._cross(*self._request.reference)

    def _check_disk(self) -> None:
        if problem := self._map.problem:
            raise BirdcageError(problem, reason=Reason.FAILED)

    def _shelter(self, percent: float) -> Steps:
        """Park while there is power to do so, and end."""
        park, words = self._keeper.park, "the dish stays here"
        if park is not None:
            there = yield PointAt(*park, optional=True)
            parked = there.true_az_deg is not None
            words = "the dish is parked" if parked else "the park position is out of reach, so the dish stays here"
        raise BirdcageError(
            f"The battery of this computer is at {percent:.0f} %: {words}, and what was heard is kept. {RESUME}",
            reason=Reason.FAILED,
        )

    # One direction

    def _hear(self, cell: int) -> Steps:
        begun = yield Wait(0.0)
        x_deg, y_deg = self._plan.at(cell)
        aim = None if self._path is None else self._path.at(begun.now_s + self._middle_s)
        to = (x_deg, y_deg) if aim is None else beside(*aim, x_deg, y_deg)
        heard = (yield from self._listen(*to)) if to[1] <= MOST_EL_DEG or aim is None else None
        if heard is None:
            self._beyond.add(cell)
            return
        if not heard.values:
            self._unread.add(cell)
            return
        sample = self._sample(heard, cell=cell)
        self._map.add(sample)
        self._heard.add(cell)
        self._at_s.append(heard.middle_s)
        self._middle_s += 0.3 * (heard.middle_s - begun.now_s - self._middle_s)
        self._newest.append((float(cell), sample.az_deg, sample.el_deg, sample.value))

    def _sample(self, heard: _Heard, *, cell: int | None = None, cross_number: int | None = None) -> MapSample:
        aim = (None, None) if self._path is None else self._path.at(heard.middle_s)
        snr, lock = heard.told.get(SNR), heard.told.get(LOCK)
        return self._map.sample(
            heard.values, cell=cell, cross_number=cross_number, utc=_utc(heard.middle_s), az_deg=heard.az_deg,
            el_deg=heard.el_deg, aim_az_deg=aim[0], aim_el_deg=aim[1], integration_s=heard.integration_s,
            snr_db=None if snr is None else float(snr.value), lock=None if lock is None else bool(lock.value),
        )  # fmt: skip

    def _listen(self, az_deg: float, el_deg: float) -> Hearing:
        """Go there, and hear at rest; None where the dish can't go, no values where nothing could be read."""
        return (yield from (self._by_tuner if self._map.of_dish else self._by_source)(az_deg, el_deg))

    def _by_tuner(self, az_deg: float, el_deg: float) -> Hearing:
        """Hear by the dish's own tuner; SNR and lock, too, in the same visit to its menu."""
        ids = (RSSI, *self._map.told_of((SNR, LOCK) if self._request.details else ()))
        there = yield HearAt(az_deg, el_deg, optional=True, ids=ids)
        if there.true_az_deg is None or there.true_el_deg is None:
            return None
        levels = [there.readings.get(RSSI)]
        for _ in range(1, self._request.reads):
            again = yield ReadFeatures((RSSI,))
            levels.append(again.readings.get(RSSI))
        told = [level for level in levels if level is not None]
        middle_s = fmean(each.utc.timestamp() for each in told) if told else there.now_s
        values = [float(each.value) for each in told]
        return _Heard(there.true_az_deg, there.true_el_deg, values, middle_s, None, there.readings)

    def _by_source(self, az_deg: float, el_deg: float) -> Hearing:
        """Hear by a source of its own."""
        there = yield PointAt(az_deg, el_deg, optional=True, brisk=True)
        if there.true_az_deg is None or there.true_el_deg is None:
            return None
        values = yield from self._map.ear.values(self._request.reads or self._map.ear.reads)
        ended_s = (yield Wait(0.0)).now_s
        integration_s = round(ended_s - there.now_s, 3)
        return _Heard(there.true_az_deg, there.true_el_deg, values, (there.now_s + ended_s) / 2.0, integration_s, {})

    def _cross(self, az_deg: float, el_deg: float) -> Steps:
        """Hear the reference: a line of directions through it along either axis. One cut short keeps its number."""
        number, width_deg, half = self._crosses, self._keeper.beam_deg, CROSS_POINTS // 2
        self._crosses += 1
        steps = [CROSS_STEP * width_deg * step for step in range(-half, half + 1)]
        points = []
        for to in (
            *(beside(az_deg, el_deg, step, 0.0) for step in steps),
            *((az_deg, el_deg + step) for step in steps),
        ):
            heard = yield from self._listen(*to)
            if heard is not None and heard.values:
                points.append(self._sample(heard, cross_number=number))
                self._map.add(points[-1])
        fit = fit_cross(points, decibels=self._map.decibels)
        if fit is not None and points[-1].utc is not None:
            if self._first_cross is not None:
                self._drift = drift_between(self._first_cross, fit, points[-1].utc, decibels=self._map.decibels)
            self._first_cross = self._first_cross or fit

    # What it tells

    @property
    def progress(self) -> tuple[int, int]:
        """How many directions were heard, and of how many."""
        return len(self._heard), self._plan.cells - len(self._beyond)

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """`map`: its key; `newest`: cell, azimuth, elevation and value of the last directions; `left_s`, if known.

        `next`: the cell under way. `beyond`: how many directions are out of reach. `until_s`: when it ends even if
        it is not whole, POSIX seconds; absent for a map that has no such time. Once two reference crosses have
        found their source `gain` (parts of the first, or decibels), `right_deg`, `up_deg` and `lost_steps`.
        """
        told: dict[str, TaskValue] = {
            "map": self._request.key,
            "newest": tuple(self._newest),
            "beyond": len(self._beyond),
        }
        if until_s := self._until_s:
            told["until_s"] = until_s
        if self._cell is not None:
            told["next"] = float(self._cell)
        if len(self._at_s) > 1:
            pace_s = (self._at_s[-1] - self._at_s[0]) / (len(self._at_s) - 1)
            heard, of = self.progress
            told["left_s"] = pace_s * (of - heard)
        if self._drift is not None:
            drift = self._drift
            told |= {"gain": drift.gain, "right_deg": drift.right_deg, "up_deg": drift.up_deg,
                     "lost_steps": drift.lost_steps}  # fmt: skip
        return told

    @property
    def end_words(self) -> str:
        """Say whether it is whole, and what is missing."""
        heard, of = self.progress
        if self._why_over:
            return f"{self._why_over} {heard} of {of} directions are heard. {RESUME}"
        beyond = f" {len(self._beyond)} more are out of reach." if self._beyond else ""
        if not self._is_whole:
            unread = f" {len(self._unread)} could not be read." if self._unread else ""
            return f"{heard} of {self._plan.cells} directions are heard.{unread}{beyond} {RESUME}"
        return f"The map is complete: {heard} directions.{beyond}"


def _utc(at_s: float) -> datetime:
    return datetime.fromtimestamp(at_s, UTC)


def _clock(at_s: float) -> str:
    return f"{_utc(at_s):%H:%M} UTC"


def map_tasks(keeper: MapKeeper) -> Mapping[str, Callable[..., Task]]:
    """Return what a station is given, so that faces may ask for maps (`BeginTask`)."""
    return {KIND: partial(MapTask, keeper=keeper)}
