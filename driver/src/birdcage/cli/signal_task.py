"""A task that goes by the signal, begun and followed to its end by a command."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from birdcage.base.config.signals import OWN_TUNER
from birdcage.base.errors import BirdcageError, CommandRefused, LinkError, PositionUnknown
from birdcage.base.reason import Reason
from birdcage.cli.dish import need_position
from birdcage.cli.say import bar
from birdcage.signal.slots_heard import seen_from
from birdcage.sky.observer import Observer
from birdcage.station.events import TaskChanged
from birdcage.station.requests import BeginTask
from birdcage.station.state import LinkPhase
from birdcage.station.task_state import TaskPhase, TaskValue

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.cli.station_command import StationCommand
    from birdcage.signal.slots_heard import SlotSeen
    from birdcage.station.events import Event
    from birdcage.station.state import Pointing
    from birdcage.station.task_state import TaskState

LINK_TOLD_S = 0.3


def ready_dish(dish: StationCommand, source: str | None, *, named: bool) -> tuple[Pointing | None, float]:
    """Wait for a dish that can be led by this source; return where it points, and the width of its beam or 0.

    A dish that tells where it points only once it has moved has None, where a target is `named` to send it to.
    `source` None: it is to sweep and listen by itself. CommandRefused where it can't, or where the source is the dish's
    own tuner, and it has none; what `need_position` raises.
    """
    dish.come_up(15.0)
    facts, beam = dish.state.dish, dish.state.beam
    if source is None and facts is not None and facts.no_sweep:
        raise CommandRefused(f"{facts.no_sweep} Nothing was sent.", reason=Reason.UNSUPPORTED)
    if source == OWN_TUNER and facts is not None and not facts.has_rssi:
        words = f"The {facts.name} has no tuner to read. With --source your receiver is heard. Nothing was sent."
        raise CommandRefused(words, reason=Reason.UNSUPPORTED)
    try:
        need_position(dish)
    except PositionUnknown as unknown:
        if not dish.state.awaits_first_move:
            raise
        if not named:
            words = "This dish tells where it points only once it has moved. Name a TARGET. Nothing was sent."
            raise PositionUnknown(words, reason=Reason.UNTOLD) from unknown
    return dish.state.position, 0.0 if beam is None else beam.mean_deg


def known_slots(wants: Wanted) -> Sequence[SlotSeen]:
    """Return the slots that may be heard where the dish stands; none where no place is set."""
    place = wants.settings.place
    if place.latitude_deg is None or place.longitude_deg is None:
        return ()
    observer = Observer(place.latitude_deg, place.longitude_deg, place.height_m)
    return seen_from(observer, wants.settings.tracking.refraction)


def follow_task(
    dish: StationCommand, kind: str, values: Mapping[str, TaskValue], holder: str, takes_s: float,
    doing: str | Callable[[TaskState], str],
    show: Callable[[TaskState], object] | None = None,
) -> TaskState:  # fmt: skip
    """Have the station do it, show how far it is, and return how it ended.

    `doing` is what is shown, with `{}` for how many are done and of how many, or makes it; `show` is told of each
    change.
    BirdcageError where it can't be begun, or is cut short, or takes longer than `takes_s`; LinkError where it ended
    with the link.
    """
    ended: dict[int, TaskState] = {}
    """By number: another program may have a task of this kind, and this one may be over before its number is known."""

    def hear(event: Event) -> None:
        if isinstance(event, TaskChanged) and event.task.kind == kind:
            if show is not None:
                dish.progress.clear()
                show(event.task)
            done, of = event.task.done or 0, event.task.of
            words = doing.format(done, of) if isinstance(doing, str) else doing(event.task)
            dish.progress.show(f"{bar(done, of)} {words}" if of else words)
            if event.task.phase is TaskPhase.OVER:
                ended[event.task.number] = event.task

    number = dish.ask(BeginTask(kind, values, holder), 30.0, hear)
    assert isinstance(number, int), "a task that has begun has one"
    deadline = dish.now + takes_s
    while number not in ended:
        if dish.now > deadline:
            raise BirdcageError(f"Not finished within {takes_s:.0f} s.", reason=Reason.TIMEOUT)
        dish.look(hear)
    dish.progress.clear()
    if not ended[number].is_done:
        raise (LinkError if is_lost(dish) else BirdcageError)(ended[number].why)
    return ended[number]


def is_lost(dish: StationCommand) -> bool:
    """Return whether the link is: that may be told a moment after the end of what it has ended."""
    until = dish.now + LINK_TOLD_S
    while dish.state.link.state is LinkPhase.UP and dish.now < until:
        dish.look()
    return dish.state.link.state is not LinkPhase.UP
