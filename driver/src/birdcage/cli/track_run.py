"""Follows a target for the length of one command."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import TYPE_CHECKING, Literal

from birdcage.base.errors import BirdcageError, MotionRefused
from birdcage.base.reason import Reason
from birdcage.cli.desk_elsewhere import DeskElsewhere
from birdcage.cli.dish import DishSession, need_position
from birdcage.cli.say import say
from birdcage.cli.track_shown import PursuitShown
from birdcage.pursuit.desk import PursuitDesk
from birdcage.pursuit.desk_setup import DeskSetup
from birdcage.pursuit.follower import reach_end, told_reach_end
from birdcage.pursuit.now import Mode
from birdcage.station.events import Event, Followed, PursuitChanged
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.cli.station_command import StationCommand
    from birdcage.pursuit.attached_desk import AttachedDesk
    from birdcage.pursuit.desk_setup import ControllerName
    from birdcage.sky.made_up_pass import PassWish
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Target
    from birdcage.station.pursuit_state import Pursuit

HOLDER = "birdcage track"
BEGIN_S = 30.0
"""How long the plan may take, and the station to take it on."""
EARLY_S = 1.0
"""So much before the end of its last leg a pursuit may be over that came to its end."""
FIRST_MOVE_S = 300.0
"""How long a move from an unknown direction may take."""
END_S = 10.0
"""How long an end that was asked for may take: the move under way comes to rest."""


@dataclass(frozen=True, slots=True)
class TrackOrder:
    """What is to be followed, and how."""

    text: str
    target: Target | PassWish
    """Or what a made-up pass is to be like: it is laid once the dish is ready for it."""
    observer: Observer
    controller: ControllerName | None = None
    time_offset_s: float | None = None
    freq_hz: float | None = None
    until: Literal["los", "reach"] | datetime = "los"
    as_json: bool = False


def follow(dish: StationCommand, wants: Wanted, order: TrackOrder) -> None:
    """Follow until it is over. PositionUnknown, MotionRefused or BirdcageError when it does not come to its end."""
    if isinstance(dish, DeskElsewhere):
        _follow_there(dish, order)
    elif isinstance(dish, DishSession):
        _follow_here(dish, wants, order)


def _follow_there(dish: DeskElsewhere, order: TrackOrder) -> None:
    dish.come_up(15.0)
    need_position(dish)
    dish.meet_desk()
    dish.desk.choose(order.text, _target(dish, order))
    dish.await_desk(lambda: dish.desk.now.choice == order.text)
    _give(dish.desk, order)
    say(f"{dish.station.via} follows it. Ctrl+C stops the dish; if this command ends otherwise, that goes on.")
    _Watch(dish, dish.desk, order, dish.holder).run()


def _target(dish: StationCommand, order: TrackOrder) -> Target:
    from birdcage.sky.made_up_pass import PassWish

    if isinstance(order.target, PassWish):
        return synthetic(order.target, dish.station.clock.utc(), order.observer)
    return order.target


def synthetic(wish: PassWish, now: datetime, observer: Observer) -> Target:
    """Return a satellite that makes such a pass. OutOfRange where none does."""
    from birdcage.sky.made_up_pass import made_up_pass
    from birdcage.sky.targets.model import Satellite

    return Satellite(made_up_pass(wish, now, observer))


def _give(desk: PursuitDesk | AttachedDesk, order: TrackOrder) -> None:
    """Order what comes after the choice."""
    if order.time_offset_s is not None:
        desk.set_time_offset(order.time_offset_s)
    if order.freq_hz is not None:
        desk.set_frequency(order.freq_hz)
    desk.follow()


def _follow_here(dish: DishSession, wants: Wanted, order: TrackOrder) -> None:
    dish.come_up(15.0)
    dish.survey()
    facts = dish.state.dish
    begins_unknown = dish.state.awaits_first_move and facts is not None and not facts.no_following
    if not begins_unknown:
        need_position(dish)
    setup = DeskSetup(
        wants.paths.catalogue, lambda: wants.settings, wants.paths, order.observer, dish.state.demo, order.controller,
        HOLDER, takes_up=False,
    )  # fmt: skip
    desk = PursuitDesk(dish.station, dish.session.clock, setup, lambda _now: None)
    try:
        desk.choose(order.text, _target(dish, order))
        if begins_unknown:
            desk.start()
            _go_to_its_start(dish, desk)
            _give(desk, order)
        else:
            _give(desk, order)
            desk.start()  # so that the first thing it tells is what came of all of that
        _Watch(dish, desk, order, HOLDER).run()
    finally:
        desk.close()


def _go_to_its_start(dish: DishSession, desk: PursuitDesk) -> None:
    """Send a dish that tells no position to where it waits for the target; from then on its position is modelled."""
    deadline = dish.now + BEGIN_S
    while desk.now.plan is None and not desk.now.problem:
        if dish.now >= deadline:
            raise BirdcageError(f"There was no plan within {BEGIN_S:.0f} s.", reason=Reason.TIMEOUT)
        dish.look()
        if desk.crash is not None:
            raise desk.crash
    place = None if desk.now.plan is None else desk.now.plan.preposition
    if place is None:
        need_position(dish)
        return
    az_deg, el_deg = place.true_az_deg, place.true_el_deg
    say(f"This dish does not tell where it points. It first goes to azimuth {az_deg:.1f}°, elevation {el_deg:.1f}°.")
    dish.ask(Goto(az_deg, el_deg, HOLDER, clamp=True), FIRST_MOVE_S)


class _Watch:
    """Watches one pursuit from its beginning to its end."""

    def __init__(
        self, dish: StationCommand, desk: PursuitDesk | AttachedDesk, order: TrackOrder, holder: str
    ) -> None:  # fmt: skip
        self._dish, self._desk, self._order, self._holder = dish, desk, order, holder
        before = dish.state.pursuit
        self._before = 0 if before is None else before.number
        self._shown = PursuitShown(dish.progress, as_json=order.as_json)
        self._pursuit: Pursuit | None = None
        self._left = False
        """Whether its end was asked for here."""

    def run(self) -> None:
        """Wait for the end."""
        self._begin()
        deadline = float("inf")
        while self._pursuit is None or self._pursuit.phase is not Phase.OVER:
            self._dish.look(self._hear)
            self._look_at_desk()
            if self._pursuit is not None and self._pursuit.phase is not Phase.FOLLOWING:
                self._shown.waiting(self._pursuit, self._dish.station.clock.utc())
            if not self._left and self._is_enough():
                self._left, deadline = True, self._dish.now + END_S
                self._desk.leave()
            if self._dish.now >= deadline:
                raise BirdcageError(f"The pursuit did not end within {END_S:.0f} s.", reason=Reason.TIMEOUT)
        clock = self._dish.station.clock
        now = clock.utc()
        self._shown.end(self._pursuit, now)
        end = reach_end(self._pursuit.plan)
        early = end is None or now < end - timedelta(seconds=EARLY_S * clock.rate)
        if not self._left and (self._dish.state.held is not None or early):
            raise BirdcageError(self._pursuit.why, reason=Reason.ENDED)

    def _begin(self) -> None:
        """Wait until the station has taken it on."""
        deadline = self._dish.now + BEGIN_S
        while self._pursuit is None:
            if self._dish.now >= deadline:
                raise BirdcageError(f"Nothing started within {BEGIN_S:.0f} s.", reason=Reason.TIMEOUT)
            self._dish.look(self._hear)
            self._look_at_desk()

    def _look_at_desk(self) -> None:
        if self._desk.crash is not None:
            raise self._desk.crash
        if isinstance(self._dish, DeskElsewhere):
            self._dish.check_desk()
        now = self._desk.now
        if self._pursuit is None and now.problem and now.mode is not Mode.FOLLOW:
            raise MotionRefused(now.problem, reason=Reason.LIMIT)

    def _is_enough(self) -> bool:
        until, pursuit = self._order.until, self._pursuit
        if pursuit is None or until == "los":
            return False
        end = told_reach_end(pursuit.plan) if until == "reach" else until
        return isinstance(end, datetime) and self._dish.station.clock.utc() >= end

    def _is_ours(self, pursuit: Pursuit) -> bool:
        return pursuit.holder == self._holder and pursuit.number > self._before

    def _hear(self, event: Event) -> None:
        if isinstance(event, PursuitChanged) and self._is_ours(event.pursuit):
            self._pursuit = event.pursuit
            self._shown.plan(event.pursuit, event.utc)
            self._shown.phase(event.pursuit, event.utc)
        elif isinstance(event, Followed):
            self._shown.sample(event.sample, self._pursuit)
