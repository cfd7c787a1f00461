"""The log of passes: of every pass that was followed, where the dish was sent, where it was, and what it heard."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.background import BackgroundWriter
from birdcage.pursuit.pass_levels import PassLevels
from birdcage.pursuit.pass_listener import LivePass, PassFile, PassListener, PassRemark
from birdcage.pursuit.pass_log_items import Item, PassBegan, PassEnded, PassLooked, PassTold
from birdcage.pursuit.pass_log_work import PassLogWork
from birdcage.pursuit.pass_record import PassHead, PassSample, head_of
from birdcage.rotator.feature import RSSI, SNR
from birdcage.station.events import Event, Followed, PursuitChanged, ReadingRead
from birdcage.station.pursuit_state import DONE, Phase, PointingSample, Pursuit

if TYPE_CHECKING:
    from birdcage.sky.elements import ElementSet

QUEUE_SIZE = 8192
CLOSE_S = 0.2
"""How long the end of the program may wait for the disk."""
SELDOM_S = 10.0
"""How often a target is kept that does not pass: it is followed for days."""
PROGRAM_ENDED = "The program was ended."
_FOLLOWS = frozenset({Phase.FOLLOWING, Phase.REWINDING})
_DUE = frozenset({Phase.YIELDED, Phase.INTERRUPTED, Phase.OVER})


class PassLog(PassListener):
    """`hear` is for the station's thread, all else for any; nothing waits but `flush` and `close`."""

    label = "log of passes"

    def __init__(self, journal: Path, folder: Path, *, site: Callable[[], str] = str) -> None:
        """Keep passes in the database `journal`, and each as CSV in `folder`.

        `site`: names the place, asked at the beginning of each pass, on the station's thread.
        """
        self._elements: ElementSet | None = None
        self._work = PassLogWork(journal, folder, self._epoch_of)
        self._writer: BackgroundWriter[Item] = BackgroundWriter("pass log", self._work.write, size=QUEUE_SIZE)
        self._site = site
        self._latest: Pursuit | None = None
        self._open: PassHead | None = None
        self._done = 0
        """The number of the pursuit whose pass was closed last."""
        self._last: tuple[float, datetime] | None = None
        """When the last sample was kept: monotonic, UTC."""
        self._levels = PassLevels()

    @property
    def problem(self) -> str:
        """What is not being kept, and why; empty when all is well."""
        return self._work.problem

    @property
    def busy(self) -> bool:
        """Whether something is not on disk yet."""
        return not self.flush(0.0)

    def begins(self, live: LivePass) -> None:
        """Note by which elements it is followed. The pass of the log begins with the station's own events."""
        self._elements = live.elements

    def changes(self, live: LivePass) -> None:
        """The same."""
        self._elements = live.elements

    def hear(self, event: Event, *, demo: bool) -> None:
        """Take an event of the station; `demo`: whether its dish is a simulated one. Returns at once."""
        if isinstance(event, PursuitChanged):
            self._changed(event, demo)
        elif isinstance(event, Followed):
            pursuit = self._latest
            if self._open is None and pursuit is not None and event.number == pursuit.number != self._done:
                self._begin(pursuit, event.utc, demo)
            if self._open is not None and event.number == self._open.pursuit:
                self._keep(event.sample)
        elif isinstance(event, ReadingRead) and isinstance(event.value, int | float):
            if event.feature == RSSI:
                self._levels.by_tuner(event.at, float(event.value), event.unit)
            elif event.feature == SNR:
                self._levels.snr(float(event.value))

    def signal(self, value: float, unit: str, at: float) -> None:
        """Take the strength that a receiver tells, at a monotonic time; it goes before the dish's own signal."""
        self._levels.by_receiver(at, value, unit)

    def remark(self, remark: PassRemark) -> None:
        """Keep what is said of a pass before, during or after it."""
        self._writer.offer(remark)

    def made(self, file: PassFile) -> None:
        """Keep that there is a file of a pass before, during or after it."""
        self._writer.offer(file)

    def flush(self, timeout_s: float = 2.0) -> bool:
        """Wait until all is on disk; False if that took too long."""
        return self._writer.flush(timeout_s)

    def close(self, timeout_s: float = CLOSE_S) -> None:
        """Write what is waiting, and end. A pass under way is closed. After the station has been closed."""
        if self._open is not None:
            self._end(self._open.started if self._last is None else self._last[1], PROGRAM_ENDED)
        self._writer.close(timeout_s)

    def _changed(self, event: PursuitChanged, demo: bool) -> None:
        pursuit = self._latest = event.pursuit
        if self._open is not None and pursuit.number != self._open.pursuit:
            self._end(event.utc, "Another pursuit began.")
        if self._open is None and pursuit.number != self._done and self._is_due(pursuit, event.utc):
            self._begin(pursuit, event.utc, demo)
        if self._open is None:
            return
        head = head_of(pursuit, self._open.started, demo=self._open.demo, site=self._open.site)
        # The latency changes with every command; the one at the end is kept.
        if replace(head, latency_s=None) != replace(self._open, latency_s=None):
            self._writer.offer(PassTold(head))
        self._open = head
        if pursuit.phase is Phase.PARKING:
            self._end(event.utc, DONE)
        elif pursuit.phase is Phase.OVER:
            self._end(event.utc, pursuit.why)

    def _is_due(self, pursuit: Pursuit, utc: datetime) -> bool:
        """Return whether the pass is followed, or should be: one that was missed belongs into the log too."""
        if pursuit.phase in _FOLLOWS:
            return True
        stretches = pursuit.plan.reach.intervals
        return pursuit.phase in _DUE and bool(stretches) and utc >= stretches[0].start

    def _begin(self, pursuit: Pursuit, utc: datetime, demo: bool) -> None:
        self._open = head_of(pursuit, utc, demo=demo, site=self._site())
        self._last = None
        self._levels.begin()
        self._writer.offer(PassBegan(self._open))

    def _end(self, utc: datetime, outcome: str) -> None:
        if self._open is not None:
            self._writer.offer(PassEnded(utc, outcome, self._open.latency_s))
            self._done, self._open = self._open.pursuit, None

    def _keep(self, sample: PointingSample) -> None:
        seldom = self._open is not None and self._open.aos is None
        if seldom and self._last is not None and sample.at - self._last[0] < SELDOM_S:
            return
        self._last = (sample.at, sample.utc)
        heard = self._levels.take(sample.at, still=seldom)
        self._writer.offer(
            PassLooked(
                PassSample(
                    sample.utc, sample.target_az_deg, sample.target_el_deg, sample.planned_az_deg,
                    sample.planned_el_deg, sample.commanded_az_deg, sample.commanded_el_deg, sample.reported_az_deg,
                    sample.reported_el_deg, sample.error_deg, sample.loss_db, heard.value,
                    heard.unit, heard.scatter, heard.n, heard.snr_db,
                )
            )
        )  # fmt: skip

    def _epoch_of(self, norad_id: int) -> datetime | None:
        """Return the epoch of the elements of the pass, as far as it is known by then. The writer's thread."""
        elements = self._elements
        return elements.epoch if elements is not None and elements.norad_id == norad_id else None
