"""Keeps on disk what is being followed, and knows whether it may go on by itself after a restart."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.base.geometry import separation, shortest_turn
from birdcage.pursuit.follower import IN_MID_PASS, told_reach_end
from birdcage.pursuit.now import Unfinished
from birdcage.pursuit.resume_file import KeptPursuit, ResumeFile
from birdcage.station.pursuit_state import Phase, Pursuit
from birdcage.station.state import LinkPhase

if TYPE_CHECKING:
    from birdcage.pursuit.chosen_target import ChosenTarget
    from birdcage.station.state import Pointing, StationState

STANDS_WITHIN_DEG = 0.5
"""How far from where it was last sent the dish may stand, to count as left alone."""
HEARTBEAT_S = 1.0
"""How often what is followed is written, in monotonic seconds."""
AHEAD_S = 2.5
"""So much of the way ahead is written with it: until the next time, and what is under way then."""


class ResumeStore:
    """For the desk's thread alone. Keeps nothing, and finds nothing, where there is no `memory`."""

    def __init__(self, memory: ResumeFile | None, *, takes_up: bool = True) -> None:
        self._memory, self._takes_up = memory, takes_up
        self._kept: KeptPursuit | None = None
        """Of the pursuit under way."""
        self._written_at = 0.0
        self.found: KeptPursuit | None = None
        """Of the program before this one, as long as it can still be taken up."""
        self.may_resume = False
        """Whether it is still open if that goes on by itself."""

    def begin(self, now: datetime) -> None:
        """Look for what was being followed when the program ended."""
        if self._memory is None or not self._takes_up:
            return
        self.found = self._memory.read()
        self.may_resume = self.found is not None and not self.found.left
        self.forget_old(now)

    @property
    def unfinished(self) -> Unfinished | None:
        """What was found, as faces show it."""
        found = self.found
        return None if found is None else Unfinished(found.name, found.text, found.since, found.reach_end)

    def forget(self) -> None:
        """Forget what was found: it was taken up, or declined."""
        self.found, self.may_resume = None, False
        if self._memory is not None and self._kept is None:
            self._memory.clear()

    def forget_old(self, now: datetime) -> bool:
        """Forget what was found once its pass is over; return whether it was."""
        if self.found is None or self.found.reach_end is None or now < self.found.reach_end:
            return False
        self.forget()
        return True

    def resumes(self, state: StationState, now: datetime, *, within_s: float, allowed: bool) -> bool:
        """Return whether what was found goes on by itself, now.

        Only if the owner allows it, the gap was short, and the dish is homed and stands where it was left; a dish of
        which that is not known yet may still tell.
        """
        found = self.found
        if found is None or not self.may_resume:
            return False
        if not allowed or now - found.seen > timedelta(seconds=within_s) or state.held is not None or state.fault:
            self.may_resume = False
            return False
        if state.link.state is not LinkPhase.UP or state.position is None or state.position_lost is not None:
            return False
        self.may_resume = False
        return state.homed is True and _off_deg(found, state.position) <= STANDS_WITHIN_DEG

    def note(self, pursuit: Pursuit | None, choice: ChosenTarget | None, now: datetime, monotonic: float) -> None:
        """Write what is being followed, or remove it once that has ended in order."""
        if self._memory is None:
            return
        if pursuit is None or pursuit.phase in (Phase.OVER, Phase.PARKING):
            if self._kept is not None:
                self._kept = None
                self._memory.clear()
            return
        if self._kept is None:
            if pursuit.phase not in IN_MID_PASS or choice is None or pursuit.sample is None:
                return
            passing = pursuit.plan.passing
            sample = pursuit.sample
            self._kept = KeptPursuit(
                text=choice.text, name=pursuit.plan.aim.name, since=now,
                reach_end=told_reach_end(pursuit.plan), seen=now,
                az_deg=sample.commanded_az_deg, el_deg=sample.commanded_el_deg,
                ahead_az_deg=sample.commanded_az_deg, ahead_el_deg=sample.commanded_el_deg,
                aos=None if passing is None else passing.aos, frequency_hz=choice.wanted_hz,
                time_offset_s=choice.time_offset_s,
            )  # fmt: skip
            self.found, self.may_resume = None, False
        elif monotonic < self._written_at + HEARTBEAT_S:
            return
        self._kept = _seen(self._kept, pursuit, now)
        self._written_at = monotonic
        self._memory.write(self._kept)

    @property
    def keeps(self) -> bool:
        """Whether something is followed of which `end` has to write."""
        return self._kept is not None

    def end(self) -> None:
        """Write that the program ends in order: it then waits for a person, and does not go on by itself."""
        if self._memory is not None and self._kept is not None:
            self._memory.write(replace(self._kept, left=True))

    @property
    def problem(self) -> str:
        """Why nothing could be written."""
        return "" if self._memory is None else self._memory.problem


def _seen(kept: KeptPursuit, pursuit: Pursuit, now: datetime) -> KeptPursuit:
    """Return it with where the dish is, and where it may be when the program dies before it writes again."""
    sample = pursuit.sample
    if sample is None:
        return replace(kept, seen=now)
    az_deg, el_deg = ahead_deg = sample.commanded_az_deg, sample.commanded_el_deg
    if pursuit.phase is Phase.FOLLOWING:
        ahead_deg = pursuit.plan.sky.at(now.timestamp() + AHEAD_S)
    return replace(
        kept, seen=now, az_deg=az_deg, el_deg=el_deg, ahead_az_deg=ahead_deg[0] % 360.0, ahead_el_deg=ahead_deg[1]
    )


def _off_deg(found: KeptPursuit, position: Pointing) -> float:
    """Return how far the dish stands from the way that it was on."""
    turn_deg = shortest_turn(found.az_deg, found.ahead_az_deg)
    rise_deg = found.ahead_el_deg - found.el_deg
    return min(
        separation(position.az_deg, position.el_deg, found.az_deg + turn_deg * share, found.el_deg + rise_deg * share)
        for share in (step / 20.0 for step in range(21))
    )
