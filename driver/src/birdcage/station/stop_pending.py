"""What became of a STOP: whether it got through, and what is still awaited."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from birdcage.antenna.strategy.strategy import StopAction, Unplanned
from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import separation
from birdcage.base.reason import Reason
from birdcage.rotator.facts import Facts
from birdcage.rotator.ladder import MoveKind, StopMeans, StopOrder
from birdcage.station.state import Activity, FaultReason, Motion, Pointing, StationState, StopReport

SHORT_DEG = 0.5
RELEASED = "The motors are released: nothing drives the dish, and its position is unknown. Home it."
BUSY_WITH = {MoveKind.STOW: "Stowing", MoveKind.HOME: "Homing", MoveKind.SWEEP: "Sweeping"}
LEARNT = (StopMeans.RETARGET, StopMeans.COMMAND, StopMeans.ABORT)
"""What a dish in motion shows to work, or not."""
UNKNOWN = (Reason.UNKNOWN_COMMAND, Reason.UNSUPPORTED)
"""For what reasons a machine refuses a command that it does not have."""
OTHERS = (Activity.UNKNOWN, Activity.MOVING_UNASKED, Activity.STOWING)
"""Where motion is not at the speed that this program knows, if it moves at all."""
GOES_ON = "The sweep goes on to its end: nothing else is known to stop it but the power of the dish."


def unplanned(state: StationState, facts: Facts, *, motor_runs: bool) -> Unplanned:
    """Return what may move besides what was asked for. An axis that is blocked and driven on counts as seen moving."""
    is_stalled = state.fault is not None and state.fault.reason is FaultReason.STALL
    if motor_runs or state.activity is Activity.MOVING_UNASKED or (is_stalled and facts.drives_on):
        return Unplanned.SEEN
    return Unplanned.UNKNOWN if state.activity is Activity.UNKNOWN else Unplanned.NONE


class StopReach(Enum):
    """Whether the last STOP got through."""

    LOOKING = "looking"
    """Nothing was sent yet: two readings must tell first where to aim, or that nothing moves."""
    CHECKING = "checking"
    """Nothing was sent, as nothing was known to move; two readings must prove that."""
    SENT = "sent"
    AT_REST = "at rest"
    """Nothing was sent, as nothing moved."""
    ENDS = "ends"
    """Nothing could be sent: the move of one axis ends by itself, and nothing follows it."""
    NOT = "not"

    @property
    def is_open(self) -> bool:
        """Whether readings must still tell what STOP is to do."""
        return self in (StopReach.LOOKING, StopReach.CHECKING)


@dataclass(slots=True, kw_only=True)
class PendingStop:
    """A STOP whose effect is not known yet."""

    report: StopReport
    sent: int
    answered: bool
    still_from: Pointing | None
    """The first of the readings that agree with the last one."""
    deadline: float
    still_asked: float = -math.inf
    """When that was asked for; on a slow line it tells of a moment well before it came."""
    slowest: bool = False
    """Whether it may move more slowly than the speeds that are known: it was not, or not only, sent by this program."""
    action_is_complete: bool = False
    """Whether what follows the answer was done."""
    unknown: bool = False
    """Whether the machine has answered that it knows no such command."""
    note: str = ""
    """What else came of it."""
    order: StopOrder | None = None
    """What was sent, and is repeated as it was: a dish whose answers alone were lost must not be sent on."""
    target: Motion | None = None
    """The motion that was to be stopped, as it was shown; None of one that this program had not sent."""
    unsent: StopAction | None = None
    """What the port has not taken, until it does."""

    def hear(self, answers: Iterable[CommandRefused | None]) -> None:
        """Take in what the machine has answered."""
        self.unknown = any(each is not None and each.reason in UNKNOWN for each in answers)

    def ended_short(self, at_rest: Pointing) -> bool:
        """Return whether the motion ended so far from its target that it was stopped, and not just over."""
        to = self.target
        return to is None or separation(at_rest.az_deg, at_rest.el_deg, to.to_az_deg, to.to_el_deg) > SHORT_DEG
