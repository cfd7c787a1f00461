"""The choice and what is followed, each kept up to date with the catalogue, the settings, the place and the dish."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.pursuit.choosing import bring_up_to_date, choice_of, listen_at
from birdcage.pursuit.chosen_target import ChosenTarget
from birdcage.pursuit.circumstances import Circumstances
from birdcage.pursuit.desk_setup import DeskSetup
from birdcage.pursuit.finder import Finder
from birdcage.pursuit.follower import BEFORE_LEAVING, Follower, Post, options_of, reach_start
from birdcage.pursuit.refiner import Refiner
from birdcage.station.station import Station

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Target
    from birdcage.tracking.plan import Plan

BEFORE_S = 12.0
"""So long before the dish has to leave, countdown included, the plan is made anew if it stands elsewhere by then."""
ELSEWHERE_DEG = 1.0


class PlanKeeper:
    """For the desk's thread alone."""

    def __init__(
        self, station: Station, clock: Clock, setup: DeskSetup, follower: Follower, post: Post,
        changed: Callable[[], object], *, threads: bool,
    ) -> None:  # fmt: skip
        self._station, self._clock, self._setup, self._follower = station, clock, setup, follower
        self._changed = changed
        self._refiner = Refiner(post, self._refined, threads=threads)
        self.settings: Settings = setup.settings()
        self.observer: Observer | None = setup.observer
        self.finder = Finder(setup.catalogue, setup.paths.downlinks_file)
        self.choice: ChosenTarget | None = None
        self.followed: ChosenTarget | None = None
        """What the station follows for this desk: the choice, or what was it before."""
        self._looked_before: float | None = None
        """The time to leave (POSIX seconds) before which the plan was looked at once more."""

    @property
    def all(self) -> list[ChosenTarget]:
        """Both, or the one that there is."""
        return list({id(each): each for each in (self.choice, self.followed) if each is not None}.values())

    def site(self) -> str:
        """Return the name of the place; empty for none. Any thread."""
        return "" if self.observer is None else self.observer.name

    def circumstances(self) -> Circumstances | None:
        """Return what plans are made for now; None while no place is set."""
        from birdcage.station.mounting import mount_of

        if self.observer is None:
            return None
        mount = mount_of(self._station.state, self.settings)
        return Circumstances(self._clock.utc(), self.observer, mount, self.settings)

    def choose(self, text: str, target: Target | None) -> None:
        """Choose. UnknownTarget, or another BirdcageError with a sentence, when nothing is called that."""
        self.finder.refresh()
        note = ""
        if target is None:
            resolved = self.finder.resolve(text)
            target, note, finder = resolved.target, resolved.note, self.finder
        else:
            finder = None
        choice = choice_of(text, target, finder)
        choice.note = note
        if self.followed is not None and self.followed.target == choice.target:
            choice = self.followed  # with its pass, its frequency and its plan
            choice.text = text
        self.take(choice)

    def take(self, choice: ChosenTarget) -> None:
        """Choose it."""
        listen_at(choice, self.settings, self._setup.paths.downlinks_file)
        self.choice = choice

    def apply(self, settings: Settings, observer: Observer | None) -> None:
        """Use other settings and another place."""
        self.settings, self.observer = settings, observer
        for choice in self.all:
            listen_at(choice, settings, self._setup.paths.downlinks_file)

    def read_catalogue(self) -> bool:
        """Take over what the catalogue says now; return whether its file has changed."""
        if not self.finder.refresh():
            return False
        for choice in self.all:
            if bring_up_to_date(choice, self.finder):
                listen_at(choice, self.settings, self._setup.paths.downlinks_file)
        return True

    def set_time_offset(self, choice: ChosenTarget, seconds: float) -> None:
        """Let a satellite come so much later; its catalogue remembers. BirdcageError or ValueError where it can't."""
        from birdcage.sky.catalogue import Catalogue

        assert choice.elements is not None, "asked for satellites only"
        satellite = choice.elements.norad_id or choice.elements.name
        if choice.of_catalogue and self._setup.catalogue.exists():
            with Catalogue(self._setup.catalogue) as catalogue:
                catalogue.set_time_offset(satellite, seconds or None, now=self._clock.utc())
        else:
            choice.of_catalogue = False  # one of those that ship: it counts as long as the program runs
        for each in self.all:
            if each.elements is not None and (each.elements.norad_id or each.elements.name) == satellite:
                each.time_offset_s = seconds

    def refresh(self, choice: ChosenTarget, at: Circumstances) -> bool:
        """Bring a choice up to date; return whether it has another plan."""
        live = self._follower.live if choice is self.followed else None
        pinned = None if live is None else live.plan.passing
        keep_turn = live is not None and live.phase not in BEFORE_LEAVING
        return choice.refresh(at, pinned=pinned, keep_turn=keep_turn)

    def hand_on(self) -> None:
        """Give the station the present plan of what it follows, if that is another one than it has."""
        plan = None if self.followed is None else self.followed.plan
        if plan is not None and plan.course is not None:
            self._follower.renew(plan)

    def refine(self, at: Circumstances) -> None:
        """Let plans be refined that are not yet."""
        for choice in self.all:
            if choice.plan is not None:
                options = options_of(self.settings, self._setup.controller)
                self._refiner.ask(choice.plan, at.mount, options, self.settings.tracking.preposition_s)

    def _refined(self, plan: Plan, better: Plan) -> None:
        """Take a refined plan over, unless it comes too late: once it is in reach the plan stands."""
        start = reach_start(better)
        for choice in self.all:
            late = choice is self.followed and start is not None and self._clock.utc() >= start
            if choice.plan is plan and not late:
                choice.plan = better
                self._changed()

    def look_before_leaving(self, at: Circumstances) -> None:
        """Let the plan be made anew shortly before the dish leaves, if it stands elsewhere than when it was made."""
        live, choice = self._follower.live, self.followed
        if live is None or choice is None or live.phase not in BEFORE_LEAVING or live.plan.preposition is None:
            return
        leave_s = live.plan.preposition.leave_s
        if self._looked_before == leave_s or at.now.timestamp() < leave_s - max(BEFORE_S, 2.0 * self._clock.rate):
            return
        self._looked_before = leave_s
        plan = choice.plan
        if plan is not None and plan.is_same_pass(live.plan) and choice.stood_elsewhere(at, ELSEWHERE_DEG):
            choice.forget_plan()
