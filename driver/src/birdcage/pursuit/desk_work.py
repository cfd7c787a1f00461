"""What the desk does, on its own thread: orders, one turn after the other, and what there is to be shown."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from datetime import datetime
from functools import partial
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.errors import BirdcageError
from birdcage.base.held import HeldReason
from birdcage.pursuit.autotrack import Autotrack
from birdcage.pursuit.chosen_target import ChosenTarget
from birdcage.pursuit.circumstances import Circumstances
from birdcage.pursuit.desk_setup import DeskSetup, observer_of
from birdcage.pursuit.face_search import FaceSearches
from birdcage.pursuit.follower import Follower, Post, options_of, reach_end
from birdcage.pursuit.now import NO_PLACE, DeskNow, Mode, Resumable
from birdcage.pursuit.pass_listener import LivePass
from birdcage.pursuit.pass_services import PassServices
from birdcage.pursuit.plan_keeper import PlanKeeper
from birdcage.pursuit.pointer import BelowWords
from birdcage.pursuit.resume_file import ResumeFile
from birdcage.pursuit.resume_store import ResumeStore
from birdcage.pursuit.stopped import StoppedPursuit
from birdcage.pursuit.timetable import Timetable
from birdcage.radio.now import RadioNow
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto
from birdcage.station.station import Station

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Target

LOOK_S = 1.0
"""How often it looks round while something is chosen or followed, in monotonic seconds."""
REST_S = 5.0
"""How often else."""
LOOK_AT_FILE_S = 5.0
NO_CHOICE = "Choose a target first."
NO_FAVOURITES = "Autotrack follows favourites, and you have none. Mark some satellites as favourites."


class DeskWork:
    """Everything here belongs to one thread."""

    def __init__(self, station: Station, clock: Clock, setup: DeskSetup, post: Post, *, threads: bool) -> None:
        self._threads = threads
        self.services = PassServices(station, lambda: post(self.look_again))
        """What goes along with every pass."""
        self._radio: Callable[[], RadioNow] = RadioNow
        self._begun = False
        self._station, self._clock, self._setup, self._post = station, clock, setup, post
        self._follower = Follower(station, setup.holder, post)
        self._plans = PlanKeeper(station, clock, setup, self._follower, post, self.look_again, threads=threads)
        self._unfinished = ResumeStore(None if setup.demo else ResumeFile(setup.paths.own), takes_up=setup.takes_up)
        self._auto = Autotrack(Timetable(setup.paths.downlinks_file))
        self._stopped = StoppedPursuit()
        self._by_autotrack = False
        """Whether autotrack has asked for what is followed, and not a person."""
        self.faces = FaceSearches(self._plans, clock, self.look_again)
        """What each face searches for itself."""
        self._below = BelowWords()
        self._mode, self._problem = Mode.WATCH, ""
        self._file_at = self._tell_at = -math.inf
        self._changed = True

    # --- orders: `PursuitOrders` says what they are for

    def choose(self, text: str, target: Target | None = None) -> bool:
        """Choose a target; return whether there is one."""
        self._say("")
        self._follower.problem = ""
        try:
            self._plans.choose(text, target)
        except BirdcageError as error:
            self._say(str(error))
            return False
        return True

    def choose_pass(self, aos: datetime) -> None:
        """Choose a pass."""
        if self._plans.choice is not None:
            # Another one, so that the one that may be followed keeps its pass.
            self._plans.take(self._plans.choice.for_another_pass(aos))
            self._changed = True

    def set_time_offset(self, seconds: float) -> None:
        """Set the time offset."""
        choice = self._plans.choice
        if choice is None or choice.elements is None:
            self._say("A time offset needs a satellite. Choose one first.")
            return
        self._say("")
        try:
            self._plans.set_time_offset(choice, seconds)
        except (BirdcageError, ValueError) as error:
            self._say(str(error))

    def set_frequency(self, hertz: float | None) -> None:
        """Set the frequency."""
        if self._plans.choice is None:
            self._say(NO_CHOICE)
            return
        self._plans.choice.wanted_hz, self._changed = hertz, True

    def aim_once(self) -> None:
        """Point where it stands."""
        ready = self._ready()
        if ready is None:
            return
        choice, at = ready
        self._plans.refresh(choice, at)
        plan, now_s = choice.plan, at.now.timestamp()
        if plan is not None and plan.sky.start_s <= now_s <= plan.sky.end_s:
            az_deg, el_deg = plan.sky.at(now_s)
        else:
            look = choice.look(at)
            if look is None:
                return
            az_deg, el_deg = look.az_deg, look.el_deg
        self._mode = Mode.AIM
        future = self._station.submit(Goto(az_deg % 360.0, el_deg, self._setup.holder))
        future.add_done_callback(lambda done: self._post(partial(self._aimed, done)))

    def follow(self, *, asked: bool = True) -> bool:
        """Follow the choice; return whether that was asked of the station."""
        ready = self._ready()
        return ready is not None and self._follow(*ready, asked=asked)

    def leave(self) -> None:
        """Leave what is followed."""
        self._stopped.forget()
        # Left on, it would begin anew at once what a person has just ended.
        self._auto.switch(False)
        self._mode, self._changed = Mode.WATCH, True
        self._follower.leave(self._setup.holder)

    def take_up(self, *, asked: bool) -> None:
        """Follow what was left unfinished."""
        found = self._unfinished.found
        if found is None or not self.choose(found.text):
            return
        choice = self._plans.choice
        assert choice is not None, "one was chosen"
        choice.wanted_hz, choice.wanted_at, choice.time_offset_s = found.frequency_hz, found.aos, found.time_offset_s
        if self.follow(asked=asked):
            self.forget_unfinished()

    def resume(self) -> None:
        """Follow again what STOP or a hand has ended or interrupted, autotrack included."""
        live, found, by_autotrack = self._follower.live, self._resumable(), self._by_autotrack
        # A hand that has just given control back: the pursuit counts down, which a person who asks need not wait for.
        counts_down = live is not None and live.phase is Phase.COUNTDOWN
        if found is None and not counts_down:
            self._say("No interrupted pass.")
            return
        autotrack, row = self._stopped.autotrack, self._stopped.row
        choice = self._plans.followed if live is not None else self._stopped.choice
        if autotrack:
            self.set_autotrack(True)
            if row is not None and choice is not None:
                self._auto.asked_for(row, self._clock.monotonic())  # it is asked for here
        if choice is not None:
            plan = live.plan if live is not None else None if found is None else found.plan
            if plan is not None and plan.passing is not None:
                choice.wanted_at = plan.passing.tca
            self._plans.take(choice)
            if self.follow():
                self._by_autotrack = autotrack or by_autotrack
        self._stopped.forget()

    def forget_unfinished(self) -> None:
        """Forget what was left unfinished."""
        self._unfinished.forget()
        self._changed = True

    def set_autotrack(self, on: bool) -> None:
        """Switch autotrack."""
        self._auto.switch(on)
        self._stopped.forget()
        self._plans.finder.refresh()
        self._say(NO_FAVOURITES if on and not self._plans.finder.favourites else "")

    def apply(self, settings: Settings, observer: Observer | None) -> None:
        """Use other settings."""
        self._plans.apply(settings, observer)
        self._changed = True

    def read_settings(self) -> None:
        """Use what the settings say now."""
        if self._setup.load is not None:
            settings = self._setup.load()
            self.apply(settings, observer_of(settings))

    def look_again(self) -> None:
        """Show anew: something has changed."""
        self._changed = True

    # --- its own turns

    def step(self) -> float:
        """Do what there is to do; return how many seconds it may rest then."""
        now, monotonic = self._clock.utc(), self._clock.monotonic()
        if not self._begun:
            self._begun = True
            self._begin(now)
        if monotonic >= self._file_at:
            self._file_at = monotonic + LOOK_AT_FILE_S
            if self._plans.read_catalogue():
                self.faces.look_again(now)
                self._changed = True
        self._notice(now, monotonic)
        at = self._plans.circumstances()
        if at is not None:
            self._keep_timetable(at, monotonic)
            self._plans.look_before_leaving(at)
            for choice in self._plans.all:
                self._changed |= self._plans.refresh(choice, at)
            self._plans.hand_on()
            self._plans.refine(at)
        rest_s = (
            LOOK_S
            if self._plans.all or self.faces.locate_something or self._auto.on or self._unfinished.may_resume
            else REST_S
        )
        return min(rest_s, max(self.services.step() - monotonic, 0.0))

    def told(self) -> DeskNow | None:
        """Return what there is to be shown; None while that is the same."""
        monotonic = self._clock.monotonic()
        told_each_second = self._plans.choice is not None or self.faces.locate_something
        if not (self._changed or (told_each_second and monotonic >= self._tell_at)):
            return None
        self._changed, self._tell_at = False, monotonic + LOOK_S
        choice, at = self._plans.choice, self._plans.circumstances()
        now = self._clock.utc()
        shown = DeskNow(
            now, mode=self._mode, autotrack=self._auto.on,
            schedule=self._auto.timetable.rows, unfinished=self._unfinished.unfinished,
            resumable=self._resumable(),
            radio=self._radio(),
        )  # fmt: skip
        if choice is not None:
            shown = replace(
                shown, choice=choice.text, aim=None if choice.plan is None else choice.plan.aim, plan=choice.plan,
                passes=choice.shown(now), look=None if at is None else choice.look(at),
            )  # fmt: skip
            shown = replace(shown, note=" ".join(filter(None, (choice.note, self._below_words(choice)))))
        return replace(shown, problem=self._why())

    @property
    def owes(self) -> bool:
        """Whether `end` has something to leave or to end. Any thread."""
        return self._unfinished.keeps or self.services.busy

    def end(self) -> None:
        """Leave what there is to be remembered, and end what runs beside."""
        self._unfinished.end()
        self.services.close()

    def _begin(self, now: datetime) -> None:
        """Look for what was left unfinished, and let the log, the hooks and the receiver go along from now on."""
        from birdcage.pursuit.hooks import HookListener
        from birdcage.pursuit.pass_level import PassLevel
        from birdcage.pursuit.pass_log import PassLog
        from birdcage.pursuit.pass_tuner import PassTuner

        self._unfinished.begin(now)
        paths, settings, services = self._setup.paths, self._plans.settings, self.services
        tuner = PassTuner(
            self._station, self._clock, settings, services.signal, threads=self._threads,
            changed=lambda: self._post(self.look_again), receiver=self._setup.receiver,
        )  # fmt: skip
        self._radio = lambda: tuner.now
        services.add(PassLog(paths.journal, paths.passes, site=self._plans.site))
        services.add(HookListener(settings.hooks, services.remark, self._clock, services.made))
        services.add(PassLevel(self._station, self._clock, services.signal, self._setup.source_of))
        services.add(tuner)

    def _why(self) -> str:
        """Return the one thing that a person should know."""
        choice = self._plans.choice
        return (
            self._problem
            or self._follower.problem
            or (NO_PLACE if choice is not None and self._plans.observer is None else "")
            or ("" if choice is None else choice.problem)
            or self._plans.finder.problem
            or self._unfinished.problem
            or self.services.problem
        )

    def _below_words(self, choice: ChosenTarget) -> str:
        """Return that the choice is below the horizon, of what has no passes to say when it rises."""
        observer = self._plans.observer
        if observer is None or choice.elements is not None:
            return ""
        try:
            return self._below.of(choice.target, observer, self._clock.utc())
        except BirdcageError as error:
            return str(error)

    def _say(self, problem: str) -> None:
        self._problem, self._changed = problem, True

    def _ready(self) -> tuple[ChosenTarget, Circumstances] | None:
        """Return the choice and what a plan is made for; None, and say so, where one is missing."""
        choice, at = self._plans.choice, self._plans.circumstances()
        self._say(NO_PLACE if at is None else NO_CHOICE if choice is None else "")
        return None if choice is None or at is None else (choice, at)

    def _follow(self, choice: ChosenTarget, at: Circumstances, *, asked: bool) -> bool:
        choice.forget_plan()
        self._plans.refresh(choice, at)
        plan = choice.plan
        if plan is None or plan.course is None:
            why = choice.problem or ("" if plan is None else " ".join(plan.notes))
            self._say(why or f"{choice.target.name} does not come into reach. Nothing to follow.")
            return False
        self._stopped.forget()
        self._plans.followed, self._mode, self._by_autotrack = choice, Mode.FOLLOW, False
        self._follower.follow(plan, options_of(self._plans.settings, self._setup.controller), asked=asked)
        return True

    def _resumable(self) -> Resumable | None:
        return self._stopped.shown(self._clock.utc(), self._follower.live, autotrack=self._auto.on)

    def _after(self, choice: ChosenTarget, now: datetime) -> None:
        """Go on to the next pass after one that came to its end, if that is what its owner has set."""
        ended, at = self._follower.pursuit, self._plans.circumstances()
        end = None if ended is None else reach_end(ended.plan)
        # Autotrack asks for the next one itself; what a person or STOP has ended is over.
        wanted = self._plans.settings.tracking.at_end == "next" and not self._auto.on and choice.elements is not None
        at_its_end = end is not None and now >= end and self._station.state.held is None
        if wanted and at_its_end and self._mode is Mode.FOLLOW and at is not None:
            choice.wanted_at = None
            if self._follow(choice, at, asked=False):
                return
        if self._mode is Mode.FOLLOW:
            self._mode = Mode.WATCH

    def _notice(self, now: datetime, monotonic: float) -> None:
        """Notice what became of the pursuit, and of the one before this program."""
        if not self._follower.is_busy and self._plans.followed is not None:
            ended, self._plans.followed, self._changed = self._plans.followed, None, True
            self._auto.timetable.choose_again()
            if self._station.state.held is not None and (pursuit := self._follower.pursuit) is not None:
                self._stopped.by_stop(ended, pursuit.plan)
            self._after(ended, now)
        live, followed = self._follower.live, self._plans.followed
        elements = None if followed is None else followed.elements
        self.services.follow(
            None if live is None else LivePass(live, self._plans.settings, self._plans.observer, elements)
        )
        self._unfinished.note(live, followed, now, monotonic)
        self._changed |= self._unfinished.forget_old(now)
        tracking = self._plans.settings.tracking
        if not self._follower.is_busy and self._unfinished.resumes(
            self._station.state, now, within_s=tracking.resume_within_s, allowed=tracking.resume
        ):
            self.take_up(asked=False)

    def _recovers(self) -> bool:
        """Return whether the dish has restarted, and is homed without a person: what was scheduled goes on then."""
        fault, held = self._station.state.fault, self._station.state.held
        by_itself = self._plans.settings.station.after_reboot == "home" and fault is not None and fault.is_of_power
        return by_itself and (held is None or held.reason is HeldReason.FAULT)

    def _keep_timetable(self, at: Circumstances, monotonic: float) -> None:
        """Keep autotrack's plan, and ask for what it wants followed."""
        if self._auto.on and self._recovers():
            return
        if self._auto.on and self._station.state.held is not None:
            # STOP cancels what was scheduled too: a person switches it on again.
            self._stopped.autotrack_off(self._auto.row)
            self._auto.switch(False)
            self._say("STOP has switched autotrack off.")
        live = self._follower.live
        self._changed |= self._auto.refresh(self._plans.finder.favourites, at, live)
        row = self._auto.wants(at.now, monotonic, live, of_person=not self._by_autotrack)
        if row is None:
            return
        asked = self._auto.just_on
        self._auto.asked_for(row, monotonic)
        if self.choose(str(row.norad_id)) and self._plans.choice is not None:
            self._plans.take(self._plans.choice.for_another_pass(row.reach_start))
            self._by_autotrack = self.follow(asked=asked)

    def _aimed(self, done: Future[object]) -> None:
        error = None if done.cancelled() else done.exception()
        self._say(str(error) if isinstance(error, BirdcageError) else "")
        if self._mode is Mode.AIM:
            self._mode = Mode.WATCH
