"""What may be done now: each gives the reason against it as a sentence, None for yes.

The station checks again, and its word counts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from birdcage.signal.source import SignalFacts
from birdcage.station.state import Activity, LinkPhase, StationState

from birdcage_tui.shown.view import YOU

if TYPE_CHECKING:
    from birdcage.pursuit.now import DeskNow

    from birdcage_tui.shown.calibration import CalibrateNow
    from birdcage_tui.shown.horizon_state import HorizonState
    from birdcage_tui.shown.sky_picture import SkyPicture

RESUME_KEY = "U"


class CommandContext(Protocol):
    """What decides whether a command can be given; a `View` has it for its frame, `LiveContext` for a key."""

    @property
    def state(self) -> StationState:
        """The station's."""

    @property
    def now(self) -> float:
        """Monotonic seconds."""

    @property
    def asked(self) -> bool:
        """Whether something that you asked for is not at its end yet: a motion may be about to begin."""

    @property
    def scopes(self) -> tuple[str, ...]:
        """Whose commands hold, innermost first."""

    @property
    def track(self) -> DeskNow | None:
        """What the pursuit desk shows; None before it has told anything."""

    @property
    def heard(self) -> SignalFacts:
        """The source of the signal that is shown."""

    @property
    def via(self) -> str:
        """The program that drives the dish; empty where this one does itself."""

    @property
    def calibrate(self) -> CalibrateNow | None:
        """What the calibration shows; None before its tab was visited."""

    @property
    def sky(self) -> SkyPicture | None:
        """What is up, and which passes come; None before it was first worked out."""

    @property
    def several(self) -> bool:
        """Whether the app drives several dishes."""

    @property
    def has_map(self) -> bool:
        """Whether a map of the sky is open."""

    @property
    def horizon(self) -> HorizonState:
        """The line of trees and roofs, as it counts now."""


DESK_AWAITED = "The tracker is still loading."
"""Why no target can be followed while the pursuit desk has told nothing."""


def can_move(context: CommandContext, *, though_held: bool = False) -> str | None:
    """Return why the dish cannot be moved now; `though_held`: HELD is no reason, as it is released first."""
    state = context.state
    if state.fault is not None:
        return "A fault waits. Enter acknowledges it."
    if state.link.state is not LinkPhase.UP:
        return "The dish does not answer."
    if state.held is not None and not though_held:
        return "STOP is latched. Enter releases it."
    if state.motion_refused_because:
        return state.motion_refused_because
    if state.dish is not None and state.dish.no_direction:
        return state.dish.no_direction
    if state.homed is False or state.position is None:
        if state.awaits_first_move:
            return None
        if state.awaits_sync:
            return "The dish does not know where it points. Sync it first (Y)."
        if state.dish is not None and state.dish.never_homes:
            return "No position has been read yet."
        if state.dish is not None and state.dish.homing_s is None:
            return "The dish does not know where it points. Switch it off and on: it homes by itself."
        return "The dish does not know where it points. Home it first."
    return None


def can_step(context: CommandContext) -> str | None:
    """Return why the dish cannot be moved from where it is now."""
    reason = can_move(context)
    if reason is None and context.state.position is None:  # it awaits its first move
        return "This dish does not tell where it points. Send it somewhere first (g)."
    return reason


def can_home(context: CommandContext) -> str | None:
    """Return why the dish cannot be homed now."""
    state = context.state
    if state.fault is not None:
        return "A fault waits. Enter acknowledges it."
    if state.link.state is not LinkPhase.UP:
        return "The dish does not answer."
    if state.dish is not None and state.dish.no_homing:
        return state.dish.no_homing
    if state.held is not None:
        return "STOP is latched. Enter releases it."
    return "The dish is already homing." if state.activity is Activity.HOMING else None


def can_sync(context: CommandContext) -> str | None:
    """Return why the dish cannot be synced now. HELD is no reason: nothing moves by it."""
    state = context.state
    if state.link.state is not LinkPhase.UP or state.dish is None:
        return "The dish does not answer."
    return state.dish.no_sync or None


def can_release(context: CommandContext) -> str | None:
    """Return why there is nothing to release, acknowledge or accept."""
    state = context.state
    if state.fault is None and state.held is None and not state.motion_refused_because:
        return "No STOP and no fault to release."
    return None


def can_resume(context: CommandContext) -> str | None:
    """Return why nothing can be resumed. HELD is no reason: resuming releases it, and says so."""
    state, track = context.state, context.track
    if track is None or (track.resumable is None and track.unfinished is None):
        return "No interrupted pass."
    holder, pursuit = state.holder, state.pursuit
    if holder not in (None, YOU) and (pursuit is None or holder != pursuit.holder):
        return f"{holder} has control."
    if state.held is not None and state.last_stop is not None and state.last_stop.confirmed is not True:
        return "STOP is not confirmed: Enter releases it."
    return can_move(context, though_held=True)
