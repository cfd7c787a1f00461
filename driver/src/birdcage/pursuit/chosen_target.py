"""What was chosen: its passes, and the plan for one of them, made anew whenever what it rests on has changed."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.pursuit.circumstances import Circumstances, MountKey, key_of
from birdcage.pursuit.passes_of import meant, next_passes, still_followed
from birdcage.sky.pass_row import PassRow

if TYPE_CHECKING:
    from birdcage.sky.downlinks import Downlink
    from birdcage.sky.downlinks_hearing import FeedHearing
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.look import LookAngle
    from birdcage.sky.passes.model import Pass
    from birdcage.sky.targets import Target
    from birdcage.tracking.curve import Curve
    from birdcage.tracking.mount import Standing
    from birdcage.tracking.plan import Plan

HOURS = 1.0
"""How far the plan of a target goes that does not pass."""
RENEW_S = 1800.0
"""When a plan of that kind is carried on."""
SOON = timedelta(hours=3)
"""Until a pass that is further off the dish will have been sent elsewhere."""
NEAR_HZ = 100_000.0
"""As near as this a frequency that a person typed is that of a downlink: beyond any Doppler, below any next channel."""
FIND_AGAIN = timedelta(hours=6)
"""Passes are looked for again when the list is this old, or half of it is over."""


@dataclass(slots=True, eq=False)
class ChosenTarget:
    """For the desk's thread alone."""

    text: str
    target: Target
    """A satellite without a time offset: that is here."""
    elements: ElementSet | None = None
    time_offset_s: float = 0.0
    wanted_hz: float | None = None
    """The frequency that a person has set."""
    sent: tuple[Downlink, ...] = ()
    """What it is not known to have ceased to send."""
    usual: FeedHearing | None = None
    """What of it is listened to unless a frequency is set."""
    of_catalogue: bool = False
    """Whether what the catalogue says of it counts, now and later."""
    favourite: bool = False
    priority: int = 0
    wanted_at: datetime | None = None
    """A time within the pass that was chosen; None for the next one."""
    rows: tuple[PassRow, ...] = ()
    """The next passes, in order."""
    plan: Plan | None = None
    problem: str = ""
    note: str = ""
    """What a person should know of the target: that it is silent."""
    _rows_key: tuple[object, ...] | None = field(default=None, init=False)
    _found_at: datetime | None = field(default=None, init=False)
    _plan_key: tuple[object, ...] | None = field(default=None, init=False)
    _standing: Standing | None = field(default=None, init=False)
    """Where the dish stood when the plan was made."""
    _mount_key: MountKey | None = field(default=None, init=False)

    @property
    def frequency_hz(self) -> float | None:
        """The frequency that counts."""
        if self.wanted_hz is not None:
            return self.wanted_hz
        return None if self.usual is None else self.usual.center_hz

    @property
    def downlink(self) -> Downlink | None:
        """What is sent at that frequency, as far as it is known."""
        if self.wanted_hz is not None:
            return _downlink_at(self.sent, self.wanted_hz)
        return None if self.usual is None else self.usual.downlink

    def forget_plan(self) -> None:
        """Let the plan be made anew, by the dish as it then stands."""
        self._plan_key = None

    def for_another_pass(self, wanted_at: datetime) -> ChosenTarget:
        """Return a choice of the same target, and of the pass that goes on at that time."""
        other = copy(self)
        other.wanted_at, other.plan = wanted_at, None
        other.forget_plan()
        return other

    def look(self, at: Circumstances) -> LookAngle | None:
        """Return where it stands, without refraction; None if that is not known."""
        try:
            return self._shifted().look(at.observer, at.now)
        except BirdcageError as error:
            self.problem = str(error)
            return None

    @property
    def row(self) -> PassRow | None:
        """The row of the planned pass."""
        passing = None if self.plan is None else self.plan.passing
        return None if passing is None else next((row for row in self.rows if row.passing == passing), None)

    def shown(self, now: datetime) -> tuple[PassRow, ...]:
        """Return the passes to be listed: the planned one, and those after it."""
        coming = tuple(row for row in self.rows if row.passing.los > now)
        row = self.row
        return coming if row is None else (row, *(each for each in coming if each.passing.aos > row.passing.aos))

    def refresh(self, at: Circumstances, *, pinned: Pass | None = None, keep_turn: bool = False) -> bool:
        """Look for passes and make the plan where anything has changed; return whether there is another plan.

        `pinned`: the pass that is being followed. `keep_turn`: the dish turns because of the plan, which therefore
        stands whatever turn of the cable it comes through.
        """
        if self.elements is not None:
            self._find(at, pinned=pinned is not None)
        row = self._meant(at.now, pinned)
        passing = None if row is None else row.passing
        mount_key = key_of(at.mount)
        if keep_turn and self._mount_key is not None:
            mount_key = MountKey(mount_key.mount, self._mount_key.turn)
        tracking = at.settings.tracking
        key = (at.observer, mount_key, passing, self.frequency_hz, self.downlink, self.time_offset_s, self.elements,
               tracking.refraction, tracking.preposition_s)  # fmt: skip
        over = passing is None and self.plan is not None and at.now - self.plan.made_at >= timedelta(seconds=RENEW_S)
        if key == self._plan_key and not over:
            return False
        self._plan_key, self._mount_key = key, mount_key
        return self._make(at, passing)

    def stood_elsewhere(self, at: Circumstances, than_deg: float) -> bool:
        """Return whether the dish stands elsewhere than when the plan was made."""
        was, here = self._standing, at.mount.standing
        if was is None or here is None:
            return was is not here
        return abs(was.az_deg - here.az_deg) > than_deg or abs(was.el_deg - here.el_deg) > than_deg

    def _find(self, at: Circumstances, *, pinned: bool) -> None:
        assert self.elements is not None, "asked for satellites only"
        key = (self.elements, at.observer, at.mount.limits, self.time_offset_s, self.favourite, self.priority)
        if key == self._rows_key and self._found_at is not None:
            left = sum(row.passing.los > at.now for row in self.rows)
            old = at.now - self._found_at > FIND_AGAIN or left * 2 < len(self.rows)
            # Found again a pass differs by microseconds, and the one that is followed would be planned anew for that.
            if pinned or not old:
                return
        self._rows_key, self._found_at = key, at.now
        self.rows = next_passes(
            self.elements, at.observer, at.mount.limits, at.now, time_offset_s=self.time_offset_s,
            favourite=self.favourite, priority=self.priority,
        )  # fmt: skip

    def _meant(self, now: datetime, pinned: Pass | None) -> PassRow | None:
        row = meant(self.rows, now, self.wanted_at if pinned is None else pinned.tca)
        if pinned is not None and (row is None or row.passing.norad_id != pinned.norad_id):
            return self.row
        return row

    def _make(self, at: Circumstances, passing: Pass | None) -> bool:
        from birdcage.tracking.planning.planner import plan_pass

        tracking = at.settings.tracking
        before, self._standing = self.plan, at.mount.standing
        try:
            self.plan = plan_pass(
                self._shifted(), at.observer, at.mount, at.now, passing=passing, frequency_hz=self.frequency_hz,
                downlink=self.downlink, refraction=tracking.refraction, next_tracks=self._later(at, passing),
                preposition_s=tracking.preposition_s, hours=HOURS,
            )  # fmt: skip
        except BirdcageError as error:
            self.plan, self.problem = None, str(error)
        else:
            self.problem = ""
        return self.plan is not before

    def _later(self, at: Circumstances, passing: Pass | None) -> tuple[Curve, ...]:
        """Return the way of the next pass that comes into reach: the cable had better suit that one too."""
        from birdcage.tracking.planning.sky_path import sky_path

        if passing is None:
            return ()
        row = next((row for row in self.rows if row.passing.aos > passing.aos and still_followed(row, at.now)), None)
        if row is None or row.passing.aos - passing.los > SOON:
            return ()
        start_s, end_s = row.passing.aos.timestamp(), row.passing.los.timestamp()
        return (sky_path(self._shifted(), at.observer, start_s, end_s, refraction=at.settings.tracking.refraction),)

    def _shifted(self) -> Target:
        from birdcage.sky.targets.model import Satellite

        return self.target if self.elements is None else Satellite(self.elements, self.time_offset_s)


def _downlink_at(sent: tuple[Downlink, ...], hertz: float) -> Downlink | None:
    """Return which of it lies at a frequency; None for none."""
    for each in sent:
        if each.freq_min_hz - NEAR_HZ <= hertz <= each.freq_max_hz + NEAR_HZ:
            return each
    return None
