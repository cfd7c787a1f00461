"""Runs a motor for some seconds by asking for it again and again, ends that with STOP, and sees how far it turned."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.errors import BirdcageError, LinkError
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.cli.attached_command import AttachedCommand
from birdcage.cli.dish import need_position
from birdcage.cli.signal_task import is_lost
from birdcage.cli.station_command import StationCommand
from birdcage.rotator.feature import POSITION
from birdcage.station.events import Event, TaskChanged
from birdcage.station.requests import EndMotion, Run, Watch
from birdcage.station.state import MOVING, LinkPhase, Pointing
from birdcage.station.stop_words import power_switch
from birdcage.station.task_state import TaskPhase, TaskState
from birdcage.station.tasks.motor_run import STILL_DEG, MotorRunTask

RENEW_S = 0.2
"""How often it is asked for again: the station ends it 0.6 s after the last time."""
ANSWER_S = 10.0
REST_S = 8.0
"""How long after STOP the dish may take to be seen at rest, and then to tell where."""


class RunElsewhere(AttachedCommand):
    """Over the station of another program: a motor runs no longer than its command, however that ends."""

    outlives_terminal = False


@dataclass(frozen=True, slots=True)
class MotorTurned:
    """What a run came to."""

    axis: str
    by_deg: float
    """By how much it turned, by the dish's own count."""
    position: Pointing
    """Where the dish rests."""


def run_motor(dish: StationCommand, feature: str, value: float, seconds: float, holder: str) -> MotorTurned:
    """Run a motor, a person having agreed to its hazard, until STOP has ended that and the dish rests.

    What `Run` raises where it does not begin. BirdcageError, with the reason, for a run that ended early, did not turn
    the axis, or was not seen to end; LinkError where it ended with the link.
    """
    need_position(dish, "No motor is run.")
    since, before = dish.now, dish.state.position
    over: list[TaskState] = []

    def hear(event: Event) -> None:
        if isinstance(event, TaskChanged) and event.task.kind == MotorRunTask.kind and event.task.holder == holder:
            over.extend([event.task] if event.task.phase is TaskPhase.OVER else [])

    dish.ask(Run(feature, value, holder, agreed=True), ANSWER_S, hear)
    until, renew_at = dish.now + seconds, dish.now + RENEW_S
    while (now := dish.now) < until and not over and dish.state.link.state is LinkPhase.UP:
        if now >= renew_at:
            dish.station.submit(Run(feature, value, holder, agreed=True, renews=True))
            renew_at = now + RENEW_S
        dish.progress.show(f"The motor runs: {until - now:.1f} s to go. Ctrl+C sends STOP.")
        dish.look(hear, min(until, renew_at) - now)
    while dish.look(hear, 0.0):
        """Hear what has happened: it may have ended early in the last moment."""
    dish.progress.clear()
    if over or dish.state.link.state is not LinkPhase.UP:
        raise _ended_early(dish, over)
    dish.ask(EndMotion(holder), ANSWER_S, hear)
    after = _at_rest(dish, holder)
    if (stop := dish.stopped_since(since)) is not None:
        raise BirdcageError(f"The run did not end in order: STOP by {stop.by}.", reason=Reason.STOPPED)
    return _turned(dish, feature, before, after)


def _ended_early(dish: StationCommand, over: list[TaskState]) -> BirdcageError:
    """Return why, and where the link is lost, what alone still stops the motor."""
    if not is_lost(dish):
        return BirdcageError(over[0].why)
    why = over[0].why if over else dish.state.link.detail
    return LinkError(f"{why} The motor may run on: only the {power_switch(dish.state.dish)} stops it.")


def _at_rest(dish: StationCommand, holder: str) -> Pointing:
    """Wait until the dish is seen at rest, and return where. BirdcageError where it is not."""
    dish.station.submit(Watch(holder, frozenset({POSITION}), 5.0))
    until = dish.now + REST_S
    while dish.state.motion is not None or dish.state.activity in MOVING:
        if dish.now >= until:
            break
        dish.look()
    rested = dish.now
    while dish.now < until:
        position = dish.state.position
        if position is not None and position.told_at >= rested:
            return position
        dish.look()
    raise BirdcageError(
        f"STOP was sent, and the dish was not seen at rest within {REST_S:.0f} s. If it moves, only the "
        f"{power_switch(dish.state.dish)} stops it.",
        reason=Reason.TIMEOUT,
    )


def _turned(dish: StationCommand, feature: str, before: Pointing | None, after: Pointing) -> MotorTurned:
    facts = dish.state.dish
    held = None if facts is None else facts.features[feature].held
    assert facts is not None, "it has just run"
    assert held is not None, "it has just run"
    assert before is not None, "it has just run"
    if held.axis == facts.azimuth.name:
        start_deg, end_deg = before.dish_az_deg, after.dish_az_deg
        by_deg = shortest_turn(start_deg, end_deg)
    else:
        start_deg, end_deg = before.dish_el_deg, after.dish_el_deg
        by_deg = end_deg - start_deg
    if abs(by_deg) <= STILL_DEG:
        raise BirdcageError(
            f"The {held.axis} was not seen to turn: {start_deg:.2f}° before, {end_deg:.2f}° after. STOP was sent. "
            "Either the motor does not turn, or its encoder does not count.",
            reason=Reason.FAILED,
        )
    return MotorTurned(held.axis, by_deg, after)
