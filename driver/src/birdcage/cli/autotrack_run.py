"""Follows the passes of the favourites, one after the other, until the command is ended."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError, Held
from birdcage.base.reason import Reason
from birdcage.cli.autotrack_report import tell_schedule, values_of_schedule
from birdcage.cli.desk_elsewhere import DeskElsewhere
from birdcage.cli.dish import DishSession, need_position
from birdcage.cli.exits import EndedBySignal
from birdcage.cli.say import say, tell_json
from birdcage.cli.track_shown import PursuitShown
from birdcage.pursuit.desk import PursuitDesk
from birdcage.pursuit.desk_setup import DeskSetup
from birdcage.station.events import Event, Followed, PursuitChanged
from birdcage.station.pursuit_state import Phase

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.cli.station_command import StationCommand
    from birdcage.pursuit.attached_desk import AttachedDesk
    from birdcage.pursuit.now import Scheduled
    from birdcage.sky.observer import Observer
    from birdcage.station.pursuit_state import Pursuit

HOLDER = "birdcage autotrack"
END_S = 10.0
"""How long a pursuit may take to end that was left: the move under way comes to rest."""
_BETWEEN = frozenset({Phase.WAITING, Phase.COUNTDOWN, Phase.OVER})


def run_autotrack(
    dish: StationCommand, wants: Wanted, observer: Observer, until: datetime | None, *, as_json: bool
) -> None:
    """Follow until that time; the pass under way then is followed to its end. Without a time until a signal ends it.

    PositionUnknown when the dish does not know where it is; Held when somebody calls STOP.
    """
    if isinstance(dish, DeskElsewhere):
        _run_there(dish, wants, until, as_json=as_json)
    elif isinstance(dish, DishSession):
        _run_here(dish, wants, observer, until, as_json=as_json)


def _run_there(dish: DeskElsewhere, wants: Wanted, until: datetime | None, *, as_json: bool) -> None:
    dish.come_up(15.0)
    need_position(dish)
    dish.meet_desk()
    dish.desk.set_autotrack(True)
    say(f"{dish.station.via} follows them. Ctrl+C stops the dish; if this command ends otherwise, that goes on.")
    try:
        _Watch(dish, dish.desk, dish.holder, wants.settings.autotrack.hours, until, as_json=as_json).run()
    except (BirdcageError, EndedBySignal):
        if not dish.leave_moving:
            dish.desk.set_autotrack(False)
        raise


def _run_here(
    dish: DishSession, wants: Wanted, observer: Observer, until: datetime | None, *, as_json: bool
) -> None:  # fmt: skip
    dish.come_up(15.0)
    dish.survey()
    need_position(dish)
    setup = DeskSetup(
        wants.paths.catalogue, lambda: wants.settings, wants.paths, observer, dish.state.demo, holder=HOLDER,
        takes_up=False,
    )  # fmt: skip
    desk = PursuitDesk(dish.station, dish.session.clock, setup, lambda _now: None)
    desk.start()
    try:
        desk.set_autotrack(True)
        _Watch(dish, desk, HOLDER, wants.settings.autotrack.hours, until, as_json=as_json).run()
    finally:
        desk.close()


class _Watch:
    """Watches autotrack at work."""

    def __init__(
        self, dish: StationCommand, desk: PursuitDesk | AttachedDesk, holder: str, hours: float,
        until: datetime | None, *, as_json: bool,
    ) -> None:  # fmt: skip
        self._dish, self._desk, self._holder = dish, desk, holder
        self._hours, self._until, self._as_json = hours, until, as_json
        self._shown = PursuitShown(dish.progress, as_json=as_json)
        self._pursuit: Pursuit | None = None
        self._problem = ""
        self._rows: tuple[Scheduled, ...] = ()

    def run(self) -> None:
        """Watch until the time is over."""
        while not self._is_enough():
            self._look()
        self._desk.set_autotrack(False)
        self._desk.leave()
        deadline = self._dish.now + END_S
        while self._is_live() and self._dish.now < deadline:
            self._look()

    def _look(self) -> None:
        self._dish.look(self._hear)
        if self._desk.crash is not None:
            raise self._desk.crash
        if isinstance(self._dish, DeskElsewhere):
            self._dish.check_desk()
        held = self._dish.state.held
        if held is not None and held.earlier:
            raise Held(f"{held.sentence} Nothing is followed: `birdcage release` lets it move again.")
        if held is not None:
            raise Held(f"{held.sentence} Nothing is followed any more.", reason=Reason.STOPPED)
        now, utc = self._desk.now, self._dish.station.clock.utc()
        if now.problem != self._problem:
            self._problem = now.problem
            if now.problem:
                self._dish.progress.clear()
                say(now.problem)
        kept = tuple(row for row in now.schedule if row.kept)
        if kept and not self._rows:
            self._dish.progress.clear()
            self._tell(now.schedule, utc)
        self._rows = self._rows or kept
        if self._pursuit is not None and self._pursuit.phase not in (Phase.FOLLOWING, Phase.OVER):
            self._shown.waiting(self._pursuit, utc)

    def _tell(self, rows: tuple[Scheduled, ...], utc: datetime) -> None:
        if self._as_json:
            tell_json({"event": "schedule", **values_of_schedule(rows, utc, self._hours)})
            return
        from birdcage.cli.table import room

        tell_schedule(rows, utc, self._hours, room())

    def _is_live(self) -> bool:
        return self._pursuit is not None and self._pursuit.phase is not Phase.OVER

    def _is_enough(self) -> bool:
        """Return whether the time is over, and the dish not on a pass."""
        if self._until is None or self._dish.station.clock.utc() < self._until:
            return False
        return self._pursuit is None or self._pursuit.phase in _BETWEEN

    def _hear(self, event: Event) -> None:
        if isinstance(event, PursuitChanged) and event.pursuit.holder == self._holder:
            before, self._pursuit = self._pursuit, event.pursuit
            if before is None or before.number != event.pursuit.number:
                self._dish.progress.clear()
                say(f"{event.utc:%H:%M:%S} next: {event.pursuit.plan.aim.name}")
            self._shown.plan(event.pursuit, event.utc)
            self._shown.phase(event.pursuit, event.utc)
            was_over = before is not None and before.number == event.pursuit.number and before.phase is Phase.OVER
            if event.pursuit.phase is Phase.OVER and not was_over:
                self._shown.end(event.pursuit, event.utc)
        elif isinstance(event, Followed) and self._pursuit is not None and event.number == self._pursuit.number:
            self._shown.sample(event.sample, self._pursuit)
