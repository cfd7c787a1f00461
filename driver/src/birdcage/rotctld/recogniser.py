"""Tells, on a thread of its own, which satellite of the catalogue a client follows, and plans its pass."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError, StoreError
from birdcage.base.store import fingerprint
from birdcage.pursuit.desk_setup import observer_of
from birdcage.rotctld.client_view import WishedDirection
from birdcage.rotctld.followed_satellite import AHEAD_S, FollowedSatellite

if TYPE_CHECKING:
    from birdcage.base.clock import Clock
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.sky.catalogue import CatalogueEntry
    from birdcage.sky.observer import Observer
    from birdcage.sky.propagate import Fleet
    from birdcage.sky.recognition import RecognisedSatellite
    from birdcage.station.state import StationState

Wishes = Sequence[tuple[float, WishedDirection]]
"""What a client has wished for, with the time in POSIX seconds, in order."""
Answer = Callable[[FollowedSatellite | None], None]

LOOK_S = 10.0
"""How often it is looked what is missing, in monotonic seconds."""
TOLERANCE_DEG = 0.15
"""How far from the path a wish may lie at least, beside twice what the wishes lay beside it already."""
FAR_DEG = 30.0
"""From there on the way to where the plan begins is counted down: `docs/decisions/0062-….md`."""
NO_PLACE = "no place is set"
NO_CATALOGUE = "the catalogue is empty"

log = logging.getLogger("birdcage.rotctld")


class Recogniser:
    """One for each server. `on` may be set by any thread; `step` is for tests without a thread."""

    def __init__(
        self, clock: Clock, paths: Paths, load: Callable[[], Settings], *, on: bool = True, threads: bool = True
    ) -> None:
        """`load` reads the settings as they are now, with the place."""
        self._clock, self._paths, self._load, self._threads = clock, paths, load, threads
        self.on = on
        """Whether satellites are looked for, and followed."""
        self.lacks = ""
        """What is missing for that, in a few words; empty for nothing."""
        self._jobs: SimpleQueue[Callable[[], object] | None] = SimpleQueue()
        self._thread: threading.Thread | None = None
        self._look_at = float("-inf")
        self._seen: tuple[object, ...] | None = None
        self._entries: tuple[CatalogueEntry, ...] = ()
        self._fleet: Fleet | None = None

    # For the server's thread

    def tick(self, now: float) -> None:
        """Look, now and then, what is missing; `now` in monotonic seconds."""
        if self.on and now >= self._look_at:
            self._look_at = now + LOOK_S
            self._put(self._look)

    def ask(self, wishes: Wishes, state: StationState, answer: Answer) -> None:
        """Have the satellite told that these wishes follow; `answer` gets it, or None, on another thread."""
        self._put(lambda: answer(self._tell(wishes, state)))

    def close(self) -> None:
        """End the thread once it has done what it is at. Any thread."""
        self._jobs.put(None)

    def _put(self, job: Callable[[], object]) -> None:
        self._jobs.put(job)
        if self._threads and self._thread is None:
            self._thread = threading.Thread(target=self._run, name="recogniser", daemon=True)
            self._thread.start()

    # For its own thread

    def step(self) -> None:
        """Do what is asked for."""
        while True:
            try:
                job = self._jobs.get_nowait()
            except Empty:
                return
            if job is not None:
                job()

    def _run(self) -> None:
        while (job := self._jobs.get()) is not None:
            try:
                job()
            except Exception as fault:  # whatever it is: the clients are served on, by their own steps
                log.exception("no satellite is recognised any more")
                self.on, self.lacks = False, f"a fault of birdcage: {fault!r}"

    def _look(self) -> Observer | None:
        """Look what is missing; return where the dish stands where nothing is."""
        observer = observer_of(self._load())
        lacks = ""
        if observer is None:
            lacks = NO_PLACE
        elif not self._paths.catalogue.exists():
            lacks = NO_CATALOGUE
        self.lacks = lacks
        return None if lacks else observer

    def _tell(self, wishes: Wishes, state: StationState) -> FollowedSatellite | None:
        from birdcage.sky.recognition import AskedDirection, recognise

        observer = self._look()
        fleet = None if observer is None else self._read()
        if observer is None or fleet is None or not self.on:
            return None
        asked = [AskedDirection(t_s, wish.az_deg, wish.el_deg) for t_s, wish in wishes]
        offsets = {at: each.time_offset_s for at, each in enumerate(self._entries) if each.time_offset_s}
        found = recognise(fleet, observer, asked, offsets)
        return None if found is None else self._planned(found, observer, state)

    def _read(self) -> Fleet | None:
        """Return the catalogue, read again where it has changed; None where it is empty or can't be read."""
        from birdcage.sky.propagate import Fleet
        from birdcage.sky.watch_source import read_entries

        seen = fingerprint(self._paths.catalogue)
        if seen != self._seen:
            try:
                self._entries = read_entries(self._paths.catalogue)
            except StoreError as error:
                self.lacks = str(error)
                return None
            self._fleet = Fleet(each.elements for each in self._entries)
            # Reading it makes files beside it that were not there before.
            self._seen = fingerprint(self._paths.catalogue)
        if not self._entries:
            self.lacks = NO_CATALOGUE
            return None
        return self._fleet

    def _planned(self, found: RecognisedSatellite, observer: Observer, state: StationState) -> FollowedSatellite | None:
        """Return the satellite with a plan for the dish as it stands; None where it comes into no reach."""
        from birdcage.pursuit.choosing import choice_of, listen_at
        from birdcage.pursuit.circumstances import Circumstances
        from birdcage.pursuit.follower import options_of
        from birdcage.sky.targets.model import Satellite
        from birdcage.station.mounting import mount_of
        from birdcage.tracking.planning.sky_path import sky_path

        settings, entry = self._load(), self._entries[found.index]
        satellite = Satellite(entry.elements, entry.time_offset_s or 0.0)
        now = self._clock.utc()
        try:
            at = Circumstances(now, observer, mount_of(state, settings), settings)
            choice = choice_of(satellite.name, satellite, None)
            listen_at(choice, settings, self._paths.downlinks_file)
            choice.refresh(at)
            plan = choice.plan
            passing = None if plan is None else plan.passing
            # Once the rest of a pass is out of reach the plan is for the next one, which the client does not follow.
            if plan is None or plan.course is None or passing is None or not passing.aos <= now <= passing.los:
                return None
            until_s = passing.los.timestamp() + AHEAD_S
            path = sky_path(satellite, observer, now.timestamp() - AHEAD_S, until_s, refraction="none")
        except BirdcageError as error:
            log.info("%s is not followed: %s", satellite.name, error)
            return None
        # The client follows on where the pass ends, and asks itself whether to be taken up again.
        options = replace(options_of(settings), at_end="stay", resume=False)
        standing, leg = at.mount.standing, plan.legs[0]
        begins_az_deg, _ = plan.course.at(max(now.timestamp(), leg.start_s))
        is_far = standing is None or abs(standing.az_deg - begins_az_deg) > FAR_DEG
        return FollowedSatellite(
            satellite.name, entry.norad_id, plan, options, path, found.threshold_deg,
            TOLERANCE_DEG + 2.0 * found.misfit_deg, found.leads_s, found.steps_deg, is_far,
        )  # fmt: skip
